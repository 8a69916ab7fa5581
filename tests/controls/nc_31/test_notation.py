"""Programs in modern notation: what a frame says by the scale of the source, and where its words lead when obeyed."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Kind, Setup

GROOVE = Path(__file__).parent / "examples" / "fragment_n90_n111.txt"


def modern(*frames):
    return mnclab.modern("\n".join(frames) + "\n", "nc-31").modern.splitlines()[1:]


def test_the_example_of_the_source():
    """105 and 4 are diameters, 2 mm/rev the lead, 0.3 to 1 mm the depths (catalogue, fragment N90 to N111)."""
    text = "".join(line for line in GROOVE.read_text("utf-8").partition("---")[0].splitlines(True) if line[0] != "#")
    assert mnclab.modern(text, "nc-31").modern.splitlines() == [
        "G21 G90 G95 (mm, X on the diameter, feed per revolution)",
        *("S300 M3", "F2.0", "G0 X105.0", "G0 Z10.0", "G1 Z3.0", "G1 Z-0.3"),
        "G1 X4.0 (Stop key blocked, synchronised start)",
        "G1 G9 X0.0 Z3.0 (Stop key blocked)",
        *("G0 X105.0", "G1 Z-0.6", "(repeat N96 to N101)", "G1 Z-0.8", "(repeat N96 to N101)", "G1 Z-1.0"),
        "(repeat N96 to N101 2 times)",
    ]


@pytest.mark.parametrize(
    ("frames", "said"),
    [
        (["G77@*~", "X@-2000*", "Z-5000*", "F1500*", "P1000*", "P500"],
         "G77 U-20.0 Z-50.0 F0.15 P1=10.0 P2=5.0 (infeed at rapid) (ends at point B (X, Z1) instead of the start)"),
        (["G73*", "X6000*", "Z-5000*", "F1000*", "P2000"], "G73 X60.0 Z-50.0 F0.1 P20.0"),
        (["G31*", "X2400*", "Z@-3450*", "F15000*", "P92*", "P25*", "P100"],
         "G31 X24.0 W-34.5 F1.5 P1=0.92 P2=0.25 P3=1.0"),
        (["G32@*", "Z-3000*", "F15000"], "G32 Z-30.0 F1.5 (start at the zero mark of the spindle)"),
        (["G33@*", "Z-2500*", "F12500"], "G33 Z-25.0 F1.25 (start at the zero mark of the spindle)"),
        (["G61@*", "M5"], "G9 M5 (separate in single-block mode)"),
        (["G67~*", "X@-400*", "Z1*", "M9"], "G0 G9 U-4.0 Z0.01 M9 (Stop key blocked, synchronised start)"),
        (["X5*", "Z@-7~"], "G0 X0.05 W-0.07"),
        (["M8 ; on"], "M8"),
        (["G99*", "P5"], "G99 P5 (no function of this control)"),
        (["G77*", "P5*", "P6*", "P7"], "G77 P1=0.05 P2=0.06 P7"),
        (["X1.5"], "(not understood)"),
    ],
)  # fmt: skip
def test_a_command(frames, said):
    assert modern(*frames) == [said]


def test_s_turns_the_spindle_until_an_m_says_how():
    assert modern("S300", "M4", "S500") == ["S300 M3", "M4", "S500"]


MOVE = st.tuples(
    st.sampled_from(["X", "Z", "XZ"]),
    st.integers(-9_999, 9_999),
    st.integers(-9_999, 9_999),
    st.booleans(),
    st.booleans(),
)


@given(st.lists(MOVE, max_size=12))
def test_modern_words_lead_to_the_same_places(moves):
    """A reader of G0, G1, X, Z, U, W written here follows the right column; the library follows the left."""
    frames = ["S100", "F20"]
    for axes, x, z, rapid, relative in moves:
        marks = "~" * rapid + "@" * relative
        frames += ["X{}{}*", "Z{}{}"] if axes == "XZ" else [axes + "{}{}"]
        values = {"X": x, "Z": z}
        frames = [frame.format(values[frame[0]], marks) if "{" in frame else frame for frame in frames]
    run = mnclab.run("\n".join(frames) + "\n", "nc-31", Setup(start=(30, 0, 5)))
    assert not run.alarms
    here, seen = [60.0, 5.0], []
    for line in mnclab.modern(run).modern.splitlines()[3:]:
        words = re.findall(r"([GXZUW])(-?[\d.]+)", line)
        assert "".join(f"{letter}{value} " for letter, value in words).strip() == line
        before = list(here)
        for letter, value in words[1:]:
            axis = "XZ".find(letter) if letter in "XZ" else "UW".find(letter)
            here[axis] = float(value) + (before[axis] if letter in "UW" else 0)
        if here != before:
            seen.append((Kind.RAPID if words[0] == ("G", "0") else Kind.LINE, *here))
    path = run.toolpath.motion
    moved = [(int(kind), x * 2, z) for kind, (x, _, z) in zip(path.kind, path.end, strict=True)]
    assert [step[0] for step in moved] == [step[0] for step in seen]
    assert [step[1:] for step in moved] == [pytest.approx(step[1:], abs=1e-9) for step in seen]


def test_two_columns():
    text = "; a part\nN1 S300\n\nN2 G61* ; stop\nN3 X500\nN4 Z5~\n"
    notation = mnclab.modern(text, "nc-31")
    assert [(row.line, row.original, row.modern, row.lines) for row in notation.rows[1:]] == [
        (1, "; a part", "", 1),
        (2, "N1 S300", "S300 M3", 1),
        (4, "N2 G61* ; stop", "G1 G9 X5.0", 2),
        (5, "N3 X500", "", 0),
        (6, "N4 Z5~", "G0 Z0.05", 1),
    ]
    lines = str(notation).splitlines()
    assert len(lines) == 8 and lines[0].split() == ["NC-31", "modern", "notation"]
    page = notation._repr_html_()
    assert page.count("<tr>") == 7 and 'rowspan="2"><code>G1 G9 X5.0<' in page.replace("; vertical-align:top", "")


def test_only_where_the_notation_is_old():
    with pytest.raises(mnclab.Alarm, match="programs of mnc have no other notation") as refusal:
        mnclab.modern("G0 X5\n", "mnc")
    assert refusal.value.hint == "those of nc-31 have"
