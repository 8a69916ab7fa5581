"""Files of a user: what is refused, and that one that cannot be written stays as it was."""

import os
import stat
import subprocess
import sys
import zlib
from pathlib import Path

import pytest

from mnclab.text import file
from mnclab.text.alarm import Alarm
from mnclab.text.file import read, replaced


def write(path, content=b"new"):
    with replaced(path) as beside:
        beside.write_bytes(content)


def names(folder):
    return sorted(each.name for each in folder.iterdir())


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no such files here")
def test_what_is_no_file_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (
        tmp_path / "pipe",
        Path("/dev/zero"),
        Path("/dev/null"),
        tmp_path,
        tmp_path / "a\0b",
        tmp_path / "none",
    ):
        with pytest.raises(Alarm, match="it cannot be read: "):
            read(path, "it")
    for path in (tmp_path / "pipe", Path("/dev/null"), tmp_path, tmp_path / "a\0b", tmp_path / "none" / "a"):
        with pytest.raises(Alarm, match="cannot be written: "):
            write(path)
    assert names(tmp_path) == ["pipe"] and stat.S_ISCHR(os.stat("/dev/null").st_mode)


def test_a_file_has_a_bound(tmp_path):
    (tmp_path / "a").write_bytes(b"12345")
    assert read(tmp_path / "a", "a", 5) == b"12345"
    with pytest.raises(Alarm, match="more than"):
        read(tmp_path / "a", "a", 4)


def test_a_link_stays_and_its_target_is_written(tmp_path):
    (tmp_path / "far").mkdir()
    target, link = tmp_path / "far" / "real.csv", tmp_path / "link.csv"
    target.write_text("old")
    target.chmod(0o640)
    link.symlink_to(target)
    write(link)
    assert link.is_symlink() and target.read_text() == "new" and stat.S_IMODE(target.stat().st_mode) == 0o640
    (tmp_path / "new.csv").symlink_to(tmp_path / "not-yet.csv")
    write(tmp_path / "new.csv")
    assert (tmp_path / "not-yet.csv").read_text() == "new" and names(tmp_path / "far") == ["real.csv"]


def test_a_new_file_has_the_mode_that_files_have(tmp_path):
    (tmp_path / "plain").write_text("")
    write(tmp_path / "ours")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.parametrize("fault", [KeyboardInterrupt, ValueError, OSError(28, "No space left on device")])
def test_when_it_fails_the_old_file_stays_whole(tmp_path, fault):
    path = tmp_path / "a.svg"
    for name in ("a.svg", "a.svg.part", ".a.svg.part", "a.svg.tmp", "a.svg~"):
        (tmp_path / name).write_text("mine")
    before = names(tmp_path)
    with pytest.raises(Alarm if isinstance(fault, OSError) else fault), replaced(path) as beside:
        assert beside.suffix == ".svg" and beside.parent == tmp_path
        beside.write_text("half")
        raise fault
    assert names(tmp_path) == before and all((tmp_path / name).read_text() == "mine" for name in before)
    write(path)
    assert names(tmp_path) == before and (tmp_path / "a.svg.part").read_text() == "mine"


def test_a_name_that_is_taken_is_no_ones_to_remove(tmp_path, monkeypatch):
    monkeypatch.setattr(file.os, "urandom", lambda n: b"taken")
    name = f".{zlib.crc32(b'a'):08x}-{b'taken'.hex()}"
    (tmp_path / name).write_text("mine")
    with pytest.raises(Alarm, match="File exists"):
        write(tmp_path / "a")
    assert (tmp_path / name).read_text() == "mine"


LIMITED = """
import resource, signal, sys
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
from mnclab.text.alarm import Alarm
from mnclab.text.file import replaced
try:
    with replaced(sys.argv[1]) as beside:
        beside.write_bytes(bytes(5000))
except Alarm as alarm:
    print(alarm.message)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the limit is Linux's")
def test_a_limit_of_file_size_leaves_the_old_file(tmp_path):
    (tmp_path / "a").write_text("old")
    root = Path(file.__file__).parents[2]
    told = subprocess.run([sys.executable, "-c", LIMITED, tmp_path / "a"], capture_output=True, text=True, cwd=root)
    assert "cannot be written: File too large" in told.stdout and told.stderr == ""
    assert names(tmp_path) == ["a"] and (tmp_path / "a").read_text() == "old"
