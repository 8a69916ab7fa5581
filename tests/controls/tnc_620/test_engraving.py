"""Engraving, cycle 225 (12.6): layout, texts and moves against the catalogue; what it refuses."""

from __future__ import annotations

import json
import math
import re
from datetime import datetime
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab as mnc
from mnclab.controls.tnc_620.cycles.engraving import TextFault, tokens
from mnclab.controls.tnc_620.machining import engraving

EXAMPLES = json.loads(
    (Path(__file__).parents[2] / "authorities/catalogue/tnc620-special.json").read_text(encoding="utf-8")
)
CHECKS = [(e["code"], e["check"]) for e in EXAMPLES]
PRINTED = next(e for e in EXAMPLES if e["code"] == "CYCL DEF 225")
LINE, ARC = (check for code, check in CHECKS if code == "engraving layout")
TIMES, COUNTS = (check for code, check in CHECKS if code == "engraving system variables")
NOW = datetime(2018, 3, 5, 7, 8, 9)
VALUES = dict(re.findall(r"(Q\d+)=(\S+)", PRINTED["program"]))


def engraved(
    text: str | None = None, at: tuple[float, float] = (0, 0), settings: dict | None = None, **changed: object
) -> mnc.Run:
    values = VALUES | {key: str(value) for key, value in changed.items()}
    if text is not None:
        values["Q500"] = f'"{text}"'
    lines = "\n".join(f"{key}={value}" for key, value in values.items())
    head = f"TOOL CALL 1 Z S1000\nL X{at[0]} Y{at[1]} Z+100 FMAX M3\nCYCL DEF 225 E\n"
    setup = mnc.Setup(tools={1: mnc.Tool(radius=0.2)}, settings=settings or {})
    return mnc.run(f"{head}{lines}\nCYCL CALL\n", "tnc-620", setup)


def rows(found: mnc.Run) -> mnc.Toolpath:
    assert found.ok, found.alarms
    path = found.toolpath
    return path[[path.labels[k].startswith("CYCL DEF 225") for k in path.label] & path.is_motion]


def milled(found: mnc.Run) -> mnc.Toolpath:
    path = rows(found)
    return path[path.feed == 750]


def test_the_letter_a_move_by_move() -> None:
    """The figures of the catalogue are rounded to three digits."""
    expected = [
        ({w[0]: float(w[1:]) for w in words.split() if w[0] in "XYZ"}, words.split()[-1])
        for words in PRINTED["check"]["moves_hershey"]
    ]
    path = rows(engraved())
    assert len(path) == len(expected)
    for row, (to, feed) in zip(path, expected, strict=True):
        assert ("FMAX" if row.kind == mnc.Kind.RAPID else f"F{row.feed:g}") == feed
        for axis, value in to.items():
            assert row.end["XYZ".index(axis)] == pytest.approx(value, abs=1e-3)


def ends(cells: list, height: float, reference: int, angle: float) -> list:
    """Where cells begin on the baseline, and where the last one ends."""
    glyphs = engraving.on_line(cells, height, reference, angle)
    along = np.array([math.cos(angle), math.sin(angle)])
    begin = [np.array([g.x, g.y]) - along * g.cell.width * height / 2 for g in glyphs]
    return [*begin, begin[-1] + along * glyphs[-1].cell.width * height]


def test_layout_on_a_line() -> None:
    row = engraving.cells("ABC")
    assert engraving.length(row) * 10 == pytest.approx(LINE["length"], abs=6e-4)
    for key, reference, angle, at in (
        ("line_0_Q367_1", 1, 0, (0, 0)), ("line_30_Q367_1", 1, 30, (0, 0)), ("line_30_Q367_5_T_50_20", 5, 30, (50, 20)),
    ):  # fmt: skip
        assert np.array(ends(row, 10, reference, math.radians(angle))) + at == pytest.approx(
            np.array(LINE[key]), abs=6e-4
        )
    wide = engraving.cells("ABC", 0.5)
    assert np.array(ends(wide, 10, 1, 0)) == pytest.approx(np.array(LINE["line_0_Q514_0_5"]), abs=6e-4)
    assert engraving.length(wide) * 10 == pytest.approx(LINE["length_Q514_0_5"], abs=6e-4)
    assert 50 / engraving.length(row) == pytest.approx(LINE["height_for_Q513_0_Q574_50"], abs=6e-4)


