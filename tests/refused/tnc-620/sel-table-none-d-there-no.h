; 3:11 alarm: SEL TABLE NONE.D: there is no datum table of this name (Setup(files=…) has no files; the folder of sel-table-none-d-there-no.h has none)
TOOL CALL 1 Z S1000 F100
SEL TABLE "NONE.D"
