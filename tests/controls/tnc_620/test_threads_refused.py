"""What chapter 5 refuses: the alarm, its line and its column, for each error of each cycle; the definition is in line 4."""

from __future__ import annotations

import pytest
from tools.together import together

import mnclab as mnc

TAPPING, MILLING = (206, 207, 209), (262, 263, 264, 265, 267)
INNER, ONE_WAY = (262, 263, 264, 265), (262, 263, 264, 267)
PITCHED = (207, 209, *MILLING)
HEAD = ""  # the fault stands at the cycle's own word
CALL = "CYCL CALL"  # the fault is one of the machine and stands at the call

POSITIVE = "must be negative, got 5: a positive depth works upwards"
BEYOND = "must be at least -99.9999 and at most 99.9999, got"
LENGTH = "must be at least 0 and at most 99999.9999, got -1"

#: cycles, what is changed, the parameter at fault ("Q239 (thread pitch)"; HEAD), what is said.
REFUSED = [
    # the sign of the depths
    ((*TAPPING, 262, 265, 267), {"Q201": 5}, "Q201 (thread depth)", POSITIVE),
    ((263, 264), {"Q201": 5, "Q356": 6}, "Q201 (thread depth)", POSITIVE),
    ((263,), {"Q201": 0, "Q356": 5}, "Q356 (countersinking depth)", POSITIVE),
    ((264,), {"Q201": 0, "Q356": 5}, "Q356 (total hole depth)", POSITIVE),
    ((263, 264), {"Q201": 0, "Q356": 0, "Q358": 5, "Q359": 1}, "Q358 (depth at front)", POSITIVE),
    ((265, 267), {"Q201": 0, "Q358": 5, "Q359": 1}, "Q358 (depth at front)", POSITIVE),
    ((263,), {"Q356": 5}, "Q356 (countersinking depth)", "must have the sign of the other depths, got 5"),
    ((264,), {"Q356": 5}, "Q356 (total hole depth)", "must have the sign of the other depths, got 5"),
    ((263, 264, 265, 267), {"Q358": 5, "Q359": 9}, "Q358 (depth at front)",
     "must have the sign of the other depths, got 5"),
    ((263, 264), {"Q201": 0, "Q356": 0}, "Q201 (thread depth)", "leaves nothing to do: Q201 and Q356 and Q358 are 0"),
    ((265, 267), {"Q201": 0}, "Q201 (thread depth)", "leaves nothing to do: Q201 and Q358 are 0"),
    # the spindle
    ((206,), {"start": "M5"}, CALL, "needs a turning spindle: write S in TOOL CALL, and M3 or M4 before"),
    ((206,), {"speed": 0}, CALL, "needs a turning spindle: write S in TOOL CALL, and M3 or M4 before"),
    ((207, 209), {"speed": 0}, CALL, "needs a spindle speed: write S in TOOL CALL"),
    (ONE_WAY, {"start": "M4"}, CALL, "needs a tool that turns right: write M3 before"),
    (ONE_WAY, {"start": "M5"}, CALL, "needs a tool that turns right: write M3 before"),
    ((265,), {"start": "M5"}, CALL, "needs a turning spindle: write M3 or M4 before"),
    # the pitch
    (PITCHED, {"Q239": 0}, "Q239 (thread pitch)", "must not be 0"),
    (PITCHED, {"Q239": -100}, "Q239 (thread pitch)", f"{BEYOND} -100"),
    (PITCHED, {"Q239": 100}, "Q239 (thread pitch)", f"{BEYOND} 100"),
    ((206,), {"pitch": 0.5}, "Q206 (feed rate for tapping)",
     "means a pitch of 0.3 mm, the tap of tool 3 has 0.5 mm (PITCH)"),
    ((206,), {"pitch": 0.3011}, "Q206 (feed rate for tapping)",
     "means a pitch of 0.3 mm, the tap of tool 3 has 0.3011 mm (PITCH)"),
    ((207, 209), {"pitch": 1.5, "Q239": -1}, "Q239 (thread pitch)",
     "means a pitch of 1 mm, the tap of tool 3 has 1.5 mm (PITCH)"),
    ((262, 267), {"Q239": 0.001, "Q355": 1}, "Q239 (thread pitch)", "0.001 divides 20 into more than 10000 turns"),
    ((265,), {"Q239": 0.001}, "Q239 (thread pitch)", "0.001 divides 16 into more than 10000 turns"),
    # room for the tool
    (INNER, {"radius": 5}, "Q335 (nominal diameter)", "must be greater than the tool, 10, got 10"),
    (INNER, {"radius": 6}, "Q335 (nominal diameter)", "must be greater than the tool, 12, got 10"),
    (MILLING, {"radius": 0}, CALL, "needs a tool with a radius, got 0"),
    (MILLING, {"Q335": 0}, "Q335 (nominal diameter)", "must be greater than 0, got 0"),
    ((267,), {"Q358": -1}, "Q359 (offset at front from the stud centre)",
     "must be greater than 0 with Q358: the tool would go into the stud"),
    # infeeds
    ((264,), {"Q202": 0}, "Q202 (infeed depth)", "must be greater than 0 to drill with, got 0"),
    ((264,), {"Q202": 0.001}, "Q202 (infeed depth)", "0.001 divides 20 into more than 10000 infeeds"),
    ((264,), {"Q257": 0.001}, "Q257 (infeed depth for chip breaking)", "0.001 divides 20 into more than 10000 infeeds"),
    ((209,), {"Q257": 0.001}, "Q257 (infeed depth for chip breaking)", "0.001 divides 20 into more than 10000 infeeds"),
    # feeds
    ((206,), {"Q206": 0}, "Q206 (feed rate for tapping)", "must be greater than 0, got 0"),
    (MILLING, {"Q253": 0}, "Q253 (feed rate for pre-positioning)", "must be greater than 0, got 0"),
    (MILLING, {"Q207": 0}, "Q207 (feed rate for milling)", "must be greater than 0, got 0"),
    ((263, 265, 267), {"Q254": 0, "Q358": -1, "Q359": 9}, "Q254 (feed rate for countersinking)",
     "must be greater than 0, got 0"),
    ((264,), {"Q206": 0}, "Q206 (feed rate for plunging)", "must be greater than 0, got 0"),
    ((206,), {"Q206": "FMAX"}, "Q206 (feed rate for tapping)", "must be a number, FAUTO, got FMAX"),
    (MILLING, {"Q207": "FMAX"}, "Q207 (feed rate for milling)", "must be a number, FAUTO, got FMAX"),
    ((263, 265, 267), {"Q254": "FMAX"}, "Q254 (feed rate for countersinking)", "must be a number, FAUTO, FU, got FMAX"),
    (ONE_WAY, {"Q512": -1}, "Q512 (feed rate for approaching)", "must be at least 0 and at most 99999.999, got -1"),
    # choices and limits
    (ONE_WAY, {"Q351": 2}, "Q351 (climb or conventional milling)", "must be one of 1, -1, 0, got 2"),
    ((265,), {"Q360": 2}, "Q360 (when the countersink is made)", "must be one of 0, 1, got 2"),
    ((262, 267), {"Q355": 1.5}, "Q355 (threads per step)",
     "must be a whole number and at least 0 and at most 99999, got 1.5"),
    ((209,), {"Q403": 0}, "Q403 (factor of the speed for retracting)",
     "must be at least 0.0001 and at most 10, got 0"),
    ((209,), {"Q336": 361}, "Q336 (angle of the spindle before tapping)",
     "must be at least -360 and at most 360, got 361"),
    ((*TAPPING, *MILLING), {"Q200": -1}, "Q200 (set-up clearance)", LENGTH),
    ((*TAPPING, *MILLING), {"Q204": -1}, "Q204 (second set-up clearance)", LENGTH),
    ((263,), {"Q357": -1}, "Q357 (set-up clearance at the side)", LENGTH),
    # what is left out, and what does not belong to it
    ((*TAPPING, *MILLING), {"Q203": None}, HEAD, "Q203 (coordinate of the workpiece surface) is missing"),
    (PITCHED, {"Q239": None}, HEAD, "Q239 (thread pitch) is missing"),
]  # fmt: skip

