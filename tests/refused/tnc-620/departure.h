; == dep-ct-cca-greater-than-0
; 6:10 alarm: DEP CT CCA (centre angle of the arc) must be greater than 0 and at most 360, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP CT CCA0 R3

; == dep-ct-needs-radius-compensation-without
; 6:1 alarm: DEP CT needs radius compensation: without a side it has no direction
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 L X+20
4 DEP CT CCA90 R3

; == dep-followed-one-lt-ln-ct
; 4:3 alarm: DEP must be followed by one of LT, LN, CT, LCT, PLCT
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 DEP LEN5

; == dep-lct-ends-inside-its-arc
; 6:1 alarm: DEP LCT ends inside of its arc of R30: no line touches the arc from there (take a smaller radius, or a point farther away)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP LCT X+20 Y+9 R30

; == dep-lct-needs-x-y-its
; 6:1 alarm: DEP LCT needs X and Y of its end
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP LCT R3 X+5

; == dep-ln-needs-radius-compensation-without
; 6:1 alarm: DEP LN needs radius compensation: without a side it has no direction
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 L X+20
4 DEP LN LEN3

; == dep-lt-cannot-follow-rnd-its
; 7:1 alarm: DEP LT cannot follow RND: its direction is that of the element before
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 RND R2
5 DEP LT LEN5

; == dep-lt-len-greater-than-0
; 6:10 alarm: DEP LT LEN (length of the line) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP LT LEN0

; == dep-lt-needs-len
; 6:1 alarm: DEP LT needs LEN (length of the line)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP LT

; == dep-lt-needs-path-element-directly
; 4:1 alarm: DEP LT needs a path element directly before it (whose end gives the direction)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 DEP LT LEN5

; == dep-lt-needs-path-element-working
; 7:1 alarm: DEP LT needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 L Z+5
5 DEP LT LEN5

; == dep-lt-rl-no-meaning
; 6:16 alarm: RL has no meaning in this block (DEP LT does not take RL)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL F9
3 L X+9
4 DEP LT LEN10 RL

; == dep-plct-needs-pole-no-cc
; 6:1 alarm: DEP PLCT needs a pole: no CC was programmed (write CC X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP PLCT PR+5 PA+0 R3

; == dep-plt-refused-it-names-no
; 6:1 alarm: DEP PLT is refused: it names no point that could be polar; write DEP LT
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP PLT LEN5
