; 2:1 alarm: no feed rate was programmed before this move (write F)
1 APPR LT X+5 Y+5 LEN2 RL F100
2 L X+9
