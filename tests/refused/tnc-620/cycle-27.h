; == contour-appr
; 20:9 alarm: APPR LT cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 R0
APPR LT X+10 Y+0 LEN5 RL
L X+50
9 LBL 0
99 END PGM A MM

; == contour-c
; 20:4 alarm: CC cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
CC X+10 Y+0
C X+20 Y+0 DR+
9 LBL 0
99 END PGM A MM

; == contour-dep
; 21:8 alarm: DEP LT cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
DEP LT LEN5
9 LBL 0
99 END PGM A MM

; == contour-fl
; 20:10 alarm: FL cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
FL AN+20 X+20
9 LBL 0
99 END PGM A MM

; == contour-lp
; 20:4 alarm: LP cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
LP PR+5 PA+20
9 LBL 0
99 END PGM A MM

; == contour-narrow-arc
; 22:1 alarm: CYCL DEF 27: the inside arc of radius 3 is not greater than the distance 5: 2 mm are missing, the largest distance for the whole contour is 3 mm (take a smaller tool)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
RND R3
L Y+50
9 LBL 0
99 END PGM A MM

; == contour-rotary-axis
; 20:8 alarm: A5: the contour of a cylinder has X and Y alone, X for the rotary axis
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+20 A+5
9 LBL 0
99 END PGM A MM

; == contour-shift
; 19:1 alarm: the contour of a cylinder takes no transformation
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=0
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
CYCL DEF 7.0 X
CYCL DEF 7.1 X+5
L X+0 Y+0 RL
L X+20
9 LBL 0
99 END PGM A MM

; == cylinder-datum-on-axis
; 18:1 alarm: CYCL DEF 27 needs its datum on the axis of the cylinder, the shifts of the program move it 5 mm away
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
2 CYCL DEF 7.0 X
2 CYCL DEF 7.1 Y+5
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == depth-negative
; 8:3 alarm: CYCL DEF 27 Q1 (milling depth from the surface to the floor) must be negative, got 5: the tool comes from outside, from inside is not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=+5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == depth-radius
; 8:3 alarm: CYCL DEF 27 Q1 (milling depth from the surface to the floor) must be less deep than the radius Q16 = 40, got -40
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-40
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == fmax
; 13:3 alarm: CYCL DEF 27 Q12 (feed rate for roughing) must be a number, FAUTO, FU, FZ, got FMAX (FU has its value behind it, for example Q12=FU0.1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=FMAX
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == q10-not-0
; 11:3 alarm: CYCL DEF 27 Q10 (infeed per cut) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+0
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == q11-not-0
; 12:3 alarm: CYCL DEF 27 Q11 (feed rate for plunging) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=0
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == q16-not-0
; 14:3 alarm: CYCL DEF 27 Q16 (radius of the cylinder) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+0
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == q3-without-side
; 20:1 alarm: CYCL DEF 27: Q3=1 (finishing allowance for side) needs RL or RR in the contour (with R0 the tool is on the contour)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+1
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 R0
L X+50
9 LBL 0
99 END PGM A MM

; == rotation-of-plane
; 18:1 alarm: CYCL DEF 27 cannot run under a rotation of the plane: Y lies along the axis A
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
2 CYCL DEF 10.0 X
2 CYCL DEF 10.1 ROT+30
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == self
; 23:1 alarm: CYCL DEF 27: the contour crosses itself
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
L Y+50
L X+25
L Y-20
9 LBL 0
99 END PGM A MM

; == single-contour
; 16:1 alarm: CYCL DEF 27 takes a single contour, but CYCL DEF 14 names 2 labels
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1/1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == tool-axis-x
; 17:1 alarm: CYCL DEF 27 with the tool axis X: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
2 TOOL CALL 1 X S1000 F200
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == tool-square
; 18:1 alarm: CYCL DEF 27 needs a tool square to the rotary axis C, which carries A: the spindle axis is not perpendicular to the axis of the rotary table
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
2 CYCL DEF 19.0 X
2 CYCL DEF 19.1 B+45
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == unequal-scales
; 18:1 alarm: CYCL DEF 27 cannot run under unequal scales: the cylinder would not be round
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
2 CYCL DEF 26.0 X
2 CYCL DEF 26.1 Z2
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM
