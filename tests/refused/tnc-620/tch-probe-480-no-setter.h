; 4:1 alarm: TCH PROBE 480 needs a tool setter, a plate: Setup(setter=mnclab.Setter(…))
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 480 X
Q260=+100
9 END PGM P MM
