"""What parameters of drilling, milling, patterns and datums measure."""

from __future__ import annotations

from mnclab.lab.sketches import views
from mnclab.lab.sketches.ink import Sheet
from mnclab.lab.sketches.kinds import Draw, Kind
from mnclab.lab.sketches.rules import TABLE, Rule, axes, drawn, points
from mnclab.lab.sketches.views import level, middle, place, size, spins, wait, way

LETTERS = "edge 22,20 22,46 33,46; edge 46,20 46,46; edge 46,33 60,33; edge 60,20 60,46; edge 70,20 85,20; edge 77.5,20 77.5,46"
LINES = "part b:19,14,81,50; dash 12,44 88,44; dash 12,32 88,32; dash 12,20 88,20; "
HOLES = "dash o:48,33,25; edge o:71.5,24.4,3.4 o:56.6,9.5,3.4 o:35.5,11.3,3.4 o:23.4,28.7,3.4 o:28.8,49.1,3.4; "
ROW = "edge o:24,47,3.2 o:44,47,3.2 o:64,47,3.2 o:84,47,3.2; "
ROWS = ROW.replace(",47,", ",30,") + ROW.replace(",47,", ",13,")
SLOT = "part 48,56,42,40,110 35.7,22.2,6,110,290 48,56,30,110,40 75.6,32.9,6,220,400; dash 48,56,36,0,180; "
SLOTS = (
    "part 48,56,42,25,65 63.2,23.4,6,65,245 48,56,30,65,25 80.6,40.8,6,205,385; "
    "part 48,56,42,95,135 22.5,30.5,6,135,315 48,56,30,135,95 44.9,20.1,6,275,455; dash 48,56,36,0,180; "
)
SHIFT = "thin 11,3 11,55 93,55; datum 11,55; thin 62,3 62,24 93,24; new 62,24; "


def turned_axes(across: str, up: str) -> Draw:
    """Two axes, turned from one to the other."""

    def draw(s: Sheet, kind: Kind) -> None:
        drawn("edge 84,52 26,52 26,8; dash 78.6,27.5 26,52 7.4,12.1; ang 26,52 36 0 25 0")(s, kind)
        s.word(across, 89, 57)
        s.word(up, 32, 8)

    return draw


