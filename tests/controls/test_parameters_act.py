"""Every parameter of every drilling and milling cycle, changed alone, changes what the manual says it changes and nothing else.

What that is follows from its unit: a time changes dwells, a feed changes feeds, a speed changes the spindle, a length
changes the path. Cycles begin with the examples of their declaration.
"""

import numpy as np
import pytest
from tools.running import run
from tools.together import together

import mnclab
from mnclab import Kind
from mnclab.machine import trial

pytestmark = pytest.mark.deep

#: Cycles of the TNC 620 that are varied too, by the numbers of CYCL DEF.
TNC = (200, 201, 202, 203, 204, 205, 208, 240, 241, 1, 2, 3, 4, 5, 17, *range(210, 216), 230, 231)
MNC = {code: each for code, each in mnclab.controls["mnc"].cycles.items() if code == each.code and "MNC 12" not in each.source}
CYCLES = MNC | {
    f"CYCL DEF {number}": mnclab.controls["tnc-620"].cycles[f"CYCL DEF {number}"] for number in TNC
}
LATHE = mnclab.controls["jnc-t01"].cycles
CYCLES |= LATHE

#: What must be given beside a parameter for it to act.
BESIDE = {
    ("G305", "diameter"): {"mode": 1},
    ("G306", "predrilled_diameter"): {"diameter": 14},
    ("CYCL DEF 240", "diameter"): {"mode": 1},
}
#: A second value, where half of the first, or the next choice, would be refused.
OTHER = {
    ("G303", "break_retract"): 1,
    ("G303", "chip_breaks"): 2,
    ("G303", "min_infeed"): 1,
    ("G304", "edge_height"): 9,
    ("G306", "diameter"): 14,
    ("G306", "predrilled_diameter"): 6,
    ("G307", "depth"): -12,
    ("G307", "spindle_direction"): 5,
    ("G77", "end_z"): -65,
    ("G78", "end_z"): -65,
    ("G77", "taper_x"): 25,
    ("G78", "taper_x"): 25,
    ("CYCL DEF 203", "chip_breaks"): 2,
    ("CYCL DEF 208", "diameter"): 12,
    ("CYCL DEF 241", "depth"): -30,
    ("CYCL DEF 241", "entry_speed"): 30,
    ("CYCL DEF 241", "coolant_on"): 9,
    ("CYCL DEF 241", "coolant_off"): 8,
    ("CYCL DEF 3", "y"): 10,
    ("CYCL DEF 4", "y"): 50,
    ("CYCL DEF 4", "corner_radius"): 5,
    ("CYCL DEF 210", "slot_width"): 14,
    ("CYCL DEF 211", "slot_width"): 14,
    ("CYCL DEF 212", "corner_radius"): 12,
    ("CYCL DEF 214", "finished_diameter"): 78,
    ("CYCL DEF 215", "blank_diameter"): 90,
}
#: Parameters that act beside the path, or not at all: what they do change.
SPINDLE_ONLY = {("G307", "spindle_direction"), ("CYCL DEF 241", "spindle_direction")}
LABELS_ONLY = {("CYCL DEF 241", "coolant_on"), ("CYCL DEF 241", "coolant_off")}  # rows say which M function it is
ANGLES = ("rotation_angle", "starting_angle", "angular_length")  # of slots, not of the spindle
NOTHING = {  # it only allows wider holes (MNC-G306-C; TNC 620, 4.9); refusals are tested as such
    ("G306", "predrilled_diameter"), ("CYCL DEF 208", "roughing_diameter"),
}  # fmt: skip

CASES = [(code, parameter) for code, cycle in CYCLES.items() for parameter in cycle.parameters()]


def control_of(code):
    return "tnc-620" if code.startswith("CYCL DEF") else "jnc-t01" if code in LATHE else "mnc"


def path_of(code, values):
    return run(trial.program(mnclab.controls[control_of(code)], CYCLES[code], values), control_of(code)).toolpath


