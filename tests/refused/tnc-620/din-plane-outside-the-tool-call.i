; 4:5 alarm: G18 is not the plane of the tool axis Z (the plane is chosen in the T block: T5 G17 S1000)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G18 G01 X+5 *
N99999999 %A G71 *
