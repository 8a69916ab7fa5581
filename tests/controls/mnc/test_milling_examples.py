"""The examples of the milling cycles, number by number; see tests/authorities/README.md.

They were worked out from the rules of chapter 10 (the manual prints none). A number of a check that is not compared fails.
"""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from tools.running import run

import mnclab
from mnclab import Kind, Setup, Tool

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "mnc-milling.json"
EXAMPLES = [
    pytest.param(example["program"], example["check"], id=f"{example['code']} {example['title']}")
    for example in json.loads(FILE.read_text(encoding="utf-8"))
]
KINDS = {"rapid": Kind.RAPID, "line": Kind.LINE, "arc": Kind.ARC}
NEAR = {"abs": 1e-4}  # the numbers are rounded to four decimals


def near(value):
    return pytest.approx(value, **NEAR)


def motion_of(program, check, plunge_angle=3.0, **change):
    """The motion of the cycle's block, run with the tool of the example."""
    for old, new in change.items():
        program = program.replace(old, new)
    tool = Tool(radius=check["R"], plunge_angle=plunge_angle)
    found = run(program.rstrip("\n"), before="T1\n", tools={1: tool}, start=(0, 0, check.get("z0", 40)))
    known = ("lie 13.333 mm apart", "L1 leaves 117.013 mm² of the surface uncut")
    assert all(any(part in alarm.message for part in known) for alarm in found.alarms), found.alarms
    path = found.toolpath
    return path[(path.line == path.line.max()) & path.is_motion]


def same_moves(rows, moves):
    """Each row against a move; an axis that is not named stands still."""
    assert len(rows) == len(moves)
    for row, move in zip(rows, moves):
        assert row.kind == KINDS[move["move"]]
        target = [move.get(axis, before) for axis, before in zip("xyz", row.start)]
        assert row.end.tolist() == near(target)
        assert row.feed == move.get("feed", math.inf)


def said(rows, part):
    """The rows whose label has this part."""
    return rows[np.array([part in rows.labels[k] for k in rows.label])]


def levels(rows):
    """The heights of rows, each once, in the order of cutting."""
    return list(dict.fromkeys(rows.end[:, 2].round(9).tolist()))


def half_sides(rows, centre, part):
    """Half sides of the rings of the first layer or of the floor, in order."""
    names = [name for name in rows.labels if f"{part}, ring " in name]
    rings = [np.abs(said(rows, name).end[:, :2] - centre).max(axis=0) for name in names]
    return [ring.tolist() for ring in rings]


def radii(rows, centre, part):
    """Radii of the full circles of the first layer or of the floor, in order."""
    circles = said(said(rows, part), "circle")
    assert (circles.sweep == math.tau).all()
    return np.hypot(*(circles.end[:, :2] - centre).T).tolist()


def of_surface(program, check):
    rows = motion_of(program, check)
    cutting = rows[rows.kind == Kind.LINE]
    if moves := check.pop("moves", None):
        for strategy, expected in moves.items() if isinstance(moves, dict) else [(None, moves)]:
            changed = motion_of(program, check, **({"L0": strategy} if strategy else {}))
            same_moves(changed, expected)
    lines = sorted(set(cutting.end[:, 1].round(9).tolist()))
    for name in ("rows", "lines"):
        assert lines == near(check.pop(name, lines))
    if "levels" in check:
        assert levels(said(cutting, ", line")) == near(check.pop("levels"))
    assert lines[0] == near(check.pop("first_row", lines[0]))
    assert lines[-1] == near(check.pop("last_row", lines[-1]))
    if "step" in check:
        assert np.diff(lines) == near(check.pop("step"))
    for name, side in (("x_left", cutting.end[:, 0].min()), ("x_right", cutting.end[:, 0].max())):
        assert side == near(check.pop(name, side))
    assert rows[-1].end.tolist() == near(check.pop("end", rows[-1].end.tolist()))
    del check["R"]
    check.pop("z0", None)


