"""Parts cut with a tilted tool (3+2): closed forms of slots, holes and chamfers on planes that lean, and what is met there."""

import math

import numpy as np
import pytest
from shapely.geometry import Polygon, box

import mnclab as mnc
from mnclab import Tool
from mnclab.workpiece.milling import milled

MILL = Tool(radius=4, length=80, number=1)
BLOCK = ((-30, -20, -25), (30, 20, 0))


def run(blocks, tool=MILL, stock=BLOCK, kinematics="table-ac", others=(), **setup):
    """A program of the TNC about a block with its datum in the middle of the top."""
    text = f"BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F500\nL X+0 Y+0 Z+100 R0 FMAX M3\n{blocks}END PGM A MM\n"
    machine = {"kinematics": kinematics} if kinematics else {}
    found = mnc.run(text, "tnc-620", mnc.Setup(tools={1: tool, **dict(others)}, stock=stock, **machine, **setup))
    assert found.ok, found.alarms
    return found


def plane(blocks, a=0, b=0, c=0):
    """Blocks in a tilted plane, from far above it and back."""
    there = f"PLANE SPATIAL SPA{a:+g} SPB{b:+g} SPC{c:+g} MOVE ABST80 F5000\n"
    return f"{there}{blocks}L Z+90 FMAX\nPLANE RESET MOVE ABST80 F5000\nL Z+120 FMAX\n"


SLOT = "L X-50 Y+0 FMAX\nL Z-3 F500\nL X+50\n"
HOLE = "L X+0 Y+0 FMAX\nL Z+20 FMAX\nL Z-15 F500\n"


def leaning(low, half, angle):
    """What a slot takes of the section across it (y, z): wider than `half` on neither side, and above `low`, turned about X."""
    c, s = math.cos(angle), math.sin(angle)
    corners = np.array([(-half, low), (half, low), (half, 900), (-half, 900)])
    return Polygon(corners @ np.array([[c, s], [-s, c]])).intersection(box(-20, -25, 20, 0))


def test_a_slot_ends_in_the_sides_of_the_block():
    """A slot along X under an overhang: between the last nodes and X30 nothing of the surface is but the side itself, whose area
    is that of the section."""
    part = run(plane(SLOT, a=30)).workpiece(step=0.5)
    solid = part.solid()
    x = np.abs(solid.points[:, 0])
    assert not ((x > 29.6) & (x < 30 - 3e-4)).any() and x.max() < 30 + 3e-4
    a, b, c = solid.points[solid.triangles].transpose(1, 0, 2)
    side = (solid.points[solid.triangles][:, :, 0] > 30 - 3e-4).all(axis=1)
    area = np.linalg.norm(np.cross(b - a, c - a)[side], axis=1).sum() / 2
    assert area == pytest.approx(40 * 25 - leaning(-3, 4, math.radians(30)).area, rel=1e-3)


@pytest.mark.parametrize("kinematics", [None, "table-ac"])
def test_a_slot_on_a_plane_that_leans(kinematics):
    part = run(plane(SLOT, a=30), kinematics=kinematics).workpiece(step=0.5)
    taken = leaning(-3, 4, math.pi / 6)
    assert part.removed == pytest.approx(60 * taken.area, rel=1e-6)
    assert part.notes == ("what overhangs is shown by cells in solids and scenes, not from above",)  # one of its walls
    (section,) = part.cut("YZ", 7.0)
    wanted = box(-20, -25, 20, 0).difference(taken)
    assert Polygon(section.points).symmetric_difference(wanted).area < 1e-3
    low = -3 / math.cos(math.pi / 6)  # of the floor at y = 0
    assert part.at(0, 0) == pytest.approx(low) and part.solid().volume == pytest.approx(part.volume, rel=1e-3)
    assert part.part.distance(np.array([[0.0, 0.0, low + 1]])) == pytest.approx(math.cos(math.pi / 6))
    assert part.removed_by("line").keys() == {7} and sum(part.removed_by("row").values()) == pytest.approx(part.removed)


