"""A part in three dimensions: the body, its edges, its colours, collisions."""

import numpy as np
import pytest

import mnclab
from mnclab import Alarm, Setup, Tool
from mnclab.workpiece.blank import cylinder
from mnclab.workpiece.collision import Collision

pytest.importorskip("pyvista")

SLOT = "G17 G90 G54\nT1 M6 S2000 M3\nG0 X-10 Y20 Z5\nG1 Z-3 F300\nX70\nG0 Z20\n"
TURN = "M3\nT1\nS800 G97 G95 F0.25\nG00 X15 Z2\nG01 Z-20\nX25\nG00 X40 Z20\nM5\n"


@pytest.fixture(scope="module")
def run():
    tools = {1: Tool(radius=4, kind="mill")}
    return mnclab.run(SLOT, "g43", Setup(tools=tools, stock=((0, 0, -20), (60, 40, 0)), start=(0, 0, 50)))


@pytest.fixture(scope="module")
def part(run):
    return run.workpiece(step=1.0)


def test_the_scene_holds_the_part_and_its_edges(part):
    scene = part.scene()
    assert {"part", "edges of the part"} <= set(scene.actors)
    assert scene.actors["part"].mapper.dataset.bounds == pytest.approx((0, 60, 0, 40, -20, 0))
    edges = scene.actors["edges of the part"].mapper.dataset
    at_floor = edges.points[np.abs(edges.points[:, 2] + 3) < 1e-6]
    assert {16.0, 24.0} <= set(np.round(at_floor[:, 1], 4).tolist())  # both walls of a slot 8 wide
    assert "<Milled" in scene.alt


@pytest.mark.parametrize(("colour", "values"), [("depth", {0.0, 3.0}), ("tool", {1.0}), ("line", {5.0})])
def test_colours_are_what_they_say(part, colour, values):
    data = part.scene(colour=colour).actors["part"].mapper.dataset
    found = data["depth, mm" if colour == "depth" else colour]
    assert set(found[np.isfinite(found)].tolist()) == values


def test_collisions_are_red_balls_at_their_places(part):
    found = Collision("rapid", "rapid motion in material", 3, 0, 2, (30.0, 20.0, -1.0), 1.0)
    scene = part.scene(colour="none", collisions=[found])
    assert scene.actors["collisions"].mapper.dataset.center == pytest.approx((30, 20, -1), abs=1e-3)
    assert scene.actors["pins"].mapper.dataset.bounds == pytest.approx((30, 30, 20, 20, -1, 6))  # out of the part
    with pytest.raises(Alarm, match="must be those of a run, got 3"):
        part.scene(collisions=3)
    with pytest.raises(Alarm, match="colour must be depth, tool, line or none"):
        part.scene(colour="kind")


def test_a_run_shows_its_part_in_place_of_the_blank(run):
    assert {"part", "cuts"} <= set(run.scene(part=True).actors) and "blank" not in run.scene(part=True).actors
    assert "blank" in run.scene().actors


def test_a_turned_part_has_diameters():
    done = mnclab.run(TURN, "jnc-t01", Setup(stock=cylinder(20, -50, 0), start=(60, 0, 50)))
    data = done.workpiece().scene().actors["part"].mapper.dataset
    assert np.nanmax(data["diameter, mm"]) == pytest.approx(40) and data.bounds[4:] == pytest.approx((-50, 0))
