; == appr-ct-cca-greater-than-0-2
; 4:19 alarm: APPR CT CCA (centre angle of the arc) must be greater than 0 and at most 360, got -90
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR CT X+1 Y+2 CCA-90 R5 RL

; == appr-ct-cca-greater-than-0
; 4:19 alarm: APPR CT CCA (centre angle of the arc) must be greater than 0 and at most 360, got 400
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR CT X+1 Y+2 CCA400 R5 RL

; == appr-ct-needs-cca
; 4:1 alarm: APPR CT needs CCA (centre angle of the arc)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR CT X+1 Y+2 R5 RL

; == appr-ct-needs-r
; 4:1 alarm: APPR CT needs R (radius of the arc)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR CT X+1 Y+2 CCA90 RL

; == appr-ct-needs-rl-or-rr
; 4:28 alarm: APPR CT needs RL or RR: without a side it has no direction
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR CT X+1 Y+2 CCA90 R5 R0

; == appr-ct-r-not-0
; 5:25 alarm: APPR CT R (radius of the arc) must not be 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 0
3 APPR CT X+1 Y+2 CCA90 R+Q1 RL

; == appr-followed-one-lt-ln-ct
; 4:3 alarm: APPR must be followed by one of LT, LN, CT, LCT, PLT, PLN, PCT, PLCT
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR X+1 Y+2 LEN5 RL

; == appr-lct-begins-inside-its-arc
; 4:1 alarm: APPR LCT begins inside of its arc of R8: no line touches the arc from there (take a smaller radius, or a point farther away)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LCT X+4 Y+0 R8 RL
3 L X+4 Y+9

; == appr-lct-needs-r
; 4:1 alarm: APPR LCT needs R (radius of the arc)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LCT X+1 Y+2 RL

; == appr-lct-r-greater-than-0
; 4:20 alarm: APPR LCT R (radius of the arc) must be greater than 0, got -5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LCT X+1 Y+2 R-5 RL

; == appr-ln-len-greater-than-0
; 4:19 alarm: APPR LN LEN (length of the line) must be greater than 0, got -5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LN X+1 Y+2 LEN-5 RL

; == appr-ln-needs-rl-or-rr-2
; 4:24 alarm: APPR LN needs RL or RR: without a side it has no direction
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LN X+1 Y+2 LEN5 R0

; == appr-ln-needs-rl-or-rr
; 4:1 alarm: APPR LN needs RL or RR (the side on which the tool runs beside the contour)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LN X+1 Y+2 LEN5

; == appr-lt-len-greater-than-0
; 4:19 alarm: APPR LT LEN (length of the line) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+1 Y+2 LEN0 RL

; == appr-lt-needs-its-start-another
; 4:1 alarm: APPR LT needs its start at another place than the contour point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+0 Y+0 Z-3 LEN5 RL
3 L X+5

; == appr-lt-needs-len
; 4:1 alarm: APPR LT needs LEN (length of the line)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+1 Y+2 RL

; == appr-lt-needs-path-element-contour
; 4:1 alarm: APPR LT needs a path element of the contour after it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+1 Y+2 LEN5 RL

; == appr-lt-needs-rl-or-rr
; 4:1 alarm: APPR LT needs RL or RR (the side on which the tool runs beside the contour)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+1 Y+2 LEN5

; == appr-lt-needs-x-y-first
; 4:1 alarm: APPR LT needs X and Y of the first contour point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT Y+2 LEN5 RL

; == appr-lt-runs-feed-fmax-straight
; 4:27 alarm: APPR LT runs at feed: FMAX is for straight lines
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+1 Y+2 LEN5 RL FMAX

; == appr-plt-needs-pole-no-cc
; 4:1 alarm: APPR PLT needs a pole: no CC was programmed (write CC X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR PLT PR+5 PA+0 LEN5 RL

; == appr-plt-pole-outside-working-plane
; 6:1 alarm: APPR PLT: the pole CC lies in YZ, approaches and departures in XY
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10 Y+0
3 CC Y+0 Z+0
4 APPR PLT PR+10 PA+0 LEN5 RL

; == appr-with-tool-axis-x-needs-y-and-z
; 6:1 alarm: APPR LT needs Y and Z of the first contour point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X F100
3 L X+0 Y+0 Z+0 FMAX M3
4 APPR LT X+5 Y+5 LEN5 RL

; == or-departure-needs-move-tool
; 4:1 alarm: an approach or a departure needs a move: the tool stands at its end already
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+0 Y+0 LEN5 RL
3 L X+5
