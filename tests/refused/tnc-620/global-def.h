; == global-100-q200-least-0-most
; 5:1 alarm: GLOBAL DEF 100 Q200 (set-up clearance) must be at least 0 and at most 99999.9999, got -3
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 100 GENERAL
Q200=-3 ;A
Q204=40 ;B
Q253=750 ;C
Q208=1000 ;D

99 END PGM A MM

; == global-100-q200-no-default-predef
; 5:1 alarm: GLOBAL DEF 100 Q200 (set-up clearance) has no default: PREDEF is not allowed (write its value)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 100 G
Q200=PREDEF
99 END PGM A MM

; == global-100-q200-number-got-fmax
; 5:1 alarm: GLOBAL DEF 100 Q200 (set-up clearance) must be a number, got FMAX
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 100 GENERAL
Q200=FMAX ;A
Q204=40 ;B
Q253=750 ;C
Q208=1000 ;D

99 END PGM A MM

; == global-100-q204-missing
; 4:1 alarm: GLOBAL DEF 100 Q204 (second set-up clearance) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 100 G
Q200=3
99 END PGM A MM

; == global-101-not-function-this-control
; 4:1 alarm: GLOBAL DEF 101 is not a function of this control (near: GLOBAL DEF 110, GLOBAL DEF 100, GLOBAL DEF 105)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 101 P
99 END PGM A MM

; == global-105-q211-least-0-most
; 7:1 alarm: GLOBAL DEF 105 Q211 (dwell at the bottom) must be at least 0 and at most 3600, got 4000
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 105 DRILLING
Q256=0.2
Q210=0.3
Q211=4000

99 END PGM A MM

; == global-110-q351-one-1-1
; 6:1 alarm: GLOBAL DEF 110 Q351 (sense of milling) must be one of 1, -1, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 110 P
Q370=1
Q351=0
Q366=0
99 END PGM A MM

; == global-110-q370-least-0-0001
; 5:1 alarm: GLOBAL DEF 110 Q370 (path overlap factor) must be at least 0.0001 and at most 1.9999, got 2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 110 P
Q370=2
Q351=1
Q366=0
99 END PGM A MM

; == global-111-q9-one-1-1
; 8:1 alarm: GLOBAL DEF 111 Q9 (sense of milling) must be one of 1, -1, got 2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 111 C
Q2=1
Q6=2
Q7=50
Q9=2
99 END PGM A MM

; == global-120-q301-one-0-1
; 7:1 alarm: GLOBAL DEF 120 Q301 (height between measuring points) must be one of 0, 1, got 2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 120 P
Q320=0
Q260=100
Q301=2
99 END PGM A MM

; == global-125-q345-one-0-1
; 5:1 alarm: GLOBAL DEF 125 Q345 (positioning height between points) must be one of 0, 1, got 2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 125 P
Q345=2
99 END PGM A MM

; == global-needs-number-cycle
; 4:13 alarm: GLOBAL DEF needs the number of a cycle
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF
99 END PGM A MM
