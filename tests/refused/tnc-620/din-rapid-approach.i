; 4:5 alarm: G26 runs at feed: G00 is for straight lines (the block is read as APPR LCT RL X0 Y30 FMAX M3 R5)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 G41 X+0 Y+30 M3 *
N30 G26 R5 *
N40 G01 Y+60 *
N99999999 %A G71 *
