; 4:8 alarm: CFGREAD is refused: machine parameters are not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = CFGREAD ( KEY_QS1 TAG_QS2 ATR_"A" )
