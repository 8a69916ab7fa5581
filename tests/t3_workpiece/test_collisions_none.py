"""Good programs meet nothing: samples, every cycle of the mills with many values, contours, holes, bores, in any setup.

Blanks fit: the surface is Z0, what a cycle faces ends where the blank ends, and a cycle that comes after others (finishing
alone, back boring, a pilot hole) is not asked here to work in solid material.
"""

from dataclasses import replace
from pathlib import Path
from random import Random

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup, Tool
from mnclab.machine import trial
from mnclab.machine.setup import MILLS

MILL_CONTROLS = ("mnc", "g43", "tnc-620")
SAMPLES = [path for name in MILL_CONTROLS for path in sorted((Path(__file__).parents[2] / "data/programs" / name).iterdir())]
SETUPS = {
    "default": {},
    "lengths": {"tools": {number: replace(tool, length=50.0 + 7 * number) for number, tool in MILLS.items()},
                "start": (0, 0, 400)},
    "datum": {"datums": {1: (210.5, -80.25, -150)}, "presets": {1: (210.5, -80.25, -150)}},
}  # fmt: skip


def fitting(run, beside=25.0):
    """A blank about what is cut, in machine coordinates, whose surface is Z0 of the path; None if nothing is below."""
    path = run.toolpath
    cuts = np.isin(path.kind, (Kind.LINE, Kind.ARC))
    if not cuts.any():
        return None
    ends = np.concatenate([path.start[cuts], path.end[cuts]])
    low, high = ends.min(axis=0) - beside, ends.max(axis=0) + beside
    low[2], high[2] = ends[:, 2].min() - 5, 0.0
    if ends[:, 2].min() >= 0:
        return None
    return tuple((low + path.origin).tolist()), tuple((high + path.origin).tolist())


def clean(run, beside=25.0) -> bool:
    """Whether there was something to meet; it must not have been met."""
    blank = None if run.stock is not None else fitting(run, beside)
    if run.stock is None and blank is None:
        return False
    assert len(run.collisions(blank)) == 0, run.program.text
    return True


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.name)
def test_samples(path):
    clean(mnclab.run(path))


# --- every cycle -----------------------------------------------------------------------------------------------------

FACING = {"G320": -5, "G321": -5, "CYCL DEF 233": -5, "CYCL DEF 232": -5}  # the tool overruns the blank by its radius at most
STUDS = {"CYCL DEF 256": -5, "CYCL DEF 257": -5, "CYCL DEF 258": -5}  # which are approached from beside their blank
NOT_IN_SOLID = {"G304", "G204", "CYCL DEF 204", "G307", "G241", "CYCL DEF 241", "G74"}
CUT_NOTHING = {*(f"GLOBAL DEF {number}" for number in (100, 105, 110, 111, 120, 125)), "CYCL DEF 20", "CYCL DEF 22",
               "CYCL DEF 247", "CYCL DEF 239", "CYCL DEF 12"}  # alone
NOT_JUDGED = {f"CYCL DEF {number}" for number in (27, 28, 29, 39, 19)}  # on a cylinder; in a leaning plane
PILOT = {"CYCL DEF 21"}  # whose few variants are too small for the tool: with its mill in the tests of roughing
CYCLES = [
    (name, code)
    for name in MILL_CONTROLS
    for code, cycle in mnclab.controls[name].cycles.items()
    if code == cycle.code and code not in NOT_IN_SOLID | CUT_NOTHING | NOT_JUDGED | PILOT
    and "MNC 12" not in cycle.source and not code.startswith("TCH PROBE") and trial.program(mnclab.controls[name], cycle, {})
]
VARIANTS = 9


def variants(name, code):
    """Programs of one cycle: its examples, then with some of its numbers made smaller or greater."""
    chance, cycle = Random(code), mnclab.controls[name].cycles[code]
    written = [each for each in cycle.parameters() if each.required or trial.written_first(each)]
    for number in range(VARIANTS):
        values = {each.name: trial.first_value(each) for each in written}
        for each in written if number else ():
            fixed = isinstance(values[each.name], str) or "surface" in each.meaning.lower()
            if not fixed and chance.random() < 0.4:
                factor = chance.choice((0.3, 0.5, 0.7, 1.3, 1.7, 2.5))
                choices = [float(one) for one in each.choices or () if one != 2 or "scope" not in each.meaning.lower()]
                values[each.name] = chance.choice(choices) if choices else values[each.name] * factor
                if each.name == "repeats":  # a whole number
                    values[each.name] = 2
        text = trial.program(mnclab.controls[name], cycle, values)
        if "Q215=+2" not in text:  # finishing alone
            yield text


@pytest.mark.deep
@pytest.mark.parametrize("setup", SETUPS)
@pytest.mark.parametrize(("name", "code"), CYCLES)
def test_cycles(name, code, setup):
    runs = [mnclab.run(text, name, Setup(**SETUPS[setup])) for text in variants(name, code)]
    beside = (FACING | STUDS).get(code, 25.0)
    assert sum(clean(run, beside) for run in runs if run.ok) >= 4


