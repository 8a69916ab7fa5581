"""Random designs, milled as drawn and with four faults: what is reported is what plain arithmetic says of the fault."""

import math

import pytest
from design.cut_from_drawings import DRILL, MILL, R, cut, random_design, written
from tools.chance import seeds

from mnclab import Tool
from mnclab.design.model import Design

SEEDS = seeds(1, deep=33)
STEP, EXACT = 0.4, 2e-5  # mm; the centre of a circle is the mean of a few hundred places
ROUND = 2e-4  # of a bevel beside its place: its rings are not those of the design
CONE = math.tan(math.radians(59))  # of a drill of 118 degrees


def difference(seed, wider=0.0, **fault):
    design = random_design(seed)
    tools = {MILL: Tool(radius=R + wider, number=MILL, kind="mill")}
    tools[DRILL] = Tool(radius=3.5 + wider, number=DRILL, kind="drill", angle=118)
    program = written(design, **fault)
    return design, program, cut(program, tools, step=STEP).compare(design)


def deviations(found):
    """Feature and measure by what each is off, of what was measured."""
    return {(row.feature, row.measure): row.deviation for row in found.features if row.measure != "form"}


def check(found, expected):
    """What every measure is off; those not named are right."""
    for (feature, measure), deviation in deviations(found).items():
        exact = ROUND if feature.startswith("bevel") else EXACT
        assert deviation == pytest.approx(expected(feature, measure), abs=exact), (feature, measure)


def kinds(design):
    return {each.name: each.kind for each in design.features}


def check_lines(found, program, but=()):
    """The guilty line of a size that is off stands in the block of its feature."""
    for row in found.features:
        if abs(row.deviation) > 1e-3 and row.measure not in ("form", *but):
            assert row.line in program.lines_of[row.feature], row


@pytest.mark.parametrize("seed", SEEDS)
def test_as_drawn(seed):
    _, _, found = difference(seed)
    assert found.ok
    assert found.worst_gouge.value <= 1e-8 and found.worst_rest.value <= 1e-8
    assert found.gouge_volume < 1e-6 and found.rest_volume < 1e-6
    check(found, lambda feature, measure: 0.0)


@pytest.mark.parametrize("wider", [0.1, -0.1])
@pytest.mark.parametrize("seed", SEEDS)
def test_the_tool_has_another_radius(seed, wider):
    design, program, found = difference(seed, wider)
    kind = kinds(design)

    def expected(feature, measure):
        if measure in ("diameter", "width") and kind[feature] != "chamfer":
            return 2 * wider
        if measure == "length" and kind[feature] == "pocket":  # that of a slot is between the centres of its ends
            return 2 * wider
        if measure == "corner radius":
            return wider
        if measure == "depth" and kind[feature] == "hole":  # the shoulder of a wider drill stands higher
            return -wider / CONE
        return 0.0

    check(found, expected)
    worst, other = (found.worst_gouge, found.worst_rest) if wider > 0 else (found.worst_rest, found.worst_gouge)
    if wider > 0 or "chamfer" not in kind.values():
        assert worst.value == pytest.approx(abs(wider), abs=1e-6)
    else:  # at the foot of a bevel what is left goes over the corner
        assert worst.value == pytest.approx(abs(wider) * math.sqrt(2), abs=1e-4)
    assert other.value <= 1e-8
    assert not found.ok
    assert worst.line in program.lines_of[worst.feature]
    check_lines(found, program)


@pytest.mark.parametrize("seed", SEEDS)
def test_too_deep(seed):
    design, program, found = difference(seed, dz=-0.1)
    kind = kinds(design)
    check(found, lambda feature, measure: 0.1 * (measure == "depth" or kind[feature] == "chamfer"))
    assert found.worst_gouge.value == pytest.approx(0.1, abs=1e-6)
    assert found.worst_rest.value <= 1e-8
    assert found.worst_gouge.line in program.lines_of[found.worst_gouge.feature]
    check_lines(found, program)


@pytest.mark.parametrize("seed", SEEDS)
def test_shifted(seed):
    _, program, found = difference(seed, dx=0.05)
    check(found, lambda feature, measure: 0.05 * (measure == "x"))
    assert found.worst_gouge.value == pytest.approx(0.05, abs=1e-6)
    assert found.worst_rest.value == pytest.approx(0.05, abs=1e-6)
    assert found.worst_gouge.line in program.lines_of[found.worst_gouge.feature]
    assert found.worst_rest.line in program.lines_of[found.worst_rest.feature]
    check_lines(found, program)


@pytest.mark.parametrize("seed", [1, 2])
def test_nothing_was_cut(seed):
    """The blank itself: all that the design takes away is left, and no size is there."""
    design = random_design(seed)
    found = Design(design.blank).workpiece(0.4).compare(design)
    assert found.rest_volume == pytest.approx(design.blank.volume - design.volume, rel=2e-3)
    assert found.gouge_volume == 0 and found.worst_gouge.place is None and not found.ok
    assert {row.verdict for row in found.features if row.measure in ("diameter", "length", "width")} == {"not cut"}
    assert found.worst_rest.line == 0
