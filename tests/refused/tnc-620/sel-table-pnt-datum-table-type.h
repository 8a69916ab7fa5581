; 3:11 alarm: SEL TABLE A.PNT: a datum table has the type .D
TOOL CALL 1 Z S1000 F100
SEL TABLE "A.PNT"
