; == rnd-needs-path-element-directly-before-2
; 6:7 alarm: RND needs a path element directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 2
4 RND R2
5 L Y+9

; == rnd-needs-path-element-directly-before-3
; 5:7 alarm: RND needs a path element directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+5 Y+0 LEN5 RL
3 RND R2
4 L X+20

; == rnd-needs-path-element-directly-before-4
; 6:7 alarm: RND needs a path element directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 Y+5
3 RND R1
4 RND R1
5 FL X+9 Y+0

; == rnd-needs-path-element-directly-before
; 4:7 alarm: RND needs a path element directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 RND R5

; == rounding-r2-needs-both-its-elements
; 5:1 alarm: a rounding of R2 needs both its elements in the working plane
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10
3 RND R2
4 L Z-5
5 L Y+10

; == rounding-r2-stands-between-two-rapid
; 5:1 alarm: a rounding of R2 stands between two rapid moves and needs a feed (write F in its block)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 FMAX
3 RND R2
4 L Y+5 FMAX

; == rounding-r5-does-not-fit-between
; 5:1 alarm: a rounding of R5 does not fit between its elements, which are too short for it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+4
3 RND R5
4 L Y+4

; == rounding-r5-needs-path-element-after
; 5:1 alarm: a rounding of R5 needs a path element after it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10
3 RND R5
