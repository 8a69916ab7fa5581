0 BEGIN PGM BRACKET MM ; The outline of a bracket: approach and departure on arcs, roundings, chamfers. Made for this project.
1 BLK FORM 0.1 Z X+0 Y+0 Z-12
2 BLK FORM 0.2 X+90 Y+60 Z+0
3 TOOL CALL 1 Z S3000 F600
4 L X-20 Y-15 R0 FMAX M3
5 L Z+2 FMAX M8
6 L Z-6 F300
7 APPR LCT X+5 Y+25 R8 RL F400
8 L Y+55
9 RND R8
10 L X+50
11 CHF 6
12 L Y+35
13 RND R7 F250 ; an inside corner: the radius must be greater than that of the tool
14 L X+85
15 CHF 5 F250
16 L Y+5
17 RND R6
18 L X+5
19 CHF 3
20 L Y+25
21 DEP LCT X-20 Y+65 Z+2 R8
22 L Z+50 FMAX M30
23 END PGM BRACKET MM
