"""Every parameter of the cycles of chapter 5, changed alone, changes what its unit says and nothing else."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import mnclab as mnc

CYCLES = mnc.controls["tnc-620"].cycles
NUMBERS = (206, 207, 209, 262, 263, 264, 265, 267)

#: What must be programmed beside a parameter for it to act.
BESIDE: dict[tuple[int, str], dict[str, Any]] = {
    **{(n, "Q359"): {"Q358": -1, "Q359": 12} for n in (263, 264, 265, 267)},
    **{(n, "Q358"): {"Q359": 9} for n in (263, 264, 265, 267)},
    **{(n, "Q254"): {"Q358": -1, "Q359": 9} for n in (265, 267)},
    (263, "Q200"): {"Q357": 0},
    (264, "Q256"): {"Q257": 3},
    (264, "Q258"): {"Q257": 0},
    (265, "Q360"): {"Q358": -1, "Q359": 2},
}
#: A second value, where half of the first or the next choice would be refused or mean the same.
OTHER = {
    "Q239": 1.25, "Q335": 14, "Q351": -1, "Q355": 4, "Q360": 1, "Q358": -2, "Q257": 3, "Q512": 77, "Q256": 3, "Q359": 15,
    "Q204": 77,
}  # fmt: skip
#: What more than the path differs: the speed of a feed that follows from the pitch, the room of the tool, or the spindle.
ALSO = {
    "Q239": {"feeds", "spindle"}, "Q335": {"feeds"}, "Q256": {"feeds"}, "Q257": {"feeds", "spindle"}, "Q358": {"feeds"},
    "Q355": {"feeds"}, "Q359": {"feeds"}, "Q202": {"feeds"}, "Q360": {"feeds"}, "Q356": {"feeds"}, "Q201": {"feeds", "spindle"},
}  # fmt: skip

CASES = [(n, p.address) for n in NUMBERS for p in CYCLES[f"CYCL DEF {n}"].parameters()]


def seen(path: mnc.Toolpath) -> dict[str, object]:
    """What can be seen of a path, by the kind of thing."""
    motion = path.is_motion
    events = path[path.kind == mnc.Kind.SPINDLE]
    return {
        "path": [path.end[motion].round(9).tolist(), path.sweep[motion].round(9).tolist()],
        "feeds": path.feed[motion & (path.kind != mnc.Kind.RAPID)].round(9).tolist(),
        "dwells": path.time[path.kind == mnc.Kind.DWELL].tolist(),
        "spindle": events.spindle.tolist(),
        "angle": [events.labels[k] for k in events.label if "degrees" in events.labels[k]],
    }


CHANGES = {"s": {"dwells"}, "mm/min": {"feeds"}, "deg": {"angle"}}


@pytest.mark.deep
@pytest.mark.parametrize(("number", "address"), CASES)
def test_a_parameter_changes_what_it_means(called, rows, printed, number, address) -> None:
    beside = BESIDE.get((number, address), {})
    first = float(str(beside.get(address, printed[number][address])).replace(",", "."))
    parameter = next(p for p in CYCLES[f"CYCL DEF {number}"].parameters() if p.address == address)
    before = seen(rows(called(number, **beside)))
    after = seen(rows(called(number, **beside | {address: OTHER.get(address, first / 2)})))
    changed = {key for key in before if before[key] != after[key]}
    if (number, address) in ((207, "Q239"),):
        assert changed == {"feeds"}
    elif address == "Q403":
        assert changed == {"feeds", "spindle"}
    elif parameter.unit in CHANGES:
        assert changed == CHANGES[parameter.unit]
    else:
        assert "path" in changed and changed <= {"path"} | ALSO.get(address, set())


@pytest.mark.parametrize(("number", "address"), CASES)
def test_left_out_it_is_its_default_or_missing(called, rows, number, address) -> None:
    parameter = next(p for p in CYCLES[f"CYCL DEF {number}"].parameters() if p.address == address)
    run = called(number, **{address: None})
    if parameter.required:
        (alarm,) = (a for a in run.alarms if a.severity == "alarm")
        assert alarm.message == f"CYCL DEF {number} {address} ({parameter.meaning}) is missing"
        assert alarm.span[:2] == (4, 1)
    else:
        assert seen(rows(run)) == seen(rows(called(number, **{address: parameter.default})))


@pytest.mark.parametrize("number", NUMBERS)
def test_the_examples_make_a_program_that_runs(number) -> None:
    """A form begins with them."""
    from mnclab.machine import trial

    cycle = CYCLES[f"CYCL DEF {number}"]
    values = {p.name: p.example for p in cycle.parameters()}
    assert None not in values.values()
    text = trial.program(mnc.controls["tnc-620"], cycle, values)
    run = mnc.run(text, "tnc-620")
    assert run.ok, run.alarms
    cut = run.toolpath[(run.toolpath.kind == mnc.Kind.LINE) | (run.toolpath.kind == mnc.Kind.ARC)]
    assert cut.length > 20 and np.abs(cut.end[:, 2]).max() >= 16
