"""What the MNC manual leaves open (chapters 1 to 8): each has a setting, or a reason why one reading is enough.

The names and the adopted readings are in tests/authorities/catalogue/ambiguities.json; the adopted reading is the default.
That it is, tests/controls/mnc/test_readings.py shows; both readings of a setting are in test_settings.py beside it.
"""

import json
import re
from pathlib import Path

import pytest

import mnclab

TESTS = Path(__file__).parent
RECORDED = {
    entry["id"]: entry
    for entry in json.loads((TESTS / "authorities" / "catalogue" / "ambiguities.json").read_text(encoding="utf-8"))
}
SETTINGS = {setting.name: setting for setting in mnclab.controls["mnc"].settings}

#: "setting: NAME …" | "one: why one reading is enough" | "print: a slip of the print, no choice" | "later: what is not built"
READINGS = {
    "MNC-PROG-END": "setting: unlisted_m",
    "MNC-CH11": "one: the chapter is absent; any syntax would be invented",
    "MNC-WORD-SEP": "one: an address that counted twice would silently lose a word",
    "MNC-DECIMAL-COMMA": "one: 1.2 says point",
    "MNC-AXIS-LETTERS": "one: the machine has three axes; the formats of the functions define the letters",
    "MNC-MODAL-G": "one: 3.5.3 and 2.6 say so",
    "MNC-SKIP-COMMENT": "one: 1.5 defines both marks; whether skip is on is the setting block_skip",
    "MNC-COMMENT-SPACE": "one: both spellings are read",
    "MNC-G13-GROUP": "one: 3.1 lists G13 among the functions that replace each other",
    "MNC-G2xx-NUMBERS": "one: both numbers are read",
    "MNC-GROUP-FIX": "one: a group follows from what the functions cancel",
    "MNC-G0-GROUP": "one: in group 1 it would clash with G9",
    "MNC-BLOCK-ORDER": "setting: spindle_stop",
    "MNC-POWERON": "setting: power_on_motion power_on_plane power_on_dimension power_on_blending power_on_feed power_on_return",
    "MNC-HOME": "one: Setup.start gives another place",
    "MNC-XFORM-ORDER": "setting: transformation_order",
    "MNC-XFORM-SWITCH": "setting: switch_keeps",
    "MNC-OFFSET-SWITCH": "one: 2.5 says that no motion takes place",
    "MNC-XFORM-ARC": "one: 2.9.2 wants the mirror image; an ellipse is no arc",
    "MNC-G17-DEFAULT": "setting: power_on_plane",
    "MNC-G18-ORDER": "setting: g18_axes",
    "MNC-G90-OMITTED": "one: words are modal (1.3)",
    "MNC-G91-BASE": "one: 2.8.3 says from the last programmed position",
    "MNC-G92-U": "setting: g92_increment",
    "MNC-G92-XFORM": "one: the point must have the values of the block (2.5); a notice says that it is rare",
    "MNC-G92-POINT": "one: tip and centre are the same point",
    "MNC-G92-STACK": "one: G54 to G59 cancel it, so it does not change their rows",
    "MNC-G53-KEEP": "setting: g53_transformed g53_tool_length",
    "MNC-G53-G91": "one: the move leads to a point of the machine system",
    "MNC-G53-MOTION": "one: the groups of table 1.2",
    "MNC-DATUM-ROWS": "setting: datum_rows",
    "MNC-POLAR-SIGN": "one: the wording is complete in 2.9.3",
    "MNC-POLAR-CART": "one: table 2.1 ties polar words to G10 to G13",
    "MNC-POLAR-START": "one: 2.8.3 says from the last position",
    "MNC-POLAR-THIRD": "setting: helix",
    "MNC-FIG27": "print: numbers of figures",
    "MNC-G16-ABS": "setting: g16_pole",
    "MNC-POLAR-EX1": "print: a block of an example was lost",
    "MNC-G12-K": "setting: polar_arc",
    "MNC-G12-NOK": "setting: polar_arc_without_k",
    "MNC-G12-FULL": "one: a radius alone gives no full circle; with polar_arc sign none is possible",
    "MNC-G13-GROUP2": "one: see MNC-G13-GROUP",
    "MNC-G37-OMIT": "setting: g37_omitted",
    "MNC-G37-SCOPE": "one: tool and datum are not programmed dimensions",
    "MNC-FIG211": "print: numbers of figures",
    "MNC-G51-ARCS": "one: the result must be the mirror image",
    "MNC-G51-NONE": "one: 2.9.2 says that an axis without a line is not mirrored",
    "MNC-G39-EX": "print: Z for Y in an example",
    "MNC-G39-START": "setting: switch_keeps",
    "MNC-G39-ABSANGLE": "one: functions of a group replace each other",
    "MNC-G147-G247": "one: both numbers are read",
    "MNC-G0-PATH": "setting: rapid_path",
    "MNC-G1-EX": "print: a block of an example was lost",
    "MNC-33": "one: there is nothing to obey",
    "MNC-ARC-TOL": "setting: arc_tolerance",
    "MNC-ARC-RIJK": "setting: arc_by_both",
    "MNC-ARC-180": "one: geometry",
    "MNC-ARC-LINE": "one: note 1 of 3.4 does not change the modal function",
    "MNC-HELIX": "setting: helix",
    "MNC-ARC-MODAL": "one: note 1 of 3.4 speaks of the block",
    "MNC-IJ-EX": "print: axes of an example were swapped",
    "MNC-IJK-FULLTOL": "one: 0.001 mm is the last digit of a program",
    "MNC-G64-GEOM": "one: no size is given for a rounding; Limits.corner_tolerance is a matter of time",
    "MNC-G95-SWITCH": "setting: feed_mode_switch",
    "MNC-T-CHANGE": "setting: tool_change",
    "MNC-T-CRC": "one: an equidistant has one radius",
    "MNC-D": "setting: corrector_length",
    "MNC-TLC-ONCALL": "one: a control that moved Z by itself would say so",
    "MNC-TLC-G18": "one: Z is the spindle axis (2.1)",
    "MNC-TT-PLUNGE": "one: G343 and G344 could not run without the field",
    "MNC-TT-RADCORR": "one: corrections are added, as that of the length (5.2)",
    "MNC-TT-LIFE": "one: for information, no function uses it",
    "MNC-CRC-SIDE": "one: the text shifts the tool by its direction of motion",
    "MNC-CRC-FIGS": "print: figures are missing; the conditions in the cells decide",
    "MNC-CRC-BETWEEN": "one: 6.1 speaks of blocks in which motion is programmed",
    "MNC-CRC-FEED": "one: the corner belongs to the block that begins there",
    "MNC-CRC-GOUGE": "setting: gouge",
    "MNC-CRC-CHANGE": "one: 6.3 names it together with the entry",
    "MNC-G161-POINTS": "one: R <= AB is just the condition that both offsets meet",
    "MNC-G161-OBTUSE": "one: where the offsets do not meet there is no other path",
    "MNC-G161-SPIKE": "one: no limit is stated; a warning below 10 degrees",
    "MNC-G162-OBTUSE": "one: 6.4 puts it beside G161",
    "MNC-ENTRY-INSIDE": "one: the contour must be cut from its first point on",
    "MNC-ENTRY-180": "one: both rows give the same point",
    "MNC-T72-HEAD": "print: both parts of a table have one heading",
    "MNC-G40-RAPID": "one: 6.2 wants linear interpolation",
    "MNC-G40-CORNERMODE": "one: group 23 is modal (1.6)",
    "MNC-T73-DUP": "print: a row stands twice",
    "MNC-G26-TIME": "setting: spindle_run_up",
    "MNC-G4-RANGE": "one: both figures are printed",
    "MNC-M-ORDER": "setting: spindle_stop",
    "MNC-M5": "one: the parameter of G307 says so",
    "MNC-M99-MOTION": "one: what leads to the start of the cycle is left to the program",
}  # fmt: skip


