; 3:11 alarm: SEL TABLE 5.D: the name of a datum table must begin with a letter
TOOL CALL 1 Z S1000 F100
SEL TABLE "5.D"
