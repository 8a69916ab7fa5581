"""Every cycle under scales, mirror images and rotations: the path moved by plain matrices, or a refusal before it moves.

What a frame does not change is told in the program of the other side: under an equal scale its lengths are written larger,
for the same tool, the same feeds and pitches and the same fixed distances; a cycle that keeps its sense of milling under a
mirror image has the other sense there, and a bar that leaves the wall with its spindle another direction.
"""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from tools.together import together

import mnclab
from mnclab import Kind, Setup, Tool
from mnclab.controls.tnc_620.reading import sub_blocks
from mnclab.controls.tnc_620.trial import as_sub_blocks
from mnclab.controls.tnc_620.trial import klartext as signed
from mnclab.machine import trial

pytestmark = pytest.mark.deep

MNC, TNC = (
    {code: each for code, each in mnclab.controls[name].cycles.items() if code == each.code and "MNC 12" not in each.source}
    for name in ("mnc", "tnc-620")
)
QUIET = (7, 8, 9, 10, 11, 12, 13, 14, 19, 20, 26, 32, 239, 247)  # what does not move
ALONG = (25, 27, 28, 29, 39, 270, 276)  # along one contour of a label: tested in frames with it
BUILT = [*MNC, *(code for code in TNC if code.startswith("CYCL") and int(code.split()[-1]) not in (*QUIET, *ALONG))]

#: What the frames must spare (mnc: MNC-PREP-XFORM; TNC 620: 5.2 to 5.10): the pitch of a tap, any size of a thread or a bar.
TAPS = ("G84", "G309", *(f"CYCL DEF {n}" for n in (2, 17, 18, 206, 207, 209)))
TRUE_TO_SIZE = ("G304", "CYCL DEF 204", *(f"CYCL DEF {n}" for n in (262, 263, 264, 265, 267)))
HOLES = ("G83", "G85", "G300", "G301", "G302", "G303", "G305", "G307",
         *(f"CYCL DEF {n}" for n in (1, 200, 201, 202, 203, 205, 220, 221, 240, 241)))  # fmt: skip
MILLS = [code for code in BUILT if code not in (*TAPS, *TRUE_TO_SIZE, *HOLES)]

#: Its advanced stop distance is that of the true depth, no length of the program: see test_obsolete_holes.
TRUE_STOPS = ("CYCL DEF 1", "CYCL DEF 21")

#: Those that need a contour and its data; where one side is milled the mirror image keeps it.
AREAS = tuple(f"CYCL DEF {n}" for n in (21, 22, 23, 24))

#: More ways to run a cycle than its examples.
MORE = {
    "CYCL DEF 24": [{"infeed": 2.5, "sense": -1}],
    "CYCL DEF 22": [{"swing_feed": 90}, {"swing_feed": 90, "factor": 50}],
    "G305": [{"mode": 1}],
    "G321": [{"strategy": 1}, {"strategy": 2}],
    "G343": [{"plunge": 0}, {"plunge": 2, "milling_mode": -1}],
    "G344": [{"plunge": 0}],
    "CYCL DEF 200": [{"reference": 1}],
    "CYCL DEF 220": [{"type_of_traverse": 1}],
    "CYCL DEF 275": [{"plunging_strategy": 2, "machining_operation": 1}],
    "CYCL DEF 232": [{"strategy": 0}, {"strategy": 1}],
    "CYCL DEF 233": [{"strategy": k} for k in (0, 1, 3)] + [{"strategy": 4, "limit_1": 0, "limit_2": 0}],
    "CYCL DEF 240": [{"mode": 1}],
    "CYCL DEF 251": [{"plunging_strategy": 0}, {"plunging_strategy": 2, "pocket_position": 3}],
    "CYCL DEF 256": [{"approach_position": 2}],
    "CYCL DEF 202": [{"disengage": k} for k in (2, 3, 4)],
    "G302": [{"disengage": k} for k in (2, 3, 4)],
}
CASES = [(code, more) for code in BUILT for more in [{}, *MORE.get(code, [])]]
LABELS = """LBL 1
L X-40 Y-30 RL
L X+40
L Y+30
L X-40
L Y-30
LBL 0
LBL 2
L X-8 Y-6 RR
L Y+6
L X+8
L X-8 Y-6
LBL 0
"""  # a pocket with an island


