; 4:13 alarm: * ends a block: no words may stand behind it (the next block begins with N)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 X+5 * Y+5
N99999999 %A G71 *
