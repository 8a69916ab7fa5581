; 2:1 alarm: no feed rate was programmed before this move (write F or FMAX; with the setting feed_needed = False such a move is at rapid, with a warning)
L X+5
