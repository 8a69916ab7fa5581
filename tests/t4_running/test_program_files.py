"""Files that a program, a setup or a user names: in the folder of the program, of a size that ends, and files."""

import os
from pathlib import Path

import pytest

import mnclab
from mnclab import Alarm, Setup
from mnclab.geometry import dxf, svg
from mnclab.machine.setup_file import load
from mnclab.path.machines import load as load_machine
from mnclab.text import file

CALL = "0 BEGIN PGM A MM\n1 CALL PGM {}\n2 END PGM A MM\n"
CALLS = [
    CALL, "0 BEGIN PGM A MM\n1 SEL PGM {}\n2 CALL SELECTED PGM\n3 END PGM A MM\n",
    "0 BEGIN PGM A MM\n1 CYCL DEF 12.0 PGM CALL\n2 CYCL DEF 12.1 PGM {}\n3 CYCL CALL\n4 END PGM A MM\n",
]  # fmt: skip
PIPE = [] if not hasattr(os, "mkfifo") else ["pipe.h"]
NO_FILES = [*PIPE, "/dev/zero", "."]


@pytest.fixture
def folder(tmp_path):
    here = tmp_path / "programs"
    here.mkdir()
    for name in ("secret.h", "programs/own.h", "programs/deeper.txt"):
        (tmp_path / name).write_text("0 BEGIN PGM S MM\n1 Q1 = 5\n2 END PGM S MM\n")
    (here / "below").mkdir()
    (here / "below" / "far.h").write_text("0 BEGIN PGM S MM\n1 Q1 = 7\n2 END PGM S MM\n")
    (here / "out.h").symlink_to(tmp_path / "secret.h")
    (here / "round.h").symlink_to("below/../../secret.h")
    (here / "chain.h").symlink_to("out.h")
    (here / "link.h").symlink_to("own.h")
    (here / "down.h").symlink_to("below/far.h")
    (here / "gone.h").symlink_to("nowhere.h")
    for name in PIPE:
        os.mkfifo(here / name)
    return here


def run_main(folder, name, call=CALL, **setup):
    (folder / "main.h").write_text(call.format(name))
    found = mnclab.run(folder / "main.h", "tnc-620", Setup(**setup))
    return found


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("name", ["out.h", "round.h", "chain.h", "OUT.H"])
def test_a_link_that_leads_out_is_refused(folder, name, call):
    found = run_main(folder, name, call)
    alarm = found.alarms[0]
    assert (
        alarm.span
        and "symbolic link to another folder" in alarm.message
        and str(folder.parent) not in str(alarm.message)
    )
    assert "Q1" not in found.variables and len(found.programs) == 1


def test_a_table_that_leads_out_is_refused(folder):
    (folder / "out.d").symlink_to(folder.parent / "secret.h")
    found = run_main(folder, "out.d", "0 BEGIN PGM A MM\n1 SEL TABLE {}\n2 END PGM A MM\n")
    assert "symbolic link to another folder" in found.alarms[0].message


def test_a_link_inside_the_folder_is_a_file(folder):
    assert run_main(folder, "link.h").variables == {"Q1": 5} and run_main(folder, "down.h").variables == {"Q1": 7}


@pytest.mark.parametrize("to", ["loop", "own.h/under", "x" * 255])
def test_a_link_that_leads_nowhere_hides_no_other_file(folder, to):
    (folder / "loop").symlink_to(to)
    (folder / "loop.h").symlink_to("loop")
    assert run_main(folder, "own").variables == {"Q1": 5}
    assert not run_main(folder, "loop").ok


@pytest.mark.parametrize("name", ["gone.h", "../secret.h", *PIPE, "a\0b.h", "/dev/zero"])
def test_what_is_no_file_of_the_folder_is_not_there(folder, name):
    found = run_main(folder, name)
    assert not found.ok and "Q1" not in found.variables


@pytest.mark.parametrize("name", NO_FILES)
def test_no_device_and_no_pipe_is_waited_for(folder, name):
    path = folder / name
    assert "cannot be read: it is no file" in run_main(folder, "SUB", files={"SUB.H": path}).alarms[0].message
    for door in (
        lambda: mnclab.run(path, "mnc"),
        lambda: mnclab.read(path, "mnc"),
        lambda: mnclab.modern(path, "nc-31"),
        lambda: mnclab.editor(str(path), "mnc"),
        lambda: load(path),
        lambda: load_machine(path),
        lambda: svg.contours(path),
        lambda: dxf.contours(path),
    ):
        with pytest.raises(Alarm, match="cannot be read: it is no file"):
            door()


def test_a_name_with_a_nul_is_no_file(folder):
    assert "no file has such a name" in run_main(folder, "SUB", files={"SUB.H": Path("a\0b")}).alarms[0].message
    for door in (lambda: mnclab.run(Path("a\0b"), "mnc"), lambda: load("a\0b"), lambda: svg.contours(Path("a\0b"))):
        with pytest.raises(Alarm, match="no file has such a name"):
            door()


def test_every_file_has_a_bound(folder, monkeypatch):
    """The bound of a program itself is a setting; those that it calls, and other files, have that of the reader."""
    monkeypatch.setattr(file.read, "__defaults__", (20,))
    for found in (run_main(folder, "own.h"), run_main(folder, "SUB", files={"SUB.H": folder / "own.h"})):
        assert "more than" in found.alarms[0].message and found.alarms[0].span.line == 2
    monkeypatch.setattr(file.read, "__defaults__", (70,))
    (folder / "own.h").write_text("; " + "x" * 99)
    found = run_main(folder, "own.h")
    assert "more than" in found.alarms[0].message and found.alarms[0].span.line == 2
