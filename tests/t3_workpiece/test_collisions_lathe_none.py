"""Good programs of both lathes: nothing is blamed on samples, cycles and contours that a turner would run."""

import random
from math import radians, tan
from pathlib import Path

import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.machine.setup_file import load
from mnclab.workpiece.blank import chuck, cylinder

SAMPLES = Path(__file__).parents[2] / "data"
HEAD = "M3 S500 G97 G94 F100 T1\nG00 X60 Z20\n"


def none(text, control="jnc-t01", **setup):
    run = mnclab.run(text, control, Setup(start=(90, 0, 60), **setup))
    assert run.ok, run.alarms
    assert run.collisions() == (), run.collisions()


def two(chance, low, high):
    return round(chance.uniform(low, high), 2)


@pytest.mark.parametrize("path", sorted(SAMPLES.glob("setups/*/*.toml")), ids=lambda path: path.stem)
def test_samples_in_their_setups(path):
    (program,) = SAMPLES.glob(f"programs/{path.parent.name}/{path.stem}.*")
    assert mnclab.run(program, setup=load(path)).collisions() == ()


@pytest.mark.parametrize("lean", [90, 93, 95, 98])
def test_walls_of_cycles_are_blamed_on_no_rapid(lean):
    """Main edges beyond 90 degrees, and auxiliary ones of G78, leave wedges on the walls: they go with the last pass."""
    tools = {1: Tool(corner=0.4, main_angle=lean, auxiliary_angle=8, kind="turning")}
    for cycle in ("G77 X10 Z-30 U10 W-30 D3", "G77 X10 Z-30 U14 W-25 D3", "G78 X8 Z-9 U8 W-9 D2", "G78 X8 Z-9 U14 W-4 D2"):
        none(f"{HEAD}G00 X22 Z2\n{cycle}\nG00 X60 Z20\n", tools=tools, stock=cylinder(20, -60, 0))


@pytest.mark.parametrize("bevel", [0, 100, 300, 400, 500])
@pytest.mark.parametrize("stock", [100, 200, 300])
@pytest.mark.parametrize("x", [2000, 3000])
def test_the_transverse_passes_of_the_nc_31_leave_nothing_to_the_back(bevel, stock, x):
    """Steps that wait for the clean-up, and what the auxiliary edge leaves on the wall, are stock of the cycle (3.20.6)."""
    text = f"S800\nM3\nF20\nX4200~*\nZ200~\nG78*\nX{x}*\nZ-500*\nF20*\nP{stock}*\nP{bevel}\n"
    none(text, "nc-31", stock=cylinder(20, -60, 0))


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(30))
def test_shoulders_bevels_and_faces_of_the_jnc(seed):
    chance = random.Random(seed)
    radius = two(chance, 15, 40)
    x, z, depth = two(chance, 5, radius - 4), -two(chance, 20, 60), two(chance, 1, 4)
    u, w = two(chance, x, radius), -two(chance, 5, -z)
    bevel = chance.choice([f"U{x} W{z}", f"U{u} W{w}", f"U{u}"])
    lines = [f"G00 X{radius + 2} Z4", "G78 X-1 Z0 U-1 W0 D1.5", "G00 Z2", f"G77 X{x} Z{z} {bevel} D{depth}"]
    if chance.random() < 0.5:
        lines += ["G00 X60 Z20 T2", f"G00 X{x - 2} Z2", "G01 Z0", f"G01 X{x - 0.5} Z-1.5", f"G01 Z{w}", "X60"]
    none(HEAD + "\n".join([*lines, "G00 X60", "Z40\n"]), stock=cylinder(radius, -90, 3), fixtures=(chuck(radius, -90, 15),))


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(30))
def test_contours_that_only_rise_and_recesses_no_steeper_than_the_insert(seed):
    chance = random.Random(seed)
    radius, points, z, r = 30.0, [], 0.0, two(chance, 4, 9)
    while r < 27 and z > -60:
        z, r = round(z - chance.uniform(0.5, 9), 2), min(round(r + chance.choice([0, chance.uniform(0.2, 6)]), 2), 29)
        points.append((r, z))
    rough = [f"G00 X{x} Z2\nG01 Z{z + 0.2:.2f}\nG01 X{x + 2} Z{z + 2.2:.2f}\nG00 Z2" for x, z in _levels(points, radius)]
    angle = chance.uniform(20, 50)
    deep = two(chance, 0.5, 2)
    slope = round(deep / tan(radians(angle)), 3)
    contour = [f"G01 X{x} Z{z}" for x, z in points]
    recess = ["G01 X30", f"X{30 - deep} Z{-70 - slope}", f"Z{-76 - slope}", "X40", "G00 Z30"]
    lines = [*rough, "G00 X60 Z20 T2", f"G00 X{points[0][0]} Z2", *contour, "G01 X32", "G00 Z-70", *recess]
    none(HEAD + "\n".join(lines) + "\n", stock=cylinder(radius, -110, 0), fixtures=(chuck(radius, -110, 15),))


