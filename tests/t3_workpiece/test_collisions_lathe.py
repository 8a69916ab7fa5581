"""What the tools of a lathe must not meet, put into programs on purpose: found at its line, in its place, as deep as it is."""

from math import radians, sin, tan

import pytest

import mnclab
from mnclab import Alarm, Limits, Setup, Tool
from mnclab.workpiece.blank import chuck, cylinder

BAR = cylinder(20, -60, 0)
HEAD = "M3 S500 G97 G94 F100 T{}\nG00 X40 Z20\n"  # lines 1 and 2 of every program
SHARP = {"main_angle": 93, "kind": "turning"}


def met(text, tool=1, head=HEAD, control="jnc-t01", stock=BAR, **given):
    """The collisions of a program with lines parted by |; the tool is one of the magazine, or a Tool."""
    if isinstance(tool, Tool):
        given["tools"], tool = {1: tool}, 1
    setup = Setup(stock=stock, start=(60, 0, 40), **given)
    program = mnclab.run(head.format(tool) + text.replace("|", "\n") + "\n", control, setup)
    assert [each for each in program.alarms if "spindle" not in each.message] == []
    return program.collisions()


def only(found, kind, line, depth, x=None, z=None):
    (each,) = found
    assert (each.kind, each.line, each.program) == (kind, line, 0)
    assert each.depth == pytest.approx(depth, abs=2e-3)
    for value, expected in ((each.place[0], x), (each.place[2], z)):
        assert expected is None or value == pytest.approx(expected, abs=2e-3)
    assert each.place[1] == 0 and f"{each.depth:.3f} mm" in each.message and str(each).startswith(f"program:{line}: ")
    return each


# --- rapids ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("depth", [0.02, 0.5, 3, 8])
@pytest.mark.parametrize("tool", [1, 2, 3])
def test_a_rapid_along_the_bar_under_its_surface(tool, depth):
    only(met(f"G00 X{20 - depth} Z2|Z-30|X40", tool), "rapid", 4, depth, x=20 - depth)


@pytest.mark.parametrize("depth", [0.02, 1, 4])
def test_a_rapid_down_into_the_bar(depth):
    only(met(f"G00 X25 Z-20|X{20 - depth}|X40", 3), "rapid", 4, depth, x=20 - depth)


@pytest.mark.parametrize("kind", ["turning", "drill"])
@pytest.mark.parametrize("x", [-18, -10])
def test_a_rapid_beyond_the_axis_meets_the_other_side(kind, x):
    assert [(each.kind, each.line) for each in met(f"G00 X{x} Z2|Z-30", Tool(radius=3, kind=kind))] == [("rapid", 4)]


@pytest.mark.parametrize("depth", [0.1, 2, 5])
def test_a_rapid_of_a_drill_into_the_full_bar(depth):
    only(met(f"G00 X0 Z2|Z-{depth}|Z10", 6), "rapid", 4, depth, x=0, z=-depth)


@pytest.mark.parametrize("depth", [0.05, 1, 3])
def test_a_rapid_of_a_boring_bar_into_the_wall_of_a_bore(depth):
    tube = cylinder(20, -60, 0, bore=10)
    only(met(f"G00 X{10 + depth} Z2|Z-30|X9|Z10", 5, stock=tube), "rapid", 4, depth, x=10 + depth)


def test_a_rapid_through_a_collar_is_as_deep_as_the_middle_of_it():
    """Between the cut of the blade, 3 mm wide, and the face the collar is 10.5 mm; along X16 it is 4 mm deep."""
    (each,) = met("G00 X25 Z-30|G01 X15|G00 X16|Z-19.5|X40", 3)
    assert (each.kind, each.line) == ("rapid", 6) and each.depth == pytest.approx(4, abs=2e-3)


# --- the back of the insert ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("auxiliary", [20, 30, 52])
@pytest.mark.parametrize("steeper", [4, 12, 30])
@pytest.mark.parametrize("deep", [1, 3])
def test_a_flank_steeper_than_the_auxiliary_edge(auxiliary, steeper, deep):
    """From the foot of the flank the edge goes up by its own angle and leaves the bar beyond the programmed line."""
    angle = radians(auxiliary + steeper)
    foot = -20 - deep / tan(angle)
    edge = deep / sin(radians(auxiliary))
    tool = Tool(auxiliary_angle=auxiliary, **SHARP)
    found = met(f"G00 X20 Z-20|G01 X{20 - deep} Z{foot:.6f}|Z-40|X40", tool)
    off = edge * sin(radians(steeper))
    only(found, "insert", 4, off, x=20)


