"""Programs with cycles 251 to 254 that must be refused: the alarm, its line and its column.

Tool 1 has a radius of 5 and plunges at 3 degrees, tool 2 does not say how steeply, tool 3 has no radius.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools.together import together

import mnclab
from mnclab import Setup, Tool

TOOLS = {
    1: Tool(radius=5, plunge_angle=3),
    2: Tool(radius=5),
    3: Tool(plunge_angle=3),
    4: Tool(radius=5, plunge_angle=95),
}
SIZES = {
    251: "Q218=80 Q219=60 Q220=5 Q224=0 Q367=0 Q370=1", 252: "Q223=60 Q370=1", 253: "Q219=12 Q218=80 Q374=0 Q367=0",
    254: "Q219=12 Q375=80 Q367=0 Q216=50 Q217=50 Q376=45 Q248=90 Q378=0 Q377=1",
}  # fmt: skip
COMMON = "Q215=0 Q368=.2 Q207=500 Q351=1 Q201=-20 Q202=5 Q369=.1 Q206=150 Q338=5 Q200=2 Q203=0 Q204=50 Q366=1 Q385=500 Q439=0"
ALL = (251, 252, 253, 254)
NAMES = {
    "Q201": "depth", "Q202": "infeed depth", "Q206": "feed rate for plunging", "Q207": "feed rate for milling",
    "Q215": "machining operation", "Q366": "plunging strategy", "Q385": "finishing feed rate",
    "Q369": "finishing allowance for floor", "Q338": "infeed for finishing", "Q351": "climb or conventional milling",
    "Q439": "feed rate reference", "Q370": "path overlap factor", "Q220": "corner radius", "Q218": "first side length",
    "Q219": "slot width", "Q223": "circle diameter", "Q375": "pitch circle diameter", "Q377": "number of slots",
    "Q248": "opening angle of the slot", "Q367": "pocket position", "Q368": "finishing allowance for side",
    "Q200": "set-up clearance", "Q204": "second set-up clearance",
}  # fmt: skip

#: cycle, tool, what is written instead, the address that is marked, and the sentence behind its name.
REFUSED = [
    *((n, 1, "Q201=20", "Q201", "must be negative, got 20: a positive depth works upwards") for n in ALL),
    *((n, 1, "Q202=0", "Q202", "must be greater than 0, got 0") for n in ALL),
    *((n, 1, "Q202=.001", "Q202", "0.001 divides 19.9 into more than 10000 infeeds") for n in ALL),
    *((n, 1, "Q338=.001", "Q338", "0.001 divides 19.9 into more than 10000 infeeds") for n in ALL),
    *((n, 1, "Q369=20", "Q369", "must be less than the depth 20, got 20") for n in ALL),
    *((n, 1, "Q206=0", "Q206", "must be greater than 0 to mill with, got 0") for n in ALL),
    *((n, 1, "Q207=0", "Q207", "must be greater than 0 to mill with, got 0") for n in ALL),
    *((n, 1, "Q385=0", "Q385", "must be greater than 0 to mill with, got 0") for n in ALL),
    *((n, 1, "Q215=3", "Q215", "must be one of 0, 1, 2, got 3") for n in ALL),
    *((n, 1, "Q351=2", "Q351", "must be one of 1, -1, 0, got 2") for n in ALL),
    *((n, 1, "Q439=4", "Q439", "must be one of 0, 1, 2, 3, got 4") for n in ALL),
    *((n, 1, "Q200=-1", "Q200", "must be at least 0 and at most 99999.9999, got -1") for n in ALL),
    *((n, 1, "Q204=-1", "Q204", "must be at least 0 and at most 99999.9999, got -1") for n in ALL),
    *((n, 1, "Q368=-1", "Q368", "must be at least 0 and at most 99999.9999, got -1") for n in ALL),
    *(
        (n, tool, "Q366=1", "Q366",
         f"1 needs the plunge angle (ANGLE) of tool {tool}, greater than 0 and at most 90, in the tool table")
        for n in ALL for tool in (2, 4)
    ),
    (251, 2, "Q366=2", "Q366", "2 needs the plunge angle (ANGLE) of tool 2, greater than 0 and at most 90, in the tool table"),
    (252, 1, "Q366=0", "Q366", "0 needs the plunge angle (ANGLE) of tool 1 to be 0 or 90, it is 3"),
    (252, 1, "Q366=2", "Q366", "must be one of 0, 1, got 2"),
    (251, 1, "Q219=19", "Q366", "1 has a helix 18.6 wide: at least twice the tool diameter, 20"),
    (252, 1, "Q223=20", "Q366", "1 has a helix 19.6 wide: at least twice the tool diameter, 20"),
    (251, 1, "Q218=30 Q366=2", "Q366", "2 has no room for a ramp: 19.6 is less than twice the tool diameter, 20"),
    (251, 1, "Q218=10.3", "Q218", "must be at least the tool diameter and twice Q368, 10.4, got 10.3"),
    (251, 1, "Q219=10.3", "Q219", "must be at least the tool diameter and twice Q368, 10.4, got 10.3"),
    (251, 1, "Q220=4.9", "Q220", "must be 0 or at least the tool radius, 5, got 4.9"),
    (251, 1, "Q220=30.1", "Q220", "must be at most half the shorter side, 30, got 30.1"),
    (251, 1, "Q370=.0001", "Q370", "0.0005 divides 25 into more than 2000 steps"),
    (251, 1, "Q370=2", "Q370", "must be at least 0.0001 and at most 1.9999, got 2"),
    (252, 1, "Q370=.05", "Q370", "must be at least 0.1 and at most 1.9999, got 0.05"),
    (251, 1, "Q367=5", "Q367", "must be one of 0, 1, 2, 3, 4, got 5"),
    (252, 1, "Q223=10.3", "Q223", "must be at least the tool diameter and twice Q368, 10.4, got 10.3"),
    (253, 1, "Q219=9.9", "Q219", "must be at least the tool diameter, 10, got 9.9"),
    (254, 1, "Q219=9.9", "Q219", "must be at least the tool diameter, 10, got 9.9"),
    (253, 1, "Q219=10.2", "Q219", "must be at least the tool diameter and twice Q368, 10.4, got 10.2"),
    (253, 1, "Q218=11.9", "Q218", "must be at least the width Q219, 12, got 11.9"),
    (253, 1, "Q218=12", "Q366", "1 has no room for a ramp: the slot is round"),
    (254, 1, "Q248=0", "Q366", "1 has no room for a ramp: the slot is round"),
    (254, 1, "Q248=361", "Q248", "must be at least 0 and at most 360, got 361"),
    (254, 1, "Q248=-1", "Q248", "must be at least 0 and at most 360, got -1"),
    (254, 1, "Q375=12", "Q375", "must be greater than the slot width Q219, 12, got 12"),
    (254, 1, "Q377=0", "Q377", "must be a whole number and at least 1 and at most 99999, got 0"),
    (254, 1, "Q377=1.5", "Q377", "must be a whole number and at least 1 and at most 99999, got 1.5"),
    (254, 1, "Q377=99999", "Q202", "makes 4 levels of 199998 passes, more than 5000 together"),
]  # fmt: skip


def definition(number, change):
    """The blocks of a definition, and the line of each address; the program begins in line 1 with the tool call."""
    words = dict(word.split("=") for word in f"{SIZES[number]} {COMMON}".split())
    words |= dict(word.split("=") for word in change.split())
    lines = [f"CYCL DEF {number} A", *(f"{address}={value}" for address, value in words.items())]
    return "\n".join(lines), {address: k for k, address in enumerate(words, 3)}


def alarms(number, tool, change, **settings):
    text, line = definition(number, change)
    setup = Setup(tools=TOOLS, settings=settings)
    found = mnclab.run(f"TOOL CALL {tool} Z S1000\n{text}\n  CYCL CALL M3\n", "tnc-620", setup)
    return [alarm for alarm in found.alarms if alarm.severity == "alarm"], line


@together("number tool change address sentence", REFUSED, lambda number, *_: f"CYCL DEF {number}")
def test_refused(number, tool, change, address, sentence):
    (alarm,), line = alarms(number, tool, change)
    meaning = {253: {"Q218": "slot length"}, 251: {"Q219": "second side length"}}.get(number, {}).get(
        address, NAMES[address]
    )
    assert alarm.message == f"CYCL DEF {number} {address} ({meaning}) {sentence}"
    assert alarm.span[:2] == (line[address], 1)


@pytest.mark.parametrize("number", ALL)
def test_a_tool_without_radius(number):
    (alarm,), line = alarms(number, 3, "")
    at_the_call = (max(line.values()) + 1, 3)
    assert alarm.message == f"CYCL DEF {number} needs a tool with a radius, got 0" and alarm.span[:2] == at_the_call


@pytest.mark.parametrize("number", ALL)
def test_a_parameter_that_is_missing(number):
    text, line = definition(number, "")
    for address in line:
        if address not in ("Q385", "Q439"):  # they came later than the cycles
            lines = [row for row in text.splitlines() if not row.startswith(address + "=")]
            found = mnclab.run(
                "TOOL CALL 1 Z S1000\n" + "\n".join(lines) + "\nCYCL CALL M3\n", "tnc-620", Setup(tools=TOOLS)
            )
            alarm = found.alarms[0]
            assert alarm.message.startswith(f"CYCL DEF {number} {address} (") and alarm.message.endswith(") is missing")
            assert alarm.span[:2] == (2, 1)


@pytest.mark.parametrize(
    ("number", "change", "settings"),
    [
        (251, "Q201=20", {"depth_error": False}), (254, "Q201=20", {"depth_error": False}),
        (251, "Q219=19", {"plunge_error": False}), (252, "Q223=20", {"plunge_error": False}),
        (251, "Q219=20.4", {}), (251, "Q218=30.4 Q366=2", {}), (251, "Q220=30", {}), (252, "Q223=10.4 Q215=2", {}),
        (253, "Q219=10.4", {}), (253, "Q219=10 Q368=3", {}), (253, "Q219=61", {}), (254, "Q219=79", {}),
        (251, "Q215=2 Q207=0", {}), (252, "Q215=1 Q385=0", {}), (253, "Q368=0 Q369=0 Q385=0", {}),
        (251, "Q370=1.9999", {}),
    ],
)  # fmt: skip
def test_not_refused(number, change, settings):
    """The neighbours of what is refused, and what the settings allow."""
    found, _ = alarms(number, 1, change, **settings)
    assert found == []


ODD = {
    "Q218": (0, 10, 10.4, 12, 80), "Q219": (0, 10, 10.0000001, 10.000004, 12, 30), "Q223": (0, 10, 10.4000004, 20, 60),
    "Q220": (0, 4, 5, 6), "Q224": (0, -360, 33.3), "Q374": (0, 360, 7), "Q367": (0, 1, 2, 3, 4), "Q370": (0.1, 1, 1.9999),
    "Q375": (0, 12, 12.000001, 12.0001, 80), "Q376": (0, -360, 77), "Q248": (0, 1e-4, 0.01, 90, 180, 359.999, 360),
    "Q378": (0, 360, -9), "Q377": (1, 3), "Q215": (0, 1, 2), "Q368": (0, 1e-7, 0.2, 5), "Q201": (-20, -1e-4, 0, 20),
    "Q202": (0, 1e-3, 5, 99999), "Q369": (0, 1e-7, 0.1, 20), "Q338": (0, 1, 5), "Q200": (0, 2), "Q203": (0, -30, 8),
    "Q204": (0, 50), "Q366": (0, 1, 2), "Q351": (0, 1, -1), "Q439": (0, 1, 2, 3), "Q385": (0, 500),
}  # fmt: skip


@pytest.mark.deep
@pytest.mark.parametrize("number", ALL)
@settings(max_examples=60)
@given(data=st.data(), angle=st.sampled_from([0, 0.1, 3, 89.9, 90]), errors=st.booleans())
def test_no_numbers_raise_anything_but_alarms(number, data, angle, errors):
    """Whatever the numbers, the cycle runs or is refused at one of its words; what runs stays between floor and end."""
    text, line = definition(number, "")
    words = {address: data.draw(st.sampled_from(ODD[address])) for address in line if address in ODD}
    text, line = definition(number, " ".join(f"{address}={value:.9f}" for address, value in words.items()))
    setup = Setup(
        tools={1: Tool(radius=5, plunge_angle=angle)}, settings={"depth_error": errors, "plunge_error": errors}
    )
    found = mnclab.run(f"TOOL CALL 1 Z S1000\n{text}\nCYCL CALL M3\n", "tnc-620", setup)
    if not found.ok:
        (alarm,) = [alarm for alarm in found.alarms if alarm.severity == "alarm"]
        assert alarm.message.startswith(f"CYCL DEF {number} ") and alarm.span[:2] in {
            (k, 1) for k in (2, *line.values())
        }
        return
    rows = found.toolpath[found.toolpath.is_motion]
    assert np.isfinite(rows.end).all() and (rows.feed > 0).all()
    if len(rows):
        floor, end = words["Q203"] + words["Q201"], words["Q203"] + max(words["Q200"], words["Q204"])
        low, high = min(floor, words["Q203"] - words["Q200"], 0), max(end, floor, words["Q203"], 0)
        assert rows.end[:, 2].min() >= low - 1e-9 and rows.end[:, 2].max() <= high + 1e-9
        if words["Q201"] < 0:
            assert rows.end[:, 2].min() >= min(floor, 0) - 1e-9