def values_of(code, more):
    """The examples of a cycle, with what is written otherwise."""
    cycle = MNC.get(code) or TNC[code]
    found = {p.name: trial.first_value(p) for p in cycle.parameters() if trial.written_first(p) or p.required}
    shallow = {"depth": -8} if code.startswith("CYCL DEF 25") else {}  # two layers are enough
    roughed = {"rough_out_tool": 1} if code == "CYCL DEF 24" else {}
    return found | shallow | roughed | more


def larger(code, values, s):
    """The values with every length s times as long: what is told in mm, but for a pitch (mm/rev)."""
    cycle = MNC.get(code) or TNC[code]
    lengths = {p.name for p in cycle.parameters() if p.unit == "mm" or p.name == "advance"}
    return {name: value * s if name in lengths else value for name, value in values.items()}


def words(code, values):
    cycle = MNC.get(code) or TNC[code]
    return [(p.address, values[p.name]) for p in cycle.parameters() if p.name in values]


def klartext(code, values):
    return " ~\n".join([f"{code} X", *(f"  {a}={signed(v)}" for a, v in words(code, values))]) + "\n"


def program(code, values, frame, s=1.0):
    """A cycle at (20, 10) in the frame, begun at (3, 4, 60); `s` makes these places larger."""
    x, y, z, u, v = (trial.number(place * s) for place in (3, 4, 60, 20, 10))
    tool = 1 if code in MILLS and code not in ("G306", "CYCL DEF 208") else 2
    if code in MNC:
        block = " ".join([code, *(a + trial.number(v) for a, v in words(code, values))])
        call = {"position": "G80", "definition": "M5", "call": f"G0 X{u} Y{v} M99"}[MNC[code].runs]
        if MNC[code].runs == "definition":
            x, y = u, v
        return "\n".join(["G90 G54", f"T{tool} S1000 M3", frame, f"G0 X{x} Y{y} Z{z} F100", block, call, ""])
    head = f"BEGIN PGM A MM\nTOOL CALL {tool} Z S1000\nM3\n{frame}L X{x} Y{y} Z{z} R0 FMAX\n"
    call = f"L X{u} Y{v} R0 FMAX M99\n"
    if code in sub_blocks.CODES:  # they begin at the set-up clearance
        block = "\n".join(as_sub_blocks(TNC[code], words(code, values)))
        return f"{head}{block}\nL Z{values['clearance']:g} FMAX\n{call}END PGM A MM\n"
    if code in ("CYCL DEF 220", "CYCL DEF 221"):
        head, call = head + klartext("CYCL DEF 200", larger("CYCL DEF 200", values_of("CYCL DEF 200", {}), s)), ""
    if code == "CYCL DEF 18":
        text = f"M5\nCYCL DEF 18.0 X\nCYCL DEF 18.1 DEPTH{-20 * s:g}\nCYCL DEF 18.2 PITCH+1.5\n"
        return head + text + call + "END PGM A MM\n"
    if code in AREAS:
        data = "CYCL DEF 14.0 X\nCYCL DEF 14.1 LABEL 1/2\n" + klartext("CYCL DEF 20", larger("CYCL DEF 20", SL, s))
        labels = "\n".join(
            " ".join(w[0] + f"{float(w[1:]) * s:+g}" if w[0] in "XY" else w for w in line.split())
            for line in LABELS.split("\n")
        )  # fmt: skip
        return head + data + klartext(code, values) + "CYCL CALL\nM30\n" + labels + "END PGM A MM\n"
    if code == "CYCL DEF 275":
        line = f"LBL 1\nL X{-40 * s:+g} Y{-30 * s:+g}\nL X{40 * s:+g}\nRND R{20 * s:g}\nL Y{30 * s:+g}\nLBL 0\n"
        data = "CYCL DEF 14.0 X\nCYCL DEF 14.1 LABEL 1\n"
        return head + data + klartext(code, values) + "CYCL CALL\nM30\n" + line + "END PGM A MM\n"
    return head + klartext(code, values) + call + "END PGM A MM\n"


SL = {"depth": -6, "overlap": 0.9, "side_allowance": 0.5, "floor_allowance": 0.2, "surface": 0, "clearance": 2,
      "height": 30, "corner": 0.5, "sense": 1}  # fmt: skip
END_MILL = Tool(radius=5, number=1, plunge_angle=3, cutting_length=4.5, kind="mill")
DRILL = Tool(radius=4, number=2, angle=118, plunge_angle=20, kind="drill")


