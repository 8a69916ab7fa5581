"""From a path to a design: holes, pockets, slots, studs, contours, faces, chamfers and threads that a program makes."""
