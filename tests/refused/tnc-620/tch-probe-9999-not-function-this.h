; 2:1 alarm: TCH PROBE 9999 is not a function of this control (near: TCH PROBE 409, TCH PROBE 419)
1 TCH PROBE 9999 X
