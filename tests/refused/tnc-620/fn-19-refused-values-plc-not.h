; 4:1 alarm: FN 19 is refused: values to the PLC, not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 19: PLC=+10/+Q3
