G21 F300 S1000 M3
o100 sub
  o101 if [#3 LE 0]
    o101 return [-1]
  o101 endif
  G0 X#1 Y#2
  G1 Z[0-#3]
  G0 Z5
o100 endsub [#3]
G0 Z5
#<k>=0
o110 while [#<k> LT 3]
  o100 call [10*#<k>] [#<k>*#<k>] [2-#<k>]
  #<k>=[#<k>+1]
o110 endwhile
G0 X[#<_value>] Y0
M2
