"""What the misalignment cycles refuse, each at its place: rules of parameters, the machine, and what the probe meets."""

import pytest
from controls.tnc_620.alignment import PRESET, bored, cycle, plate, run, studs
from tools.together import together

from mnclab import Datum, Setup, Tool

POINTS = {"Q263": 10, "Q264": 0, "Q265": 90, "Q266": 0, "Q272": 2, "Q267": 1, "Q261": -5, "Q320": 0, "Q260": 20, "Q301": 0}
PLACES = {"Q1100": 10, "Q1101": 0, "Q1102": -5, "Q1103": 90, "Q1104": 0, "Q1105": -5}
THIRD = {"Q1100": 10, "Q1101": 10, "Q1102": 0, "Q1103": 80, "Q1104": 10, "Q1105": 0, "Q1106": 10, "Q1107": 50, "Q1108": 0}
REST = {"Q320": 0, "Q260": 20, "Q1125": 1, "Q309": 0, "Q1126": 0, "Q1120": 0, "Q1121": 0}
TWO = {"Q268": 10, "Q269": -5, "Q270": 90, "Q271": -3, "Q261": -5, "Q260": 20, "Q307": 0, "Q305": 0, "Q402": 0, "Q337": 0}
VALUES = {
    400: POINTS | {"Q307": 0, "Q305": 3},
    401: TWO,
    402: TWO | {"Q313": 31, "Q314": 31, "Q315": -6, "Q320": 0, "Q301": 0},
    403: POINTS | {"Q312": 6, "Q337": 1, "Q305": 3, "Q303": 1, "Q380": 0},
    404: {"Q307": 1, "Q305": 0},
    405: {
        "Q321": 50, "Q322": 50, "Q262": 10, "Q325": 0, "Q247": 90, "Q261": -5, "Q320": 0, "Q260": 20, "Q301": 0, "Q337": 0,
    },
    1410: PLACES | {"Q372": 2} | REST,
    1411: PLACES | {"Q1116": 20, "Q1117": 20, "Q1115": 0, "Q423": 4, "Q325": 0, "Q1119": 360} | REST,
    1420: THIRD | {"Q372": -3} | REST,
}  # fmt: skip
SIGNED, LENGTH = "must be at least -99999.9999 and at most 99999.9999", "must be at least 0 and at most 99999.9999"
ROW, TURN = "must be a whole number and at least 0 and at most 99999", "must be at least -360 and at most 360"
ASKED = "asks for a position (?): the setting manual_points says it, {1: (x, y, z)}"

