"""Alarms of programs in inches name the lengths that they tell in mm, and only those."""

import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.machine.coordinates import in_mm

INCH = 25.4


@pytest.mark.parametrize(("sentence", "length", "said"), [
    ("the tool of radius 5 does not fit", False, True), ("the approach leads the tool into the contour at X1.2 Y3", False, True),
    ("tool 5 is not in the table", False, False), ("12 passes are too many", False, False),
    ("an angle of 30 degrees", False, False), ("the tool radius 5: 4.5 mm are missing", False, True),
    ("must be at most 7.5", True, True), ("they are 4.79 mm apart", False, False), ("the depth is not known", True, False),
])  # fmt: skip
def test_which_sentences_are_about_lengths(sentence, length, said):
    assert in_mm(sentence, INCH, length) == sentence + " (lengths in mm)" * said
    assert in_mm(sentence, 1.0, length) == sentence


@pytest.mark.parametrize(("unit", "said"), [("INCH", True), ("MM", False)])
def test_a_gouge_in_inches(unit, said):
    """A tool of 5 mm in a corner arc of 0.1 units: the alarm has its radius in mm, in both units, and says so in inches."""
    text = (
        f"BEGIN PGM T {unit}\nTOOL CALL 1 Z S1000 F10\nL X-1 Y-1 R0 FMAX M3\nL X+0 Y+0 RR\nL X+1\nCR X+1.1 Y+0.1 R+0.1 DR-\n"
        f"L Y+2\nL X+3 R0\nEND PGM T {unit}\n"
    )
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=5, number=1)}))
    told = [alarm.message for alarm in run.alarms if "radius" in alarm.message]
    assert told and all(message.endswith(" (lengths in mm)") == said for message in told), told
