; 3:10 alarm: the name of a file is missing (for example SEL PATTERN "HOLES")
TOOL CALL 1 Z S1000 F100
SEL TABLE
