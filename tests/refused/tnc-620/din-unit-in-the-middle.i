; 4:5 alarm: G70 is refused: the unit, which stands in the first block: %NAME G70
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G70 *
N99999999 %A G71 *
