; == tch-probe-0-half-typed
; 4:1 alarm: TCH PROBE 0 needs its pre-position, X, Y or Z in TCH PROBE 0.1
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 0.0 REF. PLANE Q5 X-
3 L X+5 R0 FMAX
4 END PGM A MM

; == tch-probe-0-incremental-place
; 5:17 alarm: only X, Y and Z of the pre-position stand here, absolute
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 0.0 REF. PLANE Q5 X-
3 TCH PROBE 0.1 IX+5 Y+0 Z-5
4 END PGM A MM

; == tch-probe-0-no-result
; 4:29 alarm: Q and the number of the result parameter stand here, for example Q5
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 0.0 REF. PLANE X-
3 TCH PROBE 0.1 X+5 Y+0 Z-5
4 END PGM A MM

; == tch-probe-0-parameter-2000
; 4:28 alarm: TCH PROBE 0 Q (Q parameter of the result) must be a whole number and at least 0 and at most 1999, got 2000
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 0.0 REF. PLANE Q2000 X-
3 TCH PROBE 0.1 X+5 Y+0 Z-5
4 END PGM A MM

; == tch-probe-0-rotary-axis
; 4:31 alarm: the probing axis and its sense stand here: X+, X-, Y+, Y-, Z+ or Z-
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 0.0 REF. PLANE Q5 C-
3 TCH PROBE 0.1 X+5 Y+0 Z-5
4 END PGM A MM

; == tch-probe-1-angle-above-180
; 5:19 alarm: TCH PROBE 1 ANGLE (angle from the probing axis) must be at least -180 and at most 180, got 181
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 1.0 POLAR PRESET
3 TCH PROBE 1.1 X ANGLE: +181
4 TCH PROBE 1.2 X+5 Y+0 Z-5
5 END PGM A MM

; == tch-probe-1-angle-missing
; 5:18 alarm: a number is missing: the probing angle
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 1.0 POLAR PRESET
3 TCH PROBE 1.1 X
4 TCH PROBE 1.2 X+5 Y+0 Z-5
5 END PGM A MM

; == tch-probe-1-half-typed
; 4:1 alarm: TCH PROBE 1 needs its pre-position, X, Y or Z in TCH PROBE 1.2
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 1.0 POLAR PRESET
3 TCH PROBE 1.1 X ANGLE: +30
4 END PGM A MM

; == tch-probe-3-four-results
; 5:17 alarm: TCH PROBE 3 Q (first Q parameter of the results) must be at most 1996, got 1997: four parameters get results
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 3.0 MEASURING
3 TCH PROBE 3.1 Q1997
4 TCH PROBE 3.2 X ANGLE: +15
5 TCH PROBE 3.3 ABST +10 F100 MB1 REFERENCE SYSTEM: 0
6 TCH PROBE 3.4 ERRORMODE1
7 END PGM A MM

; == tch-probe-3-no-way
; 7:17 alarm: TCH PROBE 3 ABST (farthest way) must not be 0: a touch needs a way
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 3.0 MEASURING
3 TCH PROBE 3.1 Q1
4 TCH PROBE 3.2 X ANGLE: +15
5 TCH PROBE 3.3 ABST +0 F100 MB1 REFERENCE SYSTEM: 0
6 TCH PROBE 3.4 ERRORMODE1
7 END PGM A MM

; == tch-probe-30-without-height
; 5:17 alarm: a number is missing: the clearance height
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 30.0 X
3 TCH PROBE 30.1
9 END PGM P MM

; == tch-probe-4-no-direction
; 6:17 alarm: TCH PROBE 4 IX (direction, X) must not be 0 with IY and IZ: they are the direction
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 4.0 MEASURING IN 3-D
3 TCH PROBE 4.1 Q1
4 TCH PROBE 4.2 IX+0 IY+0 IZ+0
5 TCH PROBE 4.3 ABST+45 F100 MB50 REFERENCE SYSTEM:0
6 END PGM A MM

; == tch-probe-4-too-fast
; 7:25 alarm: TCH PROBE 4 F (feed of the touch) must be at least 0 and at most 3000, got 3001
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 4.0 MEASURING IN 3-D
3 TCH PROBE 4.1 Q1
4 TCH PROBE 4.2 IX+0 IY+0 IZ-1
5 TCH PROBE 4.3 ABST+45 F3001 MB50 REFERENCE SYSTEM:0
6 END PGM A MM
