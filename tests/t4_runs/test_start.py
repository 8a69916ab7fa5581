"""Starting at a block: the rest of the path is that of the whole run, and what is missed is named."""

import json
from pathlib import Path

import numpy as np
import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab import Alarm, Kind
from mnclab import __main__ as shell

SAMPLES = sorted(
    file for file in (Path(__file__).parents[2] / "data" / "programs").glob("*/*") if file.stat().st_size < 1500
)

HEAD = "N10 G17 G90 G54\nN20 T2 S900 M3\nN30 M8\nN40 G0 X0 Y0 Z20\nN50 G1 Z2 F300\n"
REST = "N60 X10\nN70 Y25 F120\nN80 G91 X5 Z-4\nN90 G90 G2 X25 Y25 I5 J0\nN100 G0 Z20\nN110 M30\n"


def about(run):
    return {one.about: one.says for one in run.missed}


def test_the_rest_is_what_a_head_of_the_same_state_does():
    """By hand what line 7 finds: G1 G90 G54, T2, S900 M3, M8, F300, the tool at X10 Y0 Z2; then the same blocks."""
    by_hand = "G17 G90 G54\nT2 S900 M3\nM8\nG0 X10 Y0 Z2\nG1 F300\n" + REST.split("\n", 1)[1]
    wanted = mnclab.run(by_hand, "mnc").toolpath
    started = mnclab.run(HEAD + REST, "mnc").start_at(7)
    path, n = started.toolpath, len(started.toolpath)
    for name in ("kind", "start", "end", "feed", "spindle", "sweep", "tool", "radius"):
        assert np.array_equal(getattr(path, name), getattr(wanted[-n:], name), equal_nan=True), name
    assert path.start[0].tolist() == [10, 0, 2] and path.line[0] == 7 and path[0].feed == 120
    assert list(path.motion.kind) == [Kind.LINE, Kind.LINE, Kind.ARC, Kind.RAPID]


def test_what_is_missed_is_named_in_order_and_with_its_line():
    started = mnclab.run(HEAD + REST, "mnc").start_at(9)
    assert [one.about for one in started.missed] == ["tool", "spindle", "coolant", "position", "active"]
    assert [one.line for one in started.missed] == [2, 2, 3, 8, 0]
    says = about(started)
    assert says["tool"].startswith("put in T2") and says["spindle"] == "turn it clockwise at 900 rev/min"
    assert says["position"] == "go to X15 Y25 Z-2" and says["coolant"] == "switch on M8"
    assert "G91" in says["active"] and "feed 120 mm/min" in says["active"] and "G17" not in says["active"]
    (warning,) = [alarm for alarm in started.alarms if "the program starts here" in alarm.message]
    assert (warning.span.line, warning.severity) == (9, "warning") and "first put in T2" in warning.message
    assert started.ok and "put in T2" in repr(started.missed) and "<table>" in started.missed._repr_html_()


def test_a_speed_is_told_with_its_own_line_and_a_rotation_only_while_it_is_active():
    program = "G54 S900 M3\nG68 X0 Y0 R30\nG0 X10 Y0\nG69\nS1200\nG0 X20 Y0\n"
    turned, ended = (mnclab.run(program, "g43").start_at(line) for line in (3, 6))
    assert [one.line for one in ended.missed if one.about == "spindle"] == [5]
    assert "rotation angle 30" in about(turned)["active"] and "rotation" not in about(ended).get("active", "")


@pytest.mark.parametrize("file", deep_but_one_in(3, SAMPLES), ids=lambda file: file.name)
def test_the_path_is_the_end_of_the_whole_one(file):
    run = mnclab.run(file)
    for line in sorted({int(line) for line in run.lines()}):
        try:
            started = run.start_at(line)
        except Alarm as alarm:
            assert "describes a contour" in alarm.message
            continue
        begin = run.at(line).step
        assert (started.toolpath.step >= begin).all() and len(started.toolpath) == (run.toolpath.step >= begin).sum()
        if len(started.toolpath):
            before = run.toolpath[run.toolpath.step < begin]
            stood = before.end[-1] if len(before) else run.toolpath.start[0]
            assert np.array_equal(started.toolpath.start[0], stood)
        assert started.at(line).state == run.at(line).state and started.variables == run.variables


def test_the_first_block_misses_nothing():
    run = mnclab.run(HEAD + REST, "mnc")
    started = run.start_at(1)
    assert started.missed == () and repr(started.missed) == "nothing is missed" and len(started.alarms) == len(run.alarms)
    assert len(started.toolpath) == len(run.toolpath) and run.missed == ()


def test_a_cycle_and_a_compensation_that_reach_over_the_start_are_named():
    holes = mnclab.run("G90 G54 T2 S500 M3\nG0 X0 Y0 Z20\nG83 X10 Y10 Z-9 R2 K4 F90\nX30\nX50\nG80\n", "mnc").start_at(5)
    assert "G83" in about(holes)["cycle"] and any("cycle: G83" in alarm.message for alarm in holes.alarms)
    cut = mnclab.run("G90 G54 T1 S500 M3\nG0 X-20 Y0 Z0\nG1 G41 X0 F90\nY40\nX40\nG40 Y60\n", "mnc").start_at(5)
    assert "to the left" in about(cut)["compensation"] and cut.toolpath[0].line == 5
    assert abs(cut.toolpath.start[0, 0]) == cut.toolpath.radius[0]  # it begins beside the contour


