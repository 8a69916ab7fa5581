; 4:14 alarm: R+5 has no meaning in this block (straight lines to polar points are G10 and G11, arcs G12, G13, G15 and G16)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 X+10 R+5 M3 *
N99999999 %A G71 *