@pytest.mark.parametrize("key", list(ARC))
def test_layout_on_an_arc(key: str) -> None:
    layout, angle, reference = map(int, re.findall(r"_(\d+)", key))
    check = ARC[key]
    sense = 1 if check["direction"] == "counterclockwise" else -1
    assert sense == (1 if layout == 1 and angle % 360 > 180 else -1)
    glyphs = engraving.on_arc(engraving.cells("ABC"), 10, reference, math.radians(angle), 50, sense)
    for glyph, expected in zip(glyphs, check["chars"], strict=True):
        assert [glyph.x, glyph.y] == pytest.approx(expected["baseline_mid"], abs=6e-4)
        assert math.remainder(math.degrees(glyph.angle) - expected["glyph_angle"], 360) == pytest.approx(0, abs=6e-4)


@pytest.mark.parametrize("key", list(ARC))
def test_the_cycle_lays_out_as_the_layout(key: str) -> None:
    """The middle of A's feet, its first two lower ends, lies on its baseline."""
    layout, angle, reference = map(int, re.findall(r"_(\d+)", key))
    path = milled(engraved("ABC", Q516=layout, Q374=angle, Q367=reference, Q517=50))
    feet = (path.end[0, :2] + path.end[1, :2]) / 2
    assert feet == pytest.approx(ARC[key]["chars"][0]["baseline_mid"], abs=6e-4)


def test_tokens() -> None:
    found = next(check for code, check in CHECKS if code == "engraving characters")["tokens"]
    assert tokens(r"%CE 50%% %aeA\\B", NOW, 0) == list("".join(found))
    for text, expected in TIMES.items():
        assert "".join(tokens(text, NOW, 0)) == expected
    for text, expected in COUNTS.items():
        assert "".join(tokens(text, NOW, 3)) == expected
    assert "".join(tokens("%oe%ue%AE%OE%UE%ss%D%at@ß", NOW, 0)) == "öüÄÖÜßø@@ß"
    assert tokens(r"a\nb\tc\vd", NOW, 0) == ["a", "\n", "b", "\t", "c", "\v", "d"]


@settings(max_examples=100)
@given(st.text(max_size=20))
def test_any_text_is_engraved_or_refused(text: str) -> None:
    try:
        found = tokens(text, NOW, 12)
    except TextFault:
        return
    assert all(sign in engraving.GLYPHS or sign in "\n\t\v" for sign in found)


@pytest.mark.parametrize("sign", list(engraving.GLYPHS))
def test_strokes_stay_in_their_cell(sign: str) -> None:
    """So that letters beside each other never touch; arcs meet lines without a gap by construction."""
    half = engraving.width(sign) / 2
    for stroke in engraving.strokes(sign):
        low, high = np.min(stroke.points, axis=0), np.max(stroke.points, axis=0)
        x, y = stroke.polyline(0.001).T if hasattr(stroke, "polyline") else stroke.points.T
        assert min(low[0], x.min()) > -half and max(high[0], x.max()) < half
        assert -0.35 < y.min() and y.max() < 1.3


def test_lines_tabs_and_the_arcs_of_lines() -> None:
    """1.597 h to the next line (2384/1493), 8 spaces of a tab; on an arc a lower line has a smaller radius."""
    row = engraving.cells(["A", "\n", "A", "\v", "A", "\t", "A"])
    w, space = engraving.width("A"), engraving.width(" ")
    assert [cell.line for cell in row] == [0, 1, 2, 2]
    assert [cell.pen for cell in row] == pytest.approx([0, 0, w, 2 * w + 8 * space])
    glyphs = engraving.on_line(row, 10, 1, 0)
    assert [g.y for g in glyphs] == pytest.approx([0, -15.968, -31.936, -31.936], abs=1e-3)
    arcs = engraving.on_arc(row[:2], 10, 0, 0, 50, -1)
    assert [math.hypot(g.x, g.y) for g in arcs] == pytest.approx([50, 50 - 15.968], abs=1e-3)


def test_arcs_are_arcs() -> None:
    path = milled(engraved("O8"))
    arcs = path[path.kind == mnc.Kind.ARC]
    assert np.abs(arcs.sweep) == pytest.approx([math.pi] * 6)


