; manner: DIN/ISO from a CAM post: no block numbers in order, one axis a block, M13
; at 12: 0, 0, 20
; at 13: 3.5, 2.25, 20
; at 16: 3.5, 17.75, -0.3
; at 17: 12.125, 17.75, -0.3
; at 18: 12.125, 7.75, -0.3
; at 20: 3.5, 7.75, 20
%POST G71 *
N1 G30 G17 X+0 Y+0 Z-10 *
N2 G31 G90 X+60 Y+20 Z+0 *
N5 T4 G17 S8000 *
N6 G00 G40 G90 Z+20 M13 *
N7 X+3.5 Y+2.25 *
N8 Z+2 *
N9 G01 Z-0.3 F200 *
N10 Y+17.75 F600 *
N11 X+12.125 *
N12 G91 Y-10 *
N13 G90 X+3.5 *
N14 G00 Z+20 M9 *
N15 M30 *
N99999999 %POST G71 *
