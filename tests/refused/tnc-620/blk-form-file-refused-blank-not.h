; 4:1 alarm: BLK FORM FILE is refused: blank from a file, not built yet: write BLK FORM 0.1 and 0.2, or give Setup(stock=…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM FILE "A.STL"
