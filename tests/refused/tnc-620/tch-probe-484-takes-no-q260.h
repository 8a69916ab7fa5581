; 6:1 alarm: Q260=9 has no meaning in this block (TCH PROBE 484 does not take Q260) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 484 X
Q536=1
Q260=9
9 END PGM P MM