def test_every_parameter_acts() -> None:
    plain = milled(engraved("Ab"))
    assert milled(engraved("Ab", Q513=20)).end[:, :2] == pytest.approx(2 * plain.end[:, :2])
    assert milled(engraved("Ab", Q574=30)).end.tolist() == plain.end.tolist()
    assert milled(engraved("Ab", Q513=0, Q574=50)).end[:, 0].max() > plain.end[:, 0].max()
    assert milled(engraved("Ab", Q514=1)).end[-1, 0] == pytest.approx(plain.end[-1, 0] + engraving.width("A") * 10)
    turned = milled(engraved("Ab", Q374=90)).end
    assert turned[:, 0] == pytest.approx(-plain.end[:, 1]) and turned[:, 1] == pytest.approx(plain.end[:, 0])
    assert set(milled(engraved("Ab", Q201=-1.25)).end[:, 2]) == {18.75}
    assert set(milled(engraved("Ab", Q203=5)).end[:, 2]) == {4.5}
    high = rows(engraved("Ab", Q200=3, Q204=80))
    assert high.end[-1, 2] == 100 and 23 in high.end[:, 2]
    assert 99 in rows(engraved("Ab", Q206=99)).feed and 321 in rows(engraved("Ab", Q207=321)).feed
    for reference, (x, y) in {2: (-0.5, 0), 3: (-1, 0), 4: (-1, -10), 5: (-0.5, -10), 6: (0, -10)}.items():
        long = engraving.length(engraving.cells("Ab")) * 10
        moved = milled(engraved("Ab", Q367=reference)).end[:, :2] - plain.end[:, :2]
        assert moved == pytest.approx(np.broadcast_to([x * long, y], moved.shape))
    assert milled(engraved("Ab", at=(7, 8))).end[:, :2] == pytest.approx(plain.end[:, :2] + (7, 8))


def test_upwards_and_not_at_all() -> None:
    """A positive depth works upwards, with the clearance below; a depth of 0 is not executed."""
    path = rows(engraved("I", Q201=0.5))
    assert 18 in path.end[:, 2] and set(path.end[path.feed == 750, 2]) == {20.5}
    assert len(rows(engraved("A", Q201=0))) == 0


def test_the_text_may_be_a_string_parameter_and_the_time_a_setting() -> None:
    blocks = engraved().program.text.replace('Q500="A"', "QS500=QS1").replace("CYCL DEF", 'QS1 = "A"\nCYCL DEF')
    found = mnc.run(blocks, "tnc-620", mnc.Setup(tools={1: mnc.Tool(radius=0.2)}))
    assert milled(found).end.tolist() == milled(engraved()).end.tolist()
    seconds = datetime.fromisoformat("2018-03-05T07:08:09+00:00").timestamp()
    clock = milled(engraved("%time08", settings={"clock": seconds}))
    assert clock.end.tolist() == milled(engraved("05.03.2018")).end.tolist()
    assert milled(engraved("%count3", settings={"counter": 42})).end.tolist() == milled(engraved("042")).end.tolist()


REFUSED = [
    ("A" * 256, {}, "Q500", "must have at most 255 characters, got 256"),
    ("ä", {}, "Q500", "has the character 'ä', which cannot be engraved: write %ae"),
    ("A^", {}, "Q500", "has the character '^', which cannot be engraved"),
    ("A%", {}, "Q500", "has %, which means nothing"),
    ("%xy", {}, "Q500", "has %xy, which means nothing"),
    ("%time16", {}, "Q500", "has %time16: %time00 to %time15 are allowed"),
    ("A\\", {}, "Q500", "has an incomplete \\"),
    ("A\\q", {}, "Q500", "has an incomplete \\q"),
    ("ABC", {"Q574": 20}, "Q574", "is 20, the text is 28.372 long"),
    ("A", {"Q516": 1}, "Q517", "must be greater than 0 for a text on an arc, got 0"),
    ("A\\nB", {"Q516": 2, "Q517": 9}, "Q500", "line 2 of the text has no radius left"),
    ("A", {"Q513": 0}, "Q513", "and Q574 are both 0"),
    ("A", {"Q513": -1}, "Q513", "must be at least 0"),
    ("A", {"Q514": 10}, "Q514", "must be at least 0 and at most 9.9999, got 10"),
    ("A", {"Q515": 1}, "Q515", "must be one of 0, got 1"),
    ("A", {"Q367": 7}, "Q367", "must be one of 0, 1, 2, 3, 4, 5, 6, got 7"),
    ("A", {"Q374": 361}, "Q374", "must be at least -360 and at most 360, got 361"),
    ("A", {"Q207": 0}, "Q207", "must be greater than 0, got 0"),
    ("\\n", {"Q513": 0, "Q574": 9}, "Q500", "has no character whose height Q574 could give"),
]


@pytest.mark.parametrize(("text", "changed", "address", "message"), REFUSED, ids=[r[3][:30] for r in REFUSED])
def test_refused(text: str, changed: dict, address: str, message: str) -> None:
    alarm = next(a for a in engraved(text, **changed).alarms if a.severity == "alarm")
    assert message in alarm.message and alarm.span[:2] == (4 + list(VALUES).index(address), 1), (
        alarm.message,
        alarm.span,
    )


def test_a_counter_too_large_for_its_digits() -> None:
    alarm = engraved("%count1", settings={"counter": 12}).alarms[0]
    assert "has %count1, and the counter stands at 12" in alarm.message
