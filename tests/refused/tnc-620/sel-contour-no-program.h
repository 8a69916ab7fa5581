; 3:15 alarm: SEL CONTOUR NONE: there is no program of this name (Setup(files=…) has no files; the folder of sel-contour-no-program.h has none)
0 BEGIN PGM A MM
1 SEL CONTOUR "NONE"
9 END PGM A MM
