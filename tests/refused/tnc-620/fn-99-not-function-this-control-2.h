; 2:1 alarm: FN 99 is not a function of this control (near: FN 9, FN 19, FN 29)
1 FN 99 X