def test_every_ambiguity_has_a_setting_or_a_reason():
    assert list(READINGS) == list(RECORDED)
    for name, verdict in READINGS.items():
        assert re.match(r"(setting: [a-z]|one: |print: |later: )\S.{3}", verdict), name


@pytest.mark.parametrize("name", [name for name, verdict in READINGS.items() if verdict.startswith("setting: ")])
def test_its_settings_exist_and_name_it(name):
    for setting in READINGS[name].removeprefix("setting: ").split():
        cited = SETTINGS[setting].source.split(", ")
        assert name in cited or (name, setting) == ("MNC-G17-DEFAULT", "power_on_plane")


def test_every_setting_that_names_an_ambiguity_stands_beside_it():
    for setting in SETTINGS.values():
        for name in set(setting.source.split(", ")) & set(RECORDED):
            assert setting.name in READINGS[name].split(), setting.name


@pytest.mark.parametrize("name", [n for n, verdict in READINGS.items() if verdict.split(":")[0] in ("setting", "one")])
def test_a_test_shows_that_the_default_is_the_adopted_reading(name):
    texts = [path.read_text(encoding="utf-8") for path in (TESTS / "controls" / "mnc").glob("test_*.py")]
    assert any(re.search(rf"\b{name}(?![\w-])", text) for text in texts)
