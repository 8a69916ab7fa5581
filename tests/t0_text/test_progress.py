"""A bar for long work where tqdm is installed; nothing for short work, in other threads, or without it."""

import sys
import threading
import types

import pytest

import mnclab
from mnclab.running import flow
from mnclab.text import opening as place
from mnclab.text.opening import progress


class Bar:
    made = []

    def __init__(self, total, desc, unit, leave):
        self.total, self.desc, self.unit, self.n, self.open = total, desc, unit, 0, True
        self.seen = []
        Bar.made.append(self)

    def update(self, by):
        self.n += by
        self.seen.append((self.n, self.total))

    def close(self):
        self.open = False


@pytest.fixture
def bars(monkeypatch):
    """The bars made in a test, with a clock that stands at `bars.now`."""
    clock = types.SimpleNamespace(now=0.0, made=[])
    Bar.made = clock.made
    module = types.ModuleType("tqdm.auto")
    module.tqdm = Bar
    monkeypatch.setitem(sys.modules, "tqdm", types.ModuleType("tqdm"))
    monkeypatch.setitem(sys.modules, "tqdm.auto", module)
    monkeypatch.setattr(place.time, "monotonic", lambda: clock.now)
    return clock


def test_a_bar_appears_after_a_moment_and_closes(bars):
    with progress("running", 100, "blocks") as at:
        at(10)
        assert bars.made == []
        bars.now = 1.5
        at(40)
        at(130)
        (bar,) = bars.made
        assert bar.open and (bar.desc, bar.unit) == ("running", " blocks")
    assert bar.seen == [(40, 100), (130, 130)] and not bar.open


def test_it_closes_when_the_work_is_interrupted(bars):
    with pytest.raises(KeyboardInterrupt), progress("running", 100, "blocks") as at:
        bars.now = 2
        at(1)
        raise KeyboardInterrupt
    assert not bars.made[0].open


def test_no_bar_in_another_thread(bars):
    def work():
        with progress("running", 100, "blocks") as at:
            bars.now = 5
            at(50)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert bars.made == []


def test_without_tqdm_nothing_is_shown(bars, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    with progress("running", 100, "blocks") as at:
        bars.now = 5
        at(50)
        at(60)
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize("settings", [{}, {"bulk": False}])
def test_a_run_says_how_far_it_is(bars, monkeypatch, settings):
    monkeypatch.setattr(place, "SOON", -1.0)
    run = mnclab.run("\n".join(f"G1 X{k % 7} F100" for k in range(5000)), "mnc", mnclab.Setup(settings=settings))
    assert run.ok
    (bar,) = bars.made
    assert bar.total == 5000 and (settings == {} or [n for n, _ in bar.seen] == [0, 1024, 2048, 3072, 4096])


def test_an_interrupted_run_leaves_the_collector_on(monkeypatch):
    import gc

    def stop(self, block):
        raise KeyboardInterrupt

    monkeypatch.setattr(flow.Course, "begin", stop)
    with pytest.raises(KeyboardInterrupt):
        mnclab.run("G1 X1 F100", "mnc")
    assert gc.isenabled()


def test_ctrl_c_in_a_shell_is_one_line(monkeypatch, capsys, tmp_path):
    from mnclab.__main__ import main

    def stop(self, block):
        raise KeyboardInterrupt

    (tmp_path / "a.mnc").write_text("G1 X1 F100\n")
    monkeypatch.setattr(flow.Course, "begin", stop)
    assert main(["run", str(tmp_path / "a.mnc")]) == 130
    assert capsys.readouterr() == ("", "mnclab: interrupted\n")
