"""New numbers of blocks: the jumps follow, the path stays, and everything else of a program is as it was."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tools.together import deep_but_one_in

import mnclab
from mnclab import Alarm
from mnclab import __main__ as shell
from mnclab.text.file import read

ROOT = Path(__file__).parents[2]
SAMPLES = sorted((ROOT / "data" / "programs").glob("*/*")) + sorted(
    file for file in (ROOT / "tests" / "programs").glob("*/*") if file.suffix != ".expected"
)
NUMBERED = [file for file in SAMPLES if re.search(rb"(?im)^[ \t/]*(N[ \t]*)?\d+[ \t]*[A-Z%*;]", file.read_bytes())]


def same_path(one, other):
    for name, column in one.toolpath.columns().items():
        assert np.array_equal(column, other.toolpath.columns()[name], equal_nan=column.dtype.kind == "f"), name


@pytest.mark.parametrize("file", deep_but_one_in(4, NUMBERED), ids=lambda file: f"{file.parent.name}-{file.name}")
def test_a_renumbered_sample_runs_the_same_path(file):
    """Row by row and line by line; the alarms stand where they stood."""
    run = mnclab.run(file, file.parent.name)
    if file.parent.name == "jnc-t01":
        return
    step = 1 if file.parent.name == "nc-31" else 7
    text = mnclab.renumber(run.program, start=3, step=step)
    called = {other.name: other for other in file.parent.iterdir()} if "CALL PGM" in text else {}
    again = mnclab.run(text, file.parent.name, mnclab.Setup(files=called))
    same_path(run, again)
    assert len(again.alarms) == len(run.alarms)
    numbers = re.compile(r"(?im)^([ \t/]*N?[ \t]*)\d+|(?<=P)\d+|(?<=GOTO )\d+")
    assert numbers.sub(r"\1", again.program.text) == numbers.sub(r"\1", run.program.text)


def test_iso_numbers_take_their_jumps_along():
    text = (
        "O1\nN5 #1=0\nN7 G0 X#1\n#1=#1+1\nIF [#1 LT 3] GOTO 7 (back to N7)\nGOTO 20\nX99\nN20 M98 P50\nM30\nO50\n"
        "N5 G1 Z-1 F100\nM99\n"
    )
    assert mnclab.renumber(text, "iso", start=100, step=100) == (
        "O1\nN100 #1=0\nN200 G0 X#1\n#1=#1+1\nIF [#1 LT 3] GOTO 200 (back to N7)\nGOTO 300\nX99\nN300 M98 P50\nM30\nO50\n"
        "N400 G1 Z-1 F100\nM99\n"
    )
    same_path(mnclab.run(text, "iso"), mnclab.run(mnclab.renumber(text, "iso"), "iso"))


def test_a_jump_leads_into_its_own_program():
    """Both programs have an N10; each GOTO means the one of its own."""
    text = "O1\nGOTO 10\nN10 M98 P2\nM30\nO2\nGOTO10\nG0 X5\nN10 G0 X7\nM99\n"
    assert mnclab.renumber(text, "iso").split() == "O1 GOTO 10 N10 M98 P2 M30 O2 GOTO20 G0 X5 N20 G0 X7 M99".split()


def test_m99_p_leads_into_the_program_that_called():
    text = "O1\nN10 M98 P2\nG0 X5\nN30 G0 X7\nM30\nO2\nN20 G0 Y1\nM99 P30\n"
    again = mnclab.renumber(text, "iso", start=1, step=1)
    assert again.endswith("M99 P2\n") and "N2 G0 X7" in again and "N3 G0 Y1" in again
    same_path(mnclab.run(text, "iso"), mnclab.run(again, "iso"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("N10 #1=10\nGOTO #1\n", "GOTO computes the block"),
        ("N10 G0 X1\nGOTO 20\n", "GOTO names block 20, which does not exist"),
        ("O1\nN5 X1\nO3\nN5 X1\nO2\nM99 P5\n", "may name 2 blocks"), ("G0 X1\n", "no block of the program has a number"),
    ],
)  # fmt: skip
def test_what_cannot_follow_is_an_alarm(text, said):
    with pytest.raises(Alarm, match=said):
        mnclab.renumber(text, "iso")


def test_zeros_marks_and_everything_else_stay():
    text = "\ufeff%\r\n N0010  G0 X1.50(N10)\r\n/N0020 Y2 ; N20\r\n/2 n30G1Z-1F5\r\n(A) N40 X#1\r\nX5\r\n"
    assert mnclab.renumber(text, "iso", start=5, step=5) == (
        "\ufeff%\r\n N0005  G0 X1.50(N10)\r\n/N0010 Y2 ; N20\r\n/2 n15G1Z-1F5\r\n(A) N20 X#1\r\nX5\r\n"
    )


def test_klartext_counts_from_zero_and_keeps_its_long_blocks():
    text = (
        "7 BEGIN PGM A MM\n8 ; 5 comments\n9 CYCL DEF 200 DRILLING ~\n  Q200=2 ~\n  Q201=-5\n/ 12 L X+10\n13   L Y+1 ; 8\n"
        "14 END PGM A MM\n"
    )
    assert mnclab.renumber(text, "tnc-620") == (
        "0 BEGIN PGM A MM\n1 ; 5 comments\n2 CYCL DEF 200 DRILLING ~\n  Q200=2 ~\n  Q201=-5\n/ 3 L X+10\n4   L Y+1 ; 8\n"
        "5 END PGM A MM\n"
    )


def test_lines_of_a_cycle_definition_in_parts_count_too():
    numbered = "5 CYCL DEF 14.0 CONTOUR GEOMETRY\n6 CYCL DEF 14.1 CONTOUR LABEL 1\n7 L X+1 R0 FMAX\n"
    counted = [line.split()[0] for line in mnclab.renumber(numbered, "tnc-620", start=0).splitlines()]
    assert counted == ["0", "1", "2"]
    bare = "TCH PROBE 1.0 DATUM PLANE\nTCH PROBE 1.1 X+ANGLE: +180\nTCH PROBE 1.2 X+5 Y+0 Z-5\nL X+1\n"
    assert [line.split()[0] for line in mnclab.renumber(bare, "tnc-620").splitlines()] == ["0", "1", "2", "3"]


def test_klartext_without_numbers_gets_them():
    text = "BEGIN PGM A MM\n\n  L X+10 FMAX\nL Y+1 FMAX\nEND PGM A MM\n"
    assert mnclab.renumber(text, "tnc-620") == "0 BEGIN PGM A MM\n\n  1 L X+10 FMAX\n2 L Y+1 FMAX\n3 END PGM A MM\n"


def test_din_iso_keeps_its_last_block():
    text = "%A G71 *\nN1 T1 G17 S100*\nN2 G98 L5*\nN9 G00 X+5*\nN99999999 %A G71 *\n"
    assert mnclab.renumber(text, "tnc-620") == "%A G71 *\nN10 T1 G17 S100*\nN20 G98 L5*\nN30 G00 X+5*\nN99999999 %A G71 *\n"


FRAMES = "S500\nF20\nN5 X4000~\nN6 Z0~\nX3000\nX4000~\nN20 G25*\nP5008\nN30 M5\n"


def test_frames_of_the_nc_31_are_counted_on_and_ranges_follow():
    """Frames 0 and 1 have no number; N5 to X4000 are 5 to 8, so the range is 5 to 8 before, and 20 to 41 + 1 after."""
    again = mnclab.renumber(FRAMES, "nc-31", start=20, step=20)
    assert again == "S500\nF20\nN20 X4000~\nN40 Z0~\nX3000\nX4000~\nN60 G25*\nP20042\nN80 M5\n"
    same_path(mnclab.run(FRAMES, "nc-31"), mnclab.run(again, "nc-31"))


def test_a_small_step_leaves_room_for_the_frames_between():
    again = mnclab.renumber(FRAMES, "nc-31")
    assert re.findall(r"N(\d+)", again) == ["2", "3", "6", "8"] and "P2005" in again
    same_path(mnclab.run(FRAMES, "nc-31"), mnclab.run(again, "nc-31"))


def test_a_range_has_room_for_three_digits():
    with pytest.raises(Alarm, match="names frames up to 999"):
        mnclab.renumber(FRAMES, "nc-31", start=500, step=500)


@st.composite
def programs(draw):
    """Blocks with numbers in any order, some without, and jumps forward."""
    numbers = draw(st.lists(st.integers(1, 9999), min_size=2, max_size=8, unique=True))
    lines = []
    for k, number in enumerate(numbers):
        jump = draw(st.booleans()) and k + 1 < len(numbers)
        ahead = numbers[draw(st.integers(k + 1, len(numbers) - 1))] if jump else 0
        lines += [f"N{number} G0 X{k}", f"Y{draw(st.integers(0, 9))}", f"GOTO {ahead}" if jump else f"Z{k}"]
    return "\n".join(lines) + "\n"


@given(programs(), st.integers(1, 500), st.integers(1, 50))
def test_random_programs_run_the_same_path(text, start, step):
    again = mnclab.renumber(text, "iso", start=start, step=step)
    run, other = mnclab.run(text, "iso"), mnclab.run(again, "iso")
    assert run.ok and other.ok
    same_path(run, other)
    assert [int(n) for n in re.findall(r"N(\d+)", again)] == list(range(start, start + step * text.count("N"), step))


@pytest.mark.parametrize(("start", "step", "said"), [
    (0, 10, "start must be at least 1"), (10, 0, "step must be at least 1"), (10**22, 1, "must be smaller than 1e"),
    (10**9, 10, "the last number would be"),
])  # fmt: skip
def test_impossible_numbers_are_refused(start, step, said):
    with pytest.raises(Alarm, match=said):
        mnclab.renumber("N1 G0 X1\n", "mnc", start=start, step=step)


def test_a_lathe_without_numbers_says_so():
    with pytest.raises(Alarm, match="blocks of jnc-t01 have no numbers"):
        mnclab.renumber("G0 X1\n", "jnc-t01")


@pytest.mark.parametrize("page", ["utf-8", "utf-8-sig", "cp1251", "utf-16", "koi8-r"])
def test_the_command_writes_the_bytes_of_the_file(tmp_path, capsys, page):
    text = "N5 G0 X1 // начало программы, подвод инструмента\r\nN6 Y2 // конец программы и отвод\r\n"
    file, out = tmp_path / "a.mnc", tmp_path / "b.mnc"
    file.write_bytes(text.encode(page))
    assert shell.main(["renumber", str(file), "--output", str(out)]) == 0
    assert out.read_bytes() == text.replace("N5", "N10").replace("N6", "N20").encode(page)
    assert shell.main(["renumber", str(file), "--start", "1", "--step", "1"]) == 0
    assert capsys.readouterr().out.startswith("N1 G0 X1 // начало")
    assert read(file, file) == text.encode(page)


def test_bytes_that_are_no_letters_are_not_written_back(tmp_path, capsys):
    file = tmp_path / "a.mnc"
    file.write_bytes(b"N5 G0 X1 // " + bytes([0x98, 0xC0, 0xC1]) + b"\n")
    assert shell.main(["renumber", str(file), "-o", str(tmp_path / "b.mnc")]) == 1
    assert "cannot be written back as they are" in capsys.readouterr().err and not (tmp_path / "b.mnc").exists()
