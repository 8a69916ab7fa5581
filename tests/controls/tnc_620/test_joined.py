"""What chapters do together: feeds and defaults in pockets, texts in place of numbers, tools by their names."""

from __future__ import annotations

from functools import partial

import pytest
from tools import running

import mnclab as mnc

TOOL = mnc.Tool(radius=5, teeth=2, name="MILL", cutting_length=30, plunge_angle=20)
START = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n2 L Z+100 R0 FMAX M3\n"
DEFAULTS = {
    100: {"Q200": 3, "Q204": 40, "Q253": 700, "Q208": 999}, 110: {"Q370": 0.7, "Q351": -1, "Q366": 1},
}  # fmt: skip
SHARED = {
    "Q215": 0, "Q368": 0.2, "Q207": 300, "Q351": 1, "Q201": -10, "Q202": 5, "Q369": 0.1, "Q206": 150, "Q338": 5, "Q200": 2,
    "Q203": 0, "Q204": 50, "Q366": 1, "Q385": 400, "Q439": 0,
}  # fmt: skip
FIGURES = {
    251: {"Q218": 60, "Q219": 40, "Q220": 5, "Q224": 0, "Q367": 0, "Q370": 1},
    252: {"Q223": 50, "Q370": 1},
    253: {"Q218": 80, "Q219": 12, "Q374": 0, "Q367": 0},
    254: {"Q219": 12, "Q375": 80, "Q367": 0, "Q216": 50, "Q217": 50, "Q376": 45, "Q248": 60, "Q378": 0, "Q377": 1},
}

run = partial(running.run, control="tnc-620", ok=None, before=START, after="\n99 END PGM A MM", tools={1: TOOL})


def defined(code: str, values: dict[str, object]) -> str:
    return f"{code} X\n" + "".join(f"{address}={value}\n" for address, value in values.items())


def milled(number: int, before: str = "", **changes: object) -> mnc.Toolpath:
    """The rows of a pocket or slot with some Q parameters changed."""
    values = {q: v for q, v in (SHARED | FIGURES[number]).items()} | changes
    found = run(before + defined(f"CYCL DEF {number}", values) + "4 L X+50 Y+50 R0 FMAX M99")
    assert found.ok, found.alarms
    return found.toolpath.motion


def same(one: mnc.Toolpath, other: mnc.Toolpath) -> bool:
    return len(one) == len(other) and bool((abs(one.end - other.end) < 1e-9).all() and (one.feed == other.feed).all())


@pytest.mark.parametrize("number", FIGURES)
def test_feeds_of_pockets_in_all_forms(number: int) -> None:
    """S 1000 and two teeth: FU0.3 = 300, FZ0.15 = 300, FAUTO = 100 mm/min."""
    plain = milled(number, Q207=300, Q206=100, Q385=400)
    assert same(plain, milled(number, Q207="FU0.3", Q206="FAUTO", Q385="FZ0.2"))
    assert same(plain, milled(number, Q207="FZ0,15", Q206="FU.1", Q385="FU 0.4"))
    assert {300, 100, 400} <= set(plain.feed)


@pytest.mark.parametrize("number", FIGURES)
def test_defaults_of_pockets(number: int) -> None:
    """PREDEF is what GLOBAL DEF 100 and 110 say; without them it is an alarm at that line."""
    known = {q: v for values in DEFAULTS.values() for q, v in values.items() if q in SHARED | FIGURES[number]}
    before = "".join(defined(f"GLOBAL DEF {n}", values) for n, values in DEFAULTS.items())
    assert same(milled(number, **known), milled(number, before, **dict.fromkeys(known, "PREDEF")))
    assert not same(milled(number), milled(number, **known))
    for address in known:
        text = defined(f"CYCL DEF {number}", SHARED | FIGURES[number] | {address: "PREDEF"})
        (alarm,) = run(text).alarms
        assert (
            alarm.span[:2] == (4 + [line[:4] for line in text.splitlines()].index(address), 1)
            and address in alarm.message
        )