KLARTEXT = (
    "0 BEGIN PGM A MM\n1 TOOL CALL 2 Z S900\n2 L X+0 Y+0 Z+5 FMAX M3\n3 Q1 = 4\n4 CALL LBL 1\n5 LBL 2\n6 L IX+Q1 F100\n"
    "7 CALL LBL 2 REP 2\n8 M30\n9 LBL 1\n10 L IY+7 F200\n11 LBL 0\n12 END PGM A MM\n"
)


def test_a_start_inside_a_repeat_or_a_sub_program_is_named():
    run = mnclab.run(KLARTEXT, "tnc-620")
    second = run.start_at(7, pass_=2)
    assert "a repeat (2 times more), entered at program:8" in about(second)["inside"]
    assert second.toolpath.motion.end[:, 0].tolist() == [8, 12] and "Q1 = 4" in about(second)["variables"]
    assert "a sub-program" in about(run.start_at(11))["inside"] and "inside" not in about(run.start_at(7))


def test_a_start_before_the_call_has_the_whole_sub_program():
    run = mnclab.run(KLARTEXT, "tnc-620").start_at(5)
    assert run.toolpath.motion.end[:, 1].tolist() == [7, 7, 7, 7] and run.toolpath.motion.end[:, 0].tolist() == [0, 4, 8, 12]


@pytest.mark.parametrize(
    ("line", "said", "hint"),
    [
        (99, "line 99 holds no block", ""), (0, "line 0 holds no block", "the next one stands in line 1"),
        (13, "the program does not come to line 13", ""),
    ],
)  # fmt: skip
def test_where_no_program_can_start_the_reason_is_told(line, said, hint):
    with pytest.raises(Alarm, match=said) as found:
        mnclab.run(KLARTEXT, "tnc-620").start_at(line)
    assert found.value.hint == hint


def test_a_line_behind_an_alarm_is_not_come_to():
    with pytest.raises(Alarm, match="does not come to line 3") as found:
        mnclab.run("G0 X1\nG1 X5\nG0 X3\n", "mnc").start_at(3)
    assert "program:2:" in found.value.hint and "feed" in found.value.hint


def test_a_pass_that_does_not_exist_is_told():
    run = mnclab.run(KLARTEXT, "tnc-620")
    with pytest.raises(Alarm, match="line 7 is executed 3 times, pass_ 4 does not exist"):
        run.start_at(7, 4)
    with pytest.raises(Alarm, match="there is no program 3"):
        run.start_at(7, program=3)


def test_a_contour_of_a_cycle_is_no_place_to_start():
    text = (
        "0 BEGIN PGM A MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 BLK FORM 0.2 X+90 Y+90 Z+0\n3 TOOL CALL 1 Z S900\n"
        "4 L X+0 Y+0 Z+50 FMAX M3\n5 CYCL DEF 14.0 CONTOUR\n6 CYCL DEF 14.1 CONTOUR LABEL 1\n"
        "7 CYCL DEF 20 CONTOUR DATA Q1=-8 Q2=+1 Q3=+0.2 Q4=+0.1 Q5=+0 Q6=+2 Q7=+50 Q8=+0.5 Q9=+1\n"
        "8 CYCL DEF 22 ROUGH-OUT Q10=-4 Q11=100 Q12=300 Q18=0 Q19=0 Q208=500\n9 CYCL CALL\n10 M30\n"
        "11 LBL 1\n12 L X+10 Y+10 RL\n13 L X+70\n14 L Y+70\n15 L X+10\n16 L Y+10\n17 LBL 0\n18 END PGM A MM\n"
    )
    run = mnclab.run(text, "tnc-620")
    assert run.ok, run.alarms
    with pytest.raises(Alarm, match="line 14 describes a contour for a cycle"):
        run.start_at(14)
    assert len(run.start_at(10).toolpath)


def test_an_inch_program_tells_its_place_in_inches():
    run = mnclab.run("G20 G90 G54\nS500 M3\nG0 X1.5 Y0 Z2\nG1 Z-.25 F5\nX3\n", "iso")
    assert about(run.start_at(5))["position"] == "go to X1.5 Y0 Z-0.25"


def test_another_setup_starts_at_the_same_block():
    again = mnclab.run(HEAD + REST, "mnc").start_at(7).again(mnclab.Setup(datums={1: (100, 0, 0)}))
    assert again.toolpath.line[0] == 7 and again.missed


def test_the_commands_start_at_a_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("a.mnc").write_text(HEAD + REST)
    assert shell.main(["run", "a.mnc", "--start-at", "7"]) == 0
    out, err = capsys.readouterr()
    assert out.split()[0] == "7" and "first put in T2" in err
    with pytest.raises(SystemExit) as end:
        shell.main(["run", "a.mnc", "--start-at", "99"])
    assert end.value.code == 2
    assert "line 99 holds no block" in capsys.readouterr().err
    assert shell.main(["time", "a.mnc", "--start-at", "9", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)
    assert shell.main(["plot", "a.mnc", "--start-at", "9", "-o", "a.csv"]) == 0 and Path("a.csv").exists()
