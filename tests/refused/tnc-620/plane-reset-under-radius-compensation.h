; 5:15 alarm: PLANE RESET cannot change the plane under radius compensation (write R0 before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL F9
3 PLANE RESET STAY
