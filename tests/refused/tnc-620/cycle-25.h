; == appr-amid-contour
; 25:1 alarm: APPR LT must begin the contour of label 1 (the block with its starting point may stand before it, nothing else)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+0 Y+0 RL
L X+20
APPR LT X+40 Y+0 LEN8 RL
L X+60
11 LBL 0
12 END PGM A MM

; == appr-into-contour
; 24:1 alarm: the approach leads the tool into the contour at X6.632 Y12.491 (take another approach, a smaller radius or a shorter distance)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X-10 Y-10 R0
APPR LCT X+10 Y+10 R3 RL
L X+50
11 LBL 0
12 END PGM A MM

; == approach-into-contour
; 26:1 alarm: the approach leads the tool into the contour at X10.000 Y15.000 (take another approach, a smaller radius or a shorter distance)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
CYCL DEF 270 DATA
 Q390=2
 Q391=1
 Q392=3
 Q393=45
 Q394=5
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10
L X+50
L Y+50
L X+10
L Y+10
11 LBL 0
12 END PGM A MM

; == block-behind-dep
; 26:1 alarm: the contour of label 1 ends with DEP LT, this block stands behind it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+0 Y+0 RL
L X+20
DEP LT LEN5
L X+60
11 LBL 0
12 END PGM A MM

; == changes-side
; 25:1 alarm: the contour of label 1 changes from RL to RR or back in this block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+0 Y+0 RL
L X+40
L Y+40 RR
11 LBL 0
12 END PGM A MM

; == coarse-tool-missing
; 19:3 alarm: CYCL DEF 25 Q18 (coarse roughing tool) names tool "GROB", which has no row in the tool table
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q446=0.01
  Q447=10
  Q448=2
  QS18="GROB"
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == coarse-tool-no-larger
; 16:3 alarm: CYCL DEF 25 Q18 (coarse roughing tool) must be larger than the tool, whose radius is 5, got 5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=1
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == compensation-ends
; 25:1 alarm: the contour of label 1 changes its radius compensation in this block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+0 Y+0 RL
L X+40
L Y+40 R0
11 LBL 0
12 END PGM A MM

; == contour-crosses-itself
; 27:1 alarm: the contour crosses itself
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+0 Y+0 RL
L X+40
L Y+40
L X+20
L Y-20
11 LBL 0
12 END PGM A MM

; == feed-0
; 14:3 alarm: CYCL DEF 25 Q12 (feed rate for roughing) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=0
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == height-below-surface
; 11:3 alarm: CYCL DEF 25 Q7 (clearance height) must not lie below the surface or the floor, got 15
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=20
  Q7=15
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == infeed-0
; 12:3 alarm: CYCL DEF 25 Q10 (infeed per cut) must not be 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=0
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == inside-arc-too-small
; 25:1 alarm: the inside arc of radius 4 is not greater than the tool radius 5: 1 mm is missing, the largest radius for the whole contour is 4 mm (take a smaller tool)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
CC X+30 Y+30
L X+30 Y+26 RL
C X+30 Y+26 DR+
11 LBL 0
12 END PGM A MM

; == leaves-plane
; 24:1 alarm: the contour of label 1 moves along the tool axis
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+0 Y+0 RL
L X+40 Z-5
11 LBL 0
12 END PGM A MM

; == needs-contour
; 18:1 alarm: CYCL DEF 25 needs a contour: CYCL DEF 14 comes before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == tool-larger-than-contour
; 24:1 alarm: the element is too short for the tool radius 5: the offsets of its neighbours do not meet on it: 0.5 mm are missing, the largest radius for the whole contour is 4.5 mm (take a smaller tool, or lengthen the element)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+0 Y+0 RL
L X+9
L Y+9
L X+0
L Y+0
11 LBL 0
12 END PGM A MM

; == with-tool-axis-x
; 20:1 alarm: CYCL DEF 25 with the tool axis X: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 X S2000 F400
2 L X+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == without-material-limit
; 17:3 alarm: CYCL DEF 25 Q446 (accepted residual material) must be at least 0.001 and at most 9.999, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == cycle-270-approach-4
; 8:2 alarm: CYCL DEF 270 Q390 (type of approach) must be one of 1, 2, 3, got 4
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
CYCL DEF 270 DATA
 Q390=4
 Q391=1
 Q392=3
 Q393=45
 Q394=2
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == cycle-270-arc-of-361-degrees
; 11:2 alarm: CYCL DEF 270 Q393 (centre angle of the arc) must be greater than 0 and at most 360, got 361
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
CYCL DEF 270 DATA
 Q390=1
 Q391=1
 Q392=3
 Q393=361
 Q394=2
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == cycle-270-arc-radius-0
; 10:2 alarm: CYCL DEF 270 Q392 (radius of the arc) must be greater than 0 for an approach on an arc, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
CYCL DEF 270 DATA
 Q390=1
 Q391=1
 Q392=0
 Q393=45
 Q394=2
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM
