0  BEGIN PGM slots MM
1  ;----------------------
2  ;T2 D=+6 CR=+0 - flat end mill
3  ;----------------------
4  * - Slot 1
5  TOOL CALL 2 Z S5000
6  L M140 MB MAX
7  M3
8  L  X+78.008  Y-20 R0 FMAX
9  END PGM slots MM
