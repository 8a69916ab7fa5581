; 3:17 alarm: SEL CONTOUR NONE.I: there is no program of this name (Setup(files=…) has no files; the folder of din-sel-contour-no-program.i has none; the block is read as SEL CONTOUR NONE.I)
%A G71 *
N10 SEL CONTOUR "NONE.I" *
N99 %A G71 *
