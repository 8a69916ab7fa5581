; 4:5 alarm: X+10 needs a path function before it (for example G00 or G01)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 X+10 Y+5 *
N99999999 %A G71 *
