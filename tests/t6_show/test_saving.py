"""Every file that is written: whole or as it was, through links, and without the folders of this machine."""

import os
import stat
from itertools import product

import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab import Alarm
from mnclab.show.export import BODIES, WRITERS

PROGRAM = "T1 S500 M3\nG90 G54\nG0 X0 Y0 Z5\nG1 X10 F100\nG3 X20 Y10 I0 J10\nG1 X30 K5\n"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A run with an alarm, of a program in a folder with a name that is found again."""
    path = tmp_path_factory.mktemp("folder-of-mine") / "part.mnc"
    path.write_text(PROGRAM)
    found = mnclab.run(path, "mnc")
    assert not found.ok
    return found


SAVES = {suffix: (lambda run, path: run.save(path)) for suffix in WRITERS} | {
    **{suffix: (lambda run, path: run.save(path, of="path")) for suffix in BODIES},
    ".svg true": lambda run, path: run.save(path, true_size=True),
    ".html report": lambda run, path: run.report(path),
    ".pdf report": lambda run, path: run.report(path),
    ".html player": lambda run, path: run.player().save(path),
}


@pytest.fixture(params=SAVES)
def save(request, tmp_path):
    """save(run) writes one kind of file to `save.path`."""

    class Save:
        path = tmp_path / f"out{request.param.split()[0]}"

        def __call__(self, run):
            return SAVES[request.param](run, self.path)

    return Save()


def test_a_link_a_mode_and_a_file_beside_stay_and_no_file_names_a_folder(run, save, tmp_path):
    (tmp_path / "far").mkdir()
    target = tmp_path / "far" / save.path.name
    target.write_bytes(b"old")
    target.chmod(0o604)
    save.path.symlink_to(target)
    (tmp_path / f"{save.path.name}.part").write_text("mine")
    assert save(run) == save.path
    assert save.path.is_symlink() and len(target.read_bytes()) > 100 and stat.S_IMODE(target.stat().st_mode) == 0o604
    assert (tmp_path / f"{save.path.name}.part").read_text() == "mine"
    assert sorted(os.listdir(tmp_path)) == sorted(["far", save.path.name, f"{save.path.name}.part"])
    assert os.listdir(target.parent) == [target.name] and b"folder-of-mine" not in target.read_bytes()


FAULTS = deep_but_one_in(5, product(SAVES, [KeyboardInterrupt, OSError(28, "No space left on device")]))


@pytest.mark.parametrize("save, fault", FAULTS, indirect=["save"])
def test_a_fault_on_the_way_leaves_the_old_file(run, save, tmp_path, monkeypatch, fault):
    """Everything is written, and then the disk is full, or Ctrl-C is pressed."""

    def fail(number):
        raise fault

    save.path.write_bytes(b"old")
    monkeypatch.setattr(os, "fsync", fail)
    with pytest.raises(Alarm if isinstance(fault, OSError) else fault):
        save(run)
    assert save.path.read_bytes() == b"old" and os.listdir(tmp_path) == [save.path.name]


def test_a_disk_that_is_full_on_the_way_is_an_alarm(run, save, tmp_path):
    resource = pytest.importorskip("resource")
    save.path.write_bytes(b"old")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))
    try:
        with pytest.raises(Alarm, match="cannot be written"):
            save(run)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert save.path.read_bytes() == b"old" and os.listdir(tmp_path) == [save.path.name]


def test_no_page_names_a_folder(run):
    assert "folder-of-mine" in str(run.alarms[0])  # the shell and editors want the whole path
    assert "folder-of-mine" not in run.player().page and "folder-of-mine" not in str(run.summary())


def test_a_file_of_another_kind_is_not_written_over(run, tmp_path):
    (tmp_path / "out.csv").symlink_to("/dev/null")
    with pytest.raises(Alarm, match="cannot be written: it is no file"):
        run.save(tmp_path / "out.csv")
    with pytest.raises(Alarm, match="No such file"):
        run.save(tmp_path / "none" / "out.csv")
    with pytest.raises(Alarm, match="no file has such a name"):
        run.player().save(tmp_path / "a\0.html")


def test_half_a_letter_is_written_as_a_question_mark(save):
    """A text of Python may hold half of a pair of surrogates, which no file can."""
    half = mnclab.run("G0 X1 // \ud800\nG1 X5 F100\nG1 X6 K\udfff\n", "mnc")
    object.__setattr__(half.program, "name", "\ud800.mnc")
    save(half)
    assert save.path.stat().st_size > 100


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_numbers_without_an_end_are_null(tmp_path):
    found = mnclab.run("G0 X1\nG1 X5 F0.000000000000000002\n", "mnc", mnclab.Setup(start=(9e8, 0, 0)))
    found.save(tmp_path / "out.json")
    assert "Infinity" not in (tmp_path / "out.json").read_text()


pytest.importorskip("ipywidgets")


def test_the_editor_saves_through_a_link_and_spares_a_part(tmp_path, monkeypatch):
    (tmp_path / "far").mkdir()
    target, link, part = tmp_path / "far" / "real.mnc", tmp_path / "a.mnc", tmp_path / "a.mnc.part"
    target.write_bytes(b"G0 X5\r\n")
    target.chmod(0o600)
    link.symlink_to(target)
    part.write_text("mine")
    box = mnclab.editor(str(link))
    box.text.value += "Y5\n"
    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", lambda number: (_ for _ in ()).throw(OSError(28, "No space left on device")))
        box.button.click()
        assert "No space left" in box.status.value and target.read_bytes() == b"G0 X5\r\n"
    box.button.click()
    assert "saved" in box.status.value and target.read_bytes() == b"G0 X5\r\nY5\r\n" and link.is_symlink()
    assert stat.S_IMODE(target.stat().st_mode) == 0o600 and part.read_text() == "mine"
    assert os.listdir(tmp_path / "far") == ["real.mnc"] and len(os.listdir(tmp_path)) == 3
