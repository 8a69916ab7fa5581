; 4:1 alarm: PLANE EULER is refused: tilted plane, not built yet: write PLANE SPATIAL with the angles of the same plane
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE EULER EULPR+0 EULNU+0 EULROT+0 STAY
