; 6:1 alarm: no feed rate was programmed before this move (write F or FMAX; with the setting feed_needed = False such a move is at rapid, with a warning)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FZ0.1 M3
3 TOOL CALL 6
4 L X+9
