; 5:5 alarm: G26 needs the radius R of its arc
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 G41 X+0 Y+5 M3 *
N30 G26 *
N99999999 %A G71 *
