"""A run that stopped has done a part of its program: every verdict, table and sheet says how far it goes, and none of them
passes. Where it stops is written in the programs below; that nothing met anything before is seen from them."""

import functools
import json

import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.__main__ import main
from mnclab.workpiece.collision import Collisions

BLANK = ((0, 0, -20), (60, 40, 0))
TOOLS = {1: Tool(number=1, radius=5, kind="mill", length=80, cutting_length=30)}
HEAD = "T1 M6\nS1000 M3\nG43 H1 G0 X-10 Y20 Z5\n"
STOPS = {
    "first": ("G777\n" + HEAD, "up to line 1, where the run stopped"),
    "midway": (HEAD + "G0 Z-4\nG1 X30 F300\nG777\nG1 X70\nM30\n", "up to line 6, where the run stopped"),
    "called": (HEAD + "G0 Z-4\nG65 P9001\nM30\n", "up to O9001:3, where the run stopped"),
    "reading": (HEAD + "G0 Z-4\nG1 X30 F300\nG1 X?\nM30\n", "up to line 6, where the run stopped"),
    "travel": (HEAD + "G0 Z-4\nG1 X30 F300\nG1 X9000\nM30\n", "up to line 6, where the run stopped"),
}
FILES = {"O9001": "O9001\nG1 X30 F300\nG777\nM99\n"}
LIMITS = mnclab.Limits(travel=((-500, 500), (-500, 500), (-500, 500)))


@functools.cache
def stopped(name, **more):
    text, reach = STOPS[name]
    run = mnclab.run(text, "g43", Setup(tools=TOOLS, stock=BLANK, files=FILES, limits=LIMITS, **more))
    assert not run.ok
    assert run.reach == reach
    return run, reach


def html(shown):
    return shown._repr_html_()


VERDICTS = {
    "collisions": lambda run: repr(run.collisions()),
    "collisions, as JSON": lambda run: json.dumps(run.collisions().as_dict()),
    "collisions, a page": lambda run: html(run.collisions()),
    "the card": html,
    "the part": lambda run: repr(run.workpiece()),
    "removal": lambda run: repr(run.removal()),
    "removal, a page": lambda run: html(run.removal()),
    "the outcome": lambda run: run.outcome().html(),
    "compared": lambda run: repr(run.workpiece().compare(mnclab.Design(BLANK))),
    "compared, a page": lambda run: html(run.workpiece().compare(mnclab.Design(BLANK))),
    "compared with itself": lambda run: run.workpiece().compare(run.workpiece()).verdict,
    "measurements": lambda run: repr(run.measurements),
    "measurements, a page": lambda run: html(run.measurements),
    "measurements, in words": lambda run: run.measurements.verdict,
    "holes": lambda run: repr(run.holes()),
    "holes, a page": lambda run: html(run.holes()),
    "two by their holes": lambda run: repr(mnclab.diff(run, run, what="holes")),
    "two paths": lambda run: repr(mnclab.diff(run, run)),
    "two paths, a page": lambda run: html(mnclab.diff(run, run)),
    "cutting data": lambda run: repr(run.cutting_data()),
    "cutting data, a page": lambda run: html(run.cutting_data()),
    "times": lambda run: repr(run.profile()),
    "times, a page": lambda run: html(run.profile()),
    "moments": lambda run: repr(run.when("z < -100")),
    "moments, a page": lambda run: html(run.when("z < -100")),
    "the design": lambda run: "\n".join(run.design().notes),
}  # fmt: skip


@pytest.mark.parametrize("stop", STOPS)
@pytest.mark.parametrize("verdict", VERDICTS)
def test_says_how_far_it_goes(verdict, stop):
    run, reach = stopped(stop)
    assert reach in VERDICTS[verdict](run)


@pytest.mark.parametrize("stop", STOPS)
def test_nothing_passes(stop):
    run, _ = stopped(stop)
    met, same = run.collisions(), run.workpiece().compare(run.workpiece())
    assert isinstance(met, tuple) and len(met) == (stop == "travel")  # the cut that would have left the travel
    assert met and not met.ok and not met.as_dict()["ok"]
    assert not same.ok and not same.as_dict()["ok"]
    assert not mnclab.diff(run, run, what="holes").same
    assert not mnclab.diff(run, run).complete


