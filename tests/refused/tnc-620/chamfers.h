; == chamfer-2-mm-needs-both-its
; 5:1 alarm: a chamfer of 2 mm needs both its elements in the working plane
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 2
4 L Z-3
5 L Y+5

; == chamfer-2-mm-needs-path-element
; 5:1 alarm: a chamfer of 2 mm needs a path element after it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF 2

; == chamfer-2-mm-needs-straight-line
; 5:1 alarm: a chamfer of 2 mm needs a straight line before and after it (round a corner with RND)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 2
4 CR X+9 Y+10 R+5 DR+

; == chamfer-2-mm-no-place-where
; 5:1 alarm: a chamfer of 2 mm has no place where the path runs straight back
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 2
4 L X+2

; == chamfer-6-mm-does-not-fit-2
; 5:1 alarm: a chamfer of 6 mm does not fit between its elements, which are too short for it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 6
4 L Y+5

; == chamfer-6-mm-does-not-fit
; 5:1 alarm: a chamfer of 6 mm does not fit between its elements, which are too short for it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF 6
4 L Y+9

; == chamfer-7-mm-does-not-fit
; 7:1 alarm: a chamfer of 7 mm does not fit between its elements, which are too short for it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 3
4 L Y+9
5 CHF 7
6 L X+0

; == chf-f-greater-than-0-got
; 5:9 alarm: CHF F (feed rate) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF 2 F0
4 L Y+9

; == chf-greater-than-0-got-0
; 5:7 alarm: CHF (chamfer side length) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF 0

; == chf-greater-than-0-got-2
; 5:7 alarm: CHF (chamfer side length) must be greater than 0, got -2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF -2
4 L Y+9

; == chf-needs-chamfer-side-length
; 5:1 alarm: CHF needs the chamfer side length
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF

; == chf-needs-path-element-directly-before
; 4:7 alarm: CHF needs a path element directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CHF 2
