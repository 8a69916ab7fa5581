"""What parameters of probing cycles and of tool setting measure."""

from __future__ import annotations

from mnclab.lab.sketches.ink import Sheet, box, polar
from mnclab.lab.sketches.kinds import Draw, Kind
from mnclab.lab.sketches.rules import TABLE, Rule, axes, drawn, points
from mnclab.lab.sketches.views import middle, place, size, touched

HOLES = "dash o:48,33,25; edge o:71.5,24.4,3.4 o:56.6,9.5,3.4 o:35.5,11.3,3.4; "
WALL = "fill 58,4 92,4 92,60 58,60; edge 58,4 58,60; "
PART = "fill 42,34 91,34 91,62 42,62; edge 42,62 42,34 91,34; datum 68,34; "
CORNER = "fill 34,40 92,40 92,3 34,3; edge 92,40 34,40 34,3; tool o:48,44.5,4.5 o:80,44.5,4.5 o:29.5,32,4.5; "
CORNER += "tool o:29.5,10,4.5; "
TWO = "part o:26,40,17; part o:70,24,17; "
WAY = "dash 14,52 67.7,21; "
HOLDER = "edge b:28,3,68,12; fill b:38,12,58,{0}; tool b:38,12,58,{0}; "

def walls(grow: float = 0) -> Draw:
    """Two walls and the width between them, or over a ridge; with limits that are dashed."""

    def draw(s: Sheet, kind: Kind) -> None:
        for edge, end in ((26, 4), (74, 92)) if kind.inside else ((26, 74),):
            s.draw("fill", *box(edge, 6, end, 58), closed=True)
        for edge, out in ((26, -grow), (74, grow)):
            s.draw("edge", (edge, 6), (edge, 58))
            s.draw("dash", (edge + out, 6), (edge + out, 58))
        s.measure((26 - grow, 32), (74 + grow, 32))

    return draw

def tolerance(axis: str) -> Draw:
    """How far the middle may be from where it should be, to both sides."""
    turn = {"x": 0, "y": 90}.get(axis, 0)

    def draw(s: Sheet, kind: Kind) -> None:
        c = (38, 32)
        s.draw("thin", polar(c, 26, turn), polar(c, 26, turn + 180))
        s.draw("thin", polar(c, 26, turn + 90), polar(c, 26, turn - 90))
        for side in (0, 180):
            middle = polar(c, 16, turn + side)
            s.draw("dash", polar(middle, 18, turn + 90), polar(middle, 18, turn - 90))
        s.measure(c, polar(c, 16, turn))
        s.address, s.anchor = f"±{s.address}", (76, 32)

    return draw

