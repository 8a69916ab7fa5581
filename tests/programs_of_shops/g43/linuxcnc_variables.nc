(a row of holes by a formula)
G21 G17 G90 G94 G40 G49 G80 G54 G98
F150 S1000 M3
#1=12.5 (pitch)
#<depth>=-6
G0 X0 Y0 Z10
G81 X[#1] Y[#1/2] Z#<depth> R2
X[2*#1]
X[3*#1] Y[SQRT[#1*8]]
G80
G0 X[ABS[-4]] Y[FIX[-2.7]]
G1 Z[COS[60]]
M2
