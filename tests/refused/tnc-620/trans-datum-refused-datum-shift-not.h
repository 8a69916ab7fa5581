; 3:1 alarm: TRANS DATUM is refused: datum shift, not built yet
TOOL CALL 1 Z S1000 F100
TRANS DATUM AXIS X+5