@cache
def setup(s=1.0, steeper=1.0, peck=1.0):
    """An end mill and a drill s times the size; `steeper`: as they are where Z is measured in a shorter unit."""
    tools = {}
    for tool in (END_MILL, DRILL):
        angle, plunge = (math.radians(a) for a in (tool.angle, tool.plunge_angle))
        tools[tool.number] = replace(
            tool, radius=tool.radius * s, cutting_length=tool.cutting_length * s / steeper,
            angle=math.degrees(2 * math.atan(math.tan(angle / 2) * steeper)),
            plunge_angle=math.degrees(math.atan(math.tan(plunge) / steeper)),
        )  # fmt: skip
    return Setup(tools={0: Tool(), **tools}, start=(0, 0, 70), settings={"peck_clearance": peck})


RUNS = {}  # paths without a frame are asked for more than once


def run_once(code, text, tools):
    control = "mnc" if code in MNC else "tnc-620"
    key = control, text, id(tools)  # a setup lives as long as its cache
    if key not in RUNS:
        RUNS[key] = mnclab.run(text, control, tools if control == "mnc" else replace(tools, settings={}))
    return RUNS[key]


def rows(found):
    """All rows after the first motion."""
    assert found.ok, found.alarms
    path = found.toolpath[int(np.argmax(found.toolpath.kind == Kind.RAPID)) + 1 :]
    way = np.abs(path.end - path.start).max(axis=1) + np.abs(path.sweep)
    return path[~path.is_motion | (way > 1e-9)]  # not what only rounding makes a move


def assert_moved(moved, plain, matrix):
    """The rows are those of another path behind a matrix; tool, feeds and times as they are there."""
    linear, shift = matrix[:3, :3], matrix[:3, 3]
    assert len(moved) == len(plain)
    assert [moved.labels[k] for k in moved.label] == [plain.labels[k] for k in plain.label]
    for column in ("start", "end", "centre"):
        expected = getattr(plain, column) @ linear.T + shift
        np.testing.assert_allclose(getattr(moved, column), expected, atol=1e-7, err_msg=column)
    # the way round is a pseudovector: a mirror image turns it over
    round_ = (plain.axis * plain.sweep[:, None]) @ linear.T * np.linalg.det(linear)
    unit = linear.T @ linear
    if np.allclose(unit, unit[0, 0] * np.eye(3)):
        round_ /= unit[0, 0] ** 2
    else:  # Z alone is scaled: circles of the plane stay as they are
        round_ = plain.axis * plain.sweep[:, None]
    np.testing.assert_allclose(moved.axis * moved.sweep[:, None], round_, atol=1e-9)
    for column in ("kind", "feed", "per_rev", "time", "spindle", "tool", "radius", "exact", "synchronous"):
        np.testing.assert_allclose(getattr(moved, column), getattr(plain, column), rtol=1e-9, err_msg=column)


def assert_refused(found, code, *said):
    assert not found.ok
    assert all(piece in found.alarms[-1].message for piece in (code, *said)), found.alarms[-1].message
    assert not any(label.startswith(f"{code} ") for label in found.toolpath.labels), "it moved first"


def scaling(code, x, y, z):
    if code in MNC:
        return f"G37 X{x} Y{y} Z{z}"
    return f"CYCL DEF 26.0 S\nCYCL DEF 26.1 X {x} Y {y} Z {z}\n"


def equal(code, s):
    return f"G37 X{s} Y{s} Z{s}" if code in MNC else f"CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL {s}\n"


def mirror(code, axes):
    if code in MNC:
        return "G51 " + " ".join(f"{axis}0" for axis in axes)
    return f"CYCL DEF 8.0 M\nCYCL DEF 8.1 {' '.join(axes)}\n"


def turn(code, angle):
    return f"G39 A{angle}" if code in MNC else f"CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT{angle:+g}\n"


def mirrored(axes):
    return np.diag([-1.0 if axis in axes else 1.0 for axis in "XYZ"] + [1.0])


def turned(angle):
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


WAYS = {1: (-1, 0), 2: (0, -1), 3: (1, 0), 4: (0, 1)}


def as_the_spindle_has_it(code, values, whole, follows):
    """The values of a path that, moved by `whole`, leaves the wall as the cycle says; its direction follows some of it."""
    if values.get("disengage"):
        x, y = (np.linalg.inv(whole) @ follows)[:2, :2] @ WAYS[int(values["disengage"])]
        values = values | {"disengage": next(d for d, way in WAYS.items() if math.dist(way, (x, y)) < 1e-9)}
    if code == "CYCL DEF 208" and np.linalg.det(whole) < 0:
        values = values | {"climb": -values["climb"]}  # 4.9: a mirror image does not influence the type of milling
    if code == "CYCL DEF 275" and np.linalg.det(whole) < 0:
        values = values | {"milling_type": -values["milling_type"]}  # 8.3
    return values


