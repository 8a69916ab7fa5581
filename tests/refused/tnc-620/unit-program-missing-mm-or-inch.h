; 4:11 alarm: the unit of the program is missing: MM or INCH must follow its name
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 END PGM B
