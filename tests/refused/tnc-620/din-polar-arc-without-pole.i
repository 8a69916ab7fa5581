; 4:1 alarm: G13 needs a pole: no I J was programmed (write I… J… before it; the block is read as CP PA90 DR+ M3)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G13 H+90 M3 *
N99999999 %A G71 *
