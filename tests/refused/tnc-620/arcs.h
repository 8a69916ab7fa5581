; == arc-in-zx-under-radius-compensation
; 7:1 alarm: C: an arc in ZX cannot stand under radius compensation, which lies in XY (write R0 in a straight line before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10 Y+0 Z+0 RL
3 L X+20
4 CC X+0 Z+0
5 C X+0 Z+20 DR-

; == c-leaves-plane-its-centre
; 5:10 alarm: C Z5: the circle centre CC lies in XY (write CC Z… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+0
3 C X+10 Z+5 DR+

; == c-needs-circle-centre-no-cc
; 4:1 alarm: C needs a circle centre: no CC was programmed (write CC X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 C X+1 Y+0 DR+

; == c-needs-sense-rotation-or-dr
; 5:1 alarm: C needs the sense of rotation (write DR+ (counter-clockwise) or DR- (clockwise))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+10 Y+0
3 C X+20 Y+0

; == c-refused-rotary-axis-c-built
; 5:10 alarm: C is refused: the rotary axis C is built for L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT X+9 C+5

; == c-under-m126-not-built
; 5:9 alarm: C under M126 (shortest way of rotary axes) is not built yet (Setup(kinematics="table-ac"), or one of its own, says where the rotary axes are)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M126
3 L X+5 C+5

; == c-under-m128-not-built
; 5:5 alarm: C under M128 (tool centre point management) is not built yet (Setup(kinematics="table-ac"), or one of its own, says where the rotary axes are)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F9 M128 F500
3 L C+5

; == cc-names-three-axes
; 4:14 alarm: CC Z0: outside the working plane XY a circle names the two axes of its plane (for example CC X… Z…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+0 Y+0 Z+0

; == cc-outside-working-plane-names
; 4:6 alarm: CC Z5: outside the working plane XY a circle names the two axes of its plane (for example CC X… Z…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC Z+5

; == cr-names-three-axes
; 5:14 alarm: CR Z0: outside the working plane XY a circle names the two axes of its plane (for example CR X… Z…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10
3 CR X+5 Y+5 Z+0 R+10 DR+

; == cr-needs-end-other-than-its
; 4:10 alarm: CR needs an end other than its start (a full circle is written with CC and C)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CR X+0 R5 DR+

; == cr-needs-radius-r
; 4:1 alarm: CR needs the radius R
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CR X+10 DR+

; == end-point-not-on-circle-radius
; 5:1 alarm: the end point is not on the circle: radius 10.0000 at the start, 11.0000 at the end, allowed difference 0.016 mm
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+10 Y+0
3 C X+21 Y+0 DR+

; == inside-arc-radius-4-not-greater
; 6:1 alarm: the inside arc of radius 4 is not greater than the tool radius 5: 1 mm is missing, the largest radius for the whole contour is 4 mm (take a smaller tool)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 CR X+20 Y+8 R4 DR+

; == r3-too-small-distance-10-mm
; 4:11 alarm: R3 is too small for the distance 10 mm between start and end: at least 5 mm is needed (too short by 2 mm)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CR X+10 R+3 DR+
