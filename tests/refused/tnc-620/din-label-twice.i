; 5:10 alarm: G98 L3 is set twice (a label stands for one place in the program)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G98 L3 *
N30 G98 L3 *
N99999999 %A G71 *
