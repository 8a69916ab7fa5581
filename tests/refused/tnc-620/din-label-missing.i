; 4:6 alarm: label 3 does not exist (this program has no labels; the block is read as CALL LBL 3 REP2)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 L3,2 *
N99999999 %A G71 *
