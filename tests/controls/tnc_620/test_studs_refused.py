"""Programs with cycles 256, 257, 258 and 233 that must be refused: the alarm, its line and its column."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools.together import together

import mnclab
from mnclab import Setup, Tool

TOOLS = {1: Tool(radius=5), 3: Tool()}
STUD = "Q368=.2 Q207=500 Q351=1 Q201=-20 Q202=5 Q206=150 Q200=2 Q203=0 Q204=50 Q370=1 Q215=0 Q369=.1 Q338=5 Q385=800"
WORDS = {
    256: f"Q218=60 Q424=74 Q219=40 Q425=60 Q220=5 Q224=0 Q367=0 Q437=0 {STUD}",
    257: f"Q223=50 Q222=60 Q376=0 {STUD}",
    258: f"Q573=0 Q571=50 Q222=80 Q572=6 Q224=0 Q220=2 {STUD}",
    233: "Q215=0 Q389=2 Q350=1 Q218=120 Q219=80 Q227=0 Q386=-6 Q369=.2 Q202=3 Q370=1 Q207=500 Q385=500 Q253=750 Q357=2 "
    "Q200=2 Q204=50 Q347=0 Q348=0 Q349=0 Q220=8 Q368=.3 Q338=0 Q367=-1",
}  # fmt: skip
STUDS, ALL = (256, 257, 258), (256, 257, 258, 233)
NAMES = {
    "Q201": "depth", "Q202": "infeed depth", "Q206": "feed rate for plunging", "Q207": "feed rate for milling",
    "Q215": "machining operation", "Q385": "finishing feed rate", "Q369": "finishing allowance for floor",
    "Q338": "infeed for finishing", "Q351": "climb or conventional milling", "Q370": "path overlap factor",
    "Q218": "first side length", "Q219": "second side length", "Q424": "first side of the blank",
    "Q425": "second side of the blank", "Q223": "diameter of the finished stud", "Q222": "diameter of the blank",
    "Q376": "starting angle", "Q437": "approach position", "Q367": "stud position", "Q368": "finishing allowance for side",
    "Q220": "rounding (+) or bevel (-) of the corners", "Q572": "number of corners", "Q573": "reference circle",
    "Q224": "angle of rotation", "Q347": "first limit", "Q348": "second limit", "Q349": "third limit",
    "Q389": "machining strategy", "Q350": "milling direction", "Q386": "coordinate to mill down to",
    "Q253": "feed rate for pre-positioning", "Q357": "clearance to the side", "Q200": "set-up clearance",
    "Q204": "second set-up clearance",
}  # fmt: skip
OF_233 = {"Q202": "greatest infeed", "Q220": "corner radius between limits", "Q367": "surface position"}
RANGE = "must be at least 0 and at most 99999.9999, got -1"

#: cycle, what is written instead, the address that is marked, and the sentence behind its name.
REFUSED = [
    *((n, "Q201=20", "Q201", "must be negative, got 20: a positive depth works upwards") for n in STUDS),
    *((n, "Q202=0", "Q202", "must be greater than 0, got 0") for n in ALL),
    *((n, "Q202=.001", "Q202", "0.001 divides 19.9 into more than 10000 infeeds") for n in STUDS),
    *((n, "Q338=.001", "Q338", "0.001 divides 19.9 into more than 10000 infeeds") for n in STUDS),
    *((n, "Q369=20", "Q369", "must be less than the depth 20, got 20") for n in STUDS),
    *((n, "Q206=0", "Q206", "must be greater than 0 to mill with, got 0") for n in STUDS),
    *((n, "Q207=0", "Q207", "must be greater than 0 to mill with, got 0") for n in ALL),
    *((n, "Q215=3", "Q215", "must be one of 0, 1, 2, got 3") for n in ALL),
    *((n, "Q351=2", "Q351", "must be one of 1, -1, 0, got 2") for n in STUDS),
    *((n, "Q370=2", "Q370", "must be at least 0.0001 and at most 1.9999, got 2") for n in (257, 258)),
    *((n, "Q370=.05", "Q370", "must be at least 0.1 and at most 1.9999, got 0.05") for n in (256, 233)),
    *((n, "Q200=-1", "Q200", RANGE) for n in ALL), *((n, "Q204=-1", "Q204", RANGE) for n in ALL),
    *((n, "Q368=-1", "Q368", RANGE) for n in (256, 257, 233)),
    (256, "Q424=59", "Q424", "must be at least the side of the stud Q218, 60, got 59"),
    (256, "Q425=39.9", "Q425", "must be at least the side of the stud Q219, 40, got 39.9"),
    (256, "Q220=20.1", "Q220", "must be at most half the shorter side, 20, got 20.1"),
    (256, "Q220=-20.1", "Q220", "must be at most half the shorter side, 20, got -20.1"),
    (256, "Q367=5", "Q367", "must be one of 0, 1, 2, 3, 4, got 5"),
    (256, "Q437=5", "Q437", "must be one of 0, 1, 2, 3, 4, got 5"),
    (256, "Q224=361", "Q224", "must be at least -360 and at most 360, got 361"),
    (257, "Q222=49", "Q222", "must be at least the diameter of the stud Q223, 50, got 49"),
    (257, "Q376=-.5", "Q376", "must be -1 or at least 0, got -0.5"),
    (257, "Q376=361", "Q376", "must be at least -1 and at most 360, got 361"),
    (257, "Q222=99999 Q370=.0001", "Q370", "0.0005 divides 49974.3 into more than 2000 steps"),
    (258, "Q222=50", "Q222", "must be greater than the reference circle Q571, 50, got 50"),
    (258, "Q572=2", "Q572", "must be a whole number and at least 3 and at most 30, got 2"),
    (258, "Q572=31", "Q572", "must be a whole number and at least 3 and at most 30, got 31"),
    (258, "Q572=4.5", "Q572", "must be a whole number and at least 3 and at most 30, got 4.5"),
    (258, "Q573=2", "Q573", "must be one of 0, 1, got 2"),
    (258, "Q220=25.1", "Q220", "must be at most the radius of the inscribed circle, 25, got 25.1"),
    (258, "Q220=-14.5", "Q220", "must be a bevel of at most half a side, 14.4338, got 14.5"),
    (258, "Q368=-25", "Q368", "must leave something of the radius 25 of the inscribed circle, got -25"),
    (258, "Q385=0 Q207=0", "Q207", "must be greater than 0 to mill with, got 0"),
    (233, "Q386=5", "Q386", "must lie below Q227 = 0, got 5: it works upwards"),
    (233, "Q389=4 Q347=1", "Q347", "must be 0 in spiral machining (Q389 = 4), got 1"),
    (233, "Q389=4 Q348=-2", "Q348", "must be 0 in spiral machining (Q389 = 4), got -2"),
    (233, "Q389=4 Q349=2", "Q349", "must be 0 in spiral machining (Q389 = 4), got 2"),
    (233, "Q389=5", "Q389", "must be one of 0, 1, 2, 3, 4, got 5"),
    (233, "Q350=0", "Q350", "must be one of 1, 2, got 0"),
    (233, "Q347=3", "Q347", "must be one of 0, -1, 1, -2, 2, got 3"),
    (233, "Q367=-2", "Q367", "must be one of -1, 0, 1, 2, 3, 4, got -2"),
    (233, "Q369=6", "Q369", "must be less than the depth 6, got 6"),
    (233, "Q202=.0001", "Q202", "0.0001 divides 5.8 into more than 10000 steps"),
    (233, "Q338=.0001 Q347=1", "Q338", "0.0001 divides 6 into more than 10000 infeeds"),
    (233, "Q218=0", "Q218", "must not be 0"), (233, "Q219=0", "Q219", "must not be 0"),
    (233, "Q253=0", "Q253", "must be greater than 0 to mill with, got 0"),
    (233, "Q385=0", "Q385", "must be greater than 0 to mill with, got 0"),
    (233, "Q218=10 Q347=1 Q348=-1", "Q218",
     "must be at least the tool diameter and twice Q368 between walls, 10.6, got 10"),
    (233, "Q219=-10 Q347=2 Q349=-2", "Q219",
     "must be at least the tool diameter and twice Q368 between walls, 10.6, got 10"),
    (233, "Q347=1 Q348=2 Q220=81", "Q220", "must be at most 80 to fit between the limits, got 81"),
    (233, "Q347=1 Q348=2 Q349=-2 Q220=41", "Q220", "must be at most 40 to fit between the limits, got 41"),
    (233, "Q357=-1", "Q357", RANGE), (233, "Q220=-1", "Q220", RANGE),
]  # fmt: skip


def definition(number, change):
    """The blocks of a definition, and the line of each address; the program begins in line 1 with the tool call."""
    words = dict(word.split("=") for word in WORDS[number].split()) | dict(word.split("=") for word in change.split())
    lines = [f"CYCL DEF {number} A", *(f"{address}={value}" for address, value in words.items())]
    return "\n".join(lines), {address: k for k, address in enumerate(words, 3)}


def alarms(number, tool, change, **settings):
    text, line = definition(number, change)
    setup = Setup(tools=TOOLS, settings=settings)
    found = mnclab.run(f"TOOL CALL {tool} Z S1000\n{text}\n  CYCL CALL M3\n", "tnc-620", setup)
    return [alarm for alarm in found.alarms if alarm.severity == "alarm"], line


@together("number change address sentence", REFUSED, lambda number, *_: f"CYCL DEF {number}")
def test_refused(number, change, address, sentence):
    (alarm,), line = alarms(number, 1, change)
    meaning = OF_233.get(address) if number == 233 else None
    meaning = meaning or ("angle of the first corner" if (number, address) == (258, "Q224") else NAMES[address])
    assert alarm.message == f"CYCL DEF {number} {address} ({meaning}) {sentence}"
    assert alarm.span[:2] == (line[address], 1)


@pytest.mark.parametrize("number", ALL)
def test_a_tool_without_radius(number):
    (alarm,), line = alarms(number, 3, "")
    at_the_call = (max(line.values()) + 1, 3)
    assert alarm.message == f"CYCL DEF {number} needs a tool with a radius, got 0" and alarm.span[:2] == at_the_call


LATER = {
    256: {"Q437", "Q215", "Q369", "Q338", "Q385"}, 257: {"Q376", "Q215", "Q369", "Q338", "Q385"}, 258: set(),
    233: {"Q348", "Q349", "Q367"},
}  # fmt: skip


@pytest.mark.parametrize("number", ALL)
def test_a_parameter_that_is_missing(number):
    """Only what came later than the cycle, or has a value of its own, may be left out."""
    text, line = definition(number, "")
    for address in line:
        lines = [row for row in text.splitlines() if not row.startswith(address + "=")]
        found = mnclab.run(
            "TOOL CALL 1 Z S1000\n" + "\n".join(lines) + "\nCYCL CALL M3\n", "tnc-620", Setup(tools=TOOLS)
        )
        if address in LATER[number]:
            assert found.ok
            continue
        alarm = found.alarms[0]
        assert alarm.message.startswith(f"CYCL DEF {number} {address} (") and alarm.message.endswith(") is missing")
        assert alarm.span[:2] == (2, 1)


@pytest.mark.parametrize(
    ("number", "change", "settings"),
    [
        (256, "Q201=20", {"depth_error": False}), (233, "Q386=6", {"depth_error": False}),
        (256, "Q424=60 Q425=40", {}), (257, "Q222=50", {}), (258, "Q222=50.1", {}), (256, "Q220=20", {}),
        (256, "Q220=-20", {}), (258, "Q220=25", {}), (258, "Q220=-14.4", {}), (258, "Q368=-24.9", {}),
        (256, "Q385=0", {}), (258, "Q385=0", {}), (256, "Q215=2 Q207=0", {}), (257, "Q376=360", {}),
        (233, "Q386=0 Q202=0", {}), (233, "Q218=10.6 Q347=1 Q348=-1 Q220=5", {}), (233, "Q218=-120 Q219=-80", {}),
        (233, "Q347=1 Q348=1 Q349=1", {}), (233, "Q215=1 Q385=0", {}),
    ],
)  # fmt: skip
def test_not_refused(number, change, settings):
    """The neighbours of what is refused, and what the settings allow."""
    found, _ = alarms(number, 1, change, **settings)
    assert found == []


ODD = {
    "Q218": (-60, 0, 10, 12, 60), "Q219": (-40, 0, 10, 12, 40), "Q424": (0, 60, 74), "Q425": (0, 40, 60, 1000),
    "Q220": (0, -6, -5, 5, 6, 20, 25), "Q224": (0, 33.3, -360), "Q367": (-1, 0, 1, 3), "Q437": (0, 1, 4), "Q223": (0, 1e-6, 50),
    "Q222": (0, 50, 50.000001, 80), "Q376": (-1, -0.5, 0, 77), "Q573": (0, 1), "Q571": (0, 1e-6, 50), "Q572": (3, 6, 30),
    "Q368": (0, 1e-7, 0.2, 9, -1, -30), "Q201": (-20, -1e-4, 0, 20), "Q202": (0, 1e-3, 5), "Q369": (0, 1e-7, 0.1, 20),
    "Q338": (0, 5), "Q200": (0, 2), "Q204": (0, 50), "Q351": (0, 1, -1), "Q385": (0, 500), "Q370": (0.1, 1, 1.9999),
    "Q215": (0, 1, 2), "Q389": (0, 1, 2, 3, 4), "Q350": (1, 2), "Q386": (-6, -1e-4, 0, 6), "Q357": (0, 2),
    "Q347": (0, -1, 1, -2, 2), "Q348": (0, -1, 1, -2, 2), "Q349": (0, -1, 1, -2, 2),
}  # fmt: skip


@pytest.mark.deep
@pytest.mark.parametrize("number", ALL)
@settings(max_examples=60)
@given(data=st.data(), errors=st.booleans())
def test_no_numbers_raise_anything_but_alarms(number, data, errors):
    """Whatever the numbers, the cycle runs or is refused at one of its words; what runs stays between floor and end."""
    _, line = definition(number, "")
    words = {address: data.draw(st.sampled_from(ODD[address])) for address in line if address in ODD}
    text, line = definition(number, " ".join(f"{address}={value:.9f}" for address, value in words.items()))
    setup = Setup(tools=TOOLS, settings={"depth_error": errors})
    found = mnclab.run(f"TOOL CALL 1 Z S1000\n{text}\nCYCL CALL M3\n", "tnc-620", setup)
    if not found.ok:
        alarm = next(alarm for alarm in found.alarms if alarm.severity == "alarm")
        assert alarm.message.startswith(f"CYCL DEF {number} ")
        assert alarm.span[:2] in {(k, 1) for k in (2, *line.values())}
        return
    rows = found.toolpath[found.toolpath.is_motion]
    assert np.isfinite(rows.end).all() and (rows.feed > 0).all()
    floor = words.get("Q201", words.get("Q386"))
    if len(rows):
        high = max(words["Q200"], words["Q204"], floor)
        assert rows.end[:, 2].min() >= min(floor, -words["Q200"]) - 1e-9 and rows.end[:, 2].max() <= high + 1e-9
        if floor < 0:
            assert rows.end[:, 2].min() >= floor - 1e-9
