; == clsd-begins-closed-contour-inside-another
; 5:14 alarm: CLSD+ begins a closed contour inside another one (end that with CLSD- first)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 Y+5 CLSD+
3 FL X+9 Y+5 CLSD+

; == clsd-ends-closed-contour-that-no
; 4:14 alarm: CLSD- ends a closed contour that no CLSD+ began
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 Y+5 CLSD-

; == dp-needs-par-block-parallel-line
; 4:6 alarm: DP (distance of parallels) needs PAR, the block of the parallel line
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL DP5 AN+0

; == fc-cca-most-360-got-361
; 4:13 alarm: FC CCA (central angle) must be at most 360, got 361
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC R5 DR+ CCA361

; == fc-cca-needs-sense-rotation
; 4:9 alarm: FC CCA (central angle) needs the sense of rotation (write DR+ or DR-)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC R5 CCA90

; == fc-free-contour-not-determined-2
; 4:1 alarm: FC: the free contour is not determined, 2 more data are needed; not known here: centre and end point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC DR+ R10
3 L X+5

; == fc-r-greater-than-0-got
; 4:6 alarm: FC R (radius) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC R0 DR+

; == fc-r5-contradicts-what-known-contour
; 4:10 alarm: FC R5 contradicts what is known of the contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC DR+ R5 CCX+20 CCY+0

; == fc-runs-feed-fmax-straight-lines
; 4:13 alarm: FC runs at feed: FMAX is for straight lines
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC DR+ R5 FMAX

; == fct-needs-path-element-working-plane
; 5:1 alarm: FCT needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Z+5
3 FCT R5 DR+

; == fl-d-needs-pdx-pdy-point
; 4:6 alarm: FL D (distance) needs PDX and PDY, the point beside the element
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL D5 AN+0

; == fl-free-contour-2-solutions-here
; 5:1 alarm: FL: the free contour has 2 solutions here (choose one with FSELECT 1 to FSELECT 2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL LEN30
3 FL LEN40 X+50 Y+0

; == fl-free-contour-not-determined-1-2
; 5:1 alarm: FL: the free contour is not determined, 1 more datum is needed; not known here: direction, place and end point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+10 AN+0
3 FL X+50
4 M8

; == fl-free-contour-not-determined-1-3
; 4:1 alarm: FL: the free contour is not determined, 1 more datum is needed; not known here: direction
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+0 Y+0

; == fl-free-contour-not-determined-1
; 4:1 alarm: FL: the free contour is not determined, 1 more datum is needed; not known here: end point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL AN+30

; == fl-ian-needs-path-element-working
; 4:6 alarm: FL IAN needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL IAN+5 LEN5

; == fl-len-greater-than-0-got
; 4:6 alarm: FL LEN (length) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL LEN0 AN+0

; == fl-len12-contradicts-what-known-contour
; 4:15 alarm: FL LEN12 contradicts what is known of the contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+10 Y+0 LEN12

; == fl-no-solution-element-cannot-joined-2
; 5:1 alarm: FL has no solution: the element cannot be joined to what is known of the contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC DR- R30 CCX+30 CCY+0
3 FL AN+0 PDX+30 PDY+90 D10

; == fl-no-solution-element-cannot-joined
; 4:1 alarm: FL has no solution: the element cannot be joined to what is known of the contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+10 Y+0 AN+180

; == fl-pdx-needs-pdy-beside-it
; 4:6 alarm: FL PDX needs PDY beside it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL PDX+5 AN+0 D1

; == fl-pdx-pdy-need-d-distance
; 4:6 alarm: FL PDX PDY need D, the distance of the element from that point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL PDX+5 PDY+5 AN+0

; == fl-pr-needs-pole
; 4:6 alarm: FL PR needs a pole (write FPOL X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL PR+10 AN+0

; == fl-with-tool-axis-y
; 6:1 alarm: FL with the tool axis Y: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Y
3 L X+0 Z+0 FMAX
4 FL AN+0 LEN10

; == flt-needs-path-element-working-plane
; 4:1 alarm: FLT needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FLT X+25

; == fpol-needs-y-coordinate-pole
; 4:8 alarm: FPOL needs Y, the coordinate of the pole
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FPOL X+10

; == fpol-with-tool-axis-x
; 5:1 alarm: FPOL with the tool axis X: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X
3 FPOL X+0 Y+0

; == fpol-x-absolute-inside-free-contour
; 5:8 alarm: FPOL X (pole) must be absolute inside a free contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL AN+0
3 FPOL IX+1 Y+0

; == fselect-follow-block-free-contour
; 4:11 alarm: FSELECT must follow a block of a free contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FSELECT 1

; == fselect-needs-number-solution
; 5:1 alarm: FSELECT needs the number of a solution
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL LEN10 AN+0
3 FSELECT

; == fselect-number-solution-1-2-here-2
; 6:11 alarm: FSELECT must be the number of a solution, 1 to 2 here, got 1.5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL LEN30
3 FL LEN40 X+50 Y+0
4 FSELECT 1.5

; == fselect-number-solution-1-2-here
; 6:11 alarm: FSELECT must be the number of a solution, 1 to 2 here, got 3
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL LEN30
3 FL LEN40 X+50 Y+0
4 FSELECT 3

; == len3-no-meaning-this-block
; 4:23 alarm: LEN3 has no meaning in this block (APPR LCT does not take LEN)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LCT X+1 Y+2 R5 LEN3 RL

; == ran1-needs-ian-which-counts-that
; 4:11 alarm: RAN1 needs IAN, which counts from that block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL AN+5 RAN 1

; == rx2-needs-ix-which-counts-that
; 4:10 alarm: RX2 needs IX, which counts from that block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 RX 2

; == rx7-name-earlier-block-free-contour
; 5:15 alarm: RX7 must name an earlier block of a free contour, block 7 is none
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 Y+1
3 FL IX+5 Y+9 RX 7
