"""What the drilling cycles refuse: the alarm, its line and its column.

Every program is BEGIN PGM, a TOOL CALL and a definition: its Q lines begin in line 4, and the call comes last.
"""

import pytest

import mnclab as mnc

MILL, DRILL = 1, 2  # radius 5, plunge angle 3, no point angle; radius 4, point angle 118

VALUES = {
    240: {200: 2, 343: 0, 201: -3, 344: -9, 206: 150, 211: 0, 203: 0, 204: 20},
    200: {200: 2, 201: -20, 206: 150, 202: 5, 210: 0, 203: 0, 204: 20, 211: 0, 395: 0},
    201: {200: 2, 201: -15, 206: 100, 211: 0.5, 208: 250, 203: 0, 204: 20},
    202: {200: 2, 201: -15, 206: 100, 211: 0.5, 208: 250, 203: 0, 204: 20, 214: 1, 336: 0},
    203: {200: 2, 201: -20, 206: 150, 202: 5, 210: 0, 203: 0, 204: 20, 212: 0.2, 213: 3, 205: 3, 211: 0, 208: 500, 256: 0.2,
          395: 0},
    204: {200: 2, 249: 5, 250: 20, 251: 3.5, 252: 15, 253: 750, 254: 200, 255: 0, 203: 20, 204: 50, 214: 1, 336: 0},
    205: {200: 2, 201: -80, 206: 150, 202: 15, 203: 0, 204: 50, 212: 0.5, 205: 3, 258: 0.5, 259: 1, 257: 5, 256: 0.2,
          211: 0.25, 379: 7.5, 253: 750, 208: 9999, 395: 0},
    208: {200: 2, 201: -20, 206: 150, 334: 0.3, 203: 0, 204: 50, 335: 12, 342: 0, 351: 1},
    241: {200: 2, 201: -80, 206: 150, 211: 0.25, 203: 0, 204: 50, 379: 7.5, 253: 750, 208: 1000, 426: 3, 427: 25, 428: 500,
          429: 8, 430: 9, 435: 20, 401: 100, 202: 9999, 212: 0, 205: 0},
}  # fmt: skip

WIDE, LONG = "at least -99999.9999 and at most 99999.9999", "at least 0 and at most 99999.9999"
UP = "a positive depth works upwards"
POINT = "needs the point angle of tool 1 (T-ANGLE of the tool table)"

#: Cycle, Q parameters that differ, the one that is marked, and what is said of it.
AT_THE_CALL = [
    (240, {201: 3}, 201, f"(depth) must be negative, got 3: {UP}"),
    (240, {343: 1, 344: 9}, 344, f"(diameter of the centring) must be negative, got 9: {UP}"),
    (240, {343: 1}, 343, f"(what the centring goes to) {POINT}"),
    *((code, {201: 15}, 201, f"(depth) must be negative, got 15: {UP}") for code in (200, 201, 202, 203, 205, 208, 241)),
    *((code, {395: 1}, 395, f"(depth reference) {POINT}") for code in (200, 203, 205)),
    *((code, {206: 0}, 206, "(feed rate for plunging) must be greater than 0 to drill with, got 0") for code in VALUES
      if 206 in VALUES[code]),
    *((code, {202: 0.001} | more, 202, "(infeed depth) 0.001 divides 20 into more than 10000 infeeds")
      for code, more in ((200, {}), (203, {212: 0}))),
    (203, {212: 1, 205: 0}, 202, "(infeed depth) 5 less 1 each time divides 20 into more than 10000 infeeds"),
    (204, {249: -5}, 249, "(depth of the counterbore) must not be negative, got -5"),
    (204, {249: 20}, 249, "(depth of the counterbore) must be less than Q250 = 20, got 20"),
    (204, {253: 0}, 253, "(feed rate for pre-positioning) must be greater than 0 to position with, got 0"),
    (204, {254: 0}, 254, "(feed rate for counterboring) must be greater than 0 to bore with, got 0"),
    (205, {379: 80}, 379, "(depth of the starting point) must be less than the depth 80, got 80"),
    (205, {253: 0}, 253, "(feed rate for pre-positioning) must be greater than 0 to reach the starting point, got 0"),
    (205, {253: 0, 379: 0}, 253,
     "(feed rate for pre-positioning) must be greater than 0 to return after a chip break, got 0"),
    (205, {257: 0.001}, 257, "(infeed between chip breaks) 0.001 divides 72.5 into more than 10000 infeeds"),
    (208, {335: 9}, 335, "(diameter of the bore) must be at least the tool diameter 10, got 9"),
    (208, {335: 21}, 335, "(diameter of the bore) must be at most twice the tool diameter 10 while Q342 is 0, got 21"),
    (208, {334: 0}, 334, "(infeed per turn of the helix) must be greater than 0 to mill with, got 0"),
    (208, {334: 0.001}, 334, "(infeed per turn of the helix) 0.001 a turn makes more than 10000 turns of 22"),
    (241, {379: 80}, 379, "(depth of the starting point) must be less than the depth 80, got 80"),
    (241, {435: 80}, 435, "(depth of a dwell on the way) must be less than the depth 80, got 80"),
    (241, {435: 6}, 435, "(depth of a dwell on the way) must be more than 6, where the drilling begins, got 6"),
    (241, {401: 0}, 401, "(feed rate factor after the dwell) must be greater than 0 to drill on with, got 0"),
    (241, {428: 0}, 428, "(speed when drilling) must be greater than 0 to drill with, got 0"),
    (241, {253: 0}, 253, "(feed rate for pre-positioning) must be greater than 0 to reach the starting point, got 0"),
]  # fmt: skip

