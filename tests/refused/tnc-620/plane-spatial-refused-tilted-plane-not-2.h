; 3:1 alarm: PLANE SPATIAL is refused: tilted plane, not built yet
TOOL CALL 1 Z S1000 F100
PLANE SPATIAL SPA+0 SPB+90 SPC+0 TURN FMAX
