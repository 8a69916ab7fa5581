; == cfgread-refused-machine-parameters-are-not
; 4:8 alarm: CFGREAD is refused: machine parameters are not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = CFGREAD ( KEY_QS1 TAG_QS2 ATR_"A" )

; == declare-string-needs-qs-parameter
; 4:18 alarm: DECLARE STRING needs a QS parameter and = (for example DECLARE STRING QS1 = "A")
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 DECLARE STRING Q1 = 5

; == function-dwell-needs-time
; 4:18 alarm: FUNCTION DWELL needs TIME or REV (for example FUNCTION DWELL TIME10)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FUNCTION DWELL 10

; == function-dwell-rev-needs-turning-spindle
; 4:18 alarm: FUNCTION DWELL REV needs a turning spindle (write S and M3 before the move)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FUNCTION DWELL REV5

; == function-dwell-time-least-0
; 4:18 alarm: FUNCTION DWELL TIME (seconds) must be at least 0, got -1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FUNCTION DWELL TIME-1

; == function-dwell-time-needs-number
; 4:18 alarm: TIME needs a number
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FUNCTION DWELL TIME

; == function-reset-tcpm-takes-no-words
; 4:23 alarm: X5 has no meaning in this block (FUNCTION RESET TCPM does not take X)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FUNCTION RESET TCPM X+5

; == id-missing
; 4:23 alarm: ID is missing (for example FN 18: SYSREAD Q25 = ID210 NR4 IDX3)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = NR4

; == no-text-was-given-qs1-2
; 4:11 alarm: no text was given to QS1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 SEL PGM QS1

; == no-text-was-given-qs1
; 4:31 alarm: no text was given to QS1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF +1 EQU +1 GOTO LBL QS1

; == no-text-was-given-qs2
; 4:9 alarm: no text was given to QS2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = QS2

; == nothing-may-follow-strlen-here
; 4:24 alarm: nothing may follow STRLEN ( … ) here (calculate in a block of its own)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = STRLEN(SRC_"A") + 1

; == nr-missing
; 4:26 alarm: NR is missing (for example FN 17: SYSWRITE ID 990 NR 6 = +1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 17: SYSWRITE ID 990 = +1

; == sysstr-id10010-path-not-built
; 4:9 alarm: SYSSTR ID10010 NR1 is not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = SYSSTR ( ID10010 NR1 )

; == sysstr-id321-no-time-of-day
; 4:1 alarm: SYSSTR ID321 asks for the time, which a run does not have (the setting clock gives it one)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = SYSSTR ( ID321 NR 8 )

; == sysstr-needs-nr
; 4:9 alarm: SYSSTR needs NR
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = SYSSTR ( ID321 )

; == tonumb-needs-text-that-one-number
; 4:8 alarm: TONUMB needs a text that is one number, got "8A"
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = TONUMB ( SRC_"8A" )
