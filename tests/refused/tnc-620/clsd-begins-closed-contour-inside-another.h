; 5:14 alarm: CLSD+ begins a closed contour inside another one (end that with CLSD- first)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 Y+5 CLSD+
3 FL X+9 Y+5 CLSD+