CASES = [(number, *case[1:]) for case in REFUSED for number in case[0]]


@together("number changed parameter sentence", CASES, lambda number, *_: f"CYCL DEF {number}")
def test_refused(called, number, changed, parameter, sentence) -> None:
    run = called(number, **changed)
    (alarm,) = (a for a in run.alarms if a.severity == "alarm")
    code = f"CYCL DEF {number} "
    assert alarm.message == code + (f"{parameter} " if parameter not in (HEAD, CALL) else "") + sentence
    lines = run.programs[0].text.splitlines()
    address = {HEAD: "3 CYCL", CALL: "4 CYCL"}.get(parameter) or parameter.split()[0]
    line = next(k for k, text in enumerate(lines, 1) if text.startswith(address))
    assert (alarm.span.line, alarm.span.column) == (line, 1) and (line == 4) == (parameter == HEAD)


@pytest.mark.parametrize("number", [*TAPPING, *MILLING])
def test_a_refused_cycle_does_not_move(called, number) -> None:
    """Whatever is at fault is found before the first move."""
    run = called(number, Q201=5, **{"Q356": 6} if number in (263, 264) else {})
    assert run.toolpath.end[-1].tolist() == [0, 0, 100]


@pytest.mark.parametrize("number", [*TAPPING, *MILLING])
def test_an_address_of_another_cycle(called, number) -> None:
    run = called(number, Q343=1)
    (alarm,) = (a for a in run.alarms if a.severity == "alarm")
    assert alarm.message == f"Q343=1 has no meaning in this block (CYCL DEF {number} does not take Q343)"
    lines = run.programs[0].text.splitlines()
    assert (alarm.span.line, alarm.span.column) == (lines.index("Q343=1") + 1, 1)


