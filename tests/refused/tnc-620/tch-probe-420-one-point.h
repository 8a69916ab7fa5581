; 8:1 alarm: TCH PROBE 420 Q265 (second touch point, reference axis) and Q266 give the first touch point again: two points make an angle
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 420 X
Q263=+10
Q264=+10
Q265=10
Q266=10
Q272=1
Q267=-1
Q261=-5
Q320=0
Q260=+10
Q301=1
Q281=1
4 END PGM A MM