def of_pocket(program, check):
    rows = motion_of(program, check)
    centre = check.pop("centre", [0, 0])
    layers = said(said(rows, "layer"), "ring" if "G343" in program else "circle")
    assert levels(layers) == near(check.pop("rough_levels"))
    if "rings" in check:
        found = half_sides(rows, centre, "layer 1 of 4")
        assert np.array(found) == near(np.array(check.pop("rings")))
        assert np.diff(found, axis=0) == near(check.pop("step"))
        assert np.array(half_sides(rows, centre, "floor finishing")) == near(np.array(check.pop("floor_rings")))
    if "circles" in check:
        assert radii(rows, centre, "layer 1 of 4") == near(check.pop("circles"))
        assert radii(rows, centre, "floor finishing") == near(check.pop("floor_circles"))
    walls = rows[np.array([rows.labels[k][-4:] == "of 4" and "side" in rows.labels[k] for k in rows.label])]
    if "wall_levels" in check:
        assert levels(walls) == near(check.pop("wall_levels"))
    if "wall_half_sides" in check:
        assert np.abs(walls.end[:, :2] - centre).max(axis=0).tolist() == near(check.pop("wall_half_sides"))
        assert check.pop("wall_corner_radius") == 0 and (walls.kind == Kind.LINE).all()
    if "wall_radius" in check:
        assert np.hypot(*(walls.end[:, :2] - centre).T) == near(check.pop("wall_radius"))
    if "floor_start" in check:
        (plunge,) = said(rows, "floor finishing, entry")
        assert plunge.start.tolist() == near([*centre, check.pop("floor_start")])
        assert plunge.end[2] == near(check.pop("floor_level"))
    if "last_ring" in check:
        ring, said_so = said(rows, "ring 6 of 6"), check.pop("last_ring")
        turn = math.radians(-said_so["rotation"])
        flat = ring.end[:, :2] @ np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
        assert np.abs(flat).max(axis=0).tolist() == near(said_so["half_sides"])
        arcs = ring[ring.kind == Kind.ARC]
        assert np.hypot(*(arcs.start - arcs.centre).T[:2]) == near(said_so["corner_radius"]) and len(arcs) == 4
        assert ring[0].start[:2].tolist() == near(check.pop("start_of_last_ring"))
    assert rows[-1].end.tolist() == near(check.pop("end", rows[-1].end.tolist()))
    del check["R"]


def of_helix(program, check):
    plunge_angle = check.pop("plunge_angle")
    down, over, helix, circle, back = said(motion_of(program, check, plunge_angle), "layer")[:5]
    assert (down.start[2], down.end[2], down.feed) == (2, check["z_from"], 150)
    assert over.end[:2].tolist() == [check["helix_radius"], 0]
    assert math.dist(helix.start[:2], helix.centre[:2]) == near(check.pop("helix_radius"))
    turns = helix.sweep / math.tau
    assert (helix.start[2], helix.end[2]) == (check.pop("z_from"), check.pop("z_to"))
    assert turns == near(check.pop("turns"))
    assert (helix.start[2] - helix.end[2]) / turns == near(check.pop("pitch"))
    assert circle.sweep == math.tau and circle.end.tolist() == helix.end.tolist()
    assert back.end.tolist() == [0, 0, -5]
    assert check.pop("error_if") == "plunge_angle = 0"
    setup = Setup(tools={1: Tool(radius=check.pop("R"))})
    assert "needs the plunge angle" in mnclab.run("T1\n" + program, "mnc", setup).alarms[0].message


def of_ramp(program, check):
    for case in check.pop("cases"):
        rows = said(motion_of(program, check, case["plunge_angle"]), "entry ramp")
        sloping = rows[rows.start[:, 2] != rows.end[:, 2]]
        assert len(sloping) == case["strokes"]
        assert np.abs(sloping.end[:, 0] - sloping.start[:, 0]) == near(case["stroke"])
        assert sloping.start[:, 2] - sloping.end[:, 2] == near(case["drop"])
        assert set(sloping.feed) == {150} and set(rows.feed) == {150, 500}
        level = rows[-2]  # the last stroke, before the way back to the centre
        assert level.start[2] == level.end[2] == -5
        assert abs(level.end[0] - level.start[0]) == near(case["stroke"])
        assert rows[-1].end.tolist() == near([0, 0, -5])
    del check["R"]


@pytest.mark.parametrize(("program", "check"), EXAMPLES)
def test_the_numbers_of_an_example(program, check):
    check = json.loads(json.dumps(check))  # a copy to take from
    if "helix_radius" in check:
        of_helix(program, check)
    elif "cases" in check:
        of_ramp(program, check)
    elif program.startswith("G32"):
        of_surface(program, check)
    else:
        of_pocket(program, check)
    assert not check, f"not compared: {check}"
