"""The designs that the sample programs make: what their comments promise, and heights that agree with the part as cut."""

from math import radians, tan
from pathlib import Path

import numpy as np
import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab.design.model import Face, Groove, Hole, Pocket, Slot
from mnclab.design.model.shapes import Circle, Rectangle
from mnclab.machine.setup_file import load

DATA = Path(__file__).parents[2] / "data"
PROGRAMS = {f"{path.parent.name}/{path.stem}": path for path in sorted(DATA.glob("programs/*/*"))}
POINT = 4 / tan(radians(59))  # of the drill 8
#: What is in a part but not in its design, and is said.
NAMELESS = {
    "mnc/prepared_holes": "the point of a tool alone has no name", "tnc-620/name_plate": "what a pointed tool cuts has no name",
    "tnc-620/threads": "is cut outside",
}  # fmt: skip


def holes(depth, *places, **more):
    return [Hole(x, y, 8, depth, **more) for x, y in places]


#: The numbers are those of the programs. Depths of drilled holes are to the shoulder: that of the tip less the point.
FEATURES = {
    "g43/bolt_circle": holes(15 - POINT, *((30 * np.cos(a), 30 * np.sin(a)) for a in np.radians(22.5 + 45 * np.arange(8)))),
    "g43/two_lengths": [*holes(15 - POINT, (20, 20)), Slot((60, 20), (90, 20), 16, 5)],
    "mnc/drilling_two_ways": holes(18 - POINT, (10, 10), (40, 10)),
    "mnc/row_of_holes": holes(18 - POINT, *((x, 10) for x in (10, 30, 70, 90))),
    "mnc/milled_plate": [Face(2), Pocket.rectangle(40, 35, 60, 40, 12, 8, 15, top=0), Pocket.circle(102, 35, 36, 8, top=0)],
    "mnc/prepared_holes": [Hole(40, 10, 8, 20 - POINT), Hole(65, 10, 14, 12, 180),
        Hole(90, 10, 14, 12, 180, thread="M16", thread_depth=10)],
    "mnc/square": [Groove(Rectangle(20, 20, 40, 40), 10, 2)],
    "mnc/window": [Pocket.rectangle(30, 20, 60, 40, 5, 8)],
    "tnc-620/calls": [*holes(20 - POINT, *((x, 10) for x in (10, 30, 50, 70, 90)))],
    "tnc-620/flange": holes(None, *((45 * np.cos(a), 45 * np.sin(a)) for a in np.radians(np.arange(22.5, 360, 45))),
        *((25 * np.cos(a), 25 * np.sin(a)) for a in np.radians(np.arange(30, 390, 60))), (0, 0), (52, 52), (-52, 52),
        (52, -52), (-52, -52)),
    "tnc-620/holes": [*holes(15, (15, 15)), *holes(26 - POINT, (40, 15)), *holes(None, (15, 45), (40, 45)),
        Hole(75, 30, 28, 12, 180)],
    "tnc-620/pocket": [Pocket.rectangle(0, 0, 60, 40, 10, 8)],
    "tnc-620/square": [Groove(Rectangle(20, 20, 40, 40), 10, 2)],
    "tnc-620/steps": [Slot((10 * k, 0), (10 * k, 40), 6, 1 + k / 2) for k in range(5)],
}  # fmt: skip


def run_of(name):
    setup = DATA / "setups" / f"{name}.toml"
    return mnclab.run(PROGRAMS[name], setup=load(setup) if setup.exists() else None)


MILLED = [name for name in PROGRAMS if name.split("/")[0] in ("g43", "mnc", "tnc-620")]
#: Programs that name no blank, and whose setup has none.
WITHOUT_STOCK = (
    *(f"mnc/{name}" for name in ("arc_by_centre", "arcs_by_radius", "four_arcs", "full_circle", "hexagon", "hexagon_arc")),
    *(f"mnc/{name}" for name in ("machine_coordinates", "mirrored", "scaled", "set_and_shift", "three_planes", "turned")),
    "tnc-620/drum_cam", "tnc-620/drum_window", "tnc-620/ellipse_round",
)  # fmt: skip


def said(feature):
    return feature.kind, {each.name: each.text or pytest.approx(each.nominal, abs=1e-6) for each in feature.measures()}


