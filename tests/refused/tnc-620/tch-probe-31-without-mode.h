; 5:18 alarm: a number is missing: the mode 0, 1 or 2
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 31.0 X
3 TCH PROBE 31.1 CHECK:
9 END PGM P MM
