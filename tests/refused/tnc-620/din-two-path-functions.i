; 4:9 alarm: G00 and G01 stand in one block: one path function is allowed
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 G01 X+10 *
N99999999 %A G71 *
