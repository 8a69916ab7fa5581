; 4:9 alarm: G73 H (rotation angle) must be at least -360 and at most 360, got 400 (the block is read as CYCL DEF 10 ROT400)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G73 H+400 *
N99999999 %A G71 *
