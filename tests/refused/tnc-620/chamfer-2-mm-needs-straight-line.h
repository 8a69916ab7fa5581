; 5:1 alarm: a chamfer of 2 mm needs a straight line before and after it (round a corner with RND)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 2
4 CR X+9 Y+10 R+5 DR+
