; A product is the sum of the products of the parts of b, with their weights: so product.sv and long_product.sv
; multiply.
(declare-const a Int) (declare-const x Int) (declare-const y Int) (declare-const z Int) (declare-const b Int)
(assert (= b (+ x (* 64 y) (* 4096 z))))
(assert (not (= (* a b) (+ (* a x) (* 64 (* a y)) (* 4096 (* a z))))))
(check-sat-using (then simplify solve-eqs (using-params simplify :som true) smt))
