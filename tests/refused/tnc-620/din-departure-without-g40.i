; 4:5 alarm: G27 needs a straight line with G40 after it, to the end of the departure
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G27 R5 *
N30 G01 X+5 *
N99999999 %A G71 *
