; 4:1 alarm: TCH PROBE 483 needs a tool setter, a plate: Setup(setter=mnclab.Setter(…))
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 483 X
Q340=1
Q260=+100
Q341=0
9 END PGM P MM
