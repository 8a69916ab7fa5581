/* moves as a text for a small controller */
const char moves[] = "\
G21\n\
T1M6\n\
G0X0Y0\n\
G1X10Y5F300\n\
M30";