#: The same for what is wrong by itself.
AT_THE_DEFINITION = [
    *((code, {200: -1}, 200, f"(set-up clearance) must be {LONG}, got -1") for code in VALUES),
    *((code, {204: -1}, 204, f"(second set-up clearance) must be {LONG}, got -1") for code in VALUES),
    *(
        (code, {203: 100000}, 203, f"(coordinate of the workpiece surface) must be {WIDE}, got 100000")
        for code in VALUES
    ),
    (240, {343: 2}, 343, "(what the centring goes to) must be one of 0, 1, got 2"),
    (200, {395: 2}, 395, "(depth reference) must be one of 0, 1, got 2"),
    (202, {214: 5}, 214, "(direction in which the tool leaves the wall) must be one of 0, 1, 2, 3, 4, got 5"),
    (202, {336: 361}, 336, "(angle of the spindle stop) must be at least -360 and at most 360, got 361"),
    (
        203,
        {213: 1.5},
        213,
        "(chip breaks before each retraction) must be a whole number and at least 0 and at most 99999, got 1.5",
    ),
    (204, {214: 0}, 214, "(direction in which the tool leaves the wall) must be one of 1, 2, 3, 4, got 0"),
    (204, {250: 0}, 250, "(thickness of the workpiece) must be at least 0.0001 and at most 99999.9999, got 0"),
    (208, {351: 2}, 351, "(climb or conventional milling) must be one of 1, -1, 0, got 2"),
    (241, {426: 6}, 426, "(spindle when entering and leaving) must be one of 3, 4, 5, got 6"),
    (241, {401: 101}, 401, "(feed rate factor after the dwell) must be at least 0 and at most 100, got 101"),
]


def program(code, changed, tool=MILL, called=True):
    """The text, and the line of each Q parameter."""
    values = VALUES[code] | changed
    lines = [
        "0 BEGIN PGM A MM",
        f"1 TOOL CALL {tool} Z S1000",
        f"2 CYCL DEF {code} X",
        *(f"Q{q}={v:g}" for q, v in values.items()),
    ]
    call = ["3 L X+30 Y+20 R0 FMAX M3 M99"] if called else []
    return "\n".join([*lines, *call, "4 END PGM A MM", ""]), {q: k for k, q in enumerate(values, 4)}


