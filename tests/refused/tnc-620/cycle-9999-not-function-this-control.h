; 2:1 alarm: CYCL DEF 9999 is not a function of this control (near: CYCL DEF 9, CYCL DEF 209, CYCL DEF 29)
1 CYCL DEF 9999 X