@pytest.mark.parametrize("sheet", ["report", "setup_sheet", "tool_sheet"])
def test_sheets_say_it_too(sheet, tmp_path):
    run, reach = stopped("midway")
    assert reach in getattr(run, sheet)(tmp_path / "a.html").read_text("utf-8")


def test_a_whole_run_passes_and_says_nothing():
    run = mnclab.run(STOPS["midway"][0].replace("G777\n", ""), "g43", Setup(tools=TOOLS, stock=BLANK))
    met = run.collisions()
    assert run.ok and run.reach == "" and run.halt is None
    assert met.ok and not met and repr(met) == "no collisions"
    assert met.as_dict() == {"ok": True, "reach": "", "sentence": "no collisions", "notes": [], "collisions": []}
    assert run.workpiece().compare(run.workpiece()).ok and mnclab.diff(run, run, what="holes").same
    assert not any("stopped" in tell(run) for tell in VERDICTS.values())


def test_the_part_after_a_line_is_whole():
    """Whoever asks for the part after a line that was reached has all of it."""
    run, _ = stopped("midway")
    part = run.workpiece(line=5)
    assert part.notes == () and part.compare(part).ok


def test_a_run_that_moves_nothing_was_not_judged():
    met = mnclab.run("G17\nM30\n", "g43", Setup(tools=TOOLS, stock=BLANK)).collisions()
    assert repr(met) == "no collisions since nothing moves" and not met.ok


def test_rows_without_a_tool_were_not_judged():
    text = "G54 S1000 M3\nG0 X-10 Y20 Z-4\nG1 X70 F300\nM30\n"
    met = mnclab.run(text, "g43", Setup(tools={}, stock=BLANK)).collisions()
    assert len(met) == 0 and not met.ok and "rows without a tool" in repr(met)


def test_the_shell_fails_and_says_so(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.nc").write_text(STOPS["midway"][0])
    setup = '[stock]\nlow = [0, 0, -20]\nhigh = [60, 40, 0]\n'
    (tmp_path / "blank.toml").write_text(setup)
    assert main(["check", "--material", "--control", "g43", "--setup", "blank.toml", "a.nc"]) == 1
    assert "a.nc: note: no collisions up to line 6, where the run stopped" in capsys.readouterr().err
    assert main(["check", "--material", "--json", "--control", "g43", "--setup", "blank.toml", "a.nc"]) == 1
    (told,) = json.loads(capsys.readouterr().out)
    assert told["collisions"] == [] and told["reach"] == "up to line 6, where the run stopped"


def test_collisions_are_counted_up_to_there():
    assert repr(Collisions(reach="up to line 3, where the run stopped")) == "no collisions up to line 3, where the run stopped"


@pytest.mark.parametrize("tapped", [True, False])
def test_a_thread_that_nothing_cuts_is_not_cut(tapped):
    """A core drilled through, 6.8 mm for M8, with and without the tap after it; 250 mm/min at 200 rev/min are its pitch."""
    text = "T2 M6\nS1000 M3\nG43 H2 G0 X20 Y20 Z5\nG98 G81 Z-25 R2 F100\nG80\nG0 Z50\n"
    tap = "T3 M6\nS200 M3\nG43 H3 G0 X20 Y20 Z5\nG98 G84 Z-22 R5 F250\nG80\nG0 Z50\n"
    tools = {2: Tool(number=2, radius=3.4, kind="drill", length=80), 3: Tool(number=3, radius=4, kind="tap", length=80)}
    run = mnclab.run(text + tap * tapped + "M30\n", "g43", Setup(tools=tools, stock=BLANK))
    assert run.ok
    drawn = mnclab.Design(BLANK, [mnclab.design.Hole(20, 20, None, thread="M8")])
    (row,) = [row for row in run.workpiece().compare(drawn).features if row.measure == "thread"]
    assert row.verdict == ("ok" if tapped else "not cut") and row.ok is tapped
