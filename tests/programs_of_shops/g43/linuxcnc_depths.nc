(steps of a pocket, the last one as deep as the bottom)
G21 F300 S1000 M3
#<bottom>=-5
#<z>=0
#<pass>=0
G0 X0 Y0 Z5
o10 do
  #<z>=[#<z>-2]
  #<pass>=[#<pass>+1]
  o20 if [#<z> LT #<bottom>]
    #<z>=#<bottom>
  o20 else if [#<pass> EQ 2]
    F150
  o20 endif
  G1 Z#<z>
  X[20*#<pass>]
  X0
o10 while [#<z> GT #<bottom>]
o30 repeat [2]
  G0 Z[10*#<pass>]
  #<pass>=[#<pass>+1]
o30 endrepeat
M2
