; 4:41 alarm: PLANE SPATIAL MB (retraction before the axes turn) needs MOVE or TURN: with STAY no axis moves
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE SPATIAL SPA+0 SPB+20 SPC+0 STAY MB5
