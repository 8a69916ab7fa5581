"""Which control a text is for: programs in the manner of each, of makers that are not here, and of none.

`tests/recognition/CONTROL/` holds programs of a control, `none/KIND--NAME` what none reads, `undecided/A+B--NAME` what
may be for two. They are written for this test.
"""

import subprocess
import sys
from pathlib import Path

import pytest

import mnclab
from mnclab import Alarm
from mnclab.controls import CONTROLS
from mnclab.controls.recognition import candidates, leading

FOLDER = Path(__file__).parents[1] / "recognition"
OURS = sorted(file for name in CONTROLS for file in (FOLDER / name).glob("*"))
NONE = sorted((FOLDER / "none").iterdir())
UNDECIDED = sorted((FOLDER / "undecided").iterdir())
KINDS = {
    "sinumerik": "a SINUMERIK program", "okuma": "an OKUMA program", "fagor": "a FAGOR program",
    "fanuc-lathe": "a lathe program of the FANUC kind", "maho": "a MAHO or Philips program",
    "printer": "a program of a 3D printer", "hpgl": "an HPGL drawing",
    "apt": "an APT source or CLDATA", "drawing": "a drawing or a model", "source": "source code or a page",
}  # fmt: skip


@pytest.mark.parametrize(("name", "text"), [("part.nc31", "N1 X100\n"), ("", "BEGIN PGM A MM\nL X+5 R0 FMAX\n")])
def test_only_the_control_that_is_found_is_imported(name, text):
    """The signs of the others are read without what obeys them."""
    code = f"""import sys; from mnclab.controls import CONTROLS; from mnclab.controls.recognition import recognise
found = recognise({name!r}, {text!r}, CONTROLS).name
print(found, *sorted(each for each in sys.modules if each.endswith(".control") and each.count(".") == 3))"""
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert len(said) == 2 and said[1] == f"mnclab.controls.{said[0].replace('-', '_')}.control"


def test_there_are_programs_of_everything():
    assert len(OURS) >= 55 and len(NONE) >= 20 and {file.name.partition("--")[0] for file in NONE} == {*KINDS, "nothing"}


@pytest.mark.parametrize("file", OURS, ids=lambda file: f"{file.parent.name}-{file.name}")
def test_the_control_is_found(file):
    assert mnclab.read(file).control == file.parent.name


@pytest.mark.parametrize("file", OURS, ids=lambda file: f"{file.parent.name}-{file.name}")
def test_the_text_alone_never_points_to_another(file):
    """Without its suffix a short program may say too little, but it says nothing wrong."""
    fitting = leading(candidates("", file.read_text("utf-8"), CONTROLS))
    assert not fitting or file.name.startswith("own.") or file.parent.name in [one.name for one in fitting]


@pytest.mark.parametrize("file", NONE, ids=lambda file: file.name)
def test_what_no_control_reads_is_called_by_its_name(file):
    kind = file.name.partition("--")[0]
    said = "nothing in the text or the file's name says" if kind == "nothing" else f"this looks like {KINDS[kind]}, which is none"
    with pytest.raises(Alarm, match=said) as found:
        mnclab.run(file)
    assert "control= one of mnc, " in found.value.hint and (kind == "nothing" or "line " in found.value.hint)


@pytest.mark.parametrize("file", UNDECIDED, ids=lambda file: file.name)
def test_what_may_be_for_two_is_told_with_the_reasons(file):
    with pytest.raises(Alarm, match="this may be .* or .*: name the control ") as found:
        mnclab.run(file)
    for part in file.name.partition("--")[0].split("+"):
        assert part in found.value.message and part in found.value.hint
    assert "(line 1: " in found.value.hint or "no Y" in found.value.hint
    assert 'control="' in found.value.hint


def test_a_binary_file_is_no_program(tmp_path):
    file = tmp_path / "part.pbg"
    file.write_bytes(bytes(range(256)) * 8)
    with pytest.raises(Alarm, match="binary file"):
        mnclab.run(file)


def test_a_reason_has_the_line_where_it_stands():
    text = "(a head)\n\nG90\n   MCALL CYCLE83(10, 0)\n"
    best = candidates("", text, CONTROLS)[0]
    assert best.name == "a SINUMERIK program" and {finding.line for finding in best.findings} == {4}


@pytest.mark.parametrize("words", ["CALL LBL 5", "BEGIN PGM", "MCALL", "CYCLE81("])
def test_what_a_comment_speaks_of_is_no_sign(words):
    assert mnclab.read(f"(like {words})\nG21 G90\nT1 M6\nG0 X1 Y2 ; {words}\n").control == "g43"


def test_a_long_program_is_judged_by_its_first_lines():
    text = "G21 G90\nT1 M6\n" + "G1 X1.234 Y5.678 F100\n" * 200_000
    assert leading(candidates("", text, CONTROLS))[0].name == "g43"