@pytest.mark.parametrize(("code", "changed", "q", "sentence"), AT_THE_CALL)
def test_refused_at_the_call(code, changed, q, sentence):
    text, lines = program(code, changed)
    (alarm,) = mnc.run(text, "tnc-620").alarms
    assert (alarm.message, *alarm.span[:2]) == (f"CYCL DEF {code} Q{q} {sentence}", lines[q], 1)
    assert mnc.run(program(code, changed, called=False)[0], "tnc-620").ok  # until the call it may be corrected


@pytest.mark.parametrize(("code", "changed", "q", "sentence"), AT_THE_DEFINITION)
def test_refused_at_the_definition(code, changed, q, sentence):
    text, lines = program(code, changed, called=False)
    (alarm,) = mnc.run(text, "tnc-620").alarms
    assert (alarm.message, *alarm.span[:2]) == (f"CYCL DEF {code} Q{q} {sentence}", lines[q], 1)


@pytest.mark.parametrize("q", [429, 430])
@pytest.mark.parametrize("number", [3, 25, 99])
def test_241_switches_nothing_but_the_coolant(q, number):
    text, lines = program(241, {q: number})
    (alarm,) = mnc.run(text, "tnc-620").alarms
    assert (alarm.message[:17], *alarm.span[:2]) == (f"CYCL DEF 241 Q{q}", lines[q], 1)
    assert "must switch the coolant (" in alarm.message and alarm.message.endswith(f"or be 0, got {number}")


@pytest.mark.parametrize("code", [202, 204])
def test_an_oriented_stop_needs_a_controlled_spindle(code):
    setup = mnc.Setup(settings={"controlled_spindle": False})
    text, lines = program(code, {})
    (alarm,) = mnc.run(text, "tnc-620", setup).alarms
    assert alarm.span[:2] == (max(lines.values()) + 1, 1) and alarm.message.startswith(
        f"CYCL DEF {code} needs a controlled spindle"
    )


@pytest.mark.parametrize("code", VALUES)
def test_what_stands_in_the_table_runs(code):
    tool = DRILL if code == 240 else MILL
    found = mnc.run(program(code, {}, tool)[0], "tnc-620")
    assert found.alarms == () and len(found.toolpath) > 3


@pytest.mark.parametrize("code", [c for c in VALUES if 201 in VALUES[c]])
def test_depth_0_is_not_executed(code):
    changed = {201: 0} | ({379: 0} if 379 in VALUES[code] else {})
    path = mnc.run(program(code, changed)[0], "tnc-620").toolpath
    assert not any(label.startswith("CYCL") for label in (path.labels[k] for k in path.label))


def test_depth_0_of_the_others():
    for code, changed, tool in ((204, {249: 0}, MILL), (240, {343: 1, 344: 0}, DRILL)):
        path = mnc.run(program(code, changed, tool)[0], "tnc-620").toolpath
        assert not any(label.startswith("CYCL") for label in (path.labels[k] for k in path.label))


@pytest.mark.parametrize("code", VALUES)
def test_every_parameter_is_asked_for(code):
    """Left out, it is missing, except what the dialog fills in by itself and what came later than the cycle."""
    optional = {200: {395, 211}, 203: {395}, 205: {395, 208}, 241: {435, 401, 202, 212, 205}}.get(code, set())
    for q in VALUES[code]:
        text, _ = program(code, {})
        text = "\n".join(line for line in text.splitlines() if not line.startswith(f"Q{q}="))
        alarms = mnc.run(text, "tnc-620").alarms
        if q in optional:
            assert alarms == ()
        else:
            assert alarms[0].span[:2] == (3, 1) and f"Q{q} (" in alarms[0].message
            assert alarms[0].message.endswith("is missing")


def test_208_says_once_that_it_goes_down_less_steeply():
    """Plunge angle 3, path radius 1: 2 pi tan 3 = 0.3293 a turn."""
    text, lines = program(208, {334: 1})
    text = text.replace("4 END", "4 L X+60 FMAX M99\n5 END")
    found = mnc.run(text, "tnc-620")
    (warning,) = found.alarms
    assert found.ok and warning.span[:2] == (lines[334], 1)
    assert warning.message == "CYCL DEF 208 Q334 1 is reduced: the plunge angle 3 of tool 1 allows 0.3293"
