; 5:16 alarm: U is refused: the secondary axis U is built for L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 S
3 CYCL DEF 7.1 U+5
