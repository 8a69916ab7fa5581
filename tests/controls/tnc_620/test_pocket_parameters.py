"""Every parameter of cycles 251 to 254, changed alone, changes what it means: the path, or nothing but feeds."""

import numpy as np
import pytest
from tools.running import run
from tools.together import together

import mnclab
from mnclab import Kind
from mnclab.machine import trial

pytestmark = pytest.mark.deep

CYCLES = {code: mnclab.controls["tnc-620"].cycles[code] for code in (f"CYCL DEF {n}" for n in (251, 252, 253, 254))}
CASES = [(code, parameter) for code, cycle in CYCLES.items() for parameter in cycle.parameters()]
#: In 252 the tool decides alone whether it goes down on a helix or not; the other value is refused (test_pockets_refused).
ACTING = [case for case in CASES if (case[0], case[1].name) != ("CYCL DEF 252", "plunging_strategy")]
#: A second value, where half of the example or the next choice is refused or means the same.
OTHER = {
    "corner_radius": 12, "circle_diameter": 44, "slot_width": 14, "repetitions": 1, "milling_type": -1,
    "side_allowance": 0.5, "floor_allowance": 0.5,
}  # fmt: skip
FEEDS = {"milling_feed", "plunging_feed", "finishing_feed", "feed_reference"}


def shape_and_feeds(code, values):
    path = run(trial.program(mnclab.controls["tnc-620"], CYCLES[code], values), "tnc-620").toolpath
    cut = path.is_motion & (path.kind != Kind.RAPID)
    shape = path.end[path.is_motion].round(9).tolist(), path.sweep[path.is_motion].round(9).tolist()
    return shape, path.feed[cut].round(9).tolist()


def examples(code):
    return {parameter.name: parameter.example for parameter in CYCLES[code].parameters()}


def another(code, parameter):
    if parameter.name in OTHER:
        return OTHER[parameter.name]
    if parameter.name == "plunging_strategy":
        return 2 if code == "CYCL DEF 251" else 0
    if parameter.choices:
        return next(choice for choice in parameter.choices if choice != parameter.example)
    return parameter.example / 2 if parameter.example else 3.5


@pytest.mark.parametrize(("code", "parameter"), ACTING, ids=lambda case: getattr(case, "name", case))
def test_a_parameter_acts(code, parameter):
    values, name = examples(code), parameter.name
    shape, feeds = shape_and_feeds(code, values)
    other, other_feeds = shape_and_feeds(code, values | {name: another(code, parameter)})
    if name in FEEDS:
        assert other == shape and other_feeds != feeds
    else:
        assert other != shape


@together("code parameter", CASES, lambda code, parameter: code, lambda code, parameter: parameter.name)
def test_every_parameter_has_an_example(code, parameter):
    assert parameter.example is not None and not parameter.refuses(parameter.example)


@pytest.mark.parametrize("code", CYCLES)
def test_every_row_of_a_cycle_says_what_happens(code):
    found = mnclab.run(trial.program(mnclab.controls["tnc-620"], CYCLES[code], examples(code)), "tnc-620")
    path = found.toolpath
    call = path[(path.line == path.line[path.is_motion].max()) & path.is_motion]
    said = [call.labels[k] for k in call.label][1:]  # the block positions first
    assert said and all(name.startswith(code + " ") and len(name) > len(code) + 3 for name in said)
    for part in ("layer 1 of 4, ", "side finishing 2 of 4", "floor finishing, "):
        assert any(part in name for name in said)
    assert np.isfinite(call.end).all()
