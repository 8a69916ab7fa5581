; 4:1 alarm: G310 is refused: a cycle of the machine tool builder, whose manual alone describes it: leave it out where it moves nothing
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G310 Q1=1 *
N99999999 %A G71 *
