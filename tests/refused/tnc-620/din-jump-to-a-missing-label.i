; 4:27 alarm: label 7 does not exist (this program has no labels; the block is read as FN 9 +1 +1 7)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 D09 P01 +1 P02 +1 P03 7 *
N99999999 %A G71 *
