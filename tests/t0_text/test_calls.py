"""A call that does not fit a function is an Alarm that says what it takes."""

from __future__ import annotations

import inspect
import pickle
from typing import Any

import pytest

import mnclab as mnc
from mnclab.text.given import fitting

RUN = mnc.run("G0 X5\n", "mnc")


@fitting
def weigh(length: float, *, density: float = 7.85) -> float:
    """Something to weigh."""
    return length * density


def test_a_call_that_fits_is_that_of_the_function() -> None:
    assert weigh(2, density=3) == 6
    assert str(inspect.signature(weigh)).startswith("(length: 'float', *, density")
    assert pickle.loads(pickle.dumps(weigh)) is weigh


def test_a_fault_inside_stays_what_it_is() -> None:
    @fitting
    def faulty(length: float) -> Any:
        return None + length  # type: ignore[operator]

    with pytest.raises(TypeError, match="unsupported operand"):
        faulty(2.0)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (None, "must be a number, got None"), ("abc", "must be a number, got 'abc'"), ([], "must be a number, got []"),
        (True, None), (3, None), (10**400, "must be a finite number of at most 1e+09, got 1000000000"),
    ],
)  # fmt: skip
def test_a_value_of_another_kind_than_its_annotation(wrong: Any, said: str | None) -> None:
    """The call fails in Python's own way first: what Python can work with stays as it was."""
    if said is None:
        assert weigh(wrong) == 7.85 * wrong
        return
    with pytest.raises(mnc.Alarm) as caught:
        weigh(wrong)
    assert caught.value.message.startswith(f"weigh: length {said}")


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: mnc.area.Contour("abc"), "Contour: points must be numbers, got 'abc'"),
        (lambda: mnc.area.rectangle(1e-320, 5), "rectangle: length must be 0, or a number of at least 1e-150, got 1e-320"),
        (lambda: mnc.area.terraces(mnc.area.Part(mnc.area.Region(()), 5), None), "terraces: whole must be a number, got None"),
        (lambda: mnc.strategies.zigzag(1.5, 1.5, 1.5), "zigzag: region must be of the kind Region, got 1.5"),
        (lambda: mnc.Probe(deflection=None), "Probe: deflection must be a sequence, got None"),
        (lambda: mnc.probing.spatial_angles(0), "the axes of a system must be an array (3, 3), got one ()"),
        (lambda: mnc.probing.reduced(0, 0), "a turn must be greater than 0 degrees, got 0"),
        (lambda: RUN.toolpath["abc"], "a row of a toolpath is named by a whole number, some by a slice, numbers or a mask"),
        (lambda: RUN.toolpath[None], "a row of a toolpath is named by a whole number, some by a slice, numbers or a mask"),
    ],
)
def test_values_that_are_none_of_a_function(call: Any, said: str) -> None:
    with pytest.raises(mnc.Alarm) as caught:
        call()
    assert caught.value.message.startswith(said)


def test_a_refusal_is_what_python_calls_it_too() -> None:
    """For `except ValueError` and `except IndexError` of those who work with contours and paths as with numbers."""
    with pytest.raises(ValueError, match="^a contour needs at least two points, got 1$") as refused:
        mnc.area.Contour([(0, 0)])
    with pytest.raises(IndexError, match="there is no row 999") as absent:
        RUN.toolpath[999]
    assert isinstance(refused.value, mnc.Alarm) and isinstance(absent.value, mnc.Alarm)


@pytest.mark.parametrize(
    ("call", "said", "hinted"),
    [
        (lambda: weigh(1, densty=2), "weigh has no option 'densty'", "near: density"),
        (lambda: weigh(1, colour=2), "weigh has no option 'colour'", "it takes length, density"),
        (lambda: weigh(), "weigh: missing a required argument: 'length'", "weigh(length, density=…)"),
        (lambda: weigh(1, 2), "weigh: too many positional arguments", "weigh(length, density=…)"),
        (lambda: mnc.Tool(dimater=3), "Tool has no option 'dimater'", "near: diameter"),
        (lambda: mnc.Setup(tool={}), "Setup has no option 'tool'", "near: tools"),
        (lambda: mnc.Setup(blank=(80, 60, 20)), "Setup has no option 'blank'", "write stock"),
        (lambda: mnc.Setup(machine="small-mill"), "Setup has no option 'machine'", 'write limits="small-mill"'),
        (lambda: mnc.run("G0 X5\n", "mnc", maschine="small-mill"), "run has no option 'maschine'", ""),
        (lambda: mnc.Limits(acelleration=3), "Limits has no option 'acelleration'", "near: acceleration"),
        (lambda: mnc.diff(RUN, RUN, tol=1), "diff has no option 'tol'", "write tolerance"),
        (lambda: mnc.diff(RUN), "diff: missing a required argument: 'other'", "diff(one, other, step=…, what=…, tolerance=…)"),
        (lambda: mnc.plot_profiles(RUN, machines=[]), "this figure has no option machines", ""),
        (lambda: mnc.form("G83", "mnc", X=20), "form has no option 'X'", "it takes code, control"),
        (lambda: mnc.editor(), "editor: missing a required argument: 'path'", "editor(path,"),
        (lambda: RUN.at(lin=1), "at has no option 'lin'", "near: line"),
        (lambda: RUN.largest_radius(limit=3), "largest_radius has no option 'limit'", "it takes none"),
        (lambda: RUN.collisions(stok=1), "collisions has no option 'stok'", "near: stock"),
        (lambda: RUN.cutting_data(v=100), "cutting_data has no option 'v'", "write vc"),
        (lambda: RUN.report(), "report: missing a required argument: 'path'", "report("),
        (lambda: RUN.setup_sheet("a.pdf", titel="x"), "setup_sheet has no option 'titel'", "near: title"),
        (lambda: RUN.player(siz=3), "Player has no option 'siz'", ""),
        (lambda: RUN.plot(width=85), "this figure has no option width", "write size_mm=(85, None)"),
        (lambda: RUN.plot(figsize=(7, 5)), "this figure has no option figsize", "write size"),
    ],
)
def test_a_call_that_does_not_fit(call: Any, said: str, hinted: str) -> None:
    with pytest.raises(mnc.Alarm) as told:
        call()
    assert told.value.message.startswith(said)
    assert hinted in told.value.hint
