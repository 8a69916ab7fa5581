; 4:23 alarm: X5 has no meaning in this block (FUNCTION RESET TCPM does not take X)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FUNCTION RESET TCPM X+5
