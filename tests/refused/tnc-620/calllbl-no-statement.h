; 4:3 alarm: CALLLBL is no statement of this control (near: CALL LBL)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALLLBL 1
