; == a-under-m116-not-built
; 5:5 alarm: A under M116 (feed of rotary axes in mm/min) is not built yet (Setup(kinematics="table-ac"), or one of its own, says where the rotary axes are)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 M116
3 L A+5

; == u-refused-axis-u-not-built-2
; 5:16 alarm: U is refused: the secondary axis U is built for L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 S
3 CYCL DEF 7.1 U+5

; == u-secondary-axis-under-compensation
; 5:10 alarm: U5: secondary axes under radius compensation are not built yet (write R0)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10 Y+0 RL
3 L X+20 U+5

; == v-refused-axis-v-not-built
; 4:14 alarm: V is refused: the secondary axis V is built for L alone
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 V+1

; == v-secondary-axis-with-m91
; 4:5 alarm: V5: secondary axes under M91 or M92 are not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L V+5 M91 FMAX

; == w-secondary-axis-in-arc
; 5:9 alarm: W is refused: the secondary axis W is built for L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+0 Y+0
3 C X+0 W+5 DR+