@pytest.mark.parametrize(("auxiliary", "deep"), [(20, 2), (30, 1), (52, 4)])
def test_a_plunge_beside_a_collar(auxiliary, deep):
    tool = Tool(auxiliary_angle=auxiliary, **SHARP)
    only(met(f"G00 X25 Z-30|G01 X{20 - deep}|X40", tool), "insert", 4, deep / tan(radians(auxiliary)), x=20)


@pytest.mark.parametrize("deep", [0.5, 1])
def test_a_plunge_of_an_insert_without_angles_has_the_usual_ones(deep):
    """5 degrees behind the tip, as its picture has them."""
    only(met(f"G00 X25 Z-30|G01 X{20 - deep}|X40", Tool(kind="turning")), "insert", 4, deep / tan(radians(5)), x=20)


@pytest.mark.parametrize("deep", [3.5, 5, 7])
def test_a_blade_that_turns_deeper_than_it_is_wide(deep):
    found = met(f"G00 X25 Z-30|G01 X{20 - deep}|Z-40|G00 X40", 3)
    assert [(each.kind, each.line) for each in found] == [("insert", 5)] and found[0].depth == pytest.approx(deep, abs=2e-3)


def test_turning_away_from_the_chuck_with_the_back():
    found = met("G00 X25 Z-30|G01 X17|T1 G01 Z-10|G00 X40", 3)
    assert ("insert", 5) in {(each.kind, each.line) for each in found}


def test_the_same_flank_is_free_where_the_insert_follows():
    for auxiliary in (31, 40, 60):
        assert not met("G00 X20 Z-20|G01 X18 Z-23.46410162|Z-40|X40", Tool(auxiliary_angle=auxiliary, **SHARP))


def test_facing_is_the_work_of_the_auxiliary_edge():
    for tool in (1, 2):
        assert not met("G00 X22 Z-1|G01 X-1|G00 Z2|X22|Z-2|G01 X-1|G00 Z10", tool)


# --- the chuck -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("deep", [0.02, 0.5, 2, 5, 9])
@pytest.mark.parametrize("way", ["G01 Z{z}|G00 X60", "G00 Z{z}|X60", "G01 X17.5 Z{z}|G00 X60"])
def test_a_tool_goes_on_into_the_jaws(deep, way):
    held = chuck(20, -60, grip=20)  # the jaws end at Z-40
    before = "G00 X18 Z2|G01 Z-30|" if way.startswith("G00") else "G00 X18 Z2|"
    found = met(before + way.format(z=-40 - deep), 1, fixtures=(held,))
    hit = [each for each in found if each.kind == "chuck"]
    assert hit[0].line == 4 + ("G01 Z-30" in before) and hit[0].depth == pytest.approx(deep, abs=0.02)
    assert hit[0].place[2] == pytest.approx(-40 - deep, abs=2e-3)


def test_a_tool_before_the_jaws_meets_nothing():
    assert not met("G00 X18 Z2|G01 Z-40|X22|G00 X60", 1, fixtures=(chuck(20, -60, grip=20),))


def test_a_chuck_says_what_it_needs():
    held = chuck(20, -60)
    assert held.bore == 20 and held.bounds[:, 2].tolist() == [-120, -40]
    for wrong in ((0, 0), (20, "9"), (20, 0, -1), (20, 0, 10, 0)):
        with pytest.raises(Alarm, match="of a chuck"):
            chuck(*wrong)
    with pytest.raises(Alarm, match="on a lathe a blank and its chuck are boxes or bodies about Z"):
        met("G00 X18 Z2", fixtures=(cylinder(5, 0, 9, axis="X"),))


# --- shanks, holders, the spindle ------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["shank", "holder"])
@pytest.mark.parametrize("deep", [0.05, 0.1, 0.2, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6, 6.5])
def test_a_drill_that_goes_deeper_than_it_is_long(kind, deep):
    body = (12, 30)
    tool = Tool(5, angle=118, kind="drill", **{kind: body if kind == "shank" else (body,)})
    only(met(f"G00 X0 Z2|G01 Z-{30 + deep}|G00 Z10", tool), kind, 4, deep, z=-deep)


@pytest.mark.parametrize("deep", [0.5, 2, 4])
def test_the_bar_of_a_boring_tool_is_too_thick_for_its_bore(deep):
    """It lies 2.4 mm below the tip: from a tip at 11 the bar comes as far down as 8.6 less its diameter."""
    thick = (8.6 + 11 + deep) / 2
    tool = Tool(corner=0.4, main_angle=95, auxiliary_angle=30, kind="boring", shank=(thick, 5))
    found = met("G00 X11 Z20|G01 Z-25|G00 X9 Z-24|Z10", tool, stock=cylinder(20, -60, 0, bore=10))
    assert ("insert", 4) in {(each.kind, each.line) for each in found}
    assert next(each for each in found if each.line == 4).depth == pytest.approx(deep, abs=0.02)


