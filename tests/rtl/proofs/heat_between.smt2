; The heat of a mixture lies between those of its parts (docs/automaton.md, section 2). q and r are quotient and
; rest, as mixer.sv proves them, and d is amount x dither >> 16.
(declare-const a Int) (declare-const f Int) (declare-const h Int) (declare-const g Int)
(declare-const d Int) (declare-const q Int) (declare-const r Int)
(assert (and (>= a 0) (> f 0) (<= 0 h g)))
(assert (and (<= 0 d) (< d (+ a f))))
(assert (and (<= 0 r) (< r (+ a f))))
(assert (= (+ (* q (+ a f)) r) (+ (* a h) (* f g) d)))
(assert (not (and (<= h q) (<= q g))))
(check-sat)
