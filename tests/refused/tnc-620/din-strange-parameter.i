; 4:17 alarm: Q999=5 has no meaning in this block (G201 does not take Q999) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G201 Q200=2 Q999=5 *
N99999999 %A G71 *