@pytest.mark.parametrize("pattern", ["CYCL DEF 220", "CYCL DEF 221"])
def test_a_circular_slot_has_no_place_in_a_polar_pattern(pattern: str) -> None:
    points = {
        "CYCL DEF 220": {"Q216": 50, "Q217": 50, "Q244": 80, "Q245": 0, "Q246": 360, "Q247": 0, "Q241": 4, "Q365": 0},
        "CYCL DEF 221": {"Q225": 0, "Q226": 0, "Q237": 90, "Q238": 90, "Q242": 2, "Q243": 2, "Q224": 0},
    }[pattern] | {"Q200": 2, "Q203": 0, "Q204": 50, "Q301": 1}
    for position, refused in ((0, True), (1, pattern == "CYCL DEF 220")):
        slot = defined("CYCL DEF 254", SHARED | FIGURES[254] | {"Q367": position})
        found = run(slot + defined(pattern, points))
        assert found.ok != refused
        if refused:
            assert found.alarms[0].message.startswith(f"{pattern} cannot be combined with CYCL DEF 254")


def test_a_text_parameter_is_no_number() -> None:
    drilling = {"Q200": 2, "Q201": -15, "Q206": 250, "Q202": 0, "Q210": 0, "Q203": 0, "Q204": 20, "Q211": 0}
    (alarm,) = run('3 QS1 = "5"\n' + defined("CYCL DEF 200", drilling | {"Q200": "QS1"})).alarms
    assert alarm.span[:2] == (6, 1) and "Q200" in alarm.message
    (alarm,) = run(defined("CYCL DEF 200", drilling | {"Q200": '"5"'})).alarms
    assert (alarm.span[:2], alarm.message) == ((5, 1), "CYCL DEF 200 Q200 (set-up clearance) must be a number, got 5")


@pytest.mark.parametrize("tool", ["Q18=0", "Q18=Q50", 'QS18="MILL"', 'QS18="NONE"', "Q18=7"])
def test_the_coarse_tool_of_fine_roughing(tool: str) -> None:
    """Q18 by number, computed, or QS18 by name; 0 is none; a tool that is not there is refused, one as wide leaves nothing."""
    address, value = tool.split("=")
    square = "LBL 1\nL X+0 Y+0 RR\nL Y+60\nL X+60\nL Y+0\nL X+0\nLBL 0\n"
    data = {f"Q{k}": v for k, v in zip(range(1, 10), (-10, 1, 0, 0, 0, 2, 50, 0, 1), strict=True)}
    rough = {"Q10": -5, "Q11": 100, "Q12": 350, address: value, "Q19": 0, "Q208": 9999}
    contour = "CYCL DEF 14.0 C\nCYCL DEF 14.1 CONTOUR LABEL 1\n"
    text = f"3 Q50 = 0\n{contour}{defined('CYCL DEF 20', data)}{defined('CYCL DEF 22', rough)}CYCL CALL\nM30\n{square}"
    found = run(text)
    names = {'QS18="NONE"': 'names tool "NONE", which has no radius', "Q18=7": "names tool 7, which has no row in the tool table"}
    if tool in names:
        (alarm,) = found.alarms
        assert alarm.message == f"CYCL DEF 22 Q18 (coarse roughing tool) {names[tool]}"
        assert found.program.line_text(alarm.span.line) == tool
    elif tool == 'QS18="MILL"':
        assert found.ok and "has nothing to cut" in found.alarms[0].message
    else:
        assert found.ok and not found.alarms


@pytest.mark.parametrize(
    ("block", "words"),
    [
        ("CYCL DEF 200 DRILLING M99 F100 ~", {23: "M99", 27: "F100"}), ("CYCL DEF 9.0 DWELL X+5", {20: "X+5"}),
        ("CYCL DEF 247 PRESET 3-D A1, part 2 ~", {25: "A1"}), ("CYCL DEF 200 ROUGH-OUT 2 OF 3 ~", {}),
        ("GLOBAL DEF 100 GENERAL R0", {24: "R0"}),
    ],
)  # fmt: skip
def test_what_looks_like_a_word_in_the_name_of_a_cycle_is_told(block: str, words: dict[int, str]) -> None:
    warnings = [a for a in mnc.read(f"{block}\n  Q200=2\n", "tnc-620").alarms if a.severity == "warning"]
    assert {a.span.column: a.message.split()[0] for a in warnings} == words
    assert all(a.span.line == 1 and a.span.length == len(words[a.span.column]) for a in warnings)