def idents(case):
    code, more = case
    return " ".join([code, *(f"{name}={value:g}" for name, value in more.items())])


def each(*more):
    """A case a cycle, which lists every way to run it that fails; with more of what a test takes: its names and values."""
    names, values = more or ("", [()])
    return together(
        f"case {names}", [(case, *others) for case in CASES for others in values] if names else CASES,
        lambda case, *_: case[0], lambda case, *others: " ".join([idents(case), *map(str, others)]),
    )  # fmt: skip


@each("s", [(2,), (0.5,)])
def test_an_equal_scale_is_larger_lengths_for_the_same_tool(case, s):
    code, more = case
    values, tools = values_of(code, more), setup(s)
    found = run_once(code, program(code, values, equal(code, s)), tools)
    if code in TAPS + TRUE_TO_SIZE:
        return assert_refused(found, code, "under a scale", "keeps its")
    written = program(code, larger(code, values, s), "", s)
    assert_moved(rows(found), rows(run_once(code, written, tools)), np.eye(4))


FRAMES = [("X", 0), ("XY", 0), ("", 90), ("Y", -90)]


@each("axes angle", FRAMES)
def test_a_mirror_image_and_a_rotation_move_the_path(case, axes, angle):
    code, more = case
    values, first, second = values_of(code, more), mirrored(axes), turned(angle)
    if code in MNC:  # mirrored, then turned; the spindle follows neither
        frame, whole, follows = f"{turn(code, angle)}\n{mirror(code, axes) if axes else ''}", second @ first, np.eye(4)
    else:  # what is defined last acts first; the direction off the wall follows the rotation alone (4.5, 4.7)
        frame, whole, follows = (mirror(code, axes) if axes else "") + turn(code, angle), first @ second, second
    found = run_once(code, program(code, values, frame), setup())
    if code in AREAS[1:] and np.linalg.det(whole) < 0:
        return  # it keeps its sense: see below
    plain = run_once(code, program(code, as_the_spindle_has_it(code, values, whole, follows), ""), setup())
    assert_moved(rows(found), rows(plain), whole)


@each()
def test_scale_mirror_and_rotation_together(case):
    code, more = case
    if code in TAPS + TRUE_TO_SIZE or values_of(code, more).get("disengage") or code in (*AREAS, "CYCL DEF 208"):
        return
    values, whole = values_of(code, more), turned(30) @ mirrored("X")
    frame = turn(code, 30) + ("\n" if code in MNC else "") + mirror(code, "X")
    frame += ("\n" if code in MNC else "") + equal(code, 2)
    found = run_once(code, program(code, values, frame), setup(2))
    written = as_the_spindle_has_it(code, larger(code, values, 2), whole, whole)
    plain = run_once(code, program(code, written, "", 2), setup(2))
    assert_moved(rows(found), rows(plain), whole)


@each()
def test_unequal_scales_of_the_plane_move_holes_and_stop_what_mills(case):
    code, more = case
    values = values_of(code, more)
    for z in (1,) if code in TRUE_STOPS else (1, 2):
        found = run_once(code, program(code, values, scaling(code, 1, 3, z)), setup())
        if code in MILLS or more.get("mode") == 1 or more.get("type_of_traverse") == 1:
            assert_refused(found, code, "under unequal scales of the plane")
        elif code in TRUE_TO_SIZE or code in TAPS and z == 2:
            assert_refused(found, code, "under a scale")
        else:
            plain = rows(run_once(code, program(code, values, ""), setup(1, z, 1 / z)))
            plain = plain.replace(start=fixed_off(plain.start), end=fixed_off(plain.end))
            assert_moved(rows(found), plain, np.diag([1.0, 3, z, 1]))


def fixed_off(places):
    """Places where the shift off the wall is a third as long along Y, so that a factor of 3 makes it whole."""
    near = np.hypot(*(places[:, :2] - (20, 10)).T) < 0.5
    return np.where(near[:, None] & [False, True, False], 10 + (places - 10) / 3, places)


