; 4:6 alarm: %SUB: there is no program of this name (Setup(files=…) has no files; the folder of din-called-program-missing.i has none; the block is read as CALL PGM SUB)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 %SUB *
N99999999 %A G71 *
