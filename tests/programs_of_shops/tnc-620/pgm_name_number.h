; manner: TNC 150 / 355: a number as name, no block numbers, blanks between letter and number
; at 12: 20, 20, 5
; at 14: 20, 20, 3 | 20, 20, 1
; at 15: 30, 20, 3 | 30, 20, 1
; at 16: 30, 30, 3 | 30, 30, 1
; at 18: 20, 20, 3 | 20, 20, 1
; at 20: 20, 20, 50
BEGIN PGM 42 MM
TOOL DEF 7 L+0,000 R+3,000
TOOL CALL 7 Z S 1500,000
L Z + 5,000 R0 F9999 M03
L X + 20,000 Y + 20,000 R0 F9999
LBL 5
L IZ - 2,000 R0 F100
L IX + 10,000
L IY + 10,000
L IX - 10,000
L IY - 10,000
CALL LBL 5 REP 1/1
L Z + 50,000 R0 F9999 M02
END PGM 42 MM
