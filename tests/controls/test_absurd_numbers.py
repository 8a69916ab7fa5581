"""Numbers that are absurd but legal, in every parameter of every cycle: the run is bounded, or refused by name."""

import pytest
from tools.together import deep_but_one_in

import mnclab as mnc
from mnclab import Setup, Tool
from mnclab.machine import trial

EXTREMES = (0.001, -0.001, 99999.0, -99999.0, 99999.9999)
SHARE, MOST = 5, 1_000_000  # one case in so many; rows that a single cycle may make


def cases():
    """Control, cycle, parameter and number, as far as the parameter allows the number; each at its limits, too."""
    for control in mnc.controls.values():
        for cycle in dict.fromkeys(control.cycles.values()):
            for p in cycle.parameters():
                if trial.is_text(p) or p.choices:
                    continue
                limits = [value for value in (p.at_least, p.at_most) if value is not None]
                for value in dict.fromkeys((*EXTREMES, *limits)):
                    if not p.refuses(value):
                        yield control.name, cycle, p.name, value


def tried(control, cycle, name, value):
    """The trial program of a cycle with one number changed."""
    numbers = {p.name: trial.first_value(p) for p in cycle.parameters() if p.required or trial.written_first(p)}
    text = trial.program(mnc.controls[control], cycle, numbers | {name: value})
    return None if text is None else mnc.run(text, control)


@pytest.mark.parametrize("which", deep_but_one_in(4, range(8)))
def test_absurd_numbers_are_bounded_or_refused(which):
    for case in list(cases())[which :: 8 * SHARE]:
        run = tried(*case)
        assert run is None or len(run.toolpath) <= MOST, case


@pytest.mark.parametrize(
    "code", ["CYCL DEF 251", "CYCL DEF 252", "CYCL DEF 253", "CYCL DEF 256", "CYCL DEF 257", "CYCL DEF 233"]
)
def test_a_tool_that_is_hardly_there(code):
    cycle = mnc.controls["tnc-620"].cycles[code]
    text = trial.program(mnc.controls["tnc-620"], cycle, {p.name: trial.first_value(p) for p in cycle.parameters()})
    tiny = Tool(radius=0.001, plunge_angle=3)
    run = mnc.run(text, "tnc-620", Setup(tools={1: tiny, 2: tiny}))
    assert not run.ok and ("more than" in run.alarms[-1].message or len(run.toolpath) <= MOST)
