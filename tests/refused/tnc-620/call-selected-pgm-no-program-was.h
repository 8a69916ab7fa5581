; 4:1 alarm: CALL SELECTED PGM: no program was chosen (write SEL PGM "NAME" before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL SELECTED PGM