@pytest.mark.parametrize("number", [264, 265])
def test_what_is_not_done_needs_nothing(called, number) -> None:
    """Feeds and infeeds of steps that are left out are not asked for."""
    changed = {"Q356": 0, "Q202": 0, "Q206": 0} if number == 264 else {"Q254": 0}
    assert called(number, **changed).ok


def test_a_tool_that_does_not_fit_may_still_countersink(called) -> None:
    assert called(263, radius=6, Q201=0).ok and called(265, radius=6, Q201=0, Q358=-1).ok


def test_a_parameter_that_a_program_changes_is_checked_at_the_call(printed) -> None:
    values = "\n".join(f"{address}={value}" for address, value in printed[262].items())
    text = f"1 TOOL CALL 3 Z S500\n2 CYCL DEF 262 X\n{values}\n3 Q239 = 0\n4 CYCL CALL M3\n"
    alarms = [a for a in mnc.run(text, "tnc-620").alarms if a.severity == "alarm"]
    assert [(a.message, a.span[:2]) for a in alarms] == [("CYCL DEF 262 Q239 (thread pitch) must not be 0", (4, 1))]


@pytest.mark.parametrize("number", [207, 209])
def test_rigid_tapping_needs_a_controlled_spindle(called, number) -> None:
    run = called(number)
    run = run.again(run.setup.with_settings(controlled_spindle=False))
    (alarm,) = run.alarms
    line = run.programs[0].text.splitlines().index("4 CYCL CALL") + 1
    assert alarm.span[:2] == (line, 1) and alarm.message.startswith(f"CYCL DEF {number} needs a controlled spindle")
