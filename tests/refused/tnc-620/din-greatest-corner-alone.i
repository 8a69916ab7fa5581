; 4:13 alarm: G31 needs G30 before it (the block is read as BLK FORM 0.2 X100 Y100 Z0)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G31 G90 X+100 Y+100 Z+0 *
N99999999 %A G71 *
