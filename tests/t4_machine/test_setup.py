"""What a Setup takes: numbers that can be, tables of what they are named for; nothing that two runs share."""

import math
from dataclasses import fields
from fractions import Fraction
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tools.together import together

import mnclab
from mnclab import Alarm, Datum, Limits, Probe, Setup, Tool
from mnclab.workpiece.blank import Box, Revolved

NAN, INF = math.nan, math.inf
NEVER = [NAN, INF, -INF, "3", None, True, [1], {}, 1j, 10**400]
WORDS_AND_BODIES = ("name", "kind", "hand", "centre_cutting", "shank", "holder", "wear", "locked", "runout", "edges")
NUMBERS = [each.name for each in fields(Tool) if each.name not in WORDS_AND_BODIES]
SIZES = ["radius", "corner", "teeth", "cutting_length", "width", "number", "angle", "plunge_angle"]


@together(
    "name value", product(NUMBERS, NEVER), lambda name, value: name, lambda name, value: repr(value)[:9]
)  # fmt: skip
def test_no_dimension_of_a_tool_is_anything_but_a_number(name, value):
    with pytest.raises(Alarm, match=f"the {name.replace('_', ' ')} of a tool must be a (finite )?number, got "):
        Tool(**{name: value})


def test_a_size_of_a_tool_is_not_negative_but_a_delta_may_be():
    for name in SIZES:
        with pytest.raises(Alarm, match="must be at least 0, got -1"):
            Tool(**{name: -1})
    tool = Tool(radius=Fraction(1, 2), dr=-2, length=-12, dl=np.float64(-0.5), pitch=-1)
    assert (tool.effective_radius, tool.effective_length) == (-1.5, -12.5)  # another side; against a zero tool
    for name in ("name", "kind"):
        with pytest.raises(Alarm, match=f"the {name} of a tool must be a text, got 3"):
            Tool(**{name: 3})


@pytest.mark.parametrize("value", NEVER, ids=lambda value: str(value)[:9])
def test_no_coordinate_is_anything_but_a_number(value):
    for build in (
        lambda: Datum(y=value),
        lambda: Datum(1, 2, value),
        lambda: Setup(start=(0, value, 0)),
        lambda: Setup(datums={1: (0, value)}),
        lambda: Setup(presets={1: [0, value, 0]}),
        lambda: Setup(correctors={1: (0, 0, value)}),
        lambda: Setup(datums={value if not isinstance(value, list | dict) else "a": (0, 0, 0)}),
        lambda: Probe(clearance=value),
        lambda: Probe(reach=value),
        lambda: Limits(corner_tolerance=value),
        lambda: Limits(rapid=(value, 1, 1)),
        lambda: Limits(acceleration=(1, 1, value)),
        lambda: Limits(rapid=value if value != [1] else NAN),
        lambda: Limits(tool_change=value),
        lambda: Setup(stock=((0, 0, 0), (1, 1, value)) if value not in ("3", True) else 5),
    ):
        with pytest.raises(Alarm):
            build()


@pytest.mark.parametrize("named", [{"clearance": -1}, {"reach": 0}, {"feed": -5}, {"rapid": NAN}, {"rapid": 0}])
def test_a_probe_that_cannot_be(named):
    with pytest.raises(Alarm, match=f"the {next(iter(named))} of a probe must be"):
        Probe(**named)


@pytest.mark.parametrize(
    ("what", "sentence"),
    [
        ({"tools": {1: 5}}, r"tools\[1\] must be a Tool, got 5"),
        ({"tools": [Tool()]}, "tools must be a dict, got"),
        ({"tools": {"1": Tool()}}, "a row of tools must be a number, got '1'"),
        ({"tools": {-1: Tool()}}, "a row of tools must be at least 0, got -1"),
        ({"datums": {1: 5}}, r"datums\[1\] must be a Datum or its numbers, got 5"),
        ({"datums": {1: "123"}}, r"datums\[1\] must be a Datum or its numbers, got '123'"),
        ({"datums": {1: range(9)}}, r"datums\[1\] must be a Datum"),
        ({"presets": 3}, "presets must be a dict, got 3"),
        ({"start": (0, 0)}, "start must be three numbers"),
        ({"start": "123"}, "start must be three numbers"),
        ({"stock": 5}, "stock must be three sizes"),
        ({"stock": Box((0, 0, 0), (1, 1, NAN))}, "stock must be three sizes"),
        ({"stock": Revolved(((-5.0, 0.0), (-5.0, 9.0)))}, "stock must be three sizes"),
        ({"stock": Revolved(((INF, 0.0), (INF, 5.0)), "Z", (0.0, 0.0, 0.0), 0.0)}, "stock must be three sizes"),
        ({"part": 5}, "part must be a part"),
        ({"part": print}, "part must be a part"),
        ({"probe": 5}, "probe must be a Probe"),
        ({"limits": 5}, "limits must be a Limits"),
        ({"files": {"A": 5}}, r"files\['A'\] must be a text or a Path"),
        ({"files": {5: "A"}}, "files must be a dict with names"),
        ({"settings": 5}, "settings must be a dict with names"),
        ({"variables": [1]}, "variables must be a dict with names"),
        ({"kinematics": {"A": 1}}, "kinematics must be a Kinematics, or the name of a machine"),
        ({"kinematics": ()}, "kinematics must be a Kinematics, or the name of a machine"),
        ({"kinematics": "small-mill"}, "the machine small-mill has no rotary axes"),
        ({"true_kinematics": "table-ac"}, "true_kinematics must be a Kinematics"),
        ({"true_tools": {1: 5}}, r"true_tools\[1\] must be a Tool, got 5"),
        ({"true_tools": 1}, "true_tools must be a dict, got 1"),
    ],
    ids=str,
)
def test_what_cannot_be_is_refused_where_it_is_given(what, sentence):
    with pytest.raises(Alarm, match=sentence):
        Setup(**what)


