"""The steps of a cycle without a program: a table for each, or a sentence that says what is missing."""

import pytest

import mnclab
from mnclab import Alarm
from mnclab.controls.cycle_steps import steps
from mnclab.machining.steps import Go, Touch, Wait

DRILLING = {"Q200": 2, "Q201": -20, "Q206": 150, "Q202": 15, "Q210": 0, "Q203": 0, "Q204": 50, "Q211": 0.5}


def test_two_pecks_of_a_hole():
    """20 mm deep in pecks of 15: down to -15, out to the clearance of 2, to 2 above -15, to the bottom, a dwell, out."""
    found = steps("CYCL DEF 200", "tnc-620", **DRILLING)
    assert [step.z for step in found if isinstance(step, Go)] == [2, -15, 2, -13, -20, 50]
    assert [step.feed for step in found if isinstance(step, Go) and step.feed < 1e9] == [150, 150]
    assert [step.seconds for step in found if isinstance(step, Wait)][-1] == 0.5
    head, rule, *rows = str(found).splitlines()
    assert head.split() == ["step", "values", "what", "is", "happening"] and len(rows) == len(found)
    assert "z -15, feed 150" in rows[1] and "rapid" in rows[0] and found._repr_html_().count("<tr>") == len(found) + 1


def test_a_touch_is_answered_where_it_leads():
    """Cycle 419 touches once along its axis: 20 mm towards X+50 with the ball of 2 mm."""
    words = {"Q263": 50, "Q264": 0, "Q261": -5, "Q320": 0, "Q260": 20, "Q272": 1, "Q267": 1, "Q305": 1, "Q333": 0, "Q303": 1}
    found = steps("TCH PROBE 419", "tnc-620", tool=mnclab.Tool(radius=2, kind="probe"), **words)
    assert sum(isinstance(step, Touch) for step in found) == 1 and found[-1] is not None


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: steps("CYCL DEF 200", "tnc-620", Q201=-20), "CYCL DEF 200 Q.* is missing"),
        (lambda: steps("CYCL DEF 200", "tnc-620", **DRILLING, Q999=1), "CYCL DEF 200 has no Q999"),
        (lambda: steps("CYCL DEF 200", "tnc-620", **{**DRILLING, "Q201": "deep"}), "must be a number"),
        (lambda: steps("CYCL DEF 200", "tnc-620", **{**DRILLING, "Q201": None}), "Q201 must be a number"),
        (lambda: steps("CYCL DEF 22", "tnc-620", Q10=5, Q11=100, Q12=500, Q19=0), "needs a contour"),
        (lambda: steps("G1", "mnc", X=5), "is no cycle"),
        (lambda: steps("G83", "mnc", tool=5), "the tool must be a Tool"),
        (lambda: steps("G83", "mnc", start=5), "start must be three numbers"),
        (lambda: steps("G999", "mnc"), "has no code"),
    ],
)
def test_what_is_missing_is_said(call, message):
    with pytest.raises(Alarm, match=message) as caught:
        call()
    assert caught.value.span is None and ":0:" not in str(caught.value)


@pytest.mark.parametrize("control", list(mnclab.controls))
def test_every_cycle_has_steps_or_a_sentence(control):
    shown = 0
    for code, cycle in mnclab.controls[control].cycles.items():
        words = {p.address: p.example for p in cycle.parameters() if p.example is not None and not p.mark}
        words |= {p.address: 1.0 for p in cycle.parameters() if p.required and p.address not in words and p.type != "text"}
        try:
            table = steps(code, control, **words)
        except Alarm as alarm:
            assert alarm.message
            continue
        shown += bool(table)
        assert str(table).count("\n") == len(table) + 1 and "object at" not in str(table)
    assert shown > 3
