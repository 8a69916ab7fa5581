; == din-approach-without-compensation
; 5:5 alarm: G26 needs a straight line with G41 or G42 directly before it, to the first contour point
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 X+10 Y+5 M3 *
N30 G26 R5 *
N99999999 %A G71 *

; == din-approach-without-radius
; 5:5 alarm: G26 needs the radius R of its arc
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 G41 X+0 Y+5 M3 *
N30 G26 *
N99999999 %A G71 *

; == din-arc-without-centre
; 5:1 alarm: G02 needs a circle centre: no I J was programmed (write I… J… before it; the block is read as C X0 Y10 DR-)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 X+10 Y+0 M3 *
N30 G02 X+0 Y+10 *
N99999999 %A G71 *

; == din-departure-without-g40
; 4:5 alarm: G27 needs a straight line with G40 after it, to the end of the departure
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G27 R5 *
N30 G01 X+5 *
N99999999 %A G71 *

; == din-g05-without-a-sense
; 4:5 alarm: G05 needs the sense of rotation of an arc before it: none was programmed (write G02 or G03, or G12 or G13)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G05 X+5 Y+5 R+10 *
N99999999 %A G71 *

; == din-greatest-corner-alone
; 4:13 alarm: G31 needs G30 before it (the block is read as BLK FORM 0.2 X100 Y100 Z0)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G31 G90 X+100 Y+100 Z+0 *
N99999999 %A G71 *

; == din-incremental-corner
; 3:17 alarm: G30 X (coordinate of the corner) must be absolute (the block is read as BLK FORM 0.1 Z IX0 IY0 IZ-20)
%A G71 *
N10 G30 G17 G91 X+0 Y+0 Z-20 *

; == din-mirror-with-a-number
; 4:9 alarm: only letters of axes stand here, for example X Y
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G28 X5 *
N99999999 %A G71 *

; == din-paraxial-compensation
; 4:9 alarm: G43 and G44, radius compensation of single axes, are not built yet
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G07 G43 X+50 *
N99999999 %A G71 *

; == din-plane-outside-the-tool-call
; 4:5 alarm: G18 is not the plane of the tool axis Z (the plane is chosen in the T block: T5 G17 S1000)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G18 G01 X+5 *
N99999999 %A G71 *

; == din-polar-arc-without-pole
; 4:1 alarm: G13 needs a pole: no I J was programmed (write I… J… before it; the block is read as CP PA90 DR+ M3)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G13 H+90 M3 *
N99999999 %A G71 *

; == din-polar-word-of-a-line
; 4:14 alarm: R+5 has no meaning in this block (straight lines to polar points are G10 and G11, arcs G12, G13, G15 and G16)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G01 X+10 R+5 M3 *
N99999999 %A G71 *

; == din-rapid-approach
; 4:5 alarm: G26 runs at feed: G00 is for straight lines (the block is read as APPR LCT RL X0 Y30 FMAX M3 R5)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 G41 X+0 Y+30 M3 *
N30 G26 R5 *
N40 G01 Y+60 *
N99999999 %A G71 *

; == din-rotation-too-large
; 4:9 alarm: G73 H (rotation angle) must be at least -360 and at most 360, got 400 (the block is read as CYCL DEF 10 ROT400)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G73 H+400 *
N99999999 %A G71 *

; == din-two-axes-of-g07
; 4:5 alarm: G07 moves one axis alone
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G07 X+5 Y+5 M3 *
N99999999 %A G71 *

; == din-z-alone-under-an-arc
; 7:5 alarm: Z+50 alone is no end of an arc (G02 is active) (write G00 or G01)
%A G71 *
N10 T1 G17 S1000 F100 *
N20 G00 X+10 Y+0 M3 *
N30 I+0 J+0 *
N40 G02 X+0 Y+10 *
N50 Z+50 *
N99999999 %A G71 *