@pytest.mark.parametrize(
    "travel",
    [5, ((0, 1), (0, 1)), ((0, 1), (0, 1), 5), ((0, 1), (0, 1), (1, 0)), ((0, 1), (0, 1), (1, 1)),
     ((0, 1), (0, NAN), (0, 1)), ((0, 1), (0, "9"), (0, 1)), ((0, 1), (0, 1), (0, 1, 2))],
)  # fmt: skip
def test_a_travel_goes_up_in_three_axes(travel):
    with pytest.raises(Alarm, match="limit travel"):
        Limits(travel=travel)
    assert Limits(travel=[[0, INF], [-INF, 0], [0, 1]]).travel  # without an end is an end too


WILD = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(), st.binary(),
                 st.lists(st.one_of(st.floats(), st.text()), max_size=4), st.tuples(st.floats(), st.floats(), st.floats()),
                 st.dictionaries(st.one_of(st.integers(), st.text()), st.one_of(st.floats(), st.text(), st.none())))  # fmt: skip


@given(name=st.sampled_from([each.name for each in fields(Setup) if each.name != "source"]), value=WILD)
def test_a_setup_of_anything_is_a_setup_or_an_alarm(name, value):
    try:
        setup = Setup(**{name: value})
        mnclab.run("T1\nG0 X1\nG1 X2 F100\n", "mnc", setup)  # a setup that was taken can be run with
    except Alarm:
        return


def test_nothing_is_shared_between_setups_and_runs():
    own = {1: Tool(radius=7)}
    setup = Setup(tools=own)
    setup.tools[1] = Tool(radius=99)
    assert own[1].radius == 7 and mnclab.run("T1\nG0 X1\n", "mnc").toolpath.radius[-1] == 5
    setup.tools[1] = 5
    with pytest.raises(Alarm, match=r"tools\[1\] must be a Tool, got 5"):
        mnclab.run("T1\nG0 X1\n", "mnc", setup)
    given_own = Setup(tools=own, files={"A": Path("a")})
    own[1] = Tool(radius=8)
    assert given_own.tools[1].radius == 7
    run = mnclab.run("T1\nG0 X1\n", "mnc", given_own)
    run.tables.tools[1] = Tool(radius=9)
    assert given_own.tools[1].radius == 7 and run.again(given_own).toolpath.radius[-1] == 7


def test_the_page_of_a_setup_is_in_words_with_units():
    drill, sides = Tool(radius=4, length=80, kind="drill", angle=118), ((0, 0, -20), (60, 40, 0))
    given = Setup(tools={1: drill}, datums={2: (1, 2)}, stock=sides, limits=Limits(jerk=5), variables={"Q1": 2})
    assert repr(given).splitlines() == [
        "Setup",
        "  T1: drill, radius 4 mm, length 80 mm, angle 118°",
        "  datum 2: X1 Y2 Z0",
        "  stock: X0 Y0 Z-20 to X60 Y40 Z0",
        "  probe: as usual",
        "  limits: jerk 5 mm/s³",
        "  start: X0 Y0 Z0",
        "  variable Q1: 2",
    ]
    assert ">limits</td>" in given._repr_html_() and ">jerk 5 mm/s³</td>" in given._repr_html_()
    assert "  limits: as usual\n" in repr(Setup()) and "  tools: those of the control\n" in repr(Setup())
    kept = mnclab.run("G00 X1\n", "jnc-t01").setup
    assert "  tools: the usual ones: roughing insert 80°, finishing insert 35°," in repr(kept)


def test_a_setting_too_large_for_any_number():
    for control in ("mnc", "g43", "jnc-t01"):
        with pytest.raises(Alarm, match="setting arc_tolerance .* must be a number from 0"):
            mnclab.run("", control, Setup(settings={"arc_tolerance": 10**400}))


def test_datums_that_bear_the_numbers_of_their_codes():
    """G54 to G59 are the rows 1 to 6; a table that is as long has a row 54, and a control without these codes all rows."""
    for control in ("g43", "mnc"):
        for row in (54, 59):
            with pytest.raises(Alarm, match=rf"row {row} of datums .* rows 1 to 6") as caught:
                mnclab.run("G0 X1\n", control, datums={1: (0, 0, 0), row: (1, 2, 3)})
            assert caught.value.hint == f"for G{row}: Setup(datums={{{row - 53}: …}})"
        assert mnclab.run("G0 X1\n", control, datums={6: (1, 2, 3), 53: (0, 0, 0), 54: (1, 2, 3), 60: (0, 0, 0)}).ok
    shift = "0 BEGIN PGM A MM\n1 CYCL DEF 7.0 DATUM SHIFT\n2 CYCL DEF 7.1 #54\n3 L X+0 Y+0 Z+0 FMAX\n4 END PGM A MM\n"
    assert mnclab.run(shift, "tnc-620", datums={54: (1, 2, 3)}).toolpath.end[-1].tolist() == [1, 2, 3]
