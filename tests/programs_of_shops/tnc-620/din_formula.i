; manner: DIN/ISO of the iTNC 530: formulas in Q, wall of lines
; 40 cos a, 20 sin a for a = 0, 90, 180
; at 11: 0, 0, 10
; at 15: 40, 0, 10 | 0, 20, 10 | -40, 0, 10
; at 18: -40, 0, 50
%ELLIPSE G71 *
N10 Q1 = 40 *
N20 Q2 = 20 *
N30 Q3 = 0 *
N40 T4 G17 S4000 F400 *
N50 G00 G40 G90 Z+10 M3 *
N60 G98 L1 *
N70 Q4 = Q1 * COS Q3 *
N80 Q5 = Q2 * SIN Q3 *
N90 G01 X+Q4 Y+Q5 F400 *
N100 Q3 = Q3 + 90 *
N110 D12 P01 +Q3 P02 +200 P03 1 *
N120 G00 Z+50 M2 *
N99999999 %ELLIPSE G71 *
