; 21:1 alarm: Q320=0 has no meaning in this block (TCH PROBE 430 does not take Q320) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 430 X
Q273=+50
Q274=+50
Q262=80
Q291=+0
Q292=+90
Q293=+180
Q261=-5
Q260=+10
Q288=80.1
Q289=79.9
Q279=0.15
Q280=0.15
Q281=1
Q309=0
Q330=0
Q320=0
4 END PGM A MM
