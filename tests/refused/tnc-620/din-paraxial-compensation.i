; 4:9 alarm: G43 and G44, radius compensation of single axes, are not built yet
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G07 G43 X+50 *
N99999999 %A G71 *
