; == cp-helix-along-plane-its-pole
; 6:13 alarm: CP Z3: the pole lies in ZX, a helix has its end in Y
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+0 Z+5
3 L X+10
4 CP IPA+90 Z+3 DR+

; == cp-ipa-30-dr-turn-opposite
; 5:6 alarm: CP IPA-30 and DR+ turn in opposite senses
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP IPA-30 DR+

; == cp-ipa-not-0
; 5:6 alarm: CP IPA (angle travelled) must not be 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP IPA+0 DR+

; == cp-needs-pa-or-ipa
; 5:1 alarm: CP needs PA (polar angle of the end) or IPA (angle travelled)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP DR+

; == cp-needs-pole-no-cc-was
; 4:1 alarm: CP needs a pole: no CC was programmed (write CC X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CP IPA+30 DR+

; == cp-needs-sense-rotation-or-dr
; 5:1 alarm: CP needs the sense of rotation (write DR+ (counter-clockwise) or DR- (clockwise))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP IPA+30

; == cp-runs-feed-fmax-straight-lines
; 5:16 alarm: CP runs at feed: FMAX is for straight lines
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP PA+30 DR+ FMAX

; == cp-tool-stands-pole-where-it
; 5:6 alarm: CP: the tool stands at the pole, where it has no polar angle (write the angle PA, absolute)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC
3 CP IPA+30 DR+

; == cp-with-tool-axis-x-under-compensation
; 9:1 alarm: CP: an arc in XY cannot stand under radius compensation, which lies in YZ (write R0 in a straight line before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X F100
3 L X+0 Y+0 Z+0 FMAX M3
4 L Y+10 RL
5 L Z+20
6 CC X+0 Y+0
7 CP IPA+90 DR+

; == lp-needs-pole-no-cc-was
; 4:1 alarm: LP needs a pole: no CC was programmed (write CC X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LP PR+5 PA+0

; == lp-needs-pr-or-pa
; 5:1 alarm: LP needs PR (polar radius) or PA (polar angle)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 LP

; == lp-pr-least-0-got-1
; 5:6 alarm: LP PR (polar radius) must be at least 0, got -1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+3 Y+4
3 LP IPR-6 PA+0

; == lp-pr-least-0-got-5
; 5:6 alarm: LP PR (polar radius) must be at least 0, got -5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 LP PR-5 PA+0

; == lp-tool-stands-pole-where-it-2
; 5:1 alarm: LP: the tool stands at the pole, where it has no polar angle (write the angle PA, absolute)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC
3 LP PR+5

; == lp-tool-stands-pole-where-it
; 5:11 alarm: LP: the tool stands at the pole, where it has no polar angle (write the angle PA, absolute)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC
3 LP PR+5 IPA+30

; == pr-coordinates-axes-stand-one-block
; 5:5 alarm: PR and coordinates of axes stand in one block (write LP PR… PA…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 L PR+5 PA+0 X+3

; == pr5-no-meaning-this-block
; 5:12 alarm: PR5 has no meaning in this block (CP does not take PR)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP PA+30 PR+5 DR+
