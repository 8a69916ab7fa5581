; 4:5 alarm: G07 moves one axis alone
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G07 X+5 Y+5 M3 *
N99999999 %A G71 *