def test_a_boring_tool_outside_of_a_bar_has_its_bar_in_it():
    """It stands between the tip and the axis; how long its edge is nobody said, 12 mm at most."""
    tool, tube = Tool(corner=0.4, kind="boring"), cylinder(20, -60, 0, bore=10)
    found = met("G00 X18 Z5|G01 Z-30|G00 X40", tool)
    assert (found[0].kind, found[0].line) == ("holder", 4) and "bar of the boring tool" in found[0].message
    assert not met("G00 X12 Z5|G01 Z-30|G00 X9|Z10", tool, stock=tube)
    assert not met("G00 X19 Z5|G01 Z-30|G00 X9|Z10", tool, stock=tube)


@pytest.mark.parametrize("radius", [3, 5, 10, 11.5, 14, 20])
@pytest.mark.parametrize("shank", [None, (4, 10)])
def test_a_boring_tool_in_full_material(radius, shank):
    """On the axis nothing is cut: a short edge leaves a core where the bar is, a long one turns backwards beyond it."""
    tool = Tool(corner=0.4, kind="boring", shank=shank)
    for x in (radius - 0.5, radius / 2):
        found = met(f"G00 X{x} Z5|G01 Z-30", tool, stock=cylinder(radius, -60, 0))
        assert {("holder", 4)} <= {(each.kind, each.line) for each in found} and "bor" in found[0].message
        thin = Tool(corner=0.4, kind="boring")
        assert not met(f"G00 X{x} Z5|G01 Z-30|G00 X{x - 0.3}|Z5", thin, stock=cylinder(radius, -60, 0, bore=x - 0.3))


def test_a_blind_bore_is_faced_by_its_boring_tool():
    """Along the wall down to the point of the drill, and across to the axis over its cone."""
    tools = {1: Tool(radius=8, angle=118, kind="drill"), 2: Tool(corner=0.4, kind="boring")}
    head = "M3 S500 G97 G94 F100 T1\nG00 X40 Z20\n"
    assert not met("G00 X0 Z2|G01 Z-30|G00 Z20 T2|X9 Z2|G01 Z-25|X0|G00 Z2", 1, head, tools=tools)


@pytest.mark.parametrize("kind", ["mill", "drill", "reamer", "countersink", "tap"])
@pytest.mark.parametrize("way", ["G01 Z-15", "G32 Z-15 F2", "G01 X{x} Z-15"])
@pytest.mark.parametrize("x", [0, 0.5, 10, -10])
def test_a_tool_about_its_own_axis_cuts_on_the_axis_of_the_part(kind, way, x):
    """There alone does the part turn about the tool; beside it a ring is cut, as wide as the tool, which breaks it."""
    found = met(f"G00 X{x} Z2|{way.format(x=x)}|G00 Z10", Tool(radius=3, kind=kind))
    beside = [each for each in found if each.kind == "axis"]
    assert [each.line for each in beside] == ([4] if x else [])
    assert all(f"the {kind} {abs(x):.3f} mm beside the axis" in each.message and "X" in each.message for each in beside)
    assert mnclab.workpiece.collision.KINDS.keys() >= {each.kind for each in found}


@pytest.mark.parametrize("deep", [0.02, 1, 3])
@pytest.mark.parametrize("control", ["M5", "M5|G04 F1"])
@pytest.mark.parametrize("cut", ["G01 Z-20", "G01 X{x} Z-20", "G03 X{x} Z-20 R40"])
def test_a_cut_while_the_spindle_stands(deep, control, cut):
    """The tool goes down into the bar as far as it says, from the face to Z-20."""
    line = 4 + control.count("|") + 1
    found = met(f"G00 X{20 - deep} Z2|{control}|{cut.format(x=20 - deep)}|G00 X40", 2)
    assert [(each.kind, each.line) for each in found if each.kind == "spindle"] == [("spindle", line)]


def test_an_unknown_start_is_not_blamed_and_a_known_one_is():
    text = "M3 S500 T1\nG00 X18 Z-10\nG00 X40\n"
    assert [each.line for each in mnclab.run(text, "jnc-t01", Setup(stock=BAR)).collisions()] == [2]  # arrives in it
    text = "M3 S500 T1\nG00 X18 Z2\nG94 F100\nG01 Z-10\nX40\n"
    assert not mnclab.run(text, "jnc-t01", Setup(stock=BAR)).collisions()
    assert mnclab.run(text, "jnc-t01", Setup(stock=BAR, start=(0, 0, -5))).collisions()


