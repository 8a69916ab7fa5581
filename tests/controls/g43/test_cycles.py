"""The drilling cycles of ISO controls, against LinuxCNC where both have them (tests/authorities/generate_g43.py)."""

import json
from functools import partial
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from tools import running
from tools.together import together

import mnclab
from mnclab import Kind, Setup, Tool

RECORDS = json.loads((Path(__file__).parents[2] / "authorities" / "g43.json").read_text("utf-8"))["records"]
KINDS = {"rapid": Kind.RAPID, "line": Kind.LINE}


def joined(rows):
    """Rows (line, kind, end, feed); two rapids on one after the other along Z, the same way, are one."""
    found = []
    for row in rows:
        if len(found) > 1 and row[1] == found[-1][1] == Kind.RAPID:
            a, b, c = (np.array(one[2]) for one in (found[-2], found[-1], row))
            if (a[:2] == b[:2]).all() and (b[:2] == c[:2]).all() and (b - a)[2] * (c - b)[2] > 0:
                found.pop()
        found.append(row)
    return found


@together("record", RECORDS, lambda record: record["name"].rpartition("-")[0], lambda record: record["name"])
def test_against_linuxcnc(record):
    run = mnclab.run(record["text"] + "M2\n", "g43", Setup(settings={"dialect": "linuxcnc"}))
    assert run.ok and not run.alarms
    moves = run.toolpath.motion
    ours = joined(zip(moves.line.tolist(), moves.kind.tolist(), moves.end.round(9).tolist(), moves.feed.tolist()))
    theirs = joined(
        (m["line"], KINDS[m["kind"]], np.round(m["to"], 9).tolist(), m.get("feed", np.inf)) for m in record["motion"]
    )
    assert [row[:2] for row in ours] == [row[:2] for row in theirs]
    assert np.abs(np.array([row[2] for row in ours]) - [row[2] for row in theirs]).max() < 2e-9
    assert [row[3] for row in ours] == pytest.approx([row[3] for row in theirs])

run = partial(running.run, control="g43")


def test_a_hole_under_length_compensation():
    """The cycle's first motion takes the offset up: the tip drills to Z-10 with the tool's own length."""
    found = run("T2 M6\nG43 S800 M3 F100\nG81 X5 Y5 Z-10 R2\nG80\n", tools={2: Tool(length=120)}, start=(0, 0, 300))
    motion = found.toolpath.motion
    assert motion.end[:, 2].tolist() == [300, 2, -10, 2, 300]  # register 300 stays: with its offset the tip is at 300


def test_dwells_count_milliseconds():
    found = run("F100 Z9\nG82 X5 Z-10 R2 P1500\nG4 P250\nG4 X2\n")
    assert found.toolpath[found.toolpath.kind == Kind.DWELL].time.tolist() == [1.5, 0.25, 2]


@pytest.mark.parametrize(("code", "senses"), [("G84", [1, -1, 1]), ("G74", [-1, 1, -1])])
def test_tapping(code, senses):
    found = run(f"S400 M{3 if code == 'G84' else 4} F500 Z9\n{code} X5 Z-10 R2\n")
    path = found.toolpath
    assert [np.sign(speed) for speed in path[path.kind == Kind.SPINDLE].spindle] == [senses[0], senses[1], senses[2]]
    threads = path[path.synchronous]
    assert threads.feed.tolist() == [500, 500] and (threads.per_rev == 500 / 400).all()


def test_fine_boring_leaves_the_wall():
    found = run("S400 M3 F50 Z9\nG76 X5 Y1 Z-10 R2 Q0.3\n")
    ends = found.toolpath.motion.end.tolist()
    assert ends[3:7] == [[5, 1, -10], [4.7, 1, -10], [4.7, 1, 2], [5, 1, 2]]


def test_every_code_of_another_chapter_is_remarked_once():
    """If the setting wants it; by default a run says nothing of them, and the table of functions does."""
    text = "G91 X1\nG91 X1\nG2 X2 R1 F100\nX2 R1\n"
    assert not mnclab.run(text, "g43").alarms
    assert mnclab.controls["g43"].functions["G2"].source == "ISO meaning"
    found = mnclab.run(text, "g43", Setup(settings={"undescribed": "warn"}))
    assert [str(alarm).split(": ", 2)[2].split(":")[0] for alarm in found.alarms] == ["G91", "G2"]


# --- from one cycle to the next ---------------------------------------------------------------------------------------

WORDS = dict.fromkeys(("G81", "G84", "G74", "G85", "G86"), "")
WORDS |= {"G82": "P100", "G89": "P100", "G83": "Q5", "G73": "Q5", "G76": "Q.5"}
START = "G90 F120 S800 M3\nG0 X0 Y0 Z9\n"


