; 5:5 alarm: G26 needs a straight line with G41 or G42 directly before it, to the first contour point
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 X+10 Y+5 M3 *
N30 G26 R5 *
N99999999 %A G71 *
