"""`mnclab send`: what a control takes moves as the program did; what would not run is not sent."""

import re
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import __main__ as shell

PROGRAMS = Path(__file__).parents[2] / "data" / "programs"
SENT = [
    ("mnc/first_path.mnc", ".mnc"), ("mnc/compensated.mnc", ".mnc"), ("tnc-620/lid.h", ".H"), ("tnc-620/holes.h", ".H"),
    ("tnc-620/cover.i", ".I"), ("jnc-t01/shaft.jnc", ".jnc"), ("g43/bolt_circle.nc", ".nc"),
]  # fmt: skip


@pytest.mark.parametrize("name, suffix", SENT)
def test_what_is_sent_moves_as_the_program_does(name, suffix, tmp_path):
    source = PROGRAMS / name
    assert shell.main(["send", str(source), "-o", str(tmp_path), "--name", "part_1"]) == 0
    sent = (tmp_path / f"PART_1{suffix}").read_bytes()
    assert sent.count(b"\n") == sent.count(b"\r\n") == len(sent.splitlines())
    own = mnclab.run(source)
    other = mnclab.run(sent.decode("cp1251"), own.control.name)
    assert not other.alarms
    for column in ("kind", "start", "end", "feed", "tool"):
        assert np.array_equal(getattr(own.toolpath, column), getattr(other.toolpath, column), equal_nan=True), column
    assert {path.name for path in tmp_path.iterdir()} == {
        f"PART_1{suffix}", "PART_1_first_run.txt", "PART_1_setup.html", "PART_1_tools.html"
    }  # fmt: skip


def test_an_answer_is_sent_with_the_tools_and_the_blank_of_its_exercise(tmp_path, capsys):
    (tmp_path / "mnc-07.mnc").write_text(mnclab.exercise("mnc-07").solution())
    assert shell.main(["send", str(tmp_path / "mnc-07.mnc"), "--exercise", "mnc-07", "-o", str(tmp_path / "stick")]) == 0
    assert "the blank is clamped as drawn" in (tmp_path / "stick" / "MNC-07_first_run.txt").read_text()
    with pytest.raises(SystemExit):
        shell.main(["send", str(tmp_path / "mnc-07.mnc"), "--exercise", "mnc-77"])
    assert "there is no exercise" in capsys.readouterr().err


def test_a_klartext_program_bears_the_name_of_its_file_and_is_numbered_from_0(tmp_path):
    shell.main(["send", str(PROGRAMS / "tnc-620/lid.h"), "-o", str(tmp_path), "--name", "deckel"])
    lines = (tmp_path / "DECKEL.H").read_text("ascii").splitlines()
    assert lines[0].startswith("0 BEGIN PGM DECKEL MM ;") and lines[-1] == f"{lines[-1].split()[0]} END PGM DECKEL MM"
    numbers = [int(line.split()[0]) for line in lines if line.split()[0].isdigit()]
    assert numbers == list(range(len(numbers)))


@pytest.mark.parametrize("text", [
    "BEGIN PGM A INCH ; note\nTOOL CALL 1 Z S900\nL X+1 R0 F9 M3\nEND PGM A INCH\n",
    "0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z S900\n2 L X+1 R0 F9 M3\n3 END PGM A INCH\n",
    "TOOL CALL 1 Z S900\nL X+1 R0 F9 M3\n",
])  # fmt: skip
def test_the_unit_of_a_klartext_program_stays(text, tmp_path):
    source = tmp_path / "in.h"
    source.write_text(text)
    assert shell.main(["send", str(source), "--control", "tnc-620", "-o", str(tmp_path)]) == 0
    sent = (tmp_path / "IN.H").read_text("ascii")
    assert mnclab.run(sent, "tnc-620").toolpath.end[-1, 0] == pytest.approx(25.4 if "INCH" in text else 1.0)
    assert [line.split()[0] for line in sent.splitlines()] == ["0", "1", "2", "3"] and "PGM A" not in sent


def test_frames_to_key_in_are_counted_and_are_those_of_the_program(tmp_path):
    source = PROGRAMS / "nc-31/shaft.nc31"
    assert shell.main(["send", str(source), "-o", str(tmp_path)]) == 0
    head, *rows = (tmp_path / "SHAFT.txt").read_text("ascii").splitlines()
    frames = re.findall(r"N\d+ \S+", "\n".join(rows))
    assert head == f"SHAFT: {len(frames)} frames"
    own, keyed = mnclab.run(source), mnclab.run("\n".join(frames), "nc-31")
    assert np.array_equal(own.toolpath.end, keyed.toolpath.end) and np.array_equal(own.toolpath.start, keyed.toolpath.start)


def test_the_first_run_is_watched_at_the_first_cut_of_each_tool(tmp_path):
    source = tmp_path / "two.mnc"
    source.write_text("G17 G90 G54 T1 S900 M3\nG0 X5 Y6 Z7\nG1 Z-1 F100\nX20\nG0 Z50\nT2 S500\nG0 X9\nM0\nG1 Z-2 F90\nG0 Z50\n")
    assert shell.main(["send", str(source), "-o", str(tmp_path)]) == 0
    text = (tmp_path / "TWO_first_run.txt").read_text("utf-8")
    watched = [line.removeprefix("[ ] ") for line in text.partition("is done:\n")[2].splitlines()]
    assert watched == [
        "line 2, T1: the tool comes; is the way free?; X5 Y6 Z7", "line 3, T1: the first cut; X5 Y6 Z-1",
        "line 7, T2: the tool comes; is the way free?; X9 Y6 Z50", "line 8, T2: the program stops; X9 Y6 Z50",
        "line 9, T2: the first cut; X9 Y6 Z-2",
    ]  # fmt: skip


@pytest.mark.parametrize("text, said", [
    ("G17 G90 T1 S900 M3\nG0 X5 W7\n", "W"),  # has an alarm
    ("G17 G90 T1 S900 M3\nG0 X5 // \u4e2d\n", "2:10"),  # a letter that is in no code page of the control
])  # fmt: skip
def test_what_would_not_run_is_not_sent(text, said, tmp_path, capsys):
    source = tmp_path / "odd.mnc"
    source.write_text(text, "utf-8")
    assert shell.main(["send", str(source), "-o", str(tmp_path / "out")]) == 1
    assert said in capsys.readouterr().err and not (tmp_path / "out").exists()


def test_an_odd_name_is_refused(tmp_path):
    with pytest.raises(SystemExit):
        shell.main(["send", str(PROGRAMS / "mnc/first_path.mnc"), "-o", str(tmp_path), "--name", "../x"])


def test_programs_that_are_called_are_named(tmp_path, capsys):
    (tmp_path / "main.h").write_text("BEGIN PGM MAIN MM\nCALL PGM SUB.H\nEND PGM MAIN MM\n")
    (tmp_path / "sub.h").write_text("BEGIN PGM SUB MM\nTOOL CALL 1 Z S900\nL X+1 R0 F9 M3\nEND PGM SUB MM\n")
    assert shell.main(["send", str(tmp_path / "main.h"), "-o", str(tmp_path / "out")]) == 0
    assert "send them too: sub.h" in capsys.readouterr().err.lower()
