; 9:1 alarm: TCH PROBE 426 Q266 (second touch point, minor axis) is that of the first touch point: a ridge lies between two
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 426 X
Q263=+50
Q264=+25
Q265=+50
Q266=25
Q272=2
Q261=-5
Q320=0
Q260=+20
Q311=45
Q288=45
Q289=44.95
Q281=1
Q309=0
Q330=0
4 END PGM A MM
