; 5:1 alarm: STOPS is no statement of this control (near: STOP; if it is the rest of the comment above, begin it with ;)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Z+50 R0 FMAX ; the spindle
stops here
3 END PGM A MM
