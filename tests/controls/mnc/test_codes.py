"""Every code of the manual is obeyed or refused by name; groups, modality and power-on state are those of table 1.2."""

import json
from pathlib import Path

import pytest
from tools.together import together

import mnclab
from mnclab.text.alarm import slips_between

CONTROL = mnclab.controls["mnc"]
FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "codes.json"
CODES = {entry["code"]: entry for entry in json.loads(FILE.read_text(encoding="utf-8"))}
BUILT = [code for code in CODES if code in CONTROL.functions]


def each(codes):
    return together("code", codes, lambda code: code[0])


@each([*CODES, *(alias for entry in CODES.values() for alias in entry["aliases"] or ())])
def test_a_code_of_the_manual_is_built_or_refused_by_name(code):
    if code in CONTROL.functions or code in CONTROL.cycles:
        assert mnclab.help(code, "mnc") is not None
        assert code not in CONTROL.refused
        return
    run = mnclab.run(f"G1 X5 F100\n{code}\n", "mnc")
    assert [(a.severity, a.span[:3]) for a in run.alarms] == [("alarm", (2, 1, len(code)))]
    assert run.alarms[0].message.startswith(f"{code} is refused: it is part of this control")


@each(BUILT)
def test_a_function_is_modal_and_on_as_the_manual_says(code):
    function = CONTROL.functions[code]
    assert (function.power_on, function.modal) == (CODES[code]["power_on"], CODES[code]["modal"])
    assert function.title and function.doc and function.source


def test_functions_stand_in_the_groups_of_the_manual():
    """Two functions share a group here exactly when they do there (M3, M4, M5 cancel each other without a number)."""
    for one in BUILT:
        for other in BUILT:
            ours = CONTROL.functions[one].group is not None and (
                CONTROL.functions[one].group == CONTROL.functions[other].group
            )
            theirs = CODES[one]["group"] is not None and CODES[one]["group"] == CODES[other]["group"]
            assert ours == theirs or {one, other} <= {"M3", "M4", "M5"}, (one, other)


GROUPS = {}
for built in BUILT:
    GROUPS.setdefault(CODES[built]["group"], []).append(built)
PAIRS = [(a, b) for group, members in GROUPS.items() if group for a in members for b in members]


@together("first second", PAIRS, lambda first, second: CODES[first]["group"])
def test_only_one_function_of_a_group_stands_in_a_block(first, second):
    run = mnclab.run(f"F100\n{first} {second} X1\n", "mnc")
    assert [a.span[:2] for a in run.alarms] == [(2, len(first) + 2)]
    assert run.alarms[0].message.startswith(second)
    words = "is written twice in this block" if first == second else "only one function of a group may stand in a block"
    assert words in run.alarms[0].message
    assert not len(run.toolpath)


@each([c for c in CONTROL.functions if c[0] in "GM" and c not in CODES and c != "G247"])
def test_what_the_manual_does_not_list_is_said_to_be_so(code):
    run = mnclab.run(f"{code}\n", "mnc")
    assert run.ok
    assert [a.severity for a in run.alarms] == ["warning"] and "the manual does not list it" in run.alarms[0].message


@pytest.mark.parametrize(
    ("wrong", "near"),
    [
        ("G60", "G61"), ("G20", "G2"), ("G146", "G147"), ("M33", "M3"), ("G-1", "G1"), ("G17.5", "G17"),
        ("G31", "G13"), ("G900", "G90"), ("G380", "G38"), ("M98", "M9"), ("G811", "G11"),
    ],
)  # fmt: skip
def test_an_unknown_code_gets_the_one_that_is_a_slip_away(wrong, near):
    """Left out, added, exchanged, or two in the wrong order: counted by hand. What is two slips away is not named."""
    alarm = mnclab.run(f"{wrong}\n", "mnc").alarms[0]
    assert alarm.message == f"{wrong} is not a function of this control"
    assert alarm.hint.startswith(f"near: {near}") and alarm.hint.count(",") < 3
    for code in alarm.hint.removeprefix("near: ").split(", "):
        assert code in CONTROL.functions or code in CONTROL.cycles
        assert slips_between(wrong.replace("-", "").partition(".")[0], code) <= 1


def test_codes_that_are_equally_near_are_named_in_the_order_of_help():
    assert mnclab.run("G180\n", "mnc").alarms[0].hint == "near: G18, G10, G160"


@pytest.mark.parametrize(
    ("wrong", "column", "hint"),
    [
        ("G10O", 4, "the letter O stands where the digit 0 was meant"),
        ("G1О", 3, "the letter О stands where the digit 0 was meant"),  # Cyrillic O
        ("GО1", 1, "the letter О stands where the digit 0 was meant"),
        ("G0l", 3, "the letter l stands where the digit 1 was meant"),
        ("Gl X5", 1, "the letter l stands where the digit 1 was meant"),
        ("M0З", 3, "the letter З stands where the digit 3 was meant"),
        ("М3", 1, "write the Latin letter M"),
        ("G1 Х10", 4, "write the Latin letter X"),
        ("G I5", 1, ""),  # I5 is a word
        ("T l", 1, ""),
        ("TOOL CALL", 1, "TOOL is no word of this control: a word is one letter and its number"),  # a word, no number
        ("GOO X5", 1, "the letter O stands where the digit 0 was meant"),
        ("G0OX5", 3, "the letter O stands where the digit 0 was meant"),
    ],
)
def test_a_letter_in_place_of_a_digit_or_of_a_latin_letter(wrong, column, hint):
    alarm = mnclab.run(f"F100\n{wrong}\n", "mnc").alarms[0]
    assert (alarm.span[:2], alarm.hint) == ((2, column), hint)