def _levels(points, radius):
    """Passes of 2 mm above a rising contour: how far each goes along Z."""
    x = radius - 2
    while x > points[0][0] + 1:
        yield x, _end(points, x)
        x -= 2


def _end(points, x):
    """The first place of a rising contour that is as high as a level, from the face."""
    before = (points[0][0], 0.0)
    for r, z in points:
        if r >= x - 0.3:
            share = 0 if r == before[0] else max((x - 0.3 - before[0]) / (r - before[0]), 0)
            return before[1] + share * (z - before[1])
        before = (r, z)
    return points[-1][1]


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(30))
def test_holes_bores_grooves_and_threads_of_the_jnc(seed):
    chance = random.Random(seed)
    radius = two(chance, 24, 35)
    depth, bore, at, step = two(chance, 15, 40), two(chance, 8, 14), -two(chance, 15, 40), two(chance, 1, 5)
    root = two(chance, radius - 4, radius - 1)
    lines = [
        "T6", "G00 X0 Z3", f"G73 Z-{depth} D{two(chance, 3, 9)} R1", "G00 Z20", "T5", "G00 X4.5 Z2",
        f"G77 X{bore} Z-{depth - 6} U{bore} W-{depth - 6} D1.5", "G00 Z20", "X60 T3", f"G00 X{radius + 2} Z{at}",
        f"G75 X{root} Z{at - 10} D{step}", "G00 X60", "Z20 T4", f"G00 X{radius + 2} Z6",
    ]  # fmt: skip
    pitch = chance.choice([1, 1.5, 2])
    for k in (1, 2, 3):
        lines += [f"G00 X{radius - 0.2 * pitch * k:.3f}", f"G32 Z{at + 5} F{pitch}", f"G00 X{radius + 2}", "Z6"]
    lines += ["G00 X60 Z20 T7", "G00 X17 Z2", f"G74 Z-{two(chance, 1, 4)} X20 D1.5", "G00 Z40"]
    none(HEAD + "\n".join(lines) + "\n", stock=cylinder(radius, -90, 0), fixtures=(chuck(radius, -90, 15),))


def frames(*each):
    return "\n".join(each) + "\n"


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(60))
def test_cycles_of_the_nc_31(seed):
    """Roughing, finishing, grooves, threads, faces, holes and bores, on diameters and in hundredths."""
    chance = random.Random(seed)
    bar = chance.randint(40, 70)  # diameter, mm
    x, z, p = 100 * chance.randint(20, bar - 12), -100 * chance.randint(20, 50), 10 * chance.randint(10, 40)
    start = ["S800", "M3", "F20", "Z200~", f"X{100 * bar}~"]
    rough = ["G77*~", f"X{x + 40}*", f"Z{z + 10}*", "F3000*", f"P{p}"]
    fine = ["G70*~", f"X{x}*", f"Z{z}*", "F1500"]
    groove = [f"Z{z + 400}~", f"X{x + 200}~", "G75*~", f"X{x - 300}*", f"Z{z}*", "F800*", "P200"]
    thread = [f"X{x + 300}~", "Z450~", "S400", "G31*", f"X{x}*", f"Z{z + 150}*", "F15000*", "P92*", "P25"]
    face = ["G78*~", "X0*", "Z0*", "F2000*", "P80"]
    hole = ["X0~", "G73*", "Z-4500*", "F1200*", f"P{chance.randint(400, 1500)}"]
    bore = ["X900~", "G77*~", f"X{100 * chance.randint(14, bar - 12)}*", "Z-2500*", "F1800*", "P200"]
    faces = [f"X{x - 1000}~", "G74*~", f"X{x - 400}*", "Z-200*", "F600*", "P300"]
    kinds = [[rough, fine], [rough, fine, groove], [rough, fine, groove, thread], [face, hole], [face, hole, bore], [face, faces]]
    end = [f"X{100 * bar + 400}~", "Z5000~"] if seed % 6 < 3 else ["Z5000~"]
    body = [line for block in kinds[seed % 6] for line in block]
    none(frames(*start, *body, *end), "nc-31", stock=cylinder(bar / 2, -90, 1 if seed % 6 > 2 else 0))
