; == r0-cannot-end-radius-compensation-c
; 6:13 alarm: R0 cannot end the radius compensation in C (write it in a straight line L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 L X+9
4 C X+9 Y+5 R0 DR+

; == rl-cannot-begin-radius-compensation-c
; 4:9 alarm: RL cannot begin the radius compensation in C (write it in a straight line L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 C X+5 RL DR+

; == rl-cannot-begin-radius-compensation-ct
; 5:14 alarm: RL cannot begin the radius compensation in CT (write it in a straight line L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT X+9 Y+9 RL

; == rl-cannot-begin-radius-compensation-fc
; 4:13 alarm: RL cannot begin the radius compensation in FC (write it in a straight line L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC DR+ R5 RL

; == rl-no-meaning-this-block-2
; 14:29 alarm: RL has no meaning in this block
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
4 CYCL CALL POS X+1 Y+2 Z+2 RL

; == rl-no-meaning-this-block
; 6:15 alarm: RL has no meaning in this block (DEP LT does not take RL)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP LT LEN5 RL

; == rl-rr-stand-one-block-one
; 4:12 alarm: RL and RR stand in one block: one of R0, RL, RR is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL RR

; == rr-cannot-begin-radius-compensation-cp
; 5:16 alarm: RR cannot begin the radius compensation in CP (write it in a straight line L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP PA+30 DR+ RR

; == side-compensation-cannot-change-one-element
; 6:1 alarm: the side of the compensation cannot change from one element to the next (write a straight line without compensation between them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 L Y+9 RR
5 L Y+30
