; 4:22 alarm: CONTOUR DEF P1: contours are built for the tool axis Z alone
0 BEGIN PGM A MM
1 TOOL CALL 1 X S100
CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM
