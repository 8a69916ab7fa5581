; 4:33 alarm: X5 has no meaning in this block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF +1 EQU +1 GOTO LBL 1 X5
3 LBL 1