RULES = [
    *((number, {"Q260": -100000}, "Q260", SIGNED) for number in VALUES if number != 404),
    *((number, {"Q261": 100000}, "Q261", SIGNED) for number in (400, 401, 402, 403, 405)),
    *((number, {"Q320": -0.1}, "Q320", LENGTH) for number in (400, 402, 403, 405, 1410, 1411, 1420)),
    *((number, {"Q301": 2}, "Q301", "must be one of 0, 1") for number in (400, 402, 403, 405)),
    *((number, {"Q305": 1.5}, "Q305", ROW) for number in (400, 401, 402, 403)),
    *((number, {"Q307": 361}, "Q307", TURN) for number in (400, 401, 402, 404)),
    *((number, {"Q402": 2}, "Q402", "must be one of 0, 1") for number in (401, 402)),
    *((number, {"Q337": 2}, "Q337", "must be one of 0, 1") for number in (401, 402, 403)),
    *((number, {"Q267": 0}, "Q267", "must be one of -1, 1, got 0") for number in (400, 403)),
    (400, {"Q272": 3}, "Q272", "must be one of 1, 2, got 3"),
    (400, {"Q265": 10}, "Q265", "is that of the first touch point: two places make a line"),
    (400, {"Q272": 1}, "Q266", "is that of the first touch point: two places make a line"),
    *((number, {"Q270": 10, "Q271": -5}, "Q270", "and Q271 are those of the first center") for number in (401, 402)),
    (402, {"Q313": -1}, "Q313", LENGTH),
    (402, {"Q314": -1}, "Q314", LENGTH),
    (402, {"Q315": 1e5}, "Q315", SIGNED),
    (403, {"Q272": 4}, "Q272", "must be one of 1, 2, 3, got 4"),
    (403, {"Q312": 1}, "Q312", "must be one of 0, 4, 5, 6, got 1"),
    (403, {"Q312": 4}, "Q312", "A is not shown by touches along the minor axis"),
    (403, {"Q272": 3}, "Q312", "C is not shown by touches along the touch probe axis"),
    (403, {"Q272": 3, "Q312": 0, "Q266": 5}, "Q312", "0: the touch points lie apart in both axes"),
    (403, {"Q272": 3, "Q312": 4}, "Q266", "is that of the first touch point"),
    (403, {"Q272": 3, "Q312": 5}, "Q312", "needs the rotary axis B: the machine has A and C"),
    (403, {"Q303": -1}, "Q303", "must be one of 0, 1, got -1"),
    (403, {"Q380": -400}, "Q380", TURN),
    (403, {"Q265": 10}, "Q265", "is that of the first touch point"),
    (404, {"Q305": -2}, "Q305", "must be a whole number and at least -1 and at most 99999, got -2"),
    (405, {"Q262": -1}, "Q262", LENGTH),
    (405, {"Q325": 400}, "Q325", TURN),
    (405, {"Q247": 4.9}, "Q247", "must be at least 5 or at most -5, got 4.9"),
    (405, {"Q247": -121}, "Q247", "must be at least -120 and at most 120"),
    (405, {"Q337": -1}, "Q337", ROW),
    *((number, {"Q1125": 3}, "Q1125", "must be one of -1, 0, 1, 2") for number in (1410, 1411, 1420)),
    *((number, {"Q309": 3}, "Q309", "must be one of 0, 1, 2") for number in (1410, 1411, 1420)),
    *((number, {"Q1126": 3}, "Q1126", "must be one of 0, 1, 2") for number in (1410, 1411, 1420)),
    *((number, {"Q1120": 4}, "Q1120", "must be one of 0, 1, 2, 3, got 4") for number in (1410, 1411)),
    (1420, {"Q1120": 5}, "Q1120", "must be one of 0, 1, 2, 3, 4, got 5"),
    (1420, {"Q1121": 2}, "Q1121", "must be one of 0, 1, got 2"),
    *((number, {"Q1121": 3}, "Q1121", "must be one of 0, 1, 2, got 3") for number in (1410, 1411)),
    *((number, {"Q372": 0}, "Q372", "must be one of 1, -1, 2, -2, 3, -3, got 0") for number in (1410, 1420)),
    *((number, {"Q1126": 1, "Q1121": 1}, "Q1126", "then Q1121 must be 2") for number in (1410, 1411)),
    *((number, {"Q1126": 1}, "Q1126", "aligns the rotary ax") for number in (1410, 1411, 1420)),
    *((number, {"Q1103": 10}, "Q1103", "give the first place again") for number in (1410, 1411)),
    (1420, {"Q1107": 10, "Q1106": 30}, "Q1106", "makes no plane with the other points: the points lie on one line"),
    (1411, {"Q423": 2}, "Q423", "must be a whole number and at least 3 and at most 8"),
    (1411, {"Q1119": 0}, "Q1119", "must not be 0"),
    (1411, {"Q1119": -360}, "Q1119", "must be at least -359.999 and at most 360"),
    (1411, {"Q1115": 4}, "Q1115", "must be one of 0, 1, 2, 3, got 4"),
    (1411, {"Q1116": 3.9}, "Q1116", "must be at least the diameter of the ball, 4, got 3.9"),
    (1411, {"Q1117": 10000}, "Q1117", "must be at least 0 and at most 9999.9999"),
    (1411, {"QS1117": '"?"'}, "QS1117", "must be a diameter of 0 or more"),
    (1411, {"QS1116": '"20@20.1"'}, "QS1116", "and its center must both have an actual value (@), or none"),
    (1410, {"QS1100": '"10+1+2+3"'}, "QS1100", 'takes 2 tolerances at most, got "10+1+2+3"'),
    (1410, {"QS1101": '"ten"'}, "QS1101", 'is no nominal value such as "?10"'),
    (1410, {"QS1101": '""'}, "QS1101", 'is no nominal value such as "?10"'),
    (1410, {"QS1102": '"@5"'}, "QS1102", 'needs a nominal value, got "@5"'),
    (1410, {"QS1102": '"?5@5"'}, "QS1102", "asks for a position (?) and gives it (@) in one"),
    (1410, {"QS1102": '"-5@Q1901"'}, "QS1102", "takes its actual value from Q1901, which has none"),
    (1410, {"QS1102": '"-100000"'}, "QS1102", SIGNED),
    *((1410, {"QS1102": f'"-5{more}{"9" * 150}"'}, "QS1102", SIGNED) for more in ("+", "-", "@", "")),
    (1410, {"QS1100": '"10@10.1"'}, "Q1101", "needs an actual value (@) as the others of the point"),
    (1420, {"QS1107": '"50@50.1"'}, "Q1106", "needs an actual value (@) as the others of the point"),
    (1410, {"QS1101": '"?"'}, "QS1101", ASKED),
]


