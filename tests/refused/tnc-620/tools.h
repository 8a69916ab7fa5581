; == tool-call-1-5-no-row
; 4:13 alarm: TOOL CALL 1.5 has no row in the tool table (tools: 0, 1, 2, 3, 4, 5, 6)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1.5 Z

; == tool-call-77777-no-row
; 4:13 alarm: TOOL CALL 77777 has no row in the tool table (tools: 0, 1, 2, 3, 4, 5, 6)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 77777 Z

; == tool-call-cannot-change-tool-under
; 5:13 alarm: TOOL CALL cannot change the tool under radius compensation (write R0 first)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 TOOL CALL 2 Z

; == tool-call-dr2-least-0-got
; 4:17 alarm: TOOL CALL DR2 (delta corner radius) must be at least 0, got -1: the corner radius is 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Z DR2-1

; == tool-call-f-greater-than-0
; 4:17 alarm: TOOL CALL F (feed rate) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Z F0

; == tool-call-no-text-was-given
; 4:13 alarm: TOOL CALL: no text was given to QS7
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL QS7 Z

; == tool-call-s-least-0-got
; 4:17 alarm: TOOL CALL S (spindle speed) must be at least 0, got -5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Z S-5

; == tool-call-tool-axis-u-not
; 4:15 alarm: TOOL CALL: the tool axis U is not built yet, X, Y and Z are
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 U

; == tool-call-tool-axis-w-not
; 4:15 alarm: TOOL CALL: the tool axis W is not built yet, X, Y and Z are
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 W S5

; == tool-def-77777-no-row
; 4:12 alarm: TOOL DEF 77777 has no row in the tool table (tools: 0, 1, 2, 3, 4, 5, 6)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL DEF 77777

; == tool-needs-number-tool
; 4:1 alarm: TOOL DEF needs the number of the tool (for example TOOL DEF 5 L+100 R+4)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL DEF
