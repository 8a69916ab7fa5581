"""Words, modal groups, functions of one block, frames, settings; and the two tiers of plain blocks."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tools.running import run

import mnclab
from mnclab import Kind
from mnclab.controls.recognition import looks_like
from mnclab.path.toolpath import COLUMNS
from mnclab.running.bulk import SHORTEST


def obeyed(*blocks, start=(50, 0), **setup):
    return run("\n".join(blocks), "jnc-t01", ok=None, start=(start[0], 0, start[1]), **setup)


def ends(found):
    return found.toolpath.motion.end[:, [0, 2]].tolist()


def test_what_is_active_at_the_start():
    """Table 2: G00, G90, G94; adopted: G97, spindle and coolant off."""
    control = mnclab.controls["jnc-t01"]
    assert set(control.power_on().values()) == {"G0", "G90", "G94", "G97", "M5", "M9"}
    assert obeyed("X10").toolpath[-1].kind == Kind.RAPID


@pytest.mark.parametrize(
    "once", ["G4 F1", "G12 Z-9 R2", "G14 X41 R-2", "G32 Z-9 F1", "G92 X0", "G73 Z-9", "G77 X9 Z-9 D9"]
)
@pytest.mark.parametrize("motion", ["G0", "G1", "G3"])
def test_a_function_that_acts_once_leaves_the_motion_function(once, motion):
    """Before it, or in its own block: the motion function only becomes active, the words belong to the other."""
    head = ["F100 S500 M3", "G1 X49 Z1"]
    after = "X30" if motion != "G3" else "X39 Z1 I-5"
    for lines in ([motion, once], [f"{motion} {once}"], [f"{once} {motion}"]):
        found = obeyed(*head, *lines, "G90", "X49 Z1" if motion != "G3" else "G1 X49 Z1", motion, after)
        assert found.ok, found.alarms
        assert found.history.value("motion", len(found.steps.block) - 1) == motion
        row = found.toolpath[-1]
        assert row.kind == {"G0": Kind.RAPID, "G1": Kind.LINE, "G3": Kind.ARC}[motion]
    first, second = (obeyed(*head, line) for line in (f"{motion} {once}", once))
    assert np.array_equal(first.toolpath.end, second.toolpath.end)


def test_spelling():
    """Lower case, tabs, no blanks, leading zeros, comments, empty lines, any order of words."""
    found = obeyed("g01f100x10.z-5.\t' a comment with X99 and ' another", "", "' alone", "Z-9X.5G00")
    assert found.ok and ends(found) == [[10, -5], [0.5, -9]]
    assert found.program[0].comment == "a comment with X99 and ' another" and found.program[1].comment == "alone"


def test_cyrillic_letters_are_read_and_reported():
    found = obeyed("G00 Х10 ' Х в комментарии", "М3 S500", "т1")
    assert found.ok and ends(found) == [[10, 0]]
    assert [(a.severity, a.span[:2], a.message) for a in found.alarms] == [
        ("warning", (1, 5), "'Х' is a Cyrillic letter, read as X"),
        ("warning", (2, 1), "'М' is a Cyrillic letter, read as M"),
        ("warning", (3, 1), "'т' is a Cyrillic letter, read as T"),
    ]
    assert found.program.text.startswith("G00 Х10")


def test_the_text_says_which_control():
    for text in ("G00 X5 ' rapid\n", "' alone\nX10.Z10.\n"):
        assert looks_like(text, mnclab.controls) == "a program of jnc-t01"
    for text in ("G00 X5\n", "(N1) N1 X5 Y1 ' a\n", "L X+5 ; 'a\n"):
        assert looks_like(text, mnclab.controls) != "a program of jnc-t01"


def test_words_of_other_controls():
    lines = ("%", "N10 G0 X5", "N20 X6", "M30", "X7")
    found = obeyed(*lines, settings={"foreign": "accept"})
    assert ends(found) == [[5, 0], [6, 0]]
    assert [(a.severity, a.span[:2]) for a in found.alarms] == [
        ("warning", (1, 1)),
        ("warning", (2, 1)),
        ("warning", (4, 1)),
    ]
    assert not obeyed(*lines).ok


def test_unknown_m_functions_have_no_effect():
    found = obeyed("M12 M40 X5", "M300")
    assert found.ok and ends(found) == [[5, 0]]
    assert [a.message.split()[0] for a in found.alarms] == ["M12", "M40", "M300"]
    assert {a.severity for a in found.alarms} == {"warning"}


def test_order_inside_a_block():
    """M3 and M7 before the motion, M5 and M9 after it, M0 last; before a dwell all but the stop."""
    kinds = obeyed("M7 X5 M3 S100").toolpath.kind.tolist()
    assert sorted(kinds[:2]) == [Kind.SPINDLE, Kind.COOLANT] and kinds[2] == Kind.RAPID
    kinds = obeyed("M3 S100", "M0 M9 X5 M5").toolpath.kind.tolist()[1:]
    assert kinds[0] == Kind.RAPID and sorted(kinds[1:3]) == [Kind.SPINDLE, Kind.COOLANT] and kinds[3] == Kind.STOP
    kinds = obeyed("M3 S100", "G4 F1 M5 M0").toolpath.kind.tolist()[1:]
    assert kinds == [Kind.SPINDLE, Kind.DWELL, Kind.STOP]


def test_optional_stop_and_m8():
    assert obeyed("M1").toolpath.kind.tolist() == []
    assert obeyed("M1", settings={"optional_stop": True}).toolpath.kind.tolist() == [Kind.STOP]
    found = obeyed("M7", "M8")
    assert (
        found.history.value("coolant", 1) == "M8"
        and "the table of this control says coolant off" in found.alarms[0].message
    )


def test_x_as_a_diameter():
    """X and U are halved, increments too; I, R and D stay on the radius; X3 = X1 + 2 R in words of the program."""
    on = {"diameter": True}
    for radius, diameter in (
        (("G0 X20 Z-5", "G91", "X-4"), ("G0 X40 Z-5", "G91", "X-8")),
        (("F9 G2 X50 Z-20 I5 K-10",), ("F9 G2 X100 Z-20 I5 K-10",)),
        (("F9 G12 Z-30 R10", "G14 X55 R2"), ("F9 G12 Z-30 R10", "G14 X110 R2")),
        (("F9 G77 X20 Z-75 U30 W-60 D6",), ("F9 G77 X40 Z-75 U60 W-60 D6",)),
        (("F9 G91 G78 X-20 Z-30 U-5 W-6 D6",), ("F9 G91 G78 X-40 Z-30 U-10 W-6 D6",)),
        (("F9 G74 X20 Z-5 D6", "G75 X20 Z-5 D2"), ("F9 G74 X40 Z-5 D6", "G75 X40 Z-5 D2")),
        (("G92 X10 Z1", "X0 Z0", "M60"), ("G92 X20 Z1", "X0 Z0", "M60")),
        (("S99 M3", "G32 X45 Z-9 F2"), ("S99 M3", "G32 X90 Z-9 F2")),
    ):
        one, other = obeyed(*radius), obeyed(*diameter, settings=on)
        assert one.ok and other.ok, (one.alarms, other.alarms)
        for name in ("kind", "end", "centre", "feed", "per_rev", "spindle"):
            assert np.allclose(
                getattr(one.toolpath, name), getattr(other.toolpath, name), rtol=0, atol=1e-12, equal_nan=True
            )
    alarm = obeyed("F9 G77 X40 Z-9 U120", settings=on).alarms[0]
    assert "must lie between X100 (the start) and X40 (X of this block), got 120" in alarm.message


def test_homing():
    home = {"home_x": 80, "home_z": 120}
    for code, end in (("M60", [80, 120]), ("M61", [80, 5]), ("M63", [45, 120])):
        found = obeyed("L1", "G92 X10 Z3", "X35 Z2", code, settings=home, correctors={1: (0, 0, 0)})
        assert ends(found)[-1] == end and found.toolpath[-1].kind == Kind.RAPID
        assert found.at(4).position[::2] == (end[0] - 10, end[1] - 3)


def test_a_corrector_acts_with_the_next_motion_of_any_kind():
    """And an arc cannot take it up: its centre and its start would not fit."""
    rows = {3: (0.1, 0, -0.2)}
    assert ends(obeyed("L3", "X40", correctors=rows)) == [[40.1, -0.2]]
    assert ends(obeyed("L3", "F9 G12 Z-9 R1", correctors=rows))[0] == [50.1, -8.2]
    assert ends(obeyed("L3", "F9 G73 Z-9", correctors=rows)) == [[50.1, -9.2], [50.1, -0.2]]
    alarm = obeyed("L3", "F9 G2 X40 Z0 R20", correctors=rows).alarms[0]
    assert alarm.span[0] == 2 and "the arc begins 0.2236 mm away" in alarm.message
    found = obeyed("L7", "X40", "L7", "X41")
    assert ends(found) == [[40, 0], [41, 0]] and [a.span[:2] for a in found.alarms] == [(1, 1)]


@pytest.mark.parametrize(
    ("setting", "value", "lines"),
    [
        ("retract", 2, ("G77 X20 Z-30 D8",)), ("wall", "feed", ("G77 X20 Z-30 U30 D8",)),
        ("arc_tolerance", 3, ("G2 X40 Z2 I-5 K0",)), ("home_x", 9, ("M61",)), ("home_z", 9, ("M63",)),
    ],
)  # fmt: skip
def test_a_setting_changes_the_path(setting, value, lines):
    before, after = obeyed("F100", *lines), obeyed("F100", *lines, settings={setting: value})
    assert after.ok and str(before.toolpath) != str(after.toolpath)


def test_a_hole_of_no_depth_is_said():
    found = obeyed("F9", "G73 Z0")
    assert found.ok and not len(found.toolpath) and "nothing is drilled" in found.alarms[0].message


def test_every_code_of_the_manual_is_there():
    control = mnclab.controls["jnc-t01"]
    g = [0, 1, 2, 3, 4, 12, 14, 32, *range(90, 98)]
    m = [0, 1, 3, 4, 5, 7, 8, 9, 60, 61, 63]
    assert {*(f"G{n}" for n in g), *(f"M{n}" for n in m), *"FSTL"} <= set(control.functions)
    assert list(control.cycles) == ["G73", "G74", "G75", "G77", "G78"]
    assert all(f.title and f.doc and f.source for f in control.functions.values())
    explained = obeyed("F100", "G12 Z-9 R2").explain(line=2)
    assert {"R2", "Z-9"} <= {m.word for m in explained.meanings} and "fillet radius" in str(explained)


# --- plain blocks ----------------------------------------------------------------------------------------------------

number = st.integers(-20_000, 20_000).map(lambda n: f"{n / 1000:g}")
plain = st.tuples(
    st.sampled_from(["", "", "G0 ", "G1 "]),
    st.lists(st.tuples(st.sampled_from("XZ"), number), max_size=2, unique_by=lambda w: w[0]),
    st.sampled_from(["", "", " F200"]),
).map(lambda t: t[0] + " ".join(a + v for a, v in t[1]) + t[2])
arc = st.tuples(
    st.sampled_from(["G2", "G3"]), number, number, st.sampled_from(["R25", "R-40", "I5", "I3 K4", "R2"])
).map(lambda t: f"{t[0]} X{t[1]} Z{t[2]} {t[3]}")
odd = st.sampled_from(
    [
        "G91",
        "G90",
        "L1",
        "L0",
        "G92 X1",
        "M3 S100",
        "G95 F0.1",
        "G94 F80",
        "G93 F2",
        "G96 S50",
        "G97 S90",
        "Y5",
        "' a",
        "G2 R5",
    ]
)


@pytest.mark.deep
@given(st.lists(st.one_of(*[plain] * 12, arc, odd), min_size=2 * SHORTEST, max_size=110))
def test_runs_of_plain_blocks(blocks):
    """Obeyed at once or one by one: the same rows, alarms and history."""
    bulk, single = (
        obeyed("S500 M3 F100", *blocks, correctors={1: (1, 0, 2)}, settings={"bulk": bulk}) for bulk in (True, False)
    )
    assert [str(a) for a in bulk.alarms] == [str(a) for a in single.alarms]
    assert len(bulk.toolpath) == len(single.toolpath)
    for name in COLUMNS:
        left, right = getattr(bulk.toolpath, name), getattr(single.toolpath, name)
        assert np.allclose(left, right, rtol=1e-12, atol=1e-12, equal_nan=True), name
    last = len(single.steps.block) - 1
    assert all(str(bulk.history.value(name, last)) == str(single.history.value(name, last)) for name in single.history)