@each()
def test_another_scale_of_z_makes_deeper_what_a_tool_cuts_as_it_can(case):
    """Steps of the depth are longer; edges, point and slopes of the tool are what they are."""
    code, more = case
    if code in TRUE_STOPS or code == "CYCL DEF 23":  # whose arc to the floor would be an ellipse: it comes down straight there
        return
    values = values_of(code, more)
    found = run_once(code, program(code, values, scaling(code, 1, 1, 2)), setup())
    if code in TAPS + TRUE_TO_SIZE:
        return assert_refused(found, code, "under a scale of Z other than 1")
    plain = run_once(code, program(code, values, ""), setup(1, 2, 0.5))
    assert_moved(rows(found), rows(plain), np.diag([1.0, 1, 2, 1]))


# --- in figures of the manual, worked by hand ------------------------------------------------------------------------------


@pytest.mark.parametrize("factor", [0.1, 3])
@pytest.mark.parametrize("angle", [0, 33, 90])
@pytest.mark.parametrize("axis", ["", "X", "Y"])
def test_the_bar_leaves_the_wall_by_the_fixed_0_2_mm_with_its_spindle(factor, angle, axis):
    """MNC: in -X of the machine whatever the frame (MNC-PREP-XFORM); TNC 4.5: a rotation counts, a mirror image does not."""
    bored = [("G302", (-0.2, 0.0)), ("CYCL DEF 202", 0.2 * turned(angle + 180)[:2, 0])]
    for code, way in bored:
        frame = turn(code, angle) + "\n" + (mirror(code, axis) + "\n" if axis else "") + equal(code, factor)
        values = values_of(code, {"disengage": 1})
        path = rows(run_once(code, program(code, values, frame), setup()))
        away = next(move for move in path if move.label.endswith("leave the wall"))
        np.testing.assert_allclose((away.end - away.start)[:2], way, atol=1e-12)


def test_back_boring_shifts_with_the_spindle_under_a_rotation():
    path = rows(run_once("G304", program("G304", values_of("G304", {"disengage": 3}), "G39 A33\nG51 X0"), setup()))
    shift = next(move for move in path if move.label.endswith("shift off the axis"))
    np.testing.assert_allclose(shift.end - shift.start, (3.5, 0, 0), atol=1e-12)


def test_a_bar_is_not_shifted_where_the_hole_is_tilted():
    found = run_once("G302", "T2 S500 M3 F100\nG18 G39 A10\nG302 Q2 H-5 Z0 D1\nX5 M99\n", setup())
    assert_refused(found, "G302", "needs a hole along the spindle")
    assert run_once("G302", "T2 S500 M3 F100\nG18 G39 A10\nG302 Q2 H-5 Z0 D0\nX5 M99\n", setup()).ok


HOLES = ["G83 X5 Z-9 R2", "G84 X5 Z-9 R2", "G85 X5 Z-9 R2", "G300 Q2 H-9 Z0", "G309 Q2 H-9 Z0 P1.5"]


@pytest.mark.parametrize("cycle", [*HOLES, "G320 X0 Y0 Z0 A50 B10 K3 V150 Q2"])
def test_no_cycle_works_from_below(cycle):
    text = f"T2 S500 M3 F100\nG0 Z50\nG51 Z0\n{cycle}\n" + ("X5 M99\n" if cycle[:2] == "G3" else "")
    found = run_once(cycle.split()[0], text, setup())
    assert_refused(found, cycle.split()[0], "cannot run under a mirror image of Z")


@pytest.mark.parametrize("frame", ["G37 Z2", "G37 X2 Y2 Z2"])
def test_a_tap_is_refused_under_another_scale_of_z(frame):
    for cycle, call in (("G84 X5 Z-9 R2 F1.5", "G80"), ("G309 Q2 H-9 Z0 P1.5", "X5 M99")):
        found = run_once("G84", f"T2 S500 M3\nG95 {frame}\n{cycle}\n{call}\n", setup())
        assert_refused(found, cycle.split()[0], "under a scale of Z other than 1", "a thread keeps its pitch")


def test_a_tap_under_a_scale_of_the_plane_has_its_pitch():
    for cycle, call in (("G84 X5 Z-9 R2 F1.5", "G80"), ("G309 Q2 H-9 Z0 P1.5", "X5 M99")):
        path = rows(run_once("G84", f"T2 S500 M3\nG95 G37 X2 Y3\n{cycle}\n{call}\n", setup()))
        assert set(path.per_rev[path.synchronous]) == {1.5}
        assert set(path.end[1:, 0]) == {10.0}


