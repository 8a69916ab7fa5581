; 3:14 alarm: SEL CONTOUR needs the name of a program (for example SEL CONTOUR "MODEL")
0 BEGIN PGM A MM
1 SEL CONTOUR
9 END PGM A MM
