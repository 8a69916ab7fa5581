; 24:1 alarm: Q277=1 has no meaning in this block (TCH PROBE 421 does not take Q277) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 421 X
Q273=+50
Q274=+50
Q262=30
Q325=+0
Q247=+90
Q261=-5
Q320=0
Q260=+20
Q301=0
Q275=30.1
Q276=30
Q279=0.1
Q280=0.1
Q281=0
Q309=0
Q330=0
Q423=4
Q365=1
Q277=1
4 END PGM A MM
