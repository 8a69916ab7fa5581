; 4:9 alarm: FC CCA (central angle) needs the sense of rotation (write DR+ or DR-)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC R5 CCA90
