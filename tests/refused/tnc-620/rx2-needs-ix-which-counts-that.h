; 4:10 alarm: RX2 needs IX, which counts from that block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 RX 2
