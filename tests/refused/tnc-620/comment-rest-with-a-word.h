; 5:1 alarm: OF is no statement of this control (if it is the rest of the comment above, begin it with ;)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 ; a comment that an editor wrapped in the middle
of what it says about X+5
3 END PGM A MM
