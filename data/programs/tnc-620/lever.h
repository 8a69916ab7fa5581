0 BEGIN PGM LEVER MM ; A lever between two eyes, told as on its drawing: centres, radii, tangents. Made for this project.
1 BLK FORM 0.1 Z X-30 Y-30 Z-10
2 BLK FORM 0.2 X+110 Y+60 Z+0
3 TOOL CALL 1 Z S3000
4 L X-40 Y-40 Z+5 R0 FMAX M3
5 L Z-8 F200
6 L X-20 Y+0 RL F300 ; the leftmost point of the large eye
7 FC DR- R20 CLSD+ CCX+0 CCY+0
8 FLT ; whatever line touches both eyes
9 FCT DR- R12 CCX+70 CCY+40
10 FL AN-110 ; leaves the small eye under an angle
11 FSELECT 1
12 RND R4
13 FL X+30 Y+5 ; the notch
14 RND R6
15 FL AN-30 PDX+0 PDY+0 D26
16 FSELECT 1
17 FCT DR- R8
18 FLT AN+180 Y-18 ; the foot
19 FC DR- R20 CLSD- CCX+0 CCY+0
20 FSELECT 1
21 L X-40 R0
22 L Z+5 FMAX M30
23 END PGM LEVER MM