def beginning(code, name):
    """The examples, with one of two parameters that stand for each other."""
    declared = CYCLES[code].parameters()
    instead = {p.instead for p in declared if p.name == name}
    values = {p.name: p.example for p in declared if p.name == name or (trial.written_first(p) or p.required)}
    return {key: value for key, value in values.items() if key not in instead} | BESIDE.get((code, name), {})


def another(code, parameter):
    if (code, parameter.name) in OTHER:
        return OTHER[code, parameter.name]
    if parameter.choices:
        return next(choice for choice in parameter.choices if choice != parameter.example)
    return parameter.example / 2 if parameter.example else 3.5


def seen(path):
    """What can be seen of a path, by the kind of thing."""
    cut, motion = path.kind != Kind.RAPID, path.is_motion
    return {
        "path": [path.end[motion].round(9).tolist(), path.sweep[motion].round(9).tolist()],
        "feeds": path.feed[motion & cut].round(9).tolist(),
        "dwells": path.time[path.kind == Kind.DWELL].tolist(),
        "spindle": path.spindle[path.kind == Kind.SPINDLE].tolist(),
        "labels": [path.labels[k] for k in path.label[np.isin(path.kind, (Kind.SPINDLE, Kind.COOLANT))]],
    }


def each(test):
    """A case a cycle, which lists every parameter that fails."""
    return together("code parameter", CASES, lambda code, parameter: code, lambda code, parameter: parameter.name)(test)


CHANGES = {"s": "dwells", "mm/min": "feeds", "rev/min": "spindle", "deg": "labels", "mm": "path", "count": "path"}


@each
def test_a_parameter_changes_what_it_means(code, parameter):
    values = beginning(code, parameter.name)
    before = seen(path_of(code, values))
    after = seen(path_of(code, values | {parameter.name: another(code, parameter)}))
    changed = {key for key in before if before[key] != after[key]}
    if (code, parameter.name) in NOTHING:
        assert changed == set()
        return
    if (code, parameter.name) in SPINDLE_ONLY:
        assert changed == {"spindle"}
        return
    if (code, parameter.name) in LABELS_ONLY:
        assert changed == {"labels"}
        return
    if parameter.unit == "mm/rev" or parameter.address == "PITCH" or (code, parameter.name) == ("G84", "feed"):
        assert changed == {"feeds"}
        return
    named = {"rotation": "path", "factor": "feeds", **dict.fromkeys(ANGLES, "path")}
    kind = named.get(parameter.name) or CHANGES.get(parameter.unit, "path")
    assert kind in changed
    if kind in ("dwells", "feeds", "spindle", "labels"):
        assert changed == {kind}
    else:
        assert changed <= {"path", "feeds", "dwells"}  # more or fewer pecks have more or fewer of them


@each
def test_left_out_it_is_its_default_or_missing(code, parameter):
    values = beginning(code, parameter.name)
    given = {k: v for k, v in values.items() if k != parameter.name}
    text = trial.program(mnclab.controls[control_of(code)], CYCLES[code], given)
    found = mnclab.run(text, control_of(code))
    if parameter.required:
        assert f"{code} {parameter.address} ({parameter.meaning}) is missing" in found.alarms[0].message
        assert found.alarms[0].span[:2] == (line_of(code, text), 1)
    elif parameter.default is not None and (code, parameter.name) not in BESIDE:
        assert found.ok, found.alarms
        assert seen(found.toolpath) == seen(path_of(code, values | {parameter.name: parameter.default}))


def line_of(code, text):
    """The line of the cycle in a program that tries it."""
    return next(k for k, line in enumerate(text.split("\n"), 1) if line.startswith(code))


def test_every_event_and_every_step_of_a_cycle_is_labelled():
    """The row after each positioning says what is happening, in the name of its cycle."""
    for code in CYCLES:
        values = beginning(code, "clearance")
        path, line = path_of(code, values), line_of(code, trial.program(mnclab.controls[control_of(code)], CYCLES[code], values))
        rows = path[path.line >= line]
        first = int(rows[0].line != line)  # the block with M99 positions first; the end of a program stops the spindle
        rows = rows[rows.line == rows.line[0]][first:]
        assert all(rows.labels[k].startswith(f"{code} ") and len(rows.labels[k]) > len(code) + 1 for k in rows.label)
