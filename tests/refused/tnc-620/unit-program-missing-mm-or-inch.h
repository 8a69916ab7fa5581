; 2:13 alarm: the unit of the program is missing: MM or INCH must follow its name
0 BEGIN PGM A
1 TOOL CALL 1 Z S1000 F100
2 END PGM A