TOUCHES: tuple[Rule, ...] = (
    ("top|plane", "(set-up|extra) clearance",
     drawn("fill b:5,46,91,62; edge 5,46 91,46; stem 56,22; say +{}; dim 36,46 36,27 36,46 56,27")),
    (".*", "(set-up|extra) clearance", drawn(WALL + "tool o:26,26,8; say +{}; dim 34,26 58,26")),
    (".*", "(safe|clearance) height", drawn(PART + "stem 56,12; dim 82,34 82,17 72,34 58,17")),
    ("sphere", "height of the center of the sphere",
     drawn("part o:58,28,14; edge 58,42 58,61; edge 46,61 70,61; datum 12,57; dim 26,57 26,28 16,57 58,28")),
    (".*", "measuring height (of the ball's cent(re|er)|at the (first|second) stud)|(first|second) measuring height",
     drawn(PART + "stem 37,50; dim 84,50 84,34 41,50 72,34")),
    (".*", "number in table|row of the datum table", TABLE),
    *axes(".*", "{X} of the centre|center, {ref}|coordinate along {X}|pre-position {X}", middle),
    *axes(".*", "{X} of the( measured)? point in the new system|new coordinate in the {ref}",
     lambda axis: place(axis, new=True, middle=True)),
    (".*", "Z (of the measured point )?in the new system( of the point measured along Z)?", place("z", new=True)),
    ("slot|point", "coordinate of the .* in the new system|new coordinate (in the measuring axis|of the touched point)",
     place("x", new=True, middle=True)),
    *axes(".*", "(nominal )?{X} of the point measured along Z|touch point of the probe axis, {ref}",
     lambda axis: place(axis, inset="top")),
    (".*", "nominal Z of the measuring point|height of the (reference|touched) surface", place("z")),
    ("rectangle", "nominal length along X|length along the reference axis", size("x")),
    ("rectangle", "nominal length along Y|length along the minor axis", size("y")),
    ("slot", "(slot|ridge|nominal) width|width of the (slot|ridge), .*|nominal length", walls()),
    ("pattern", "nominal diameter of the bolt hole circle", drawn(HOLES + "dim 24.5,24.4 71.5,41.6")),
    ("circle", "nominal diameter|diameter of the (ring|boss)", size("x")),
    ("circle", "radius of the (ring|stud)", drawn("figure; rad 50,32 20 30")),
    ("sphere", "exact radius of the calibration sphere",
     drawn("part o:58,28,16; edge 58,44 58,61; edge 46,61 70,61; rad 58,28 16 150")),
    ("circle|two|sphere", "angle of the first touch point|reference angle", touched(0, 20)),
    ("circle", "stepping angle", touched(20, 80)),
    ("two", "angle over which the touches are spread", touched(20, 170, spread=50)),
    ("circle|two|sphere", "number of (touches|touch points)", touched()),
    ("sphere", "touch points from pole to equator",
     drawn("part o:48,40,18; edge 48,58 48,63; head o:48,18.5,3.5 o:63.2,24.8,3.5 o:69.5,40,3.5; at 22,20")),
    ("pattern", "angle of the first hole", drawn(HOLES + "ang 48,33 17 0 20 8")),
    ("pattern", "angle of the second hole", drawn(HOLES + "ang 48,33 17 0 70 8")),
    ("pattern", "angle of the third hole", drawn(HOLES + "ang 48,33 17 0 120 8")),
    ("slot", "greatest permissible size|maximum limit", walls(6)),
    ("slot", "least permissible size|minimum limit", walls(-6)),
    ("point", "maximum limit", drawn(WALL + "dash 70,4 70,60; datum 12,50; dim 12,34 70,34 12,50 70,34")),
    ("point", "minimum limit", drawn(WALL + "dash 46,4 46,60; datum 12,50; dim 12,34 46,34 12,50 46,34")),

    ("pattern", "maximum limit", drawn(HOLES + "thin o:48,33,29; dim 19,33 77,33")),
    ("pattern", "minimum limit", drawn(HOLES + "thin o:48,33,20; dim 28,33 68,33")),
    (".*", "greatest permissible (size|length along X)|maximum limit( of the first side)?", size("x", 6)),
    (".*", "least permissible (size|length along X)|minimum limit( of the first side)?", size("x", -6)),
    (".*", "greatest permissible length along Y|maximum limit of the second side", size("y", 6)),
    (".*", "least permissible length along Y|minimum limit of the second side", size("y", -6)),
    *axes(".*", "permissible deviation of the centre along {X}|tolerance of the center, {ref}", tolerance),
    *axes("slot", "{X} of the starting point|starting point, {ref}", middle),
    *points("edge|corner|point|top|slot|plane", "{X} of the (first|measuring|first measuring) point|first (touch )?point, {ref}",
     1),
    *points("edge|plane|slot", "{X} of the second( measuring)? point|second (touch )?point, {ref}", 2),
    *points("corner|plane", "{X} of the third point|third (touch )?point, {ref}", 3),
    *points("two|four", "first center, {ref}", 1),
    *points("two|four", "second center, {ref}", 2),
    *points("four", "third center, {ref}", 3),
    *points("four", "fourth center, {ref}", 4),
    ("corner", "(distance )?from point 1 to (point )?2 along X", drawn(CORNER + "dim 48,56 80,56 48,44.5 80,44.5")),
    ("corner", "(distance )?from point (3|1) to (point )?4 along Y", drawn(CORNER + "dim 16,32 16,10 29.5,32 29.5,10")),
    ("slot", "shift of the second touch across the axis|offset of the second measurement",
     drawn("fill b:4,4,14,60; edge 14,4 14,60; fill b:82,4,92,60; edge 82,4 82,60; tool o:19,46,5 o:77,20,5; "
        "dim 48,46 48,20 24,46 72,20")),
    ("two", "diameter of the first stud|first diameter", drawn(TWO + "dim 9,40 43,40")),
    ("two", "diameter of the second stud|second diameter", drawn(TWO + "dim 53,24 87,24")),
    ("edge|two", "angle of the (line that is 0|reference line to X)|reference angle",
     drawn(WAY + "edge 14,52 90,52; ang 14,52 44 0 30 10")),
    (".*", "basic rotation|angle of the base rotation",
     drawn("part 14,52 72.2,37.5 65.5,10.3 7.3,24.9; dash 14,52 92,52; ang 14,52 66 0 14 8")),
    ("point", "angle (to that|from the probing) axis", drawn(WAY + "edge 14,52 90,52; tool o:14,52,5; ang 14,52 44 0 30 10")),
    ("point", "greatest distance|farthest way", drawn("tool o:14,52,5; solid o:67.7,21,2; dim 14,52 67.7,21")),
    ("point", "distance back|way back, at most to the start",
     drawn(WAY + "edge 79.2,32.9 63.2,5.1; tool o:66.8,21.5,5; dim 66.8,21.5 43.4,35")),
    ("point", "measuring feed|feed of the touch", drawn("edge 79.2,32.9 63.2,5.1; tool o:14,52,5; go 14,52 66.8,21.5")),
    ("point", "component along X|direction, X", drawn("go 14,52 67.7,52; tool 14,52 67.7,21; thin 67.7,52 67.7,21")),
    ("point", "(component along|direction,) (Y|Z)", drawn("go 14,52 14,21; tool 14,52 67.7,21; thin 14,21 67.7,21")),
    (".*", "positioning feed rate", drawn("fill b:5,46,91,62; edge 5,46 91,46; stem 22,28; go 32,28 76,28")),
)

TOOLS: tuple[Rule, ...] = (
    ("tool", "depth below the beam( for the radius)?", drawn(HOLDER.format(54) + "dash 4,34 92,34; dim 76,34 76,54 76,34 58,54")),
    ("tool", "length of the reference tool", drawn(HOLDER.format(46) + "dim 80,12 80,46 68,12 58,46")),
    ("tool", "diameter of the reference tool", drawn(HOLDER.format(46) + "dim 38,54 58,54 38,46 58,46")),
    ("tool", "permissible deviation of the length",
     drawn(HOLDER.format(46) + "dash 30,38 70,38; say ±{}; dim 78,46 78,38 58,46 70,38")),
    ("tool", "permissible deviation of the radius", drawn(HOLDER.format(46) + "dash 66,16 66,50; say ±{}; dim 58,30 66,30")),
    ("tool", "distance of the two points", drawn(
        "dash 4,46 92,40; tool 19,2 19,44.7 29,44.7 29,2; tool 67,2 67,41.7 77,41.7 77,2; dim 24,56 72,56 24,44.7 72,41.7")),
    ("tool", "clearance height", drawn(HOLDER.format(26) + "part b:36,48,60,62; datum 12,57; dim 22,57 22,26 16,57 38,26")),
)
