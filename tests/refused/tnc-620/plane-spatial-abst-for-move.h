; 4:41 alarm: PLANE SPATIAL ABST (how far below the tip the point is that stands still) is for MOVE: with TURN the axes move alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN ABST50 FMAX
