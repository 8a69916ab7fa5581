; == 0-1-needs-tool
; 4:1 alarm: BLK FORM 0.1 needs the tool axis (for example BLK FORM 0.1 Z X+0 Y+0 Z-20)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 X+0 Y+0 Z-20

; == 0-1-stands-twice
; 5:16 alarm: BLK FORM 0.1 stands twice: BLK FORM 0.2 belongs behind the first
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z X+0 Y+0 Z-20
2 BLK FORM 0.1 Z X+0 Y+0 Z-20

; == 0-1-tool-axis
; 4:16 alarm: BLK FORM 0.1: the tool axis must be X, Y or Z, got W
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 W X+0 Y+0 Z-20

; == 0-1-x-absolute
; 4:18 alarm: BLK FORM 0.1 X (coordinate of the corner) must be absolute
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z IX+0 Y+0 Z-20

; == 0-1-z-missing
; 4:16 alarm: BLK FORM 0.1 Z (coordinate of the corner) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z X+0 Y+0

; == 0-2-needs-blk-2
; 6:16 alarm: BLK FORM 0.2 needs BLK FORM 0.1 before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z X+0 Y+0 Z-20
3 BLK FORM 0.2 X+1 Y+1 Z+0
3 BLK FORM 0.2 X+1 Y+1 Z+0

; == 0-2-needs-blk
; 4:16 alarm: BLK FORM 0.2 needs BLK FORM 0.1 before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.2 X+9 Y+9 Z+0

; == 0-2-y-greater
; 5:20 alarm: BLK FORM 0.2 Y (greatest corner) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z X+0 Y+0 Z-20
3 BLK FORM 0.2 X+9 Y+0 Z+0

; == 0-3-not-function
; 4:1 alarm: BLK FORM 0.3 is not a function of this control (near: BLK FORM 0.1, BLK FORM 0.2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.3 Z X+0

; == cylinder-axis-w
; 4:21 alarm: BLK FORM CYLINDER: the axis must be X, Y or Z, got W
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM CYLINDER W R50 L100

; == cylinder-bore-too-wide
; 4:32 alarm: BLK FORM CYLINDER: the bore must be smaller than the cylinder, radius 60 in 50
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM CYLINDER Z R50 L100 DI120

; == cylinder-incremental
; 4:27 alarm: BLK FORM CYLINDER IL must be absolute
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM CYLINDER Z R50 IL100

; == cylinder-length-negative
; 4:27 alarm: BLK FORM CYLINDER L (length) must be greater than 0, got -100
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM CYLINDER Z R50 L-100

; == cylinder-needs-axis
; 4:1 alarm: BLK FORM CYLINDER needs the axis (for example BLK FORM CYLINDER Z R50 L105 DIST+5 RI10)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM CYLINDER R50 L100

; == cylinder-needs-length
; 4:21 alarm: BLK FORM CYLINDER needs L (length)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM CYLINDER Z R50 DIST+5

; == cylinder-needs-radius
; 4:21 alarm: BLK FORM CYLINDER needs R (radius) or D (diameter)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM CYLINDER Z L100

; == cylinder-radius-and-diameter
; 4:27 alarm: BLK FORM CYLINDER takes R or D, not both
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM CYLINDER Z R50 D100 L100

; == cylinder-within-cuboid
; 5:21 alarm: BLK FORM CYLINDER: BLK FORM 0.1 stands before it without BLK FORM 0.2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z X+0 Y+0 Z-20
3 BLK FORM CYLINDER Z R50 L100

; == file-refused-blank-not
; 4:1 alarm: BLK FORM FILE is refused: blank from a file, not built yet: write BLK FORM 0.1 and 0.2, or give Setup(stock=…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM FILE "A.STL"

; == rotation-about-x
; 4:21 alarm: BLK FORM ROTATION X: a turned blank is built about Z alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION X DIM_R LBL 1
3 M30
4 LBL 1
5 LBL 0

; == rotation-arcs-of-diameters
; 4:33 alarm: BLK FORM ROTATION: the contour of label 1 has arcs, which are not built for diameters (DIM_D) (write it with DIM_R)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_D LBL 1
3 M30
4 LBL 1
5 L X+0 Z+0
6 L X+20
7 CR X+0 Z-10 R+20 DR+
8 L Z+0
9 LBL 0

; == rotation-circle-in-xy
; 4:33 alarm: BLK FORM ROTATION: the contour of label 1 must lie in Z and X
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 1
3 M30
4 LBL 1
5 L X+5 Z+0
6 CC X+10 Y+0
7 C X+15 DR+
7 L X+5
9 LBL 0

; == rotation-crosses-itself
; 4:33 alarm: BLK FORM ROTATION: the contour of label 1 is no area: the contour crosses or touches itself near (-6.667, 15.000)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 1
3 M30
4 LBL 1
5 L X+5 Z+0
6 L X+20 Z-10
7 L X+20 Z+0
8 L X+5 Z-20
9 L Z+0
10 LBL 0

; == rotation-first-point
; 7:1 alarm: the contour of label 1 must begin with both coordinates of the plane
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 1
3 M30
4 LBL 1
5 L X+5
6 L X+20 Z+0
7 L Z-5
8 L X+5 Z+0
9 LBL 0

; == rotation-label-missing
; 4:33 alarm: label 7 does not exist (this program has no labels)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 7

; == rotation-leaves-zx
; 4:33 alarm: BLK FORM ROTATION: the contour of label 1 must lie in Z and X
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 1
3 M30
4 LBL 1
5 L X+5 Z+0
6 L X+20 Y+3
7 L Z-5
8 L X+5 Y+0 Z+0
9 LBL 0

; == rotation-needs-dim
; 4:23 alarm: DIM_R (radii) or DIM_D (diameters) is missing (for example BLK FORM ROTATION Z DIM_R LBL 1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z LBL 1

; == rotation-needs-label
; 4:29 alarm: LBL, the label of the contour, is missing (for example BLK FORM ROTATION Z DIM_R LBL 1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R 1

; == rotation-negative-radius
; 4:33 alarm: BLK FORM ROTATION: the contour of label 1 has a negative X
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 1
3 M30
4 LBL 1
5 L X-5 Z+0
6 L X+20
7 L Z-10
8 L X-5 Z+0
9 LBL 0

; == rotation-no-area
; 4:33 alarm: BLK FORM ROTATION: the contour of label 1 encloses no area
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 1
3 M30
4 LBL 1
5 L X+5 Z+0
6 L X+20
7 L X+5
9 LBL 0

; == rotation-open
; 4:33 alarm: BLK FORM ROTATION: the contour of label "RING" must be closed: its end is where it begins
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL "RING"
3 M30
4 LBL "RING"
5 L X+0 Z+0
6 L X+20
7 L Z-10
8 LBL 0
