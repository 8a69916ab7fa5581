; 5:12 alarm: label "B" does not exist (this program has no labels)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = "B"
3 CALL LBL QS1
