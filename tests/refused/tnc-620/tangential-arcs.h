; == ct-cannot-follow-chf-its-direction
; 6:1 alarm: CT cannot follow CHF: its direction is that of the element before
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF 2
4 CT X+9 Y+9

; == ct-cannot-follow-rnd-its-direction
; 6:1 alarm: CT cannot follow RND: its direction is that of the element before
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 RND R2
4 CT X+9 Y+9

; == ct-end-lies-straight-behind-element
; 5:1 alarm: CT: the end lies straight behind the element before, no tangential arc leads there
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT X+2

; == ct-in-zx-after-element-along-y
; 6:1 alarm: CT needs a path element in the plane ZX directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10 Y+0
3 L Y-5
4 CT X+5 Z+5

; == ct-needs-end-other-than-its
; 5:1 alarm: CT needs an end other than its start
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT X+5 Y+0

; == ct-needs-path-element-directly-before
; 4:1 alarm: CT needs a path element directly before it (whose end gives the direction)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CT X+5 Y+5

; == ct-needs-path-element-working-plane
; 6:1 alarm: CT needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 L Z-5
4 CT X+9 Y+9

; == ct-needs-x-or-y-its
; 5:1 alarm: CT needs X or Y of its end
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT

; == ct-outside-working-plane-names
; 5:6 alarm: CT Z5: outside the working plane XY a circle names the two axes of its plane (for example CT X… Z…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT Z+5

; == ct-runs-feed-fmax-straight-lines
; 5:14 alarm: CT runs at feed: FMAX is for straight lines
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT X+9 Y+9 FMAX

; == ctp-needs-path-element-directly-before
; 5:1 alarm: CTP needs a path element directly before it (whose end gives the direction)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CTP PR+5 PA+0

; == ctp-needs-pole-no-cc-was
; 5:1 alarm: CTP needs a pole: no CC was programmed (write CC X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CTP PR+5 PA+0
