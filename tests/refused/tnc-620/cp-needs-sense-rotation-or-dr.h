; 5:1 alarm: CP needs the sense of rotation (write DR+ (counter-clockwise) or DR- (clockwise))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP IPA+30