def values_of(number, changes):
    """The values with some changed; a text QS stands in the place of its number."""
    texts = {f"Q{name[2:]}": name for name in changes if name.startswith("QS")}
    return {texts.get(name, name): changes.get(texts.get(name, name), value) for name, value in VALUES[number].items()}


def refused(number, message, at, changes=None, part=None, before="L Z+100 R0 FMAX", **more):
    found = run(cycle(number, values_of(number, changes or {})), plate() if part is None else part, before, **more)
    alarm = next(a for a in found.alarms if a.severity == "alarm")
    assert message in alarm.message and f"TCH PROBE {number}" in alarm.message, alarm.message
    line = found.program.text.splitlines()[alarm.span.line - 1]
    assert line.startswith(f"{at}=" if at else f"TCH PROBE {number}") and alarm.span.column == 1, (line, alarm)
    assert not found.tables.datums and set(found.tables.presets) == {1}
    return found


@together(
    "number changes at message", RULES,
    lambda number, *_: f"TCH PROBE {number}", lambda number, changes, at, message: f"{changes} {message}",
)  # fmt: skip
def test_a_rule_of_a_parameter(number, changes, at, message):
    found = refused(number, message, at, changes)
    assert not found.touches and found.tables.presets[1] == (*PRESET, 0, 0, 0, 0, 0, 0)


@together(
    "number name", [(n, name) for n, values in VALUES.items() for name in values], lambda number, name: f"TCH PROBE {number}"
)
def test_a_parameter_that_is_missing(number, name):
    values = {key: value for key, value in VALUES[number].items() if key != name}
    found = run(cycle(number, values), plate())
    assert f"TCH PROBE {number} {name} (" in found.alarms[0].message and "is missing" in found.alarms[0].message


MOVING = [number for number in VALUES if number != 404]


@pytest.mark.parametrize("number", MOVING)
def test_what_is_in_the_spindle_and_what_is_active(number):
    message = "needs a touch probe in the spindle, T1 is a mill"
    found = run(cycle(number, VALUES[number]), plate(), "TOOL CALL 1 Z S1000", tools={1: Tool(radius=5, kind="mill")})
    assert message in found.alarms[0].message and found.alarms[0].span.column == 1
    shift = "L Z+100 R0 FMAX\nCYCL DEF 7.0 X\nCYCL DEF 7.1 X+1"
    refused(number, "cannot run while a shift is active", "", before=shift)
    refused(number, "cannot run while a rotation is active", "", before="CYCL DEF 10.0 X\nCYCL DEF 10.1 ROT+5")
    tilted = run(cycle(number, VALUES[number]), plate(), "L Z+100 R0 FMAX\nPLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY")
    assert any("cannot run while a tilt is active" in a.message for a in tilted.alarms) == (number < 1000)


@pytest.mark.parametrize("number", [400, 401, 402])
def test_a_preset_that_is_tilted(number):
    message = "cannot set a basic rotation where the active preset is tilted (SPA, SPB)"
    refused(number, message, "", presets={1: Datum(*PRESET, tilt_x=1)})


