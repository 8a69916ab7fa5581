; == q200-written-twice-this-block-2
; 9:1 alarm: Q200 is written twice in this block (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 100 GENERAL
Q200=3 ;A
Q204=40 ;B
Q253=750 ;C
Q208=1000 ;D
Q200=5
99 END PGM A MM

; == q200-written-twice-this-block
; 13:1 alarm: Q200 is written twice in this block (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=250
Q202=5
Q210=0
Q203=0
Q204=20
Q211=0
Q200=2

; == q201-5-no-meaning-this-block
; 9:1 alarm: Q201=5 has no meaning in this block (GLOBAL DEF 100 does not take Q201) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 100 GENERAL
Q200=3 ;A
Q204=40 ;B
Q253=750 ;C
Q208=1000 ;D
Q201=5
99 END PGM A MM

; == q201-auto-number
; 5:1 alarm: CYCL DEF 200 Q200 (set-up clearance) must be a number, got FMAX
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 X
Q200=MAX

; == q210-no-equals
; 9:1 alarm: Q210 has no = before its value (write Q210=+0)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=150
Q202=5
Q210 +0
Q203=0
Q204=20
Q211=0