# --- written by hand -------------------------------------------------------------------------------------------------


def milled(chance):
    """A compensated contour in layers about a boss, from outside: MNC."""
    side, deep, radius = chance.uniform(30, 60), chance.uniform(2, 12), chance.choice((1, 3, 4, 5))
    r = round(chance.uniform(MILLS[radius].radius, 12), 3)
    yield f"G17 G90 G54\nT{radius} S2500 M3\nG0 X-40 Y-40 Z5"
    layers = chance.randint(1, 4)
    for k in range(1, layers + 1):
        z = -deep * k / layers
        yield (f"G0 X-40 Y-40\nG0 Z{z + deep / layers + 1:.3f}\nG1 Z{z:.3f} F200\nG41 G1 X0 Y-20 F400\nG1 Y{side:.3f}\n"
               f"G1 X{side:.3f}\nG1 Y{r}\nG2 X{side - r:.3f} Y0 R{r}\nG1 X-30\nG40 G1 X-40 Y-40\nG0 Z5")  # fmt: skip


def drilled(chance):
    """Holes in rows by G83, then some of them milled wider: g43."""
    step, deep = chance.uniform(12, 25), chance.uniform(3, 25)
    yield f"T2 M6\nG54 G17 G90 G0 X0 Y0 S1200 M3\nG43 D2 Z20\nG99 G83 X0 Y0 Z-{deep:.3f} R2 Q{chance.uniform(2, 8):.3f} F150"
    for k in range(1, chance.randint(2, 7)):
        yield f"X{k * step:.3f}"
    yield "G98 X0\nG80\nT4 M6\nG0 X0 Y0 S3000 M3\nG43 D4 Z5\nG0 Z1\nG1 Z-2 F200"
    yield "G1 X4\nG3 X4 Y0 I-4 J0\nG1 X0\nG0 Z20"


def slots(chance):
    """Ramps to and fro, a way back at rapid in the slot, helices into the material and rapids over their floor: MNC."""
    x, y, length = chance.uniform(0, 40), chance.uniform(0, 40), chance.uniform(5, 50)
    yield f"G17 G90 G54\nT{chance.choice((1, 3, 4))} S2500 M3\nG0 X{x:.3f} Y{y:.3f} Z5\nG1 Z0 F100"
    turn = chance.uniform(0, 2 * np.pi)
    ends = [f"X{x:.3f} Y{y:.3f}", f"X{x + length * np.cos(turn):.3f} Y{y + length * np.sin(turn):.3f}"]
    passes = chance.randint(2, 7)
    for k in range(1, passes + 1):
        yield f"G1 {ends[k % 2]} Z{-0.8 * k:.3f}"
    yield f"G1 {ends[(passes + 1) % 2]}\nG0 {ends[passes % 2]}\nG0 Z5"
    round_ = chance.uniform(1, 1.9)  # less than the least radius: no core stays
    yield f"G0 X{100 + round_:.3f} Y0\nG0 Z0.5\nG1 Z0"
    for k in range(1, 6):
        yield f"G3 X{100 + round_:.3f} Y0 Z{-0.7 * k:.3f} I{-round_:.3f} J0"
    yield f"G3 X{100 + round_:.3f} Y0 I{-round_:.3f} J0\nG0 X{100 - round_:.3f}\nG0 Z5"


WRITTEN = {milled: "mnc", drilled: "g43", slots: "mnc"}


@pytest.mark.deep
@pytest.mark.parametrize("setup", SETUPS)
@pytest.mark.parametrize("write", WRITTEN, ids=lambda write: write.__name__)
def test_written_by_hand(write, setup):
    for seed in range(25):
        text = "\n".join(write(Random(seed))) + "\n"
        run = mnclab.run(text, WRITTEN[write], Setup(**SETUPS[setup]))
        assert run.ok, run.alarms
        assert clean(run)


@pytest.mark.deep
def test_tools_with_all_that_is_behind_their_edges():
    """A drill, a mill with a thinner neck and a holder in a hole of 40 mm, as deep as the neck is long."""
    tool = Tool(5, cutting_length=12, shank=(4.5, 12), holder=((20, 42),), kind="mill")
    text = "G17 G90 G54\nT1 S2500 M3\nG0 X25 Y0 Z5\nG1 Z0 F200\n"
    for k in range(1, 5):
        text += f"G3 X25 Y0 Z{-10 * k} I-25 J0\nG3 X25 Y0 I-25 J0\n"
        text += "".join(f"G1 X{x} F300\nG3 X{x} Y0 I{-x} J0\n" for x in (20, 15, 10, 5)) + "G1 X0\nG1 X25\n"
    run = mnclab.run(text + "G0 Z50\n", "mnc", Setup(tools={1: tool}, stock=((-40, -40, -40), (40, 40, 0))))
    assert run.ok and not run.collisions()