@together(
    "first second back dimension", product(WORDS, WORDS, ["G98", "G99"], ["G90", "G91"]),
    lambda first, second, back, dimension: f"{first} before others",
)  # fmt: skip
def test_hole_data_hold_among_the_cycles(first, second, back, dimension):
    """The second cycle with X alone is the one with Z, R and F written again, at the levels of the first."""
    hole = "Z-20 R2" if dimension == "G90" else "Z-22 R-7"
    before = f"{START}{back} {dimension} {first} X10 Y5 {hole} F90 {WORDS[first]}\n"
    short = run(f"{before}{second} X40 {WORDS[second]}\nX50\nG80\n")
    spelt = run(
        f"{before}G90 {second} X{40 if dimension == 'G90' else 50} Z-20 R2 F90 {WORDS[second]}\n{dimension} X50\nG80\n"
    )
    for name in ("kind", "end", "feed", "time", "spindle"):
        assert np.array_equal(getattr(short.toolpath, name), getattr(spelt.toolpath, name), equal_nan=True), name
    assert short.toolpath.motion.end[-1, 2] == (9 if back == "G98" else 2)


def test_q_and_p_hold_where_they_mean_the_same():
    """The peck of G83 is that of G73, the dwell of G82 that of G89; the shift of G76 is no peck."""
    rows = run(f"{START}G99 G83 X10 Z-20 R2 Q11\nG73 X40\n").toolpath.motion
    cuts = rows[(rows.kind == Kind.LINE) & (rows.end[:, 0] == 40) & (rows.end[:, 2] < rows.start[:, 2])]
    assert cuts.end[:, 2].tolist() == [-9, -20]
    path = run(f"{START}G99 G82 X10 Z-20 R2 P700\nG81 X30\nG89 X40 P800\nG82 X50\n").toolpath
    assert path[path.kind == Kind.DWELL].time.tolist() == [0.7, 0.8, 0.8]
    alarm = mnclab.run(f"{START}G83 X10 Z-20 R2 Q5\nG76 X40\n", "g43").alarms[-1]
    assert alarm.message == "G76 Q (shift off the wall) is missing" and alarm.span.line == 4


@pytest.mark.parametrize("between", ["G80", "G80 G0 X1"])
def test_hole_data_end_with_g80(between):
    alarm = mnclab.run(f"{START}G83 X10 Z-20 R2 Q5\n{between}\nG73 X40 Q8\n", "g43").alarms[-1]
    assert (alarm.message, alarm.span.line) == ("G73 Z (bottom of the hole) is missing", 5)


def test_the_spindle_of_linuxcnc_turns_as_the_thread_does():
    """rs274 on G74 under M3: "Spindle turning clockwise in G74"; on the others the cycle turns the spindle itself."""
    tools = {1: mnclab.Tool(radius=3, number=1, kind="tap", pitch=1)}
    for code, good, bad in (("G84", "M3", "M4"), ("G74", "M4", "M3")):
        text = f"G21 G90 G17 S100 {{}} T1 M6\nG0 X0 Y0 Z5\n{code} X1 Y1 Z-3 R1 F100\nG80\nM30\n"
        for dialect in ("fanuc", "haas", "linuxcnc"):
            setup = mnclab.Setup(tools=tools, settings={"dialect": dialect})
            assert mnclab.run(text.format(good), "g43", setup).ok
            run = mnclab.run(text.format(bad), "g43", setup)
            said = [alarm.message for alarm in run.alarms]
            assert said == ([f"{code} needs {good}, as its thread turns (LinuxCNC)"] if dialect == "linuxcnc" else [])


@pytest.mark.parametrize(("text", "message"), [
    ("G70", "G70 is no unit on Haas but drills holes on a circle: not built"),
    ("G71", "G71 is no unit on Haas but drills holes on an arc: not built"),
    ("G70 I50. J15. L8", "G70 I50 drills holes on a circle (Haas)"),
    ("G71 I50. J15. K30. L8", "G71 I50 drills holes on a circle (Haas)"),
])  # fmt: skip
def test_bolt_hole_circles_of_haas_are_no_units(text, message):
    """Haas Mill Operator's Manual: G70 Bolt Hole Circle, G71 Bolt Hole Arc; inches and millimetres are G20 and G21."""
    run = mnclab.run(text + "\nG0 X1\n", "g43", mnclab.Setup(settings={"dialect": "haas"}))
    assert [alarm.message for alarm in run.alarms] == [message]
