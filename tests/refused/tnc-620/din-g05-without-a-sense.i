; 4:5 alarm: G05 needs the sense of rotation of an arc before it: none was programmed (write G02 or G03, or G12 or G13)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G05 X+5 Y+5 R+10 *
N99999999 %A G71 *
