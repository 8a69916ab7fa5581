0 BEGIN PGM SQUARE MM ; A square of 40 mm, milled 2 mm deep along its edges. Made for this project.
1 TOOL CALL 1 Z S1000
2 L X+0 Y+0 Z+5 R0 FMAX M3
3 L Z-2 F100
4 L X+40
5 L Y+40
6 L X+0
7 L Y+0
8 L Z+5 FMAX
9 END PGM SQUARE MM
