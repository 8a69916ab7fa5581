; == cycl-call-pat-cycle-called-position
; 15:1 alarm: CYCL CALL PAT: a cycle is called at a position without radius compensation (write R0 in the block before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=250
Q202=0
Q210=0
Q203=0
Q204=20
Q211=0
3 L X+50 RL F100 M3
4 PATTERN DEF POS1 (X+10 Y+10 Z+0) POS2 (X+30 Y+10 Z+0)
5 CYCL CALL PAT

; == cycl-call-pat-no-cycle-call
; 4:1 alarm: CYCL CALL PAT has no cycle to call (define one before, for example CYCL DEF 200)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL CALL PAT

; == cycl-call-pat-no-pattern
; 14:1 alarm: CYCL CALL PAT has no pattern (write PATTERN DEF or SEL PATTERN before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=250
Q202=0
Q210=0
Q203=0
Q204=20
Q211=0
3 L Z+50 R0 FMAX M3
4 CYCL CALL PAT

; == pattern-circ1-d-least-0-got
; 4:30 alarm: PATTERN DEF CIRC1 D (diameter) must be at least 0, got -3
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF CIRC1 (X+5 Y+0 D-3 START+0 NUM2 Z+0)
99 END PGM A MM

; == pattern-circ1-start-missing
; 4:15 alarm: PATTERN DEF CIRC1 START (starting angle) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF CIRC1 (X+5 Y+0 D+3 NUM2 Z+0)
99 END PGM A MM

; == pattern-frame1-numy-whole-number-1
; 4:47 alarm: PATTERN DEF FRAME1 NUMY (number of rows) must be a whole number from 1 to 100000, got -1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF FRAME1 (X+0 Y+0 DX+1 DY+1 NUMX3 NUMY-1 ROT+0 ROTX+0 ROTY+0 Z+0)
99 END PGM A MM

; == pattern-more-than-100000-points
; 4:80 alarm: PATTERN DEF has more than 100000 points
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF PAT1 (X+0 Y+0 DX+1 DY+1 NUMX1000 NUMY90 ROT+0 ROTX+0 ROTY+0 Z+0) PAT2 (X+0 Y+0 DX+1 DY+1 NUMX1000 NUMY90 ROT+0 ROTX+0 ROTY+0 Z+0)
99 END PGM A MM

; == pattern-more-than-9-elements-pos
; 14:1 alarm: PATTERN DEF has more than 9 elements POS
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF
POS1 (X+1 Y+0 Z+0)
POS2 (X+2 Y+0 Z+0)
POS3 (X+3 Y+0 Z+0)
POS4 (X+4 Y+0 Z+0)
POS5 (X+5 Y+0 Z+0)
POS6 (X+6 Y+0 Z+0)
POS7 (X+7 Y+0 Z+0)
POS8 (X+8 Y+0 Z+0)
POS9 (X+9 Y+0 Z+0)
POS10 (X+10 Y+0 Z+0)
99 END PGM A MM

; == pattern-needs-least-one-pos-row
; 4:1 alarm: PATTERN DEF needs at least one of POS, ROW, PAT, FRAME, CIRC, PITCHCIRC
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF
99 END PGM A MM

; == pattern-one-pos-row-pat-frame
; 4:15 alarm: a pattern must be one of POS, ROW, PAT, FRAME, CIRC, PITCHCIRC (for example POS1 (X+10 Y+20 Z+0))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF STAR1 (X+5)
99 END PGM A MM

; == pattern-pat1-more-than-100000-positions
; 4:15 alarm: PATTERN DEF PAT1 has more than 100000 positions
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF PAT1 (X+0 Y+0 DX+1 DY+1 NUMX1000 NUMY1000 ROT+0 ROTX+0 ROTY+0 Z+0)
99 END PGM A MM

; == pattern-pat1-numx-whole-number-1
; 4:39 alarm: PATTERN DEF PAT1 NUMX (number of columns) must be a whole number from 1 to 100000, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF PAT1 (X+0 Y+0 DX+1 DY+1 NUMX0 NUMY3 ROT+0 ROTX+0 ROTY+0 Z+0)
99 END PGM A MM

; == pattern-pitchcirc1-both-step-end
; 4:54 alarm: PATTERN DEF PITCHCIRC1 has both STEP and END (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF PITCHCIRC1 (X+5 Y+0 D+3 START+0 STEP+5 END+9 NUM2 Z+0)
99 END PGM A MM

; == pattern-pitchcirc1-step-missing
; 4:15 alarm: PATTERN DEF PITCHCIRC1 STEP (stepping angle) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF PITCHCIRC1 (X+5 Y+0 D+3 START+0 NUM2 Z+0)
99 END PGM A MM

; == pattern-pos1-does-not-take-d
; 4:29 alarm: PATTERN DEF POS1 does not take D (it takes X Y Z)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (X+5 Y+0 D+3 Z+0)
99 END PGM A MM

; == pattern-pos1-its-bracket-not-closed-2
; 4:15 alarm: PATTERN DEF POS1: its bracket is not closed (write ))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (X+5 Y+0 Z
99 END PGM A MM

; == pattern-pos1-its-bracket-not-closed
; 4:15 alarm: PATTERN DEF POS1: its bracket is not closed (write ))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (X+5 Y+0 Z+0
99 END PGM A MM

; == pattern-pos1-stands-where-pos2-expected
; 5:1 alarm: PATTERN DEF POS1 stands where POS2 is expected
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (X+5 Y+0 Z+0)
POS1 (X+5 Y+0 Z+0)
99 END PGM A MM

; == pattern-pos1-x-absolute
; 4:21 alarm: PATTERN DEF POS1 X must be absolute (POS2 to POS9 may count from the one before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (IX+5 Y+0 Z+0)
99 END PGM A MM

; == pattern-pos1-x-written-twice
; 4:29 alarm: PATTERN DEF POS1 X is written twice (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (X+5 Y+0 X+3 Z+0)
99 END PGM A MM

; == pattern-pos1-z-missing
; 4:15 alarm: PATTERN DEF POS1 Z (workpiece surface) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (X+5 Y+0)
99 END PGM A MM

; == pattern-pos2-stands-where-pos1-expected
; 4:15 alarm: PATTERN DEF POS2 stands where POS1 is expected
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS2 (X+5 Y+0 Z+0)
99 END PGM A MM

; == pattern-row1-num-missing
; 4:15 alarm: PATTERN DEF ROW1 NUM (number of positions) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF ROW1 (X+5 Y+0 D+3 ROT+0 Z+0)
99 END PGM A MM

; == pattern-row1-num-whole-number-1-2
; 4:33 alarm: PATTERN DEF ROW1 NUM (number of positions) must be a whole number from 1 to 100000, got 2.5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF ROW1 (X+5 Y+0 D+3 NUM2.5 ROT+0 Z+0)
99 END PGM A MM

; == pattern-row1-num-whole-number-1-3
; 4:33 alarm: PATTERN DEF ROW1 NUM (number of positions) must be a whole number from 1 to 100000, got 200000
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF ROW1 (X+5 Y+0 D+3 NUM200000 ROT+0 Z+0)
99 END PGM A MM

; == pattern-row1-num-whole-number-1
; 4:33 alarm: PATTERN DEF ROW1 NUM (number of positions) must be a whole number from 1 to 100000, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF ROW1 (X+5 Y+0 D+3 NUM0 ROT+0 Z+0)
99 END PGM A MM

; == pattern-row1-x-absolute
; 4:21 alarm: PATTERN DEF ROW1 X must be absolute (POS2 to POS9 may count from the one before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF ROW1 (IX+5 Y+0 D+1 NUM2 ROT+0 Z+0)
99 END PGM A MM

; == pattern-with-tool-axis-y
; 16:1 alarm: CYCL CALL PAT: the points of a pattern lie in X and Y, the tool axis must be Z
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Y S100
3 L X+0 Y+50 Z+0 FMAX M3
4 CYCL DEF 200 D
Q200=2
Q201=-5
Q206=100
Q202=5
Q210=0
Q203=+0
Q204=20
Q211=0
5 PATTERN DEF POS1(X+1 Y+2 Z+0)
6 CYCL CALL PAT FMAX

; == pos-needs-its-number
; 4:15 alarm: POS needs its number (write POS1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS (X+5 Y+0 Z+0)
99 END PGM A MM

; == pos-needs-its-words-brackets
; 4:20 alarm: POS needs its words in brackets (write POS1 (X+… Y+…))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 X+5 Y+0 Z+0
99 END PGM A MM

; == w-no-word-pattern
; 4:29 alarm: W is no word of a pattern (X Y Z)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (X+5 Y+0 W+1)
99 END PGM A MM
