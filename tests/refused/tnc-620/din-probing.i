; 4:1 alarm: G55 is refused: Reference plane, not built yet (the block is read as TCH PROBE 0)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G55 P01 10 P02 X- P03 X+10 *
N99999999 %A G71 *
