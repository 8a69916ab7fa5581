; 5:1 alarm: G02 needs a circle centre: no I J was programmed (write I… J… before it; the block is read as C X0 Y10 DR-)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 X+10 Y+0 M3 *
N30 G02 X+0 Y+10 *
N99999999 %A G71 *
