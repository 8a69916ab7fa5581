; 12:1 alarm: TCH PROBE 431 Q296 (third touch point, reference axis) and the other points lie on one line: three points must span a plane
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 431 X
Q263=+20
Q264=+20
Q294=-10
Q265=+50
Q266=+80
Q295=+0
Q296=80
Q297=140
Q298=+12
Q320=0
Q260=+50
Q281=1
4 END PGM A MM
