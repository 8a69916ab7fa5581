; == cycle-10-rot-least-360-most-2
; 5:17 alarm: CYCL DEF 10 ROT (rotation angle) must be at least -360 and at most 360, got -361
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 10.0 R
3 CYCL DEF 10.1 IROT-361

; == cycle-10-rot-least-360-most
; 5:17 alarm: CYCL DEF 10 ROT (rotation angle) must be at least -360 and at most 360, got 400
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 10.0 R
3 CYCL DEF 10.1 ROT+400

; == cycle-10-rot-missing
; 4:1 alarm: CYCL DEF 10 ROT (rotation angle) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 10.0 R

; == cycle-11-scl-least-1e-06-2
; 4:15 alarm: CYCL DEF 11 SCL (scaling factor) must be at least 1e-06 and at most 99.999999, got -1
TOOL CALL 1 Z S1000 F100
CYCL DEF 11.0 S
CYCL DEF 11.1 SCL -1

; == cycle-11-scl-least-1e-06-3
; 4:15 alarm: CYCL DEF 11 SCL (scaling factor) must be at least 1e-06 and at most 99.999999, got 100
TOOL CALL 1 Z S1000 F100
CYCL DEF 11.0 S
CYCL DEF 11.1 SCL 100

; == cycle-11-scl-least-1e-06
; 4:15 alarm: CYCL DEF 11 SCL (scaling factor) must be at least 1e-06 and at most 99.999999, got 0
TOOL CALL 1 Z S1000 F100
CYCL DEF 11.0 S
CYCL DEF 11.1 SCL 0

; == cycle-247-q339-missing
; 3:1 alarm: CYCL DEF 247 Q339 (number of the preset) is missing
TOOL CALL 1 Z S1000 F100
CYCL DEF 247 P

; == cycle-247-q339-whole-number-least
; 4:1 alarm: CYCL DEF 247 Q339 (number of the preset) must be a whole number and at least 0 and at most 65535, got 65536
TOOL CALL 1 Z S1000 F100
CYCL DEF 247 P
Q339=65536

; == cycle-247-q339-whole-number
; 5:1 alarm: CYCL DEF 247 Q339 (number of the preset) must be a whole number and at least 0 and at most 65535, got 1.5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 247 X
Q339=+1.5

; == cycle-26-ccx-least-99999-9999
; 4:19 alarm: CYCL DEF 26 CCX (centre of the scaling along X) must be at least -99999.9999 and at most 99999.9999, got 100000
TOOL CALL 1 Z S1000 F100
CYCL DEF 26.0 S
CYCL DEF 26.1 X 2 CCX+100000

; == cycle-26-needs-axis-its-factor
; 3:1 alarm: CYCL DEF 26 needs an axis and its factor, for example CYCL DEF 26.1 X 1.4 Y 0.6
TOOL CALL 1 Z S1000 F100
CYCL DEF 26.0 S
CYCL DEF 26.1 CCX+1

; == cycle-26-takes-no-incremental-value
; 4:15 alarm: CYCL DEF 26 takes no incremental value, got IX
TOOL CALL 1 Z S1000 F100
CYCL DEF 26.0 S
CYCL DEF 26.1 IX 2

; == cycle-26-x-least-1e-06
; 4:15 alarm: CYCL DEF 26 X (factor along X) must be at least 1e-06 and at most 99.999999, got 0
TOOL CALL 1 Z S1000 F100
CYCL DEF 26.0 S
CYCL DEF 26.1 X 0 Y 1

; == cycle-7-1-stands-after-cycle
; 6:3 alarm: CYCL DEF 7.1 stands after CYCL DEF 7.2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 S
3 CYCL DEF 7.2 X+5
4 CYCL DEF 7.1 Y+6

; == cycle-7-1-stands-without-cycle
; 4:3 alarm: CYCL DEF 7.1 stands without CYCL DEF 7.0 before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.1 X+5

; == cycle-7-needs-active-datum-table
; 4:14 alarm: CYCL DEF 7 # (row of the datum table) needs an active datum table: write SEL TABLE before, or give Setup(datums=…)
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 #5

; == cycle-7-needs-axis-example-cycle
; 4:1 alarm: CYCL DEF 7 needs an axis, for example CYCL DEF 7.1 X+60
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 S
3 L X+5

; == cycle-7-shifts-axes-cannot-stand
; 5:14 alarm: CYCL DEF 7 # (row of the datum table) and shifts of axes cannot stand in one definition
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 X+1
CYCL DEF 7.2 #5

; == cycle-7-whole-number-least-0
; 4:14 alarm: CYCL DEF 7 # (row of the datum table) must be a whole number and at least 0 and at most 9999, got 10000
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 #10000

; == cycle-7-x-least-99999-9999
; 5:16 alarm: CYCL DEF 7 X (datum shift along X) must be at least -99999.9999 and at most 99999.9999, got 100000
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 S
3 CYCL DEF 7.1 X+100000

; == cycle-7-y-least-99999-9999
; 4:14 alarm: CYCL DEF 7 Y (datum shift along Y) must be at least -99999.9999 and at most 99999.9999, got -100000
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 Y-100000

; == cycle-8-axes-cannot-u-this
; 4:14 alarm: CYCL DEF 8 axes (mirrored axes) cannot be U: this axis is not built yet
TOOL CALL 1 Z S1000 F100
CYCL DEF 8.0 M
CYCL DEF 8.1 U

; == cycle-8-axes-most-three-got
; 4:14 alarm: CYCL DEF 8 axes (mirrored axes) must be at most three, got X Y A B
TOOL CALL 1 Z S1000 F100
CYCL DEF 8.0 M
CYCL DEF 8.1 X Y A B

; == cycle-8-axes-names-x-twice
; 4:14 alarm: CYCL DEF 8 axes (mirrored axes) names X twice
TOOL CALL 1 Z S1000 F100
CYCL DEF 8.0 M
CYCL DEF 8.1 X X

; == mirror-of-tool-axis-x
; 6:16 alarm: CYCL DEF 8 axes (mirrored axes) cannot be the tool axis X
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X
3 CYCL DEF 8.0 M
4 CYCL DEF 8.1 X

; == sel-table-5-d-name-datum
; 3:11 alarm: SEL TABLE 5.D: the name of a datum table must begin with a letter
TOOL CALL 1 Z S1000 F100
SEL TABLE "5.D"

; == sel-table-none-d-there-no
; 3:11 alarm: SEL TABLE NONE.D: there is no datum table of this name (Setup(files=…) has no files; the folder of sel-table-none-d-there-no.h has none)
TOOL CALL 1 Z S1000 F100
SEL TABLE "NONE.D"

; == sel-table-pnt-datum-table-type
; 3:11 alarm: SEL TABLE A.PNT: a datum table has the type .D
TOOL CALL 1 Z S1000 F100
SEL TABLE "A.PNT"

; == trans-datum-axis-needs-axis
; 4:1 alarm: TRANS DATUM AXIS needs an axis (for example TRANS DATUM AXIS X+60)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TRANS DATUM AXIS

; == trans-datum-reset-takes-no-words
; 4:21 alarm: X5 has no meaning in this block (TRANS DATUM RESET does not take X)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TRANS DATUM RESET X+5

; == trans-datum-table-not-built
; 4:1 alarm: TRANS DATUM is refused: datum shift of a table, not built yet: write CYCL DEF 7 with # and the row of the table
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TRANS DATUM TABLE TABLINE25
