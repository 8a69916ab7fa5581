; == m104-refused-older-controls
; 4:9 alarm: M104 is refused: the datum that was set by hand last, a function of older controls that is not built: write CYCL DEF 247
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M104

; == m110-m109-are-one-group-only
; 4:14 alarm: M110 and M109 are of one group: only one function of a group may stand in a block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M109 M110

; == m112-refused-older-controls
; 4:9 alarm: M112 is refused: arcs put in between lines, a function of older controls that is not built: write RND at the corners, or cycle 32
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M112 T0.01

; == m120-la-needs-number
; 4:17 alarm: M120 LA needs a number (for example M120 LA5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL M120 LA

; == m120-la-whole-number-0-99
; 4:17 alarm: M120 LA (blocks looked at in advance) must be a whole number from 0 to 99, got 100
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL M120 LA100

; == m128-refused-rotary-axes-turned
; 5:9 alarm: M128 is not built yet where rotary axes have turned (Setup(kinematics="table-ac"), or one of its own, says where the rotary axes are)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L C+5 F9
3 L X+5 M128 F500

; == m13-m3-are-one-group-only
; 4:12 alarm: M13 and M3 are of one group: only one function of a group may stand in a block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M3 M13

; == m138-refused-choice-tilting-axes-not
; 4:9 alarm: M138 needs the kinematics of the machine (Setup(kinematics="table-ac"), or one of its own, says where the rotary axes are)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M138 A C

; == m140-f-fmax-stand-one-block
; 4:20 alarm: F500 and FMAX stand in one block: one feed is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M140 MB50 F500 FMAX

; == m140-f-greater-than-0-got
; 4:15 alarm: M140 F (feed rate of the retraction) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M140 MB50 F0

; == m140-f-needs-number
; 4:15 alarm: M140 F needs a number (for example M140 MB 50 F750)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M140 MB50 F

; == m140-mb-50-mb-max-one-block
; 4:15 alarm: MB50 and MBMAX stand in one block: one distance is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M140 MB50 MB MAX

; == m140-mb-least-0-got
; 4:17 alarm: M140 MB (distance of the retraction) must be at least 0, got -50
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F9 M140 MB-50

; == m140-mb-max-leads-up-alone
; 5:10 alarm: M140 MB MAX leads up alone: the tool stands 100 mm above the end already
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Z+600 FMAX
3 L M140 MB MAX

; == m140-mb-max-takes-no-number
; 4:10 alarm: M140 MB MAX takes no number
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M140 MB MAX 50

; == m140-mb-needs-number
; 4:17 alarm: M140 MB needs a number, or MAX
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F9 M140 MB

; == m140-needs-mb
; 4:12 alarm: M140 needs MB and a distance, or MB MAX (for example M140 MB MAX or M140 MB 50)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F9 M140

; == m140-tilted-plane-not-built
; 6:5 alarm: M140 in a tilted plane is not built yet (with the kinematics of the machine it is: Setup(kinematics="table-ac"))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 19.0 X
3 CYCL DEF 19.1 A+30
4 L M140 MB50

; == m142-refused-older-controls
; 4:3 alarm: M142 is refused: erasing modal information, a function of older controls that is not built: write the functions again that are to hold
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 M142

; == m1999-not-function-this-control
; 4:9 alarm: M1999 is not a function of this control
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M1999

; == m2-m30-are-one-group-only
; 4:13 alarm: M2 and M30 are of one group: only one function of a group may stand in a block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M30 M2

; == m4-m3-are-one-group-only
; 4:12 alarm: M4 and M3 are of one group: only one function of a group may stand in a block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M3 M4

; == m6-written-twice-this-block
; 4:6 alarm: M6 is written twice in this block (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 M6 M6

; == m91-cannot-begin-radius-compensation
; 4:9 alarm: M91 cannot begin radius compensation (write RL or RR in the block after)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M91 RL

; == m91-cannot-stand-under-radius-compensation
; 5:9 alarm: M91 cannot stand under radius compensation (write R0 in the block before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 L X+6 M91

; == m91-stands-straight-line-l-alone
; 4:14 alarm: M91 stands in a straight line L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+1 Y+1 M91

; == m92-m91-are-one-group-only
; 4:13 alarm: M92 and M91 are of one group: only one function of a group may stand in a block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M91 M92

; == m92-stands-straight-line-l-alone
; 4:17 alarm: M92 stands in a straight line L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 C X+1 Y+2 DR+ M92

; == m94-names-axis-without-number-got
; 4:13 alarm: M94 names an axis without a number, got C5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M94 C5

; == m97-before-rnd
; 6:7 alarm: RND needs a path element directly before it (M97 or M98 stands there)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 L X+50 M97
4 RND R3
5 L Y-30

; == m97-cannot-stand-contour-cycle-reads
; 27:11 alarm: M97 cannot stand in a contour that a cycle reads
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 14.0 X
3 CYCL DEF 14.1 1
4 CYCL DEF 20 X
Q1=-5
Q2=1
Q3=0
Q4=0
Q5=0
Q6=2
Q7=9
Q8=0
Q9=1
5 CYCL DEF 22 X
Q10=5
Q11=9
Q12=9
Q18=0
Q19=0
Q208=99
6 CYCL CALL M3
7 M2
8 LBL 1
9 L X+0 Y+0 RR
10 L X+50 M97
11 L Y+50
12 L X+0 Y+0
13 LBL 0

; == m97-needs-path-element
; 4:3 alarm: M97 stands in the block of a path element
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 M97

; == m98-needs-path-element
; 4:3 alarm: M98 stands in the block of a path element
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 M98

; == m98-open-corner-goes-on-at-an-angle
; 5:1 alarm: an open corner is not built where the compensated contour goes on behind it at an angle (no manual says how the tool goes from one element to the next; write R0 in the block after it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 L X+50 M98
4 L Y+30