@pytest.mark.parametrize("axes", ["X", "Y", "XY"])
@pytest.mark.parametrize("sense", [1, -1])
def test_a_mirror_image_keeps_the_sense_of_sl_cycles(axes, sense, monkeypatch):
    """8.3: climb milling with M3 goes round the wall of a pocket counter-clockwise on the machine, and its islands clockwise."""
    monkeypatch.setitem(SL, "sense", sense)
    frame = mirror("CYCL DEF 22", axes)
    values = values_of("CYCL DEF 22", {"swing_feed": 0, "infeed": 5})
    path = rows(run_once("CYCL DEF 22", program("CYCL DEF 22", values, frame), setup()))
    cut = path[(path.kind == Kind.LINE) & (path.start[:, 2] == path.end[:, 2]) & (path.end[:, 2] == -5)]
    x, y = cut.start[:, 0], cut.start[:, 1]
    outermost = (np.abs(np.abs(x) - 34.5) < 1e-9) | (np.abs(np.abs(y) - 24.5) < 1e-9)  # 40 and 30 less R and Q3
    ahead = cut.end - cut.start
    turning = (x * ahead[:, 1] - y * ahead[:, 0])[outermost]
    assert len(turning) and (np.sign(turning) == sense).all()


def test_a_pattern_stops_before_it_moves_to_a_cycle_that_cannot_run():
    pocket = klartext("CYCL DEF 252", values_of("CYCL DEF 252", {}))
    holes = klartext("CYCL DEF 221", values_of("CYCL DEF 221", {}))
    head = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nM3\n" + scaling("CYCL DEF 221", 1, 2, 1)
    found = run_once("CYCL DEF 221", head + pocket + holes + "END PGM A MM\n", setup())
    assert_refused(found, "CYCL DEF 221", "cannot run CYCL DEF 252 here", "under unequal scales of the plane")


@pytest.mark.parametrize("call", ["CYCL CALL PAT FMAX", "CYCL CALL POS X+5 Y+5 Z+0 FMAX", "L X+5 Y+5 FMAX M99"])
def test_a_call_stops_before_it_moves_to_the_place(call):
    """M99 acts at the end of its block."""
    pocket = "PATTERN DEF POS1 (X+5 Y+5 Z+0)\n" + klartext("CYCL DEF 252", values_of("CYCL DEF 252", {}))
    head = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nM3\n" + scaling("CYCL DEF 252", 1, 2, 1)
    found = run_once("CYCL DEF 252", f"{head}{pocket}{call}\nEND PGM A MM\n", setup())
    assert_refused(found, "CYCL DEF 252", "cannot run under unequal scales of the plane")
    assert len(found.toolpath.motion) == ("M99" in call)


def test_a_plane_that_is_not_that_of_the_cycle_does_not_decide():
    """Pockets lie in XY under G18 too (MNC-PREP, chapter 10)."""
    text = "T1 S500 M3\nG0 Z9\n{}\n{}\nG344 Q2 Z0 H-4 P2 D30 K1 V100 F300\n"
    both = [run_once("G344", text.format(plane, "G37 X2 Y2"), setup()).toolpath for plane in ("G17", "G18")]
    assert both[0].end.tolist() == both[1].end.tolist()
    found = run_once("G344", text.format("G18", "G37 X2 Z2"), setup())
    assert_refused(found, "G344", "under unequal scales of the plane")
    centred = [run_once("G305", f"T2 S500 M3 F100\n{plane}\nG37 X2 Y2\nG305 Q2 Z0 L1 D-3\nM99\n", setup())
               for plane in ("G17", "G18")]  # fmt: skip
    for one in centred:  # a cone of 118 degrees, 6 wide on the machine
        assert one.toolpath.end[:, 2].min() == pytest.approx(-3 / math.tan(math.radians(59)))


def test_an_alarm_says_in_which_lengths_the_tool_counts():
    """A bore of 3 under the scale 2 is 6 wide; the tool is 8, and 4 in lengths of the program."""
    for code, small in (("CYCL DEF 208", {"diameter": 3}), ("G306", {"diameter": 3})):
        found = run_once(code, program(code, values_of(code, small), equal(code, 2)), setup())
        told = "must be at least the tool diameter 4, got 3, in lengths of the program"
        assert_refused(found, code, told, "under the scale 2 the tool diameter 8 counts as 4")
    plain = run_once("G306", program("G306", values_of("G306", {"diameter": 3}), "G39 A77"), setup())
    assert plain.alarms[0].message.endswith("must be at least the tool diameter 8, got 3")
    wide = {"diameter": 30, "predrilled_diameter": 5}
    warned = run_once("G306", program("G306", values_of("G306", wide), equal("G306", 2)), setup())
    assert warned.alarms[0].message.endswith("under the scale 2 the tool diameter 8 counts as 4")
