; 2:1 alarm: the unit of the program is missing: G71 (millimetres) or G70 (inches) must follow its name
%A *
N10 G00 X+5 *
