; == cycle-19-abst-missing-position-rotary
; 3:1 alarm: CYCL DEF 19 ABST (set-up clearance) is missing: to position the rotary axes both F and ABST are needed
TOOL CALL 1 Z S1000 F100
CYCL DEF 19.0 P
CYCL DEF 19.1 A+1 F100

; == cycle-19-f-greater-than-0
; 4:19 alarm: CYCL DEF 19 F (feed of the rotary axes) must be greater than 0 to position the rotary axes, got 0
TOOL CALL 1 Z S1000 F100
CYCL DEF 19.0 P
CYCL DEF 19.1 A+1 F0 ABST5

; == cycle-19-f-missing-position-rotary
; 3:1 alarm: CYCL DEF 19 F (feed of the rotary axes) is missing: to position the rotary axes both F and ABST are needed
TOOL CALL 1 Z S1000 F100
CYCL DEF 19.0 P
CYCL DEF 19.1 A+1 ABST5

; == cycle-19-least-360-most-360
; 4:15 alarm: CYCL DEF 19 A (tilt angle A) must be at least -360 and at most 360, got 361
TOOL CALL 1 Z S1000 F100
CYCL DEF 19.0 P
CYCL DEF 19.1 A+361

; == cycle-19-takes-no-incremental-value
; 4:15 alarm: CYCL DEF 19 takes no incremental value, got IA
TOOL CALL 1 Z S1000 F100
CYCL DEF 19.0 P
CYCL DEF 19.1 IA+1

; == cycle-19-with-tool-axis-x
; 5:1 alarm: CYCL DEF 19 with the tool axis X: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X
3 CYCL DEF 19.0 P
4 CYCL DEF 19.1 A+0 B+90 C+0

; == m130-tilted-plane-not-built
; 6:9 alarm: M130 in a tilted plane is not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 19.0 X
3 CYCL DEF 19.1 A+30
4 L X+5 M130

; == plane-euler-needs-eulnu
; 4:1 alarm: PLANE EULER needs EULNU (nutation, about X turned by it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE EULER EULPR+0 EULROT+0 STAY

; == plane-reset-mb-max-tilted-not-built
; 5:20 alarm: PLANE RESET MB MAX in a tilted plane is not built yet (with a distance, MB50, it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE SPATIAL SPA+0 SPB+90 SPC+0 TURN MB50 FMAX
3 PLANE RESET TURN MB MAX FMAX

; == plane-reset-needs-stay-move-turn
; 4:1 alarm: PLANE RESET needs STAY, MOVE or TURN (with STAY no axis moves)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE RESET

; == plane-reset-one-of-stay-move-turn
; 4:20 alarm: STAY and TURN stand in one block: one of STAY, MOVE, TURN is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE RESET STAY TURN

; == plane-reset-stay-takes-no-number
; 4:15 alarm: PLANE RESET STAY takes no number
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE RESET STAY 5

; == plane-reset-under-radius-compensation
; 5:15 alarm: PLANE RESET cannot change the plane under radius compensation (write R0 before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL F9
3 PLANE RESET STAY

; == plane-spatial-abst-for-move
; 4:41 alarm: PLANE SPATIAL ABST (how far below the tip the point is that stands still) is for MOVE: with TURN the axes move alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN ABST50 FMAX

; == plane-spatial-angle-from-to-360
; 4:23 alarm: PLANE SPATIAL SPB (tilt about Y) must be from -360 to 360, got 400
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE SPATIAL SPA+0 SPB+400 SPC+0 TURN FMAX

; == plane-spatial-mb-needs-move-turn
; 4:41 alarm: PLANE SPATIAL MB (retraction before the axes turn) needs MOVE or TURN: with STAY no axis moves
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE SPATIAL SPA+0 SPB+20 SPC+0 STAY MB5

; == plane-spatial-needs-spc
; 4:1 alarm: PLANE SPATIAL needs SPC (tilt about Z)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE SPATIAL SPA+0 SPB+0 STAY

; == plane-spatial-seq-and-sym
; 4:58 alarm: SEQ- and SYM+ stand in one block: one of SEQ, SYM is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE SPATIAL SPA+0 SPB+90 SPC+0 TURN MB MAX FMAX SEQ- SYM+

; == tool-axis-x-in-tilted-plane
; 6:15 alarm: TOOL CALL: the tool axis X cannot stand in a tilted working plane (reset cycle 19)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 19.0 P
3 CYCL DEF 19.1 A+0 B+90 C+0
4 TOOL CALL 1 X