def test_404_under_a_transformation():
    refused(404, "cannot run while a mirror is active", "", before="CYCL DEF 8.0 X\nCYCL DEF 8.1 X")


@pytest.mark.parametrize(("number", "changes", "at"), [
    (401, {"Q402": 1}, "Q402"), (402, {"Q402": 1}, "Q402"), (403, {}, "Q312"), (405, {}, ""),
    (1410, {"Q1121": 2}, "Q1121"), (1411, {"Q1121": 2}, "Q1121"),
])  # fmt: skip
def test_where_a_rotary_axis_cannot_turn(number, changes, at):
    refused(number, "needs the rotary axis C: the machine has A and B", at, changes, settings={"rotary_axes": "AB"})
    refused(number, "not built yet under M126 (shortest way of rotary axes)", at, changes, before="L Z+100 R0 FMAX M126")
    shifted = "L Z+100 R0 FMAX\nCYCL DEF 7.0 X\nCYCL DEF 7.1 C+5"
    refused(number, "which must not be shifted or mirrored", at, changes, before=shifted)


FAR = plate(x=500)
ROUND = bored((10.2, -4.8, 20), (90, -3, 20), (50.1, 50.1, 10))


@pytest.mark.parametrize(("number", "part", "message", "changes"), [
    *((n, FAR, "touch point inaccessible: the probe did not trigger within 10 mm", {}) for n in MOVING),
    (400, plate(y=-4), "path obstructed: the", {}),
    (401, bored((10, -5, 3), (90, -3, 30)), "path obstructed: the", {}),
    (402, studs((10, -5, 40), (90, -3, 40)), "path obstructed: the", {}),
    (403, plate(y=-4), "path obstructed: the", {}),
    (405, bored((50, 50, 5)), "path obstructed: the", {}),
    (1410, plate(y=-4), "path obstructed: the", {}),
    (1411, bored((10, 0, 10), (90, 0, 20)), "path obstructed: the", {}),
    (1420, plate(deep=40), "path obstructed: the", {"Q1102": -9}),
])  # fmt: skip
def test_what_the_probe_meets(number, part, message, changes):
    found = run(cycle(number, VALUES[number] | changes), part)
    alarm = next(a for a in found.alarms if a.severity == "alarm")
    assert message in alarm.message, alarm
    assert found.program.text.splitlines()[alarm.span.line - 1].startswith(f"TCH PROBE {number}")
    assert not found.tables.datums and found.tables.presets == {1: (*PRESET, 0, 0, 0, 0, 0, 0)}


def test_without_a_part_and_without_a_probe():
    from mnclab import run as plain

    for number in MOVING:
        text = f"TOOL CALL 7 Z\n{cycle(number, VALUES[number])}\n"
        found = plain(text, "tnc-620", Setup(tools={7: Tool(radius=2, kind="probe")}))
        assert "there is no part to touch" in found.alarms[0].message
        found = plain(cycle(number, VALUES[number]) + "\n", "tnc-620")
        assert f"TCH PROBE {number} needs a tool call before it" in found.alarms[0].message and found.alarms[0].span.line == 1


def test_a_basic_rotation_is_reset_even_where_the_touch_fails():
    """400 resets it at its beginning: then the alarm, and the row stays without it."""
    found = run(cycle(400, VALUES[400]), FAR, presets={1: Datum(*PRESET, rotation=7)})
    assert not found.ok and found.tables.presets[1].rotation == 0


def test_no_text_raises_anything_but_an_alarm():
    """Three thousand texts of the characters that these texts are made of: each is read, or refused at its word."""
    import numpy as np

    from mnclab.controls.tnc_620.probing.aimed import read

    random = np.random.default_rng(5)
    for _ in range(3000):
        text = "".join(random.choice(list("?@+-.,0159Qq e"), random.integers(0, 12)))
        try:
            found = read(text, {"Q1900": 3.0}, 25.4)
        except ValueError as fault:
            assert str(fault)
        else:
            assert found.asked if found.value is None else found.lower <= found.mean <= found.upper
