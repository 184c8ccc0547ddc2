; Four axes and four corners get no more than the cell holds: a share is at most a fifth (docs/automaton.md,
; section 14). gift_bound.sv takes this as given.
(declare-const a Int) (declare-const s Int) (declare-const f Int) (declare-const rest Int)
(assert (and (<= 0 a 65535) (<= 0 s 13107)))
(assert (= (* a s) (+ (* 65536 f) rest)))
(assert (and (<= 0 rest) (< rest 65536)))
(assert (not (and (<= 0 f) (<= (* 5 f) a))))
(check-sat)