@pytest.mark.parametrize("machine", ["pivot", "backlash", "measured"])
def test_the_part_is_that_of_the_true_machine(machine):
    """A pivot 0.1 in Y beside that of the control moves all that A30 cuts by (1 - Rx(30)) (0, 0.1, 0): by -0.1 (1 - cos 30) along
    the slot's plane and -0.1 sin 30 across it. An axis with 0.4 degrees of backlash stays at 29.8. What is measured is right."""
    a, c = mnc.Axis("A", centre=(0, 0.1, 50)), mnc.Axis("C")
    true = mnc.Kinematics(table=(mnc.Axis("A", centre=(0, 0, 50), backlash=0.4) if machine == "backlash" else a, c))
    believed = mnc.Kinematics(table=(a if machine == "measured" else mnc.Axis("A", centre=(0, 0, 50)), c))
    found = run(plane(SLOT, a=30), kinematics=believed, true_kinematics=true)
    part, s = found.workpiece(step=0.5), math.radians(30)
    if machine == "backlash":
        lag = math.radians(0.2)  # about the axis 50 above: the plane turns back with the tool
        up = np.array([-math.sin(s - lag), math.cos(s - lag)])
        foot = np.array([3 * math.sin(s), -3 * math.cos(s) - 50])  # of the floor at y' = 0, from the axis
        turn = np.array([[math.cos(lag), math.sin(lag)], [-math.sin(lag), math.cos(lag)]])
        y, z = turn @ foot + (0, 50)
        assert part.at(0, 0) == pytest.approx(z + up[0] / up[1] * y, abs=1e-6)
        return
    aside, deep = (0.0, 0.0) if machine == "measured" else (-0.1 * (1 - math.cos(s)), -0.1 * math.sin(s))
    corners = np.array([(aside - 4, deep - 3), (aside + 4, deep - 3), (aside + 4, 900), (aside - 4, 900)])
    turn = np.array([[math.cos(s), math.sin(s)], [-math.sin(s), math.cos(s)]])
    taken = Polygon(corners @ turn).intersection(box(-20, -25, 20, 0))
    assert part.at(0, 0) == pytest.approx((deep - 3) / math.cos(s)) and part.removed == pytest.approx(60 * taken.area, rel=1e-6)


@pytest.mark.parametrize(
    ("tool", "volume"),
    [
        (MILL, math.pi * 16 * 15),
        (Tool(radius=4, length=80, number=1, corner=4), math.pi * 16 * 11 + 2 / 3 * math.pi * 64),
        (Tool(radius=4, length=80, number=1, kind="drill", angle=90), math.pi * 16 * (15 - 4) + math.pi * 64 / 3),
    ],
    ids=["mill", "ball", "drill"],
)
def test_a_hole_at_45_degrees(tool, volume):
    """The top cuts it off aslant through its axis: as much is missing on one side as stands over on the other."""
    found = run(plane(HOLE, a=45), tool)
    assert found.workpiece(step=0.5).removed == pytest.approx(volume, rel=3e-4)
    assert found.collisions() == () and found.collisions().ok