MILLS: tuple[Rule, ...] = (
    # heights
    (".+", "second set-up clearance", level("surface", "second", "second")),
    (".+", "set-up clearance|clearance above the (surface|milling height)", level("surface", "clear", "clear")),
    (".+", "clearance height", level("zero", "second", "second")),
    (".+", "(coordinate of the )?(workpiece )?surface|height from which to mill", level("datum", "surface")),
    ("face", "(height|coordinate) of the milled surface|(height down to which|coordinate) to mill( down to)?",
     level("datum", "bottom")),
    ("back boring", "depth of the counterbore( from the lower surface)?", level("under", "counterbore")),
    ("back boring", "depth of the counterbore from below", level("zero", "counterbore")),
    ("back boring", "level R, below the workpiece", level("zero", "below")),
    ("back boring", "material thickness|thickness of the workpiece", level("surface", "under")),
    ("back boring", "off-centre distance of the (tool|bar)",
     drawn("side; tool 53,1 53,58 63,58 63,54 69,50 63,50 63,1; dash 62,4 62,63; dash 58,20 58,63; dim 58,24 62,24")),
    ("back boring", "height of the edge above the end of the bar",
     drawn("side; tool 57,1 57,56 67,56 67,52 74,46 67,46 67,1; dim 84,56 84,46 67,56 74,46")),
    ("thread", "depth of the thread from where the tool stands", level("clear", "bottom", "clear")),
    (".+", "(milling |thread )?depth( of the thread)?( from the surface( to the (bottom|floor|tip))?)?",
     level("surface", "bottom")),
    (".+", "bottom of the hole", level("zero", "bottom")),
    (".+", "level R", level("zero", "clear", "clear")),
    (".+", "depth below level R", level("clear", "bottom", "clear")),
    (".+", "depth of (each infeed|the first infeed|one peck)|infeed depth( for chip breaking)?|greatest infeed|"
     "infeed (per cut|per turn( of the helix)?|of each layer|between chip breaks)", level("surface", "first", lines="first")),
    ("pocket|stud|face", "infeed (for|when) finishing( the walls)?", level("surface", "first", lines="first", wall=True)),
    ("hole", "least infeed", level("before last", "bottom", lines="first,before last")),
    ("hole", "decrement of the infeed|amount by which P shrinks after each infeed",
     drawn("edge 12,10 84,10; part b:20,10,32,54; part b:40,10,52,38; part b:60,10,72,22; dim 46,54 46,38 32,54 46,38")),
    ("hole|thread", "distance back to break the chip|retraction for chip breaking|upper advanced stop distance",
     level("reached", "back", "back", "reached")),
    ("thread", "retraction for chip breaking, in pitches", level("reached", "back", "back", "reached", written="{}×")),
    ("hole", "lower advanced stop distance", level("low reached", "low back", "low back", "low reached")),
    ("hole", "depth of the start(ing)? point( below the surface)?", level("surface", "start", lines="start")),
    ("hole", "depth of a dwell on the way", level("surface", "wait", lines="wait")),
    ("hole", "chip breaks before each (withdrawal|retraction)",
     drawn("side; dash 62,20 62,52; measure 55,37 69,37; measure 55,42 69,42; measure 55,47 69,47; at 40,42")),
    ("pocket|stud|face", "(finishing )?allowance (for|of) (the )?floor|finishing allowance",
     level("rest", "bottom", lines="rest")),
    # sizes and places in a section
    ("bore", "hole diameter|diameter of the bore", drawn("side; dim 52,20 72,20 52,31 72,31")),
    ("bore", "diameter (of the hole drilled|roughed) before",
     drawn("side; dash 57,31 57,54; dash 67,31 67,54; dim 57,20 67,20 57,31 67,31")),
    ("centring", "diameter of the centring", drawn("side; dim 46,20 78,20 46,31 78,31")),
    ("thread", "nominal diameter", drawn("side; dim 48,20 76,20 48,34.5 76,34.5")),
    ("outside thread", "nominal diameter", drawn("side; dim 48,20 68,20 48,31 68,31")),
    ("thread", "(thread )?pitch( of the thread)?", drawn("side; dim 30,34.5 30,41.5 48,34.5 48,41.5")),
    ("outside thread", "thread pitch", drawn("side; dim 34,38 34,45 48,38 48,45")),
    ("thread", "threads per step", drawn("side; say {}×; dim 30,34.5 30,48.5 48,34.5 48,48.5")),
    ("outside thread", "threads per step", drawn("side; say {}×; dim 34,31 34,45 48,31 48,45")),
    ("thread", "total hole depth", level("surface", "end")),
    ("thread", "countersinking depth", drawn(
        "side; tool 56,1 56,20 42,20 42,26 56,38 56,48 68,48 68,38 82,26 82,20 68,20 68,1; dim 30,31 30,48 52,31 56,48")),
    ("thread", "set-up clearance at the side", drawn("side; tool 60,1 60,46 70,46 70,1; dim 70,41.5 76,41.5")),
    ("thread", "depth at front", drawn("side; tool 58,1 58,29 66,39 74,39 82,29 82,1; dim 30,31 30,39 52,31 66,39")),
    ("outside thread", "depth at front", drawn("side; tool 62,1 62,29 70,39 80,39 88,29 88,1; dim 30,31 30,39 48,31 70,39")),
    ("thread", "offset at front",
     drawn("side; tool 58,1 58,29 66,39 74,39 82,29 82,1; dash 62,4 62,60; dash 70,16 70,44; dim 62,20 70,20")),
    ("outside thread", "offset at front from the stud centre",
     drawn("side; tool 62,1 62,29 70,39 80,39 88,29 88,1; dash 58,4 58,60; dash 75,2 75,46; dim 58,18 75,18")),
    # times, speeds, feeds up and down
    ("", "dwell", drawn("clock 40,32")),
    ("back boring", "dwell at the bottom.*", wait("under")),
    (".+", "dwell at the bottom.*", wait("bottom")),
    (".+", "dwell at the (clearance level|set-up clearance)", wait("clear")),
    ("hole", "speed when entering and leaving", spins("front")),
    ("hole", "speed when drilling", spins("bottom")),
    ("thread", "factor of the speed for retracting|how many times faster the tap comes out", spins("", "bottom", "clear")),
    ("thread", "feed rate( for tapping)?", spins("", "clear", "bottom")),
    ("back boring", "feed into and out of the workpiece|feed rate for pre-positioning", way("clear", "below", "clear")),
    ("back boring", "(counterboring )?feed( rate( for counterboring)?)?", way("below", "counterbore")),
    ("hole", "feed to the deepened start point|feed rate for pre-positioning", way("clear", "start", line="start")),
    ("hole", "feed rate factor after the dwell", way("wait", "bottom", line="wait")),
    ("thread|outside thread", "feed rate for pre-positioning", way("clear", "bottom", "clear")),
    ("contour", "feed rate for reciprocation", drawn("side; go 48,31 78,38 48,45 74,51")),
    (".+", "feed rate( for (plunging|drilling))?|(plung|drill|centr|ream|bor)ing feed|feed (of the plunge|down to the height)",
     way("clear", "bottom")),
    ("hole|bore|pocket", "feed out of the hole|return feed|retraction feed rate|feed rate for retraction",
     way("bottom", "clear")),
    # faces
    ("face", "clearance (at|to) the side", drawn("part b:42,10,95,54; tool o:17,32,10; dim 27,32 42,32")),
    ("face|ruled", "milling feed|feed rate for milling|finishing feed( rate)?", drawn(LINES + "go 12,44 70,44; at 48,38")),
    ("face", "feed to the next line|feed rate for the stepover", drawn(LINES + "go 88,44 88,33; at 48,38")),
    ("face", "positioning feed|feed rate for pre-positioning", drawn(LINES + "go 88,44 88,33; go 4,60 12,45; at 12,56")),
    ("face|ruled", "number of (lines|cuts)", drawn(LINES.replace("dash", "measure") + "at 48,38")),
    *points("ruled", "starting point, {1st}", 1),
    *points("ruled", "second point, {1st}", 2),
    *points("ruled", "third point, {1st}", 3),
    *points("ruled", "fourth point, {1st}", 4),
    *axes("face", "start corner along {X}|starting point, {1st}", place),
    ("face", "corner radius between limits", drawn("part 4,4 20,4 36,32,16,180,270 93,48 93,61 4,61; rad 36,32 16 225")),
    # figures from above
    (".*", "(greatest )?path overlap factor",
     drawn("fill b:3,3,93,61; dash 4,22 92,22; dash 4,42 92,42; tool o:66,22,15 o:66,42,15; say {}·R; dim 34,42 34,22")),
    ("rectangle|slot|face", "(pocket )?length along X|first side length|slot length|side along X", size("x")),
    ("rectangle|slot|face|ridge", "(pocket )?length along Y|second side length|(slot|ridge) width|side along Y", size("y")),
    ("rectangle", "first side of the blank", size("x", 6)),
    ("rectangle", "second side of the blank", size("y", 6)),
    ("rectangle", "corner radius|rounding .* of the corners", drawn("figure b:21,12,79,52,13; rad 66,25 13 45")),
    ("polygon", "rounding .* of the corners", drawn("part 6,60 6,10 44.4,10 44.4,30,20,90,30 79,60; rad 44.4,30 20 60")),
    ("circle", "circle diameter|diameter of the finished (pocket|stud)", size("x")),
    ("circle|polygon", "diameter of the blank", size("x", 6)),
    ("circle", "diameter of the rough pocket", size("x", -6)),
    ("circle", "radius of the pocket", drawn("figure; rad 50,32 20 30")),
    ("circle", "starting angle", drawn("figure; tool o:70.7,14.7,6; ang 50,32 13 0 40 20")),
    ("polygon", "number of corners",
     drawn("figure; head o:73.1,32,3 o:61.5,12,3 o:38.5,12,3 o:26.9,32,3 o:38.5,52,3 o:61.5,52,3")),
    ("rectangle|slot|polygon", "angle of (rotation|the pocket|the first corner)", views.rotation),
    ("rectangle|circle|slot|polygon|contour|ridge",
     "(finishing )?allowance (for side|of the walls|that stays at the side)|allowance in the first axis", views.allowance),
    ("face", "finishing allowance for side",
     drawn("part b:4,4,26,60; fill b:26,40,93,60; dash 36,4 36,60; tool o:56,30,14; dim 26,16 36,16")),
    *axes(".*", "(hole position|centre of the scaling) along {X}|(centre|starting point) (along|in) the {1st}", middle),
    (".*", "increment to the hole along X", drawn("dash o:24,48,7; edge o:72,16,7; dim 24,32 72,32 24,48 72,16")),
    (".*", "increment to the hole along Y", drawn("dash o:24,48,7; edge o:72,16,7; dim 48,48 48,16 24,48 72,16")),
    (".*", "number of holes", drawn("head o:18,32,4 o:38,32,4 o:58,32,4 o:78,32,4; at 48,46")),
    ("pattern", "diameter of the pitch circle", drawn(HOLES + "dim 24.5,24.4 71.5,41.6")),
    ("pattern", "starting angle", drawn(HOLES + "ang 48,33 17 0 20 8")),
    ("pattern", "stopping angle", drawn(HOLES + "ang 48,33 17 0 220 8")),
    ("pattern", "stepping angle", drawn(HOLES + "ang 48,33 17 20 70 8")),
    ("pattern", "number of operations", drawn(HOLES.replace("edge", "measure") + "at 48,33")),
    ("grid", "spacing along a line", drawn(ROW + ROWS + "dim 24,57 44,57 24,47 44,47")),
    ("grid", "spacing of the lines", drawn(ROW + ROWS + "dim 12,47 12,30 24,47 24,30")),
    ("grid", "number of operations on a line", drawn(ROW.replace("edge", "measure") + ROWS + "at 54,58")),
    ("grid", "number of lines", drawn(ROW + ROWS + "measure o:24,47,3.2 o:24,30,3.2 o:24,13,3.2; at 10,30")),
    ("grid", "rotation about the starting point", drawn(
        "edge o:18,52,3.2 o:38.1,47.6,3.2 o:58.1,43.1,3.2 o:78.2,38.7,3.2; "
        "edge o:14.4,35.8,3.2 o:34.5,31.4,3.2 o:54.5,26.9,3.2 o:74.6,22.5,3.2; ang 18,52 48 0 12.5 24")),
    ("ring", "slot width", drawn("figure; dim 55.8,27 58.9,15.4")),
    ("ring", "finishing allowance for side",
     drawn("figure; dash 48,56,38,40,110 35.7,22.2,2,110,290 48,56,34,110,40 75.6,32.9,2,220,400 z; dim 57.8,19.3 58.9,15.4")),
    ("ring", "feed rate for milling", drawn("figure; go 48,56,36,48,104; at 55,30")),
    ("ring", "finishing feed rate", drawn("figure; dash 48,56,36,40,110; go 48,56,39,48,104; at 55,30")),
    ("ring", "diameter of the pitch circle|pitch circle diameter", drawn("figure; dash 48,56,36,0,180; dim 12,56 84,56")),
    ("ring", "starting angle", drawn(SLOT + "ang 48,56 23 0 40 13")),
    ("ring", "(opening angle|angular length) of the slot", drawn(SLOT + "ang 48,56 23 40 110 13")),
    ("ring", "stepping angle", drawn(SLOTS + "ang 48,56 23 25 95 13")),
    ("ring", "number of slots", drawn(SLOTS.replace("part", "measure").replace(";", " z;", 2) + "at 48,56")),
    (".*", "angle of the spindle( stop| before tapping)?|spindle angle for .*",
     drawn("edge o:50,32,12; edge 57.7,22.8 62.9,16.7; ang 50,32 24 0 50 4")),
    ("bore", "shift off the wall|shift along X", drawn(
        "fill b:3,3,93,61; fill o:50,32,24; edge o:50,32,24; dash o:50,32,13; dash 63,32 73,32; tool o:38,32,13; "
        "tool 51,32 61,32; dim 50,32 38,32")),
    ("bore", "shift along Y", drawn(
        "fill b:3,3,93,61; fill o:50,32,24; edge o:50,32,24; dash o:50,32,13; dash 50,19 50,9; tool o:50,44,13; "
        "tool 50,31 50,21; dim 50,32 50,44")),
    ("back boring", "shift off the axis",
     drawn("fill b:3,3,93,61; fill o:50,32,24; edge o:50,32,24; dash o:50,32,11; tool o:40,32,11; dim 50,32 40,32")),
    ("rectangle|circle|slot|polygon|contour|ridge", "milling feed|feed (rate for (mill|rough)ing|on the helix)",
     views.mills()),
    ("rectangle|circle|slot|polygon|contour", "finishing feed( rate)?|feed rate for finishing", views.mills(True)),
    ("thread", "feed rate for approaching", drawn("figure; dash 50,32 60,32; go 60,32,10,180,360")),
    ("outside thread", "feed rate for approaching", drawn("figure; go 80,32,10,0,180; at 85,48")),
    ("thread", "feed rate for countersinking", drawn("figure; edge o:50,32,25; go 50,32,22.5,200,330; at 50,32")),
    ("outside thread", "feed rate for countersinking", drawn("figure; edge o:50,32,15; go 50,32,17.5,200,330; at 50,32")),
    # contours
    ("contour", "radius of the arc", drawn("part 4,48 92,48 92,61 4,61; tool 50,20,28,190,270 90,48; rad 50,20 28 225")),
    ("contour", "centre angle of the arc",
     drawn("part 4,48 92,48 92,61 4,61; tool 50,20,28,190,270 90,48; ang 50,20 14 190 270 14")),
    ("contour", "distance of the auxiliary point",
     drawn("part 4,48 92,48 92,61 4,61; tool 24,16 24,48 88,48; solid o:24,16,2; dim 38,16 38,48 24,16 24,48")),
    ("contour", "path extension",
     drawn("edge 34,46 70,46 88,18; dash 14,38 34,38; tool 34,38 66,38 82,14; dim 14,28 34,28 14,38 34,46")),
    ("contour", "accepted residual material", drawn(
        "fill 12,6 20,6 20,56 92,56 92,62 12,62; edge 20,6 20,56 92,56; fill 54,22,34,180,270 20,56; "
        "tool 54,22,34,180,270; dim 20,56 30,46")),
    ("contour", "connection distance",
     drawn("part b:6,40,32,54; part b:62,40,90,54; dash 6,47 90,47; dim 32,26 62,26 32,40 62,40")),
    ("contour", "radius at inside corners",
     drawn("fill 4,50 80,50 80,4 92,4 92,60 4,60; edge 4,50 80,50 80,4; dash 4,40 50,20,20,270,360 70,4; rad 50,20 20 315")),
    ("slot", "infeed per revolution",
     drawn("edge 4,12 92,12; edge 4,52 92,52; dash o:22,32,15 o:40,32,15 o:58,32,15; dim 55,32 73,32; at 84,32")),
    ("cylinder|cylinder ridge", "radius of the cylinder", drawn("part o:48,34,24; rad 48,34 24 30")),
    # letters
    ("letters", "character height", drawn(LETTERS + "; dim 12,46 12,20 22,46 22,20")),
    ("letters", "spacing factor", drawn(LETTERS + "; say ×{}; dim 33,54 46,54 33,46 46,46")),
    ("letters", "greatest text length", drawn(LETTERS + "; dim 22,56 85,56 22,46 85,20")),
    ("letters", "feed rate for milling", drawn(LETTERS + "; go 22,20 22,46 33,46; at 36,56")),
    ("letters", "angle of rotation", drawn("edge 22.7,17.4 33.1,45.7 43.4,42; edge 47.2,8.5 57.5,36.7; edge 65.4,1.8 75.7,30; "
                                           "edge 52.3,22.6 70.6,15.9; dash 10,54 92,54; ang 10,54 54 0 20 26")),
    ("letters", "radius of the arc",
     drawn("dash 48,62,40,20,160; edge 26,8 34,23 41,20; edge 64,23 72,8; edge 66,6 78,11; edge 44,2 44,18; "
                                           "edge 54,2 54,18; edge 44,10 54,10; rad 48,62 40 75")),
    # datums, turns and scales
    ("", "datum shift along X", drawn(SHIFT + "dim 11,47 62,47")),
    ("", "datum shift along Y", drawn(SHIFT + "dim 24,55 24,24 24,55 58,24")),
    ("", "datum shift along Z", drawn("thin 4,54 92,54; datum 12,54; thin 44,14 92,14; new 62,14; dim 30,54 30,14 16,54 58,14")),
    (".*", "number of the preset|row of the datum table", TABLE),
    ("", "(tilt angle|datum shift of) A", turned_axes("Y", "Z")),
    ("", "(tilt angle|datum shift of) B", turned_axes("Z", "X")),
    ("", "(tilt angle|datum shift of) C|rotation angle|angle of the base rotation", turned_axes("X", "Y")),
    ("", "feed of the rotary axes", drawn("edge o:48,34,20; edge 48,34 48,14; go 48,34,26,20,160; head o:48,34,2")),
    ("", "scaling factor", drawn("datum 10,58; dash b:10,34,42,58; edge b:10,10,74,58; go 42,34 74,10; say ×{}")),
    ("", "factor along X", drawn("datum 10,54; dash b:10,22,42,54; edge b:10,22,74,54; go 42,38 74,38; say ×{}")),
    ("", "factor along (Y|Z)", drawn("datum 10,58; dash b:10,34,42,58; edge b:10,8,42,58; go 26,34 26,8; say ×{}")),
    ("", "permissible contour deviation", drawn("dash 8,54 66,54 66,4; tool 8,54 26,14,40,270,360 66,4; dim 66,54 54.3,42.3")),
    ("", "permissible deviation of rotary axes", drawn("edge 20,58 76,58; ang 48,58 40 90 66 10")),
)
