; 6:5 alarm: X+2 could be absolute or incremental: the ways that lead to this block bring G90 and G91 (write G90 or G91 in this block)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 X+1 M3 *
N30 G98 L1 *
N40 X+2 *
N50 G91 Y+1 *
N60 L1,2 *
N99999999 %A G71 *
