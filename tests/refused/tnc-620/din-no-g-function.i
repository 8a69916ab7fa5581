; 4:5 alarm: G92 is no G function of DIN/ISO programs
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G92 X+0 Y+0 *
N99999999 %A G71 *
