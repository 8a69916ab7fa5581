0 BEGIN PGM EYES MM ; Two eyes and the lines that touch both: the drawing gives circles, no points of tangency. Made for this project.
1 BLK FORM 0.1 Z X-30 Y-30 Z-8
2 BLK FORM 0.2 X+90 Y+30 Z+0
3 TOOL CALL 1 Z S3000 F400
4 L Z+20 R0 FMAX M3
5 L X-40 Y+0 FMAX
6 L Z-4 F200
7 L X-20 RL F300 ; the leftmost point of the large eye
8 FC DR- R20 CLSD+ CCX+0 CCY+0
9 FLT
10 FCT DR- R12 CCX+60 CCY+0
11 FLT
12 FCT DR- R20 CLSD- CCX+0 CCY+0 X-20 Y+0
13 L X-40 R0
14 L Z+20 FMAX M30
15 END PGM EYES MM
