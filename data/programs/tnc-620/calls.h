0 BEGIN PGM CALLS MM ; Five holes, each twenty deep, and three ways to call the cycle that drills them. Made for this project.
1 TOOL CALL 2 Z S1200 ; drill 8
2 L Z+25 R0 FMAX M3
3 CYCL DEF 200 DRILLING ~
  Q200=2 ;SET-UP CLEARANCE ~
  Q201=-20 ;DEPTH ~
  Q206=150 ;PLUNGING FEED ~
  Q202=6 ;INFEED ~
  Q210=0 ;DWELL AT TOP ~
  Q203=+0 ;SURFACE ~
  Q204=10 ;2ND SET-UP CLEARANCE ~
  Q211=0 ;DWELL AT DEPTH
4 L X+10 Y+10 FMAX M99 ; here, once
5 L X+30 FMAX
6 CYCL CALL ; where the tool stands
7 L X+50 FMAX M89 ; here, and after each positioning
8 L X+70 FMAX
9 L X+90 FMAX M99 ; the last one
10 L Z+25 FMAX M30
11 END PGM CALLS MM
