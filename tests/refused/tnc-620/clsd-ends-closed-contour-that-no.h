; 4:14 alarm: CLSD- ends a closed contour that no CLSD+ began
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 Y+5 CLSD-
