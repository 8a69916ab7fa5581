; == all-sub-blocks-cycle-marked-with
; 5:4 alarm: all sub-blocks of a cycle must be marked with / or none
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 D
/3 CYCL DEF 7.1 X+5

; == cycle-13-angle-least-0-most
; 4:15 alarm: CYCL DEF 13 ANGLE (angle of the spindle) must be at least 0 and at most 360, got 361
TOOL CALL 1 Z S200 F100
CYCL DEF 13.0 O
CYCL DEF 13.1 UNGHI 361

; == cycle-239-q570-missing
; 3:1 alarm: CYCL DEF 239 Q570 (what to do) is missing
TOOL CALL 1 Z S200 F100
CYCL DEF 239 L

; == cycle-239-q570-one-0-1
; 4:1 alarm: CYCL DEF 239 Q570 (what to do) must be one of 0, 1, got 2
TOOL CALL 1 Z S200 F100
CYCL DEF 239 L
Q570=2

; == cycle-310-refused-cycle-machine-tool
; 4:1 alarm: CYCL DEF 310 is refused: a cycle of the machine tool builder, whose manual alone describes it: leave it out where it moves nothing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 310

; == cycle-32-hsc-mode-one-0
; 5:15 alarm: CYCL DEF 32 HSC-MODE (filter) must be one of 0, 1, got 2
TOOL CALL 1 Z S200 F100
CYCL DEF 32.0 T
CYCL DEF 32.1 T1
CYCL DEF 32.2 HSC-MODE:2

; == cycle-32-t-least-0-most
; 4:15 alarm: CYCL DEF 32 T (permissible contour deviation) must be at least 0 and at most 10, got 10.1
TOOL CALL 1 Z S200 F100
CYCL DEF 32.0 T
CYCL DEF 32.1 T10.1

; == cycle-32-ta-least-0-most
; 5:15 alarm: CYCL DEF 32 TA (permissible deviation of rotary axes) must be at least 0 and at most 10, got -1
TOOL CALL 1 Z S200 F100
CYCL DEF 32.0 T
CYCL DEF 32.1 T1
CYCL DEF 32.2 TA-1

; == cycle-6-not-function-this-control
; 2:1 alarm: CYCL DEF 6 is not a function of this control (near: CYCL DEF 8, CYCL DEF 26, CYCL DEF 7)
1 CYCL DEF 6 X

; == cycle-9-dwell-least-0-most-2
; 4:14 alarm: CYCL DEF 9 DWELL (dwell) must be at least 0 and at most 3600, got -1
TOOL CALL 1 Z S200 F100
CYCL DEF 9.0 D
CYCL DEF 9.1 TEMP -1

; == cycle-9-dwell-least-0-most
; 4:14 alarm: CYCL DEF 9 DWELL (dwell) must be at least 0 and at most 3600, got 3601
TOOL CALL 1 Z S200 F100
CYCL DEF 9.0 D
CYCL DEF 9.1 DWELL 3601

; == cycle-9-dwell-missing
; 3:1 alarm: CYCL DEF 9 DWELL (dwell) is missing
TOOL CALL 1 Z S200 F100
CYCL DEF 9.0 D

; == cycle-9999-not-function-this-control
; 2:1 alarm: CYCL DEF 9999 is not a function of this control (near: CYCL DEF 9, CYCL DEF 209, CYCL DEF 29)
1 CYCL DEF 9999 X

; == cycle-needs-number-cycle
; 4:11 alarm: CYCL DEF needs the number of a cycle
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF
