"""Many programs checked at once: what ran, what was refused and why, whatever lies in the folder."""

import csv
import io
import json
import os
import sys
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import pytest

import mnclab
from mnclab import Alarm
from mnclab import __main__ as shell
from mnclab.controls import survey
from mnclab.controls.survey import NOT_READ, RAN, REFUSED, reason

GOOD = "// a square\nG90 G54 S500 M3\nG0 X0 Y0 Z5\nG1 X10.5 F100\n"


@pytest.fixture
def folder(tmp_path):
    """A folder with programs of all sorts, and what else lies about."""
    jobs = tmp_path / "jobs"
    (jobs / "old" / ".hidden").mkdir(parents=True)
    (jobs / "good.mnc").write_text(GOOD)
    (jobs / "old" / "comma.mnc").write_text(GOOD.replace("10.5", "10,5"))
    (jobs / "old" / "again.MNC").write_text(GOOD.replace("10.5", "99,5"))
    (jobs / "old" / ".hidden" / "no.mnc").write_text(GOOD)
    (jobs / "other.mpf").write_text("MCALL CYCLE81(10,0,2,-5)\n")
    (jobs / "empty.nc").write_text("")
    (jobs / "picture.nc").write_bytes(bytes(range(256)) * 50)
    (jobs / "klartext.h").write_text("0 BEGIN PGM A MM\n1 L X+5 R0 FMAX\n2 END PGM A MM\n")
    (jobs / "notes.md").write_text("G0 X5\n")
    return jobs


def rows(found):
    return {row.file.replace(os.sep, "/"): row for row in found.rows}


def test_every_program_below_the_folder_has_its_row(folder):
    found = rows(mnclab.check(folder))
    assert list(found) == [
        "empty.nc", "good.mnc", "klartext.h", "other.mpf", "picture.nc", "old/again.MNC", "old/comma.mnc",
    ]  # fmt: skip
    assert {name: row.status for name, row in found.items()} == {
        "good.mnc": RAN, "klartext.h": RAN, "old/comma.mnc": REFUSED, "old/again.MNC": REFUSED,
        "other.mpf": NOT_READ, "empty.nc": NOT_READ, "picture.nc": NOT_READ,
    }  # fmt: skip
    good, comma = found["good.mnc"], found["old/comma.mnc"]
    assert good[:7] == ("good.mnc", RAN, "mnc", 4, 2, 0, 0) and good.first is None and good.reason == ""
    assert (comma.line, comma.alarms, comma.control) == (4, 1, "mnc")


def test_files_stopped_for_the_same_reason_are_counted_together(folder):
    first, *others = mnclab.check(folder).reasons
    assert first.files == 2 and "',' is no part of a number" in first.reason
    assert first.example.replace(os.sep, "/") == "old/again.MNC:4" and all(one.files == 1 for one in others)


@pytest.mark.parametrize(
    ("sentence", "without"),
    [
        ("G83 K (depth of one peck) must be greater than 0, got -1.5", "G83 K (depth of one peck) must be greater than …, got …"),
        ("CYCL DEF 200 Q201 (depth) is missing", "CYCL DEF 200 Q201 (depth) is missing"),
        ("X10.5 has no meaning in this block", "X… has no meaning in this block"),
        ("M98 is refused: not built", "M98 is refused: not built"),
        ("label 'HOLE 7' does not exist", "label … does not exist"),
        ("N40 labels two blocks", "N… labels two blocks"),
    ],
)
def test_a_reason_is_the_sentence_without_its_values(sentence, without):
    assert reason(sentence) == without


def test_suffixes_control_and_setup_are_chosen(folder):
    assert list(rows(mnclab.check(folder, suffixes=["h"]))) == ["klartext.h"]
    assert "notes.md" in rows(mnclab.check(folder, suffixes="*"))
    assert rows(mnclab.check(folder, "mnc", suffixes=[".md"]))["notes.md"].status == RAN
    limits = mnclab.Limits(travel=((-5, 5), (-5, 5), (-5, 9)))
    stopped = rows(mnclab.check(folder / "good.mnc", setup=mnclab.Setup(limits=limits)))
    assert [row.status for row in stopped.values()] == [REFUSED]


def test_it_shows_itself(folder):
    found = mnclab.check(folder)
    assert found.summary == "7 files: 2 ran, 2 refused, 3 not read (mnc 3, tnc-620 1)" and not found.ok
    assert str(found).endswith(found.summary) and "old" in str(found)
    page = found._repr_html_()
    assert page.count("<table>") == 2 and "SINUMERIK" in page and "<script" not in page
    assert mnclab.check([folder / "good.mnc", str(folder / "klartext.h")]).ok


def test_what_was_checked_before_ctrl_c_is_told(folder, monkeypatch, capsys):
    obey, begun = survey.run, []

    def interrupted(*arguments):
        begun.append(arguments)
        if len(begun) == 3:
            raise KeyboardInterrupt
        return obey(*arguments)

    monkeypatch.setattr(survey, "run", interrupted)
    found = mnclab.check(folder)
    assert found.interrupted and len(found.rows) == 2 and not found.ok
    begun.clear()
    assert shell.main(["check", str(folder)]) == 130 and "interrupted" in capsys.readouterr().out


@pytest.mark.parametrize("many", [
    lambda where: mnclab.check(where, jobs=2),
    lambda where: mnclab.run_many(where),
    lambda where: mnclab.run_many(where, executor=ThreadPoolExecutor(2)),
    pytest.param(lambda where: mnclab.run_many(where, executor=processes("spawn")), marks=pytest.mark.deep),
    pytest.param(lambda where: mnclab.run_many(where, executor=processes("fork")), marks=pytest.mark.deep),
    pytest.param(lambda where: of_dask(where), marks=pytest.mark.deep),
], ids=["jobs", "all cores", "threads", "spawn", "fork", "dask"])  # fmt: skip
def test_whoever_shares_the_files_finds_the_same(folder, many):
    for k in range(20):
        (folder / f"{k}.mnc").write_text(GOOD.replace("10.5", str(k)))
    assert [row.as_dict() for row in many(folder).rows] == [row.as_dict() for row in mnclab.check(folder).rows]


def processes(begun):
    return ProcessPoolExecutor(2, get_context(begun))


def of_dask(where):
    """The example of `run_many`: a cluster of dask, here of two workers on this machine."""
    from distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        return mnclab.run_many(where, executor=client.get_executor())


def test_a_process_that_dies_is_told(folder):
    with pytest.raises(Alarm, match="a process ended by itself"):
        mnclab.run_many(folder, executor=Broken())
    with pytest.raises(Alarm, match="jobs must be at least 1, got 0"):
        mnclab.check(folder, jobs=0)


class Broken(ThreadPoolExecutor):
    """As an executor whose process was killed."""

    def map(self, *given, **more):
        raise BrokenExecutor


def test_a_fault_of_the_library_does_not_end_the_others(folder, monkeypatch):
    obey = survey.run

    def failing(file, *arguments):
        if file.name == "good.mnc":
            raise ZeroDivisionError("division by zero")
        return obey(file, *arguments)

    monkeypatch.setattr(survey, "run", failing)
    found = rows(mnclab.check(folder))
    assert found["good.mnc"].status == NOT_READ and "mnclab itself failed: ZeroDivisionError" in found["good.mnc"].reason
    assert found["klartext.h"].status == RAN


@pytest.mark.skipif(sys.platform != "linux", reason="names of files are bytes only there")
def test_names_that_cannot_be_shown_keep_their_rows(tmp_path):
    """A line end, an escape and a byte that is no letter in the names; each stays in one line of the tables."""
    for name in (b"a\nb.mnc", b"\x1b[31m.mnc", b"\xff.mnc"):
        Path(os.fsdecode(bytes(tmp_path) + b"/" + name)).write_text("G0 X1\n")
    found = mnclab.check(tmp_path)
    assert found.ok and [row.file for row in found.rows] == ["?[31m.mnc", "a?b.mnc", "?.mnc"]
    assert all(line.isprintable() for line in str(found).encode().decode().split("\n"))


def test_a_file_that_cannot_be_read_is_a_row(tmp_path):
    (tmp_path / "gone.mnc").symlink_to(tmp_path / "nothing.mnc")
    found = mnclab.check([tmp_path, tmp_path / "none.mnc"])
    assert [row.status for row in found.rows] == [NOT_READ, NOT_READ]
    assert all("cannot be read" in row.reason for row in found.rows)


@pytest.mark.parametrize("wrong", [5, None, b"jobs", [5]])
def test_what_is_no_folder_is_an_alarm(wrong):
    with pytest.raises(Alarm, match="in a folder or in files"):
        mnclab.check(wrong)


def test_the_command_prints_the_table_and_its_status(folder, capsys):
    assert shell.main(["check", str(folder)]) == 1
    out, err = capsys.readouterr()
    assert err == "" and "good.mnc" in out and out.rstrip().endswith("(mnc 3, tnc-620 1)")
    assert shell.main(["check", str(folder), "--suffixes", ".h"]) == 0
    assert "1 file: 1 ran" in capsys.readouterr().out
    assert shell.main(["check", "-j", "2", str(folder)]) == 1 and capsys.readouterr().out == out


def test_the_command_as_json_and_csv(folder, capsys):
    assert shell.main(["check", "--json", str(folder)]) == 1
    told = json.loads(capsys.readouterr().out)
    assert (told["ran"], told["refused"], told["not read"], told["interrupted"]) == (2, 2, 3, False)
    assert told["reasons"][0]["files"] == 2 and len(told["files"]) == 7
    assert shell.main(["check", "--csv", str(folder)]) == 1
    lines = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert [line["file"] for line in lines][:2] == ["empty.nc", "good.mnc"] and lines[-1]["line"] == "4"


def test_material_is_no_matter_of_a_folder(folder, capsys):
    with pytest.raises(SystemExit) as end:
        shell.main(["check", "--material", str(folder)])
    assert end.value.code == 2 and "--material is for files" in capsys.readouterr().err


@pytest.mark.parametrize("width", [60, 80, 109, 110, 160])
def test_a_table_for_a_terminal_is_no_wider_than_that(tmp_path, width):
    folder = tmp_path / "programs"
    folder.mkdir()
    long = folder / "a_name_as_long_as_programs_of_cam_systems_have_them_final.nc"
    long.write_text("%\nO1\nG21 G90\nG150 X1 (POCKET)\n%\n")
    folder.joinpath("short.nc").write_text("%\nO1\nG21 G90\nG0 X1 Y1\n%\n")
    found = mnclab.check(folder)
    lines = found.text(width).split("\n")
    assert max(map(len, lines)) <= width
    assert any(line.startswith("short.nc ") and line.endswith(" ran") for line in lines)
    assert "them_final.nc " in lines[2] and "refused: line 4: G150" in lines[2]
    assert ("blocks" in lines[0]) == (width >= 110)
    assert long.name in repr(found)


def test_a_notebook_shows_whole_sentences(tmp_path):
    said = "this looks like a lathe program of the FANUC kind, which is none of mnclab's controls"
    turned = "%\nO5\nG50 S2000\nG96 S150 M3\nG0 X50. Z2.\nG71 U2. R1.\nN10 G0 X20.\nN20 G1 Z-20.\n%\n"
    tmp_path.joinpath("turned.nc").write_text(turned)
    assert f"not read: {said}".replace("'", "&#x27;") in mnclab.check(tmp_path)._repr_html_()
