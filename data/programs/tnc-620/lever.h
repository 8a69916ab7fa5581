0 BEGIN PGM LEVER MM ; A lever between two eyes, told as on its drawing: centres, radii, tangents. Made for this project.
1 BLK FORM 0.1 Z X-30 Y-30 Z-10
2 BLK FORM 0.2 X+110 Y+60 Z+0
3 TOOL CALL 1 Z S3000
4 L X-40 Y-20 Z+5 R0 FMAX M3
5 L Z-8 F200
6 L X-20 Y+0 RL F300 ; the leftmost point of the large eye
7 FC DR- R20 CLSD+ CCX+0 CCY+0
8 FLT ; the line that touches both eyes
9 FCT DR- R12 CCX+70 CCY+40
10 FLT AN-110
11 FCT DR- R15
12 FLT X+45 AN+195 ; the lower edge up to a notch
13 FL IAN-90 LEN12
14 RND R5.5
15 FL IAN+90 LEN16
16 RND R5.5
17 FL IAN+90 LEN12
18 FL IAN-90 ; goes on along the lower edge
19 FCT DR- R20 CLSD- CCX+0 CCY+0
20 L X-40 R0
21 L Z+5 FMAX M30
22 END PGM LEVER MM
