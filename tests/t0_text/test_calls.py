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
    wrong: Any = None
    with pytest.raises(TypeError, match="unsupported operand"):
        weigh(wrong)


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
