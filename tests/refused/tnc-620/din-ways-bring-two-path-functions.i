; 10:5 alarm: Y+5 has no certain path function: the ways that lead to this block bring different ones (write G00, G01 … in this block)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 X+1 M3 *
N30 L1 *
N40 G01 X+2 *
N50 L1 *
N60 M2 *
N70 G98 L1 *
N80 Y+5 *
N90 G98 L0 *
N99999999 %A G71 *
