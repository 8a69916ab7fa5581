0 BEGIN PGM PLATE MM ; The edge of a plate: an arc to it, a chamfer, a notch, a rounding, a quarter circle. Made for this project.
1 BLK FORM 0.1 Z X+0 Y+0 Z-10
2 BLK FORM 0.2 X+80 Y+50 Z+0
3 TOOL CALL 1 Z S3000 F600 ; end mill 10
4 L Z+50 R0 FMAX M3
5 L X-20 Y-20 FMAX
6 L Z+2 FMAX
7 L Z-4 F150
8 APPR CT X+0 Y+25 CCA90 R+8 RL F400 ; on a quarter circle to the left edge
9 L Y+50
10 CHF 6 ; the corner at X0 Y50
11 L X+30
12 CR X+50 Y+50 R+10 DR+ ; a notch, half a circle
13 L X+80
14 RND R8 ; the corner at X80 Y50
15 L Y+20
16 CC X+60 Y+20
17 C X+60 Y+0 DR- ; a quarter circle about CC
18 L X+0
19 L Y+25
20 DEP CT CCA90 R+8
21 L Z+50 R0 FMAX M30
22 END PGM PLATE MM
