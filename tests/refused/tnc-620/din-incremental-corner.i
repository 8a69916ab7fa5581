; 3:17 alarm: G30 X (coordinate of the corner) must be absolute (the block is read as BLK FORM 0.1 Z IX0 IY0 IZ-20)
%A G71 *
N10 G30 G17 G91 X+0 Y+0 Z-20 *
