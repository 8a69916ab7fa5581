"""One more control in a few lines: what a third party writes to teach the house another language.

Turtle: one word a line. `F 10` forward, `L 90` turn left (degrees), `U` pen up, `D` pen down, `H n` a hole
cycle of depth n at the place.
"""

import math
import re
from dataclasses import dataclass

import numpy as np
import pytest

import mnclab
from mnclab import Kind
from mnclab.machine.control import Control, FunctionTable
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machining.steps import Go
from mnclab.text.program import ProgramBuilder
from mnclab.text.words import characters, line_starts

FUNCTIONS, CYCLES = FunctionTable(), CycleTable()


def read(text, name="program"):
    builder = ProgramBuilder(text, name, "turtle", line_starts(characters(text)), "#")
    for begin in builder.line_starts.tolist():
        line = builder.text[begin:].split("\n", 1)[0].split("#")[0]
        if not line.strip():
            continue
        word = re.match(r"\s*([A-Z])\s*([-\d.]*)\s*$", line)
        builder.block(begin)
        if word is None:
            builder.alarm("a line of the turtle is a letter and a number", begin, len(line))
        elif word[1] == "H":
            builder.word("M", 1.0, begin + word.start(1), 1)
            builder.word("H", float(word[2]), begin + word.start(1), len(word[0].strip()))
        else:
            builder.word(word[1], float(word[2]) if word[2] else None, begin + word.start(1), len(word[0].strip()))
    return builder.build()


@dataclass
class Memory:
    heading: float = 0.0  # degrees


@FUNCTIONS("F", "Forward")
def forward(m, words):
    angle, length = math.radians(m.memory.heading), m.value(words["F"])
    x, y, _ = m.programmed
    m.line(x + length * math.cos(angle), y + length * math.sin(angle), f=100)


@FUNCTIONS("L", "Left")
def left(m, words):
    m.memory.heading += m.value(words["L"])


@FUNCTIONS("U D", {"U": "Pen up", "D": "Pen down"}, group="pen", power_on="U")
def pen(m, words):
    m.rapid(z=5 if words.code == "U" else 0)


@CYCLES("M1", "Hole", runs="definition", source="here")
class Hole(Cycle):
    depth: float = param("H", "depth of the hole", above=0, at_most=20)

    def moves(self, m):
        z = m.programmed[2]
        yield Go("down", -self.depth, 50)
        yield Go("up", z)


TURTLE = Control("turtle", "Turtle", read, FUNCTIONS, CYCLES, phases=("motion",), memory=Memory, suffixes=(".turtle",))
SQUARE = "D\n" + "F 10\nL 90\n" * 4 + "H 3\nU\n"


@pytest.fixture(autouse=True)
def turtle():
    yield mnclab.controls.add(TURTLE)
    mnclab.controls.remove("turtle")


def test_it_is_read_run_and_listed(tmp_path):
    (tmp_path / "square.turtle").write_text(SQUARE)
    run = mnclab.run(tmp_path / "square.turtle")  # the suffix says which control
    assert run.ok and len(run.program) == 11
    corners = run.toolpath.end[run.toolpath.kind == Kind.LINE][:4, :2]
    assert np.allclose(corners, [[10, 0], [10, 10], [0, 10], [0, 0]], atol=1e-12)
    assert "line    X10 Y10 Z0 F100" in str(run.toolpath)
    assert run.at(line=2).position == (10, 0, 0)


def test_it_is_plotted_and_explained():
    assert mnclab.run(SQUARE, "turtle").plot().axes
    assert "depth of the hole" in str(mnclab.help("M1", "turtle"))


def test_its_time_is_that_of_stops_at_corners():
    """Each side, from stop to stop: length over speed, and the speed over the acceleration once for both ends."""
    limits = mnclab.Limits(acceleration=500, rapid=6000)
    profile = mnclab.run("D\n" + "F 10\nL 90\n" * 4, "turtle").profile(limits)
    speed = 100 / 60
    assert profile.time == pytest.approx(4 * (10 / speed + speed / 500), abs=1e-12)
    assert profile.plot().axes


def test_it_plays(tmp_path):
    run = mnclab.run(SQUARE, "turtle")
    assert run.save(tmp_path / "square.html").stat().st_size > 10_000 and "<iframe" in run.player()._repr_html_()
    assert run.player().run is run


@pytest.mark.parametrize(
    ("line", "message"),
    [("H 30", "M1 H (depth of the hole) must be greater than 0 and at most 20, got 30"), ("F F", "a letter and a number"),
     ("Q 3", "Q3 has no meaning in this block"), ("F", "F needs a number")],
)  # fmt: skip
def test_its_mistakes_are_named(line, message):
    alarm = mnclab.run(f"D\n{line}\n", "turtle").alarms[0]
    assert message in str(alarm) and alarm.span[:2] == (2, 1)
