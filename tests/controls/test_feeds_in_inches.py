"""F of programs in inches: tenths of an inch a minute on the TNC 620 (HEIDENHAIN; F100 is 10 in/min, 254 mm/min), inches on ISO.

FU and FZ are inches per revolution and per tooth. The expected feeds are 25.4 / 10 and 25.4 of what stands in the program.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Kind
from mnclab.controls.tnc_620.control import CONTROL as TNC

UNITS = pytest.mark.parametrize(("unit", "length", "feed"), [("MM", 1.0, 1.0), ("INCH", 25.4, 2.54)])
SETUP = mnc.Setup(tools={1: mnc.Tool(radius=1, teeth=4, length=50)}, start=(0, 0, 100))
DRILL = (
    "CYCL DEF 200 D ~\nQ200=1 ~\nQ201=-2 ~\nQ206={} ~\nQ202=2 ~\nQ210=0 ~\nQ203=0 ~\nQ204=1 ~\nQ211=0\n"
    "L X+1 Y+1 R0 FMAX M3\nCYCL CALL\n"
)
BORE = (
    "CYCL DEF 201 D ~\nQ200=1 ~\nQ201=-2 ~\nQ206=77 ~\nQ211=0 ~\nQ208={} ~\nQ203=0 ~\nQ204=1\nL X+1 R0 FMAX M3\nCYCL CALL\n"
)
OLD = "CYCL DEF 1.0 P\nCYCL DEF 1.1 SETUP 1\nCYCL DEF 1.2 DEPTH -2\nCYCL DEF 1.3 PECKG 2\nCYCL DEF 1.4 DWELL 0\n"
#: The words that give a feed, each with the number that it is given.
WORDS = {
    "block": "L X+1 R0 F{} M3\n", "parameter": "Q7=+{}\nL X+1 R0 FQ7 M3\n", "tool call": "TOOL CALL S900 F{}\nL X+1 R0 M3\n",
    "FAUTO": "TOOL CALL S900 F{}\nL X+1 R0 FAUTO M3\n", "arc": "CC X+1 Y+0\nC X+2 Y+0 DR+ F{} M3\n",
    "polar": "CC X+0 Y+0\nLP PR+1 PA+30 F{} M3\n",
    "CR": "CR X+2 Y+0 R+2 DR+ F{} M3\n", "rounding": "L X+2 F1 M3\nRND R0.5 F{}\nL Y+2\n",
    "chamfer": "L X+2 F1 M3\nCHF 0.5 F{}\nL Y+2\n",
    "retraction": "L X+1 FMAX M3\nL M140 MB2 F{}\n", "approach": "APPR LT X+5 Y+5 LEN2 RR F{} M3\nL X+9\nDEP LT LEN2\n",
    "call": DRILL.format(3).replace("CYCL CALL", "CYCL CALL F{}") + "L X+2\n",
    "CYCL CALL POS": DRILL.format(3).replace("CYCL CALL", "CYCL CALL POS X+4 Y+4 Z+0 F{}"),
    "drilling": DRILL, "retracting": BORE, "FAUTO of a cycle": "TOOL CALL S900 F{}\n" + DRILL.format("FAUTO"),
    "GLOBAL DEF": "GLOBAL DEF 100 G ~\nQ200=1 ~\nQ204=1 ~\nQ253=5 ~\nQ208={}\n" + BORE.format("PREDEF"),
    "older cycle": OLD + "CYCL DEF 1.5 F{}\nL X+1 Z+1 R0 FMAX M3\nCYCL CALL\n",
}  # fmt: skip

#: The feeds of all rows of those with more than one: F that of the word, numbers what else the blocks say (99 the TOOL CALL).
ROWS: dict[str, tuple[float | str, ...]] = {
    "rounding": (1, "F", 1), "chamfer": (1, "F", 1), "approach": (99, "F", "F", "F"), "call": (3, "F"),
    "CYCL CALL POS": ("F", "F", 3), "retracting": (77, "F"), "GLOBAL DEF": (77, "F"),
}  # fmt: skip


def klartext(unit: str, blocks: str, **settings: object) -> mnc.Run:
    setup = mnc.Setup(tools=SETUP.tools, start=SETUP.start, settings=settings)
    run = mnc.run(f"BEGIN PGM A {unit}\nTOOL CALL 1 Z S1000 F99\n{blocks}END PGM A {unit}\n", "tnc-620", setup)
    assert run.ok, run.alarms
    return run


def feeds(run: mnc.Run) -> np.ndarray:
    found = run.toolpath.feed[np.isin(run.toolpath.kind, (Kind.LINE, Kind.ARC))]
    return found[np.isfinite(found)]


@UNITS
@pytest.mark.parametrize("word", WORDS)
def test_every_feed_word_of_the_tnc_620(word: str, unit: str, length: float, feed: float) -> None:
    for number, settings, counts in ((40.0, {}, feed), (4.0, {"inch_feed": "inch"}, length)):
        run = klartext(unit, WORDS[word].replace("{}", f"{number:g}"), **settings)
        rows = [number if one == "F" else float(one) for one in ROWS.get(word, ("F",))]
        assert feeds(run) == pytest.approx([one * counts for one in rows], rel=1e-12)


@UNITS
def test_the_feed_of_a_touch(unit: str, length: float, feed: float) -> None:
    """TCH PROBE 3: 100 tenths of an inch a minute are 10 in/min, 254 mm/min; from X-1 two to the right into a wall at X0."""
    touch = "TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q1\nTCH PROBE 3.2 X ANGLE: +0\n"
    touch += "TCH PROBE 3.3 ABST +2 F100 MB0.5 REFERENCE SYSTEM: 0\nTCH PROBE 3.4 ERRORMODE1\n"
    text = f"BEGIN PGM A {unit}\nTOOL CALL 7 Z\nL X-1 Y+0.5 Z-0.1 R0 FMAX\n{touch}END PGM A {unit}\n"
    probe = mnc.Tool(radius=0.2, kind="probe")
    for settings, counts in (({}, feed), ({"inch_feed": "inch"}, length)):
        part = mnc.part.box((0, 0, -30), (100, 60, 0))
        run = mnc.run(text, "tnc-620", mnc.Setup(tools={7: probe}, part=part, start=(-50, 0, 100), settings=settings))
        assert run.ok and run.toolpath.feed[run.toolpath.kind == Kind.PROBE] == pytest.approx([100 * counts])

@UNITS
def test_per_revolution_and_per_tooth(unit: str, length: float, feed: float) -> None:
    """0.01 a turn, and 0.005 a tooth of 4, at 1000 rev/min; as feeds of a cycle, too, whose parameter is F again."""
    assert feeds(klartext(unit, "L X+1 R0 FU0.01 M3\nL X+2 FZ0.005\n")) == pytest.approx([10 * length, 20 * length])
    run = klartext(unit, DRILL.format("FU0.01"))
    assert 10 * length == pytest.approx(feeds(run)[0]) and run.variables["Q206"] == pytest.approx(10 * length / feed)


@UNITS
def test_din_iso(unit: str, length: float, feed: float) -> None:
    code = {"MM": 71, "INCH": 70}[unit]
    run = mnc.run(f"%A G{code} *\nN10 T1 G17 S1000 F30*\nN20 G01 G40 X+1 F40 M3*\nN30 G01 X+2*\nN99 %A G{code} *\n", "tnc-620")
    assert run.ok and feeds(run).tolist() == [40 * feed] * 2


@UNITS
def test_many_plain_blocks_at_once(unit: str, length: float, feed: float) -> None:
    blocks = "".join(f"L X+{k} F{100 + k}\n" for k in range(100))
    found = [klartext(unit, "L X-1 R0 FMAX M3\n" + blocks, bulk=bulk) for bulk in (True, False)]
    for run in found:
        assert feeds(run) == pytest.approx(np.arange(100, 200) * feed, rel=1e-12)


@UNITS
def test_a_called_program_has_its_own_unit(unit: str, length: float, feed: float) -> None:
    called = f"BEGIN PGM B {unit}\nL X+1 F10\nEND PGM B {unit}\n"
    for other, counts in (("MM", 1.0), ("INCH", 2.54)):
        text = f"BEGIN PGM A {other}\nTOOL CALL 1 Z S1\nL Y+1 F10 M3\nCALL PGM B\nL Y+2 F20\nEND PGM A {other}\n"
        run = mnc.run(text, "tnc-620", mnc.Setup(files={"B.H": called}))
        assert feeds(run) == pytest.approx([10 * counts, 10 * feed, 20 * counts])


@UNITS
def test_axes_that_turn_alone_count_degrees(unit: str, length: float, feed: float) -> None:
    """F is degrees a minute, as in programs in mm: that the unit of lengths does not touch it is a reading."""
    run = klartext(unit, "L C+90 R0 F30 M3\n")
    assert feeds(run) == pytest.approx([math.radians(30)])


def test_axes_of_the_iso_mill_that_turn_alone() -> None:
    """LinuxCNC, G94: where only rotary axes move F is degrees a minute."""
    for unit in ("G20", "G21"):
        run = mnc.run(f"{unit}\nT1 M6\nS500 M3\nG1 A90 F30\n", "g43")
        assert run.ok and feeds(run) == pytest.approx([math.radians(30)])


@pytest.mark.parametrize(("unit", "length"), [("G21", 1.0), ("G20", 25.4), ("G71", 1.0), ("G70", 25.4)])
def test_the_iso_mill_counts_inches(unit: str, length: float) -> None:
    run = mnc.run(f"{unit}\nT1 M6\nG0 X0 Z9 S500 M3\nG1 X1 F40\nG81 X2 Z-1 R1 F30\nG80\nG95 G1 X3 F0.01\n", "g43")
    assert run.ok and np.unique(feeds(run).round(9)).tolist() == pytest.approx(sorted({40 * length, 30 * length, 5 * length}))


def test_what_is_told_are_the_numbers_of_the_program() -> None:
    run = klartext("INCH", "L X+1 R0 F40 M3\n")
    assert "F40" in str(run.toolpath) and "feeds in 0.1 in/min" in run.toolpath._repr_html_()
    assert "feed 40 x 0.1 in/min" in str(run.at(3)) and "feed: 99 -> 40" in str(run.explain(3))
    run = klartext("INCH", "BLK FORM 0.1 Z X+0 Y+0 Z-1\nBLK FORM 0.2 X+4 Y+3 Z+0\nL X+1 R0 F40 M3\n")
    assert "stock X0 Y0 Z-1 to X4 Y3 Z0" in " ".join(str(run.at(5)).split())
    run = klartext("INCH", "L X+1 R0 F40 M3\n", inch_feed="inch")
    assert "F40" in str(run.toolpath) and "feed 40 in/min" in str(run.at(3))


@pytest.mark.parametrize(
    ("blocks", "told"),
    [
        ("L X+1 F-100\n", "F (feed rate) must be greater than 0, got -100"), ("L X+1 F1\nRND R-0.5\n", "got -0.5"),
        ("BLK FORM 0.1 Z X+0 Y+0 Z-1\nBLK FORM 0.2 X-2 Y+1 Z+0\n", "must be greater than 0, got -2"),
        ("L X+1 R0 F1 M3\nCR X+3 R+0.5 DR+\n", "R0.5 is too small"),
        (DRILL.format(99999), ""), (DRILL.format(100000), "must be at least 0 and at most 99999.999, got 100000"),
        ("CYCL DEF 208 B ~\nQ200=1 ~\nQ201=-2 ~\nQ206=9 ~\n"
         "Q334=0.1 ~\nQ203=0 ~\nQ204=1 ~\nQ335=0.05 ~\nQ342=0 ~\nQ351=1\nL X+1 FMAX M3\nCYCL CALL\n",
         "must be at least the tool diameter 2, got 1.27 (lengths in mm, the program says 0.05)"),
    ],
)  # fmt: skip
def test_alarms_name_the_number_that_was_written(blocks: str, told: str) -> None:
    run = mnc.run(f"BEGIN PGM A INCH\nTOOL CALL 1 Z S1000 F9\n{blocks}END PGM A INCH\n", "tnc-620", SETUP)
    assert any(told in alarm.message for alarm in run.alarms) if told else run.ok


def test_blocks_below_a_fault_are_judged_in_their_unit() -> None:
    """99999 tenths of an inch is within the range of Q206; 100001 is not, whatever stopped the run above."""
    for fault in ("L X\n", "L X+1 R0\n"):  # in reading, and in running: no feed
        text = f"BEGIN PGM A INCH\nTOOL CALL 1 Z S1000\n{fault}{DRILL.format(99999)}{DRILL.format(100001)}END PGM A INCH\n"
        first, second = mnc.run(text, "tnc-620").alarms
        assert first.span is not None and first.span.line == 3 and second.span is not None
        assert second.message.endswith("Q206 (feed rate for plunging) must be at least 0 and at most 99999.999, got 100001")
        assert text.splitlines()[second.span.line - 1] == "Q206=100001 ~"


def test_the_setting_has_its_source() -> None:
    (setting,) = (one for one in TNC.settings if one.name == "inch_feed")
    assert setting.default == "tenth" and "HEIDENHAIN" in setting.source and set(setting.choices) == {"tenth", "inch"}
