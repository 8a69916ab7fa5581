"""Free contours FK: what is given of lines and arcs, solved."""
