; == din-builder-cycle
; 4:1 alarm: G310 is refused: a cycle of the machine tool builder, whose manual alone describes it: leave it out where it moves nothing
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G310 Q1=1 *
N99999999 %A G71 *

; == din-called-program-missing
; 4:6 alarm: %SUB: there is no program of this name (Setup(files=…) has no files; the folder of din-called-program-missing.i has none; the block is read as CALL PGM SUB)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 %SUB *
N99999999 %A G71 *

; == din-depth-of-a-cycle-missing
; 4:1 alarm: G200 Q201 (depth) is missing
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G200 Q200=2 Q206=150 Q202=5 Q203=+0 Q204=50 *
N30 G00 X+5 M3 *
N40 G79 *
N99999999 %A G71 *

; == din-division-by-zero
; 4:12 alarm: division by zero at DIV (the block is read as FN 4 Q1 +5 DIV +0)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 D04 Q1 P01 +5 P02 +0 *
N99999999 %A G71 *

; == din-jump-to-a-missing-label
; 4:27 alarm: label 7 does not exist (this program has no labels; the block is read as FN 9 +1 +1 7)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 D09 P01 +1 P02 +1 P03 7 *
N99999999 %A G71 *

; == din-label-missing
; 4:6 alarm: label 3 does not exist (this program has no labels; the block is read as CALL LBL 3 REP2)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 L3,2 *
N99999999 %A G71 *

; == din-label-twice
; 5:10 alarm: G98 L3 is set twice (a label stands for one place in the program)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G98 L3 *
N30 G98 L3 *
N99999999 %A G71 *

; == din-no-g-function
; 4:5 alarm: G92 is no G function of DIN/ISO programs
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G92 X+0 Y+0 *
N99999999 %A G71 *

; == din-no-path-function
; 4:5 alarm: X+10 needs a path function before it (for example G00 or G01)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 X+10 Y+5 *
N99999999 %A G71 *

; == din-operand-missing
; 4:18 alarm: D01 needs P02 (for example D01 Q1 P01 +2 P02 +3)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 D01 Q1 P01 +2 *
N99999999 %A G71 *

; == din-probing
; 4:16 alarm: G55 takes P01, P02 with P03, X, Y and Z (for example G55 P01 5 P02 X P03 0 X+5 Y+0 Z-5)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G55 P01 10 P02 X- P03 X+10 *
N99999999 %A G71 *

; == din-qc-formula-operator-missing
; 3:16 alarm: an operator is missing before the bracket (one of & | ^ \)
%A G71 *
N10 QC10 = QC1 ( QC2 ) *
N99 %A G71 *

; == din-repeat-brings-g91
; 6:5 alarm: X+2 could be absolute or incremental: the ways that lead to this block bring G90 and G91 (write G90 or G91 in this block)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 X+1 M3 *
N30 G98 L1 *
N40 X+2 *
N50 G91 Y+1 *
N60 L1,2 *
N99999999 %A G71 *

; == din-sel-contour-no-program
; 3:17 alarm: SEL CONTOUR NONE.I: there is no program of this name (Setup(files=…) has no files; the folder of din-sel-contour-no-program.i has none; the block is read as SEL CONTOUR NONE.I)
%A G71 *
N10 SEL CONTOUR "NONE.I" *
N99 %A G71 *

; == din-skipped-g91
; 6:5 alarm: X+5 could be absolute or incremental: the ways that lead to this block bring G90 and G91 (write G90 or G91 in this block)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 M3 *
/N30 G91 *
N40 X+5 *
N99999999 %A G71 *

; == din-strange-parameter
; 4:17 alarm: Q999=5 has no meaning in this block (G201 does not take Q999) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G201 Q200=2 Q999=5 *
N99999999 %A G71 *

; == din-two-path-functions
; 4:9 alarm: G00 and G01 stand in one block: one path function is allowed
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 G01 X+10 *
N99999999 %A G71 *

; == din-unit-in-the-middle
; 4:5 alarm: G70 is refused: the unit, which stands in the first block: %NAME G70
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G70 *
N99999999 %A G71 *

; == din-unit-missing
; 2:1 alarm: the unit of the program is missing: G71 (millimetres) or G70 (inches) must follow its name
%A *
N10 G00 X+5 *

; == din-ways-bring-two-path-functions
; 10:5 alarm: Y+5 has no certain path function: the ways that lead to this block bring different ones (write G00, G01 … in this block)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 X+1 M3 *
N30 L1 *
N40 G01 X+2 *
N50 L1 *
N60 M2 *
N70 G98 L1 *
N80 Y+5 *
N90 G98 L0 *
N99999999 %A G71 *

; == din-word-of-another-function
; 4:13 alarm: H+3 does not belong to G54 (it takes X Y Z U V W A B C)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G54 X+5 H+3 *
N99999999 %A G71 *

; == din-words-behind-the-star
; 4:13 alarm: * ends a block: no words may stand behind it (the next block begins with N)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 X+5 * Y+5
N99999999 %A G71 *
