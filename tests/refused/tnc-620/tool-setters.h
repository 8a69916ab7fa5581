; == tch-probe-31-without-mode
; 5:18 alarm: a number is missing: the mode 0, 1 or 2
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 31.0 X
3 TCH PROBE 31.1 CHECK:
9 END PGM P MM

; == tch-probe-32-needs-its-last-block
; 4:1 alarm: TCH PROBE 32 PROBING THE TEETH (whether each tooth is measured) is missing
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 32.0 X
3 TCH PROBE 32.1 CHECK: 1 Q5
4 TCH PROBE 32.2 HEIGHT: +90
9 END PGM P MM

; == tch-probe-33-two-status-parameters
; 5:30 alarm: 'Q' has no meaning here
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 33.0 X
3 TCH PROBE 33.1 CHECK: 1 Q5 Q6
9 END PGM P MM

; == tch-probe-480-needs-q260
; 4:1 alarm: TCH PROBE 480 Q260 (clearance height) is missing
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 480 X
9 END PGM P MM

; == tch-probe-480-no-setter
; 4:1 alarm: TCH PROBE 480 needs a tool setter, a plate: Setup(setter=mnclab.Setter(…))
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 480 X
Q260=+100
9 END PGM P MM

; == tch-probe-480-q260-too-high
; 5:1 alarm: TCH PROBE 480 Q260 (clearance height) must be at least -99999.9999 and at most 99999.9999, got 100000
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 480 X
Q260=+100000
9 END PGM P MM

; == tch-probe-481-needs-q341
; 4:1 alarm: TCH PROBE 481 Q341 (whether each tooth is measured) is missing
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 481 X
Q340=1
Q260=+100
9 END PGM P MM

; == tch-probe-481-q340-3
; 5:1 alarm: TCH PROBE 481 Q340 (what becomes of the measured values) must be one of 0, 1, 2, got 3
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 481 X
Q340=3
Q260=+100
Q341=0
9 END PGM P MM

; == tch-probe-481-tool-axis-x
; 4:1 alarm: TCH PROBE 481 with the tool axis X: not built yet (with the tool axis Z it is)
0 BEGIN PGM P MM
1 TOOL CALL 1 X
2 TCH PROBE 481 X
Q340=1
Q260=+100
Q341=0
9 END PGM P MM

; == tch-probe-482-q341-2
; 7:1 alarm: TCH PROBE 482 Q341 (whether each tooth is measured) must be one of 0, 1, got 2
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 482 X
Q340=1
Q260=+100
Q341=2
9 END PGM P MM

; == tch-probe-483-no-setter
; 4:1 alarm: TCH PROBE 483 needs a tool setter, a plate: Setup(setter=mnclab.Setter(…))
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 483 X
Q340=1
Q260=+100
Q341=0
9 END PGM P MM

; == tch-probe-484-q536-2
; 5:1 alarm: TCH PROBE 484 Q536 (stop before running) must be one of 0, 1, got 2
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 484 X
Q536=2
9 END PGM P MM

; == tch-probe-484-takes-no-q260
; 6:1 alarm: Q260=9 has no meaning in this block (TCH PROBE 484 does not take Q260) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 484 X
Q536=1
Q260=9
9 END PGM P MM
