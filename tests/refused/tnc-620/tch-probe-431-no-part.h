; 5:1 alarm: there is no part to touch (give one: Setup(part=…); "cut" is what the program has cut)
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
Q296=+90
Q297=+35
Q298=+12
Q320=0
Q260=+50
Q281=1
4 END PGM A MM
