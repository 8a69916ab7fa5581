; 4:7 alarm: 'O' has no meaning here (the letter O stands where the digit 0 was meant)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X1O
