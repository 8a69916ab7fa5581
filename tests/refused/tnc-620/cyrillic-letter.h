; 4:5 alarm: 'Х' is a Cyrillic letter (write the Latin letter X)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Х+5
