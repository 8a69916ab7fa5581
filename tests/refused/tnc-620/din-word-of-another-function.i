; 4:13 alarm: H+3 does not belong to G54 (it takes X Y Z U V W A B C)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G54 X+5 H+3 *
N99999999 %A G71 *
