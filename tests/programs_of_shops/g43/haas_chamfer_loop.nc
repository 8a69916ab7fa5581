%
O00004 (CHAMFER OF A HOLE, ROUND BY ROUND)
G00 G17 G40 G49 G80 G90
G54
G52 X [ 0. ] Y [ 0. ] Z [ 0. ]
T11 D11 M06
G43 H11 Z50.
S3000 M03
#7= 250. (FEED)
#1= 0. (FROM)
#2= -2. (TO)
#3= 0.75 (STEP)
#5= 45. (ANGLE)
G00 X [ 0. ] Y [ 0. ]
G00 Z10. F#7
WHILE [ #1 GT #2 ] DO1
#1= #1 - #3
IF [ #1 LT #2 ] THEN #1= #2
#20= 14. / 2 + [ [ #1 - #2 ] * TAN[ #5 ] ] - 10. / 2
G01 X [ 0. ] Y [ 0. ]
G01 Z#1
G01 X [ 0. ] Y [ #20 ]
G03 I [ 0. ] J [ - #20 ]
G01 X [ 0. ] Y [ 0. ]
END1
G00 Z - 1.5
G00 Z150. M09
G52 X0. Y0. Z0.
M30
%
