; 4:53 alarm: PLANE SPATIAL SEQ (which of two solutions) is not built yet where it tilts
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE SPATIAL SPA+0 SPB+90 SPC+0 TURN MB MAX FMAX SEQ-
