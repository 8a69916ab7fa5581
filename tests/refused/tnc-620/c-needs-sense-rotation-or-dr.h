; 5:1 alarm: C needs the sense of rotation (write DR+ (counter-clockwise) or DR- (clockwise))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+10 Y+0
3 C X+20 Y+0
