"""Programs in the manner of CAM systems, schools and hobby workshops: where the tool stands, worked out by hand.

`tests/programs_of_shops/g43`: each program, and in `places.toml` the places after its lines (`LINE: X Y Z`, or `LINE pass: …`
for the pass of a line that runs often), in the unit of the program; `*` is not asserted.

The kinds are those of programs found in public repositories. Of 115 ISO files looked through in November 2026 80 run as they are,
one more in the dialect that its alarm names; of the other 34 the alarm says what is wrong, what to write or what is not built.
"""

import math
import tomllib
from pathlib import Path

import pytest

import mnclab
from mnclab import Setup

FOLDER = Path(__file__).parents[2] / "programs_of_shops" / "g43"
PROGRAMS = tomllib.loads((FOLDER / "places.toml").read_text("utf-8"))
NAMES = {"cos": lambda a: math.cos(math.radians(a)), "sin": lambda a: math.sin(math.radians(a)), "sqrt": math.sqrt}


def value(formula):
    return eval(formula, {"__builtins__": {}}, NAMES)


@pytest.mark.parametrize("name", PROGRAMS)
def test_where_the_tool_stands(name):
    given = PROGRAMS[name]
    dialect = {"dialect": given["dialect"]} if "dialect" in given else {}
    run = mnclab.run(FOLDER / f"{name}.nc", "iso", Setup(settings=dialect))
    assert run.ok, run.alarms
    unit = 25.4 if given.get("inches") else 1.0
    assert len(given["places"]) >= 5
    for place in given["places"]:
        where, _, coordinates = place.partition(": ")
        line, *passes = map(int, where.split())
        point = run.at(line, *passes).point
        for found, formula in zip(point, coordinates.split(), strict=True):
            if formula != "*":
                assert found == pytest.approx(unit * value(formula), abs=1e-9), place


def test_there_are_sixty_and_each_has_its_places():
    assert len(PROGRAMS) >= 60 and PROGRAMS.keys() == {file.stem for file in FOLDER.glob("*.nc")}
