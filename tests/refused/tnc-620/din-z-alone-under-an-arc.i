; 7:5 alarm: Z+50 alone is no end of an arc (G02 is active) (write G00 or G01)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 X+10 Y+0 M3 *
N30 I+0 J+0 *
N40 G02 X+0 Y+10 *
N50 Z+50 *
N99999999 %A G71 *
