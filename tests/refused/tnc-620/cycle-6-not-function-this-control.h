; 2:1 alarm: CYCL DEF 6 is not a function of this control (near: CYCL DEF 8, CYCL DEF 26, CYCL DEF 7)
1 CYCL DEF 6 X