def test_travel_is_judged_on_the_radius():
    limits = Limits(travel=((0, 30), (-1, 1), (-50, 50)))
    setup = Setup(stock=BAR, start=(25, 0, 20), limits=limits)
    for depth in range(1, 17):
        found = mnclab.run(f"M3 S500 T1\nG00 X18 Z2\nG00 X{30 + depth}\n", "jnc-t01", setup).collisions()
        assert [(each.kind, each.line) for each in found] == [("travel", 3)] and found[0].depth == pytest.approx(depth)


# --- what needs a hole, and what must not touch ----------------------------------------------------------------------

HOLE = "M3 S500 G97 G94 F100 T1\nG00 X0 Z20\n{drill}G00 X0 Z20\nT2\nG00 X0 Z2\nG01 Z-12\nZ2\nG00 Z20\n"


@pytest.mark.parametrize(("tool", "drilled", "depth", "said"), [
    (Tool(diameter=10, kind="reamer"), 9.8, None, ""),
    (Tool(diameter=10, kind="reamer"), 0, 12, "the reamer in full material, where it needs a hole"),
    (Tool(diameter=10, kind="tap", pitch=1.5), 8.5, None, ""),
    (Tool(diameter=10, kind="tap", pitch=1.5), 8.2, 0.0881, "narrower than 8.3762 mm"),  # (8.3762 - 8.2) / 2 into the wall
    (Tool(diameter=10, kind="tap", pitch=1.5), 0, 12, "the tap in full material, where it needs a hole"),
])  # fmt: skip
def test_a_reamer_and_a_tap_need_a_hole_on_the_axis(tool, drilled, depth, said):
    """ISO 724: the minor diameter of M10 is 10 - 1.082532 * 1.5 = 8.3762 mm."""
    drill = "G00 Z2\nG01 Z-20\n" if drilled else ""
    setup = Setup(stock=BAR, start=(60, 0, 40), tools={1: Tool(diameter=drilled or 1, kind="drill"), 2: tool})
    found = mnclab.run(HOLE.format(drill=drill), "jnc-t01", setup).collisions()
    assert [(each.kind, each.line) for each in found] == [("solid", 6 + 2 * bool(drill))] * (depth is not None)
    assert all(said in each.message and each.depth == pytest.approx(depth, abs=1e-3) for each in found)


@pytest.mark.parametrize(("way", "depth"), [
    ("G01 X30 Z-20|X23.005", None),
    ("G01 X30 Z-20|X19", 4.0),  # the ball of 3 mm reaches down to X16
    ("G00 X30 Z-20|X19", 4.0),
    ("G00 X0 Z5|Z-1", 1.0),  # its south pole is the tip
])  # fmt: skip
def test_a_probe_driven_into_the_part(way, depth):
    """A bar of radius 20: the deepest place of the ball; it takes nothing away, and its way back is no second collision."""
    found = met(f"{way}|{way[4:].partition('|')[0]}|X40 Z20", Tool(radius=3, kind="probe"))
    if depth is None:
        assert not len(found)
    else:
        only(found, "probe", 4, depth)
        assert "the probe in material" in found[0].message


@pytest.mark.parametrize(("control", "settings", "text", "said"), [
    ("jnc-t01", {}, "M3 S500 T1\nG00 X40 Z20\nX18 Z2\nZ-30\n", ("X18.000", "(X is a radius)")),
    ("jnc-t01", {"diameter": True}, "M3 S500 T1\nG00 X80 Z20\nX36 Z2\nZ-30\n", ("X36.000", "(X is a diameter)")),
    ("nc-31", {}, "S500\nM3\nX8000~*\nZ2000~\nX3600~*\nZ200~\nZ-3000~\n", ("X36.000", "(X is a diameter)")),
])  # fmt: skip
def test_x_is_said_as_it_is_typed(control, settings, text, said):
    """A rapid 2 mm under the surface of a bar of 40 mm: a radius of 18, a diameter of 36."""
    setup = Setup(stock=BAR, start=(60, 0, 40), tools={0: Tool(kind="turning"), 1: Tool(kind="turning")}, settings=settings)
    (each,) = mnclab.run(text, control, setup).collisions()
    assert all(each_said in each.message for each_said in ("2.000 mm deep at", *said))
    assert each.place[0] == pytest.approx(18)
