; 4:11 alarm: RAN1 needs IAN, which counts from that block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL AN+5 RAN 1