def test_five_faces_of_a_cube():
    """A hole of 8 mm, 10 deep, in the middle of each: what a level plane through four of them leaves, and the way of a ball."""
    sides = "".join(plane("L X+0 Y-20 FMAX\nL Z+40 FMAX\nL Z+10 F500\n", a=90, c=turn) for turn in (0, 90, 180, 270))
    found = run("L Z+2 FMAX\nL Z-10 F500\nL Z+100 FMAX\n" + sides, stock=((-20, -20, -40), (20, 20, 0)))
    part = found.workpiece(step=0.5)
    assert part.removed == pytest.approx(5 * math.pi * 16 * 10, rel=1e-3) and found.collisions().ok
    assert list(part.removed_by("line").values()) == pytest.approx([math.pi * 160] * 5, rel=2e-3)
    assert [loop.area for loop in part.cut("XY", -20.0)] == pytest.approx([1600 - 4 * 8 * 10])
    assert part.at(15, 0) == 0 and part.faces(np.array([15.0]), np.array([0.0]))[0] == -40  # what is under the hole, too
    assert part.part.distance(np.array([[15.0, 0, -20], [15, 0, -17], [0, 0, -20], [0, 0, -5]])) == pytest.approx([4, 1, -10, 4])
    solid = part.solid()
    assert solid.volume == pytest.approx(part.volume, rel=2e-3) and any("overhangs" in note for note in part.notes)
    edges = np.sort(np.concatenate([solid.triangles[:, [i, j]] for i, j in ((0, 1), (1, 2), (2, 0))]), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()


def test_holes_that_meet():
    """Two bores of radius 4 across one another through the middle: each its cylinder, the body that both share once, 16/3 r³."""
    across = plane("L X+0 Y-12 FMAX\nL Z+40 FMAX\nL Z-30 F500\n", a=90)
    part = run(across + plane("L X+0 Y-12 FMAX\nL Z+40 FMAX\nL Z-35 F500\n", a=90, c=90)).workpiece(step=0.5)
    assert part.removed == pytest.approx(math.pi * 16 * (40 + 60) - 16 / 3 * 64, rel=1e-3)
    first, second = part.removed_by("line").values()
    assert (first, second) == pytest.approx((math.pi * 16 * 40, math.pi * 16 * 60 - 16 / 3 * 64), rel=2e-3)


def test_a_pocket_from_above_opens_a_bore():
    """A bore along Y at Z-12, radius 4, then a slot from above down to Z-12: under it the lower half of the bore is open."""
    bore = plane("L X+0 Y-12 FMAX\nL Z+40 FMAX\nL Z-30 F500\n", a=90)
    part = run(bore + "L X+0 Y-40 FMAX\nL Z-12 F500\nL Y+40\nL Z+100 FMAX\n").workpiece(step=0.5)
    assert part.at(0, 0) == pytest.approx(-16) and part.at(3, 5) == pytest.approx(-12 - math.sqrt(16 - 9))
    assert part.removed == pytest.approx(40 * (8 * 12 + math.pi * 8), rel=1e-3)


def test_a_chamfer_by_a_tilted_mill_is_that_of_a_chamfer_tool():
    """3 mm at 45 degrees along the edge at Y-20: by a mill on a plane that leans, and by a chamfer tool of 90 degrees."""
    deep = 3 / math.sqrt(2)
    edge = -20 * math.cos(math.pi / 4)  # Y of the edge in the plane, whose height there is -20 sin 45 below the datum
    height = 20 * math.sin(math.pi / 4) - deep
    tilted = run(plane(f"L X-50 Y{edge:+.6f} FMAX\nL Z{height:+.6f} F500\nL X+50\n", a=45)).workpiece(step=0.5)
    tool = Tool(radius=5, length=80, number=1, kind="chamfer", angle=90)
    upright = run("L X-50 Y-20 FMAX\nL Z-3 F500\nL X+50\nL Z+100 FMAX\n", tool).workpiece(step=0.5)
    assert tilted.removed == pytest.approx(60 * 9 / 2, rel=1e-5) == upright.removed
    y = np.linspace(-19.99, -16, 50)
    assert np.abs(tilted.at(0 * y, y) - upright.at(0 * y, y)).max() < 1e-5
    assert tilted.compare(upright, 0.01).ok and not tilted.compare(run("L Z+50 FMAX\n").workpiece(step=0.5), 0.01).ok


def test_the_same_in_a_frame_that_turns():
    """A rotation of 90 degrees about Z before the plane turns all that is cut."""
    square = ((-20, -20, -25), (20, 20, 0))
    plain = run(plane(HOLE, a=35), stock=square).workpiece(step=0.5)
    turned = run(plane(HOLE, a=35, c=90), stock=square).workpiece(step=0.5)
    both = plain.turned(90)
    assert turned.removed == pytest.approx(plain.removed, rel=1e-6)
    x, y = np.random.default_rng(3).uniform(-19, 19, (2, 400))
    assert np.abs(turned.at(x, y) - both.at(x, y)).max() < 1e-6


def test_a_tilted_part_turned_over_is_cut_on():
    """A bore through, radius 4 at Z-12; turned over about X a slot 13 deep from the other side opens it from below."""
    bore = run(plane("L X+0 Y-12 FMAX\nL Z+40 FMAX\nL Z-30 F500\n", a=90)).workpiece(step=0.5)
    over = run("L X+0 Y-40 FMAX\nL Z-13 F500\nL Y+40\nL Z+100 FMAX\n", stock=bore.turned_over("x")).workpiece(step=0.5)
    assert over.at(0, 0) == pytest.approx(-17) and over.at(9, 0) == 0  # the bore is at Z-13 now
    assert over.removed == pytest.approx(40 * (8 * 13 - math.pi * 8), rel=1e-3)


def test_of_very_many_upright_moves(monkeypatch):
    """The map of heights that very many moves make, and a hole that leans beside them."""
    blocks = "L X-50 Y-15 FMAX\nL Z-2 F500\nL X+50\nL Z+100 FMAX\n" + plane(HOLE, a=45)
    exact = run(blocks).workpiece(step=0.5)
    monkeypatch.setattr(milled, "EXACT", 1)
    many = run(blocks).workpiece(step=0.5)
    assert many.many and many.removed == pytest.approx(exact.removed, rel=5e-3)
    assert np.abs(many.heights - exact.heights).max() < 1e-6


# What is met.

def kinds(found):
    return [(each.kind, each.line) for each in found]


def test_a_holder_that_leans_meets_the_block_beside():
    """A holder of radius 20 begins 18 above the tip: with the hole 15 deep it comes 3 above the plane, and leans into the top."""
    short = Tool(radius=4, length=80, number=1, holder=((20, 18),))
    met = run(plane(HOLE, a=45), short).collisions()
    assert kinds(met) == [("holder", 7)]
    x, y, z = met[0].place
    along = np.array([0, -math.sin(math.pi / 4), math.cos(math.pi / 4)])  # of the tool; its tip is 15 down from the datum
    assert np.dot(np.array([x, y, z]) + 15 * along, along) == pytest.approx(18, abs=0.02)
    assert math.dist((x, y, z), np.dot((x, y, z), along) * along) < 20 and -25 <= z <= 0
    assert run(plane(HOLE, a=45), Tool(radius=4, length=80, number=1, holder=((20, 40),))).collisions().ok


def test_a_rapid_that_leans_into_the_material():
    met = run(plane(HOLE.replace("Z-15 F500", "Z-15 FMAX"), a=45)).collisions()
    assert kinds(met) == [("rapid", 7)]
    through = plane(HOLE + "L Z+50 FMAX\nL Z-14 FMAX\n", a=45)  # back into the hole that is there
    assert run(through).collisions().ok


def test_what_one_clamping_has_cut_another_goes_through():
    """A slot from above is free for a rapid from the side; the block beside it is not."""
    slot = "L X+0 Y-40 FMAX\nL Z-12 F500\nL Y+40\nL Z+100 FMAX\n"
    side = "L X{} Y-6 FMAX\nL Z+40 FMAX\nL Z+0 FMAX\n"
    thin = Tool(radius=3, length=80, number=2)

    def judged(x):
        blocks = f"{slot}TOOL CALL 2 Z S1000\nL Z+100 R0 FMAX\n{plane(side.format(x), a=90)}"
        return run(blocks, others={2: thin}).collisions()

    assert judged("+0").ok and [each.kind for each in judged("+20")] == ["rapid"]


def test_a_fixture_beside_the_block():
    """A clamp on the side that the tool leans to is met by its holder, one on the other side is not."""
    holder = Tool(radius=4, length=80, number=1, holder=((15, 30),))
    near, far = (((-5, y, -5), (5, y + 8, 30)) for y in (-34, 26))
    hole = plane(HOLE, a=45)
    assert {each.kind for each in run(hole, holder, fixtures=(near,)).collisions()} == {"fixture"}
    assert run(hole, holder, fixtures=(far,)).collisions().ok


def test_where_the_tool_turns_near_the_block_is_told():
    """Far above it is clear; right on the block nobody knows, and a plane that is taken without a move turns somewhere, too."""
    near = "L Z+1 FMAX\nPLANE SPATIAL SPA+45 SPB+0 SPC+30 TABLE ROT {} ABST0 F5000\nL Z+60 FMAX\nPLANE RESET MOVE ABST0 F5000\n"
    (note,) = run(near.format("MOVE")).collisions().notes  # the way back is clear
    assert note.endswith("on which the tool turns not judged (program:5)")
    stays = "L Z+1 FMAX\nPLANE SPATIAL SPA+45 SPB+0 SPC+0 STAY\nL Z+60 FMAX\nPLANE RESET STAY\n"
    (note,) = run(stays, kinematics=None).collisions().notes
    assert note == "1 row on which the tool turns not judged (program:6)"


def test_simultaneous_rows_are_named_and_not_cut():
    found = run("L X-40 Z+5 FMAX\nL Z-2 F500\nL X+40 A+30 C+20\nL Z+100 FMAX\nL A+0 FMAX\n")
    turning = found.workpiece(step=1.0)
    assert found.toolpath.directions[:, 1].min() < -0.46 and turning.removed < 60 * 8 * 2 / 10
    assert any("on which the tool turns" in note and "program:6" in note for note in turning.notes)
    assert any("on which the tool turns" in note and "program:6" in note for note in found.collisions().notes)
    assert not found.collisions().ok


def test_what_the_table_turns_about_one_axis_square_to_the_tool_is_cut():
    """Points of the block against the tool at 4000 places of its way, where the axes have it: A turns while X goes."""
    found = run("L X-40 Z+5 FMAX\nL Z-2 F500\nL X+40 A+30\nL Z+100 FMAX\nL A+0 FMAX\n")
    part, chain = found.workpiece(step=1.0), found.setup.kinematics
    share, none = np.linspace(0, 1, 4000), np.zeros(4000)
    tips, along = chain.forward(np.stack([80 * share - 40, none, none + 78, 30 * share, none, none], axis=1), 80)
    points = np.random.default_rng(2).uniform((-29, -10, -5), (29, 10, -0.05), (1500, 3))
    behind = points[:, None] - tips
    high = np.einsum("pki,ki->pk", behind, along)
    aside = np.sqrt(np.maximum((behind**2).sum(axis=2) - high**2, 0))
    off = np.where(high > 0, aside, np.inf).min(axis=1) - 4
    sure = (np.abs(off) > 0.02) & (np.abs(high).min(axis=1) > 0.02)
    gone = part.sweep.gaps.empty(*points.T)
    assert (off < 0)[sure].sum() > 30 and sure.sum() > 500 and (gone == (off < 0))[sure].all()
    assert "left out" not in " ".join(part.notes) and found.collisions().notes == ()


def test_a_probe_touches_what_a_tilted_tool_has_cut():
    """A ball of radius 1 on the floor of a slot 6 deep on a plane that leans by 30 degrees: its middle stands 1 above that."""
    touch = "TOOL CALL 2 Z\nL X+0 Y+0 FMAX\nTCH PROBE 0.0 REF. PLANE Q5 Z-\nTCH PROBE 0.1 X+0 Y+0 Z-6\n"
    ball = Tool(radius=1, length=80, number=2, kind="probe")
    found = run(plane(SLOT.replace("Z-3", "Z-6"), a=30) + touch, others={2: ball}, part="cut")
    assert found.variables["Q5"] == pytest.approx((-6 + 1) / math.cos(math.pi / 6) - 1, abs=1e-9)
    a = mnc.Axis("A", centre=(0, 0.1, 50), limits=(-120, 120))  # the true one: it cuts 0.1 sin 30 deeper
    true = mnc.Kinematics(table=(a, mnc.Axis("C")))
    found = run(plane(SLOT.replace("Z-3", "Z-6"), a=30) + touch, others={2: ball}, part="cut", true_kinematics=true)
    assert found.variables["Q5"] == pytest.approx((-6.05 + 1) / math.cos(math.pi / 6) - 1, abs=1e-6)
