; 2:13 alarm: the unit of the program is missing: MM or INCH must follow its name
0 BEGIN PGM A
