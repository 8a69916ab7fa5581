; 4:12 alarm: division by zero at DIV (the block is read as FN 4 Q1 +5 DIV +0)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 D04 Q1 P01 +5 P02 +0 *
N99999999 %A G71 *
