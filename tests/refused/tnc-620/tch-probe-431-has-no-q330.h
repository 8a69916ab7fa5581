; 18:1 alarm: Q330=1 has no meaning in this block (TCH PROBE 431 does not take Q330) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
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
Q330=1
4 END PGM A MM
