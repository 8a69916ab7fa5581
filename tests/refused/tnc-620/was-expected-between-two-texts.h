; 4:13 alarm: || was expected between two texts
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = "A" "B"
