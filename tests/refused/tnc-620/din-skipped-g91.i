; 6:5 alarm: X+5 could be absolute or incremental: the ways that lead to this block bring G90 and G91 (write G90 or G91 in this block)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 M3 *
/N30 G91 *
N40 X+5 *
N99999999 %A G71 *
