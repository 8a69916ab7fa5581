; 3:31 alarm: CONTOUR DEF I2 NONE: there is no program of this name (Setup(files=…) has no files; the folder of contour-def-no-program.h has none)
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1 I2 = "NONE"
2 M30
LBL 1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM
