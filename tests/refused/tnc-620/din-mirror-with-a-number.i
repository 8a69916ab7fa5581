; 4:9 alarm: only letters of axes stand here, for example X Y
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G28 X5 *
N99999999 %A G71 *