@pytest.mark.parametrize("name", FEATURES)
def test_features(name):
    left = [said(each) for each in run_of(name).design().features]
    for each in FEATURES[name]:
        kind, sizes = said(each)
        numbers = {key: value if isinstance(value, str) else value.expected for key, value in sizes.items()}
        match = [k for k, (other, there) in enumerate(left) if other == kind and there == numbers]
        assert match, (each, left)
        del left[match[0]]
    assert left == []


SLOW = ("tnc-620/lid", "tnc-620/studs", "tnc-620/lever", "tnc-620/cam_plate", "tnc-620/pockets")


QUICK = deep_but_one_in(2, [name for name in MILLED if name not in SLOW])


@pytest.mark.parametrize("name", [*QUICK, *(pytest.param(name, marks=pytest.mark.deep) for name in SLOW)])
def test_the_design_is_the_part(name):
    run = run_of(name)
    assert (run.stock is None) == (name in WITHOUT_STOCK)
    if run.stock is None:
        return
    design = run.design()
    (x0, y0, low), (x1, y1, _) = design.bounds
    lines = np.linspace(x0 + 0.013, x1 - 0.017, 120), np.linspace(y0 + 0.011, y1 - 0.019, 120)
    x, y = (each.ravel() for each in np.meshgrid(*lines))
    off = np.abs(np.nan_to_num(design.faces(x, y)[1], nan=low) - run.workpiece().at(x, y))
    if name in NAMELESS:
        assert any(NAMELESS[name] in note for note in design.notes) and np.mean(off > 1e-6) < 0.03
    else:
        assert design.notes == () and off.max() < 1e-6


def test_the_four_slots_and_pockets():
    """Cycles 251 to 254: sizes, angles and depths of the program."""
    found = run_of("tnc-620/pockets").design().features
    rectangle, circle, slot, *bows = found
    assert (rectangle.contour, rectangle.depth) == (Rectangle(32, 30, 46, 30, 7, 15), 9)
    assert (circle.contour, circle.depth) == (Circle(86, 45, 34), 6)
    half = 35 / 2 * np.array([np.cos(np.radians(10)), -np.sin(np.radians(10))])  # 44 long, 9 wide
    assert np.allclose([slot.start, slot.end], np.array([32, 70]) + [-half, half], atol=1e-6)
    assert (slot.width, slot.depth) == (9, 5)
    for bow, angle in zip(bows, (60, 180, 300)):
        line = bow.contour.contour
        assert (bow.depth, bow.width) == pytest.approx((4, 8), abs=1e-6)
        assert line.radii == pytest.approx([26], abs=1e-6) and np.degrees(line.sweeps) == pytest.approx([60], abs=1e-5)
        middle = (86, 45) + 26 * np.array([np.cos(np.radians(angle + 30)), np.sin(np.radians(angle + 30))])
        assert line.point_at(line.length / 2)[0] == pytest.approx(middle, abs=1e-6)


def test_features_are_named_by_cycle_and_line():
    found = run_of("mnc/milled_plate").design().features
    assert [each.name for each in found] == ["G321, line 5", "G343, line 8", "G344, line 10"]


THREADS = {"jnc-t01/thread": ("M20x2", 0, -25), "nc-31/shaft": ("M24x1.5", 0, -24)}  # a thread ends where its cylinder does


@pytest.mark.parametrize("name", [name for name in PROGRAMS if name.split("/")[0] in ("jnc-t01", "nc-31")])
def test_turned_designs(name):
    """The half section of the part, with threads as features instead of their teeth."""
    run = run_of(name)
    design, part = run.design(), run.workpiece()
    assert [(each.thread, each.start, each.end) for each in design.threads] == ([THREADS[name]] if name in THREADS else [])
    if name not in THREADS:
        assert design.volume == pytest.approx(part.volume, rel=1e-9)
    assert design.notes == ()


def test_a_bore_is_a_feature():
    design = run_of("jnc-t01/flange").design()
    bore = design.features[0]
    assert (bore.kind, bore.diameter) == ("bore", 10)
    assert bore.depth == pytest.approx(24 - 5 / tan(radians(59)), abs=1e-6)
    assert bore.point == pytest.approx(118, abs=1e-6)
