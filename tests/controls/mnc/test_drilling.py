"""What the manual says of the drilling cycles beyond their examples: levels, what is modal, which cycle ends which.

Chapter 9 and 9.1: Z (W), R and F are modal, K and P are not; the initial level does not change while the cycle is
active; the cycles are of one group (table 1.2), so one ends the other.
"""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Kind, Setup, Tool
from mnclab.machine import trial

HEAD = "G54 G90 G0 X0 Y0 Z50 F120\n"


def holes(program, **setup):
    """Level R, the depths reached at feed and the level at the end, for every line that drills."""
    run = mnclab.run(HEAD + program, "mnc", Setup(**setup))
    assert run.ok, run.alarms
    path, found = run.toolpath, {}
    for line in sorted(set(path.line[path.kind == Kind.LINE].tolist())):
        rows = path[path.line == line]
        feeds = [k for k in range(len(rows)) if rows.kind[k] == Kind.LINE]
        depths = tuple(rows.end[k][2] for k in feeds)
        found[line - 1] = (rows.start[feeds[0]][2], depths, rows.end[-1][2])
    return found


@pytest.mark.parametrize("second", ["X40", "G83 X40", "G83 X40 Z-25", "G83 X40 R3", "G83 X40 Z-25 R3 F120"])
def test_modal_words_hold_whether_the_code_is_written_again_or_not(second):
    assert holes(f"G99 G83 X20 Z-25 R3\nG98 {second}\n") == {1: (3, (-25,), 3), 2: (3, (-25,), 50)}


def test_the_initial_level_does_not_change_under_g99():
    """9: "the initial level does not change even when the cycle runs under G99": the last hole ends at 50."""
    found = holes("G99 G83 X20 Z-25 R3\nG83 X30 Z-25 R3\nX40\nG98 X50\n")
    assert [end for _, _, end in found.values()] == [3, 3, 3, 50]


def test_the_initial_level_is_that_of_the_first_call_after_g80():
    assert holes("G83 X20 Z-25 R3\nG80 G0 Z30\nG83 X40 Z-25 R3\n") == {1: (3, (-25,), 50), 3: (3, (-25,), 30)}


def test_levels_stay_as_they_were_programmed():
    """A new R keeps the bottom of an absolute Z, and the depth of W or of an incremental Z (z_R - 10, z_R + Z)."""
    program = """\
G83 X1 Z-25 R3
X2 R10
G91 X1 R-45
W10
G90 R8
Z-3
G91 Z-4
R-40
"""
    assert holes(program) == {
        1: (3, (-25,), 50),
        2: (10, (-25,), 50),  # Z absolute: the bottom stays
        3: (5, (-25,), 50),  # z_R = 50 - 45
        4: (5, (-5,), 50),  # W counts from R
        5: (8, (-2,), 50),  # and keeps the depth 10
        6: (8, (-3,), 50),
        7: (8, (4,), 50),  # incremental Z: 8 - 4
        8: (10, (6,), 50),  # 50 - 40, and the depth 4 stays
    }


def test_pecks_count_from_r_and_need_not_divide_the_depth():
    """Depth 3 - (-25) = 28, pecks of 10: -7, -17, -25; K of at least the depth is one pass."""
    assert holes("G83 X1 Z-25 R3 K10\nX2 K28\nX3 K100\n") == {
        1: (3, (-7, -17, -25), 50),
        2: (3, (-25,), 50),
        3: (3, (-25,), 50),
    }


def test_the_feed_of_g83_stays_and_that_of_g300_does_not():
    run = mnclab.run(HEAD + "G83 X1 Z-5 R1 F80\nG80 G1 X2\nG300 Q1 H-5 Z0 F60\nX3\nM99\nX4\n", "mnc")
    assert run.ok
    lines = run.toolpath[run.toolpath.kind == Kind.LINE]
    assert list(zip(lines.line, lines.feed)) == [(2, 80), (3, 80), (5, 80), (6, 60), (7, 80)]


def test_a_cycle_of_the_group_ends_the_other():
    """Preparing G300 ends G83: X5 only moves. G83 forgets what was prepared: M99 has nothing to run."""
    assert list(holes("G83 X1 Z-5 R2\nG300 Q1 H-2 Z0\nX5\nX6 M99\n")) == [1, 4]
    run = mnclab.run(HEAD + "G300 Q1 H-2 Z0\nG83 X1 Z-5 R2\nX6 M99\n", "mnc")
    assert run.alarms[0].message.startswith("M99 has no prepared cycle")


def test_a_fault_of_a_later_hole_stands_at_that_hole():
    for fault, column in (("X40 R-30", 1), ("X40 K0", 5), ("X40 Z9", 5)):
        run = mnclab.run(HEAD + f"G83 X20 Z-25 R3\nX30\n{fault}\n", "mnc")
        assert [alarm.span[:2] for alarm in run.alarms] == [(4, column)]


OLD = {"G200": "G300", "G201": "G301", "G202": "G302", "G203": "G303", "G204": "G304", "G208": "G306", "G241": "G307"}


@pytest.mark.parametrize(("old", "new"), OLD.items())
def test_the_old_names_of_table_1_2(old, new):
    """MNC-G2xx-NUMBERS: the same cycle, with a notice."""
    cycle = mnclab.controls["mnc"].cycles[new]
    assert mnclab.controls["mnc"].cycles[old] is cycle
    text = trial.program(mnclab.controls["mnc"], cycle, {p.name: p.example for p in cycle.parameters() if p.required})
    runs = [mnclab.run(text.replace(new, code), "mnc") for code in (old, new)]
    assert runs[0].ok and [a.message for a in runs[0].alarms] == [f"{old} is another name of {new} ({cycle.title})"]
    assert str(runs[0].toolpath) == str(runs[1].toolpath)


def test_the_block_that_prepares_a_cycle_does_not_call_it():
    run = mnclab.run(HEAD + "G300 Q2 H-15 Z20 M99\n", "mnc")
    assert [alarm.span[:2] for alarm in run.alarms] == [(2, 18)]
    assert run.alarms[0].message == "M99 stands in the block that prepares G300"


def test_a_start_below_the_clearance_level_is_left_upwards():
    """G300 ends at max(z0, Z + Q): 12 from z0 = 5, 50 from z0 = 50."""
    assert holes("G300 Q2 H-15 Z10\nX1 M99\nG0 Z5\nX2 M99\n") == {2: (12, (-5,), 50), 4: (12, (-5,), 12)}


@pytest.mark.parametrize("code", ["G83", "G84", "G85"])
def test_every_position_word_runs_a_fixed_cycle_again(code):
    """X, Y, U, V, Z, W and R each, and nothing else (MNC-DRILL-TRIGGER)."""
    head = f"T2 S1000 M3\n{code} X1 Y1 Z-5 R2 F100\n"
    for word in ("X2", "Y2", "U1", "V1", "Z-6", "W9", "R1", "X2 Y3"):
        assert len(holes(f"{head}{word}\n")) == 2, word
    for word in ("S900", "F90", "M8", "G98", "P1"):
        run = mnclab.run(HEAD + f"{head}{word}\n", "mnc")
        drilled = {line for line in run.toolpath.line[run.toolpath.kind == Kind.LINE].tolist()}
        assert drilled == {3}, word


def test_increments_count_from_the_hole_before():
    """U and V from the present point under G90 and G91; X and Y under G91 too."""
    for dimension in ("G90", "G91"):
        run = mnclab.run(HEAD + f"G83 X5 Y6 Z-5 R2\n{dimension} U10\nV-3\nU1 V1\n", "mnc")
        places = run.toolpath.end[run.toolpath.kind == Kind.LINE]
        assert places[:, :2].tolist() == [[5, 6], [15, 6], [15, 3], [16, 4]]
    run = mnclab.run(HEAD + "G83 X5 Y6 Z-5 R2\nG91 X10\nY-3\n", "mnc")
    assert run.toolpath.end[run.toolpath.kind == Kind.LINE][:, :2].tolist() == [[5, 6], [15, 6], [15, 3]]


def test_a_plane_does_not_turn_the_hole():
    """MNC-DRILL-PLANE: along Z whatever the plane; the helix of G306 lies in XY."""
    for plane in ("G17", "G18", "G19"):
        program = f"{plane} T2 S1000 M3\nG83 X1 Z-5 R2\nG80\nG306 Q2 H-6 Z0 P2 D12\nX40 M99\n"
        run = mnclab.run(HEAD + program, "mnc")
        assert run.ok
        path = run.toolpath
        assert (path.axis[path.kind == Kind.ARC] == [0, 0, 1]).all()
        assert path.end[path.kind == Kind.LINE][0].tolist() == [1, 0, -5]


@pytest.mark.parametrize("mode", ["G94", "G95"])
def test_the_pitch_of_g84(mode):
    """9.2: F_rev = F under G95 and F / S under G94; the feed mode and F afterwards are those of the program."""
    feed = 1.25 if mode == "G95" else 500
    run = mnclab.run(HEAD + f"{mode} S400 M4 F{feed}\nG84 X1 Z-5 R2\nX9\nG80\nG1 X20\n", "mnc")
    assert run.ok
    path = run.toolpath
    thread = path[path.synchronous]
    assert set(thread.per_rev.tolist()) == {1.25} and set(thread.feed.tolist()) == {500.0}
    assert thread.spindle.tolist() == [-400, 400] * 2 and path[-1].spindle == -400
    assert path[-1].feed == 500 and (path[-1].per_rev == 1.25 if mode == "G95" else np.isnan(path[-1].per_rev))
    assert not path[-1].synchronous


def test_the_spindle_after_each_cycle():
    """G302 as before, G304 too, G307 with M and R, G309 off; the history has it as the modal function."""
    for cycle, speed, code in (
        ("G302 Q2 H-5 Z0 A30", -800, "M4"), ("G304 Q2 Z0 H3 B10 E2 L5 V300 D1", -800, "M4"),
        ("G307 Q2 H-5 Z0 M3 R25 S500", 25, "M3"), ("G307 Q2 H-5 Z0 M5", 0, "M5"), ("G309 Q2 H-5 Z0 P1", 0, "M5"),
    ):  # fmt: skip
        run = mnclab.run(HEAD + f"T2 S800 M4\n{cycle}\nX5 M99\nX9\n", "mnc")
        assert run.ok
        assert run.toolpath[-1].spindle == speed
        assert run.at(line=5).state["spindle"] == code


def test_gun_drilling_keeps_the_speed_of_the_program():
    """S is left out: it is that of the program, also in the second hole after R was the last speed; a new S counts."""
    run = mnclab.run(HEAD + "T2 S800 M3\nG307 Q2 H-5 Z0 R25\nX5 M99\nX9 M99\nS900\nX12 M99\n", "mnc")
    path = run.toolpath
    assert run.ok and path.spindle[path.kind == Kind.LINE].tolist() == [800, 25, 800, 25, 900, 25]


def test_a_mirror_turns_the_helix_over_but_not_the_shift():
    """MNC-PREP-XFORM: the shift of D1 goes to -X of the machine as the spindle stands, the helix of L1 clockwise."""
    program = "G51 X0\nT2 S800 M3\nG302 Q2 H-5 Z0 D1\nX5 M99\nG306 Q2 H-6 Z0 P2 D12\nX9 M99\n"
    path = mnclab.run(HEAD + program, "mnc").toolpath
    shifted = path[[path.labels[k] == "G302 leave the wall" for k in path.label]]
    assert shifted.end[0][0] == pytest.approx(-5 - 0.2)
    assert (path.sweep[path.kind == Kind.ARC] < 0).all()


def test_a_ring_that_stays_is_told_once():
    program = "T2 S800 M3\nG306 Q2 H-6 Z0 P2 D30 C5\nX9 M99\nX19 M99\nX29 M99\n"
    run = mnclab.run(HEAD + program, "mnc")
    assert run.ok and [(a.message, a.span[:2]) for a in run.alarms] == [
        ("G306 C 5 leaves a ring: the tool reaches in to 14", (3, 23))
    ]


def test_m99_beside_g303_is_a_parameter_and_is_told():
    run = mnclab.run(HEAD + "T2\nG303 Q2 H-6 Z0 P2 M99\nX9 M99\n", "mnc")
    assert run.ok and [a.message for a in run.alarms] == ["G303 M99 is a least infeed of 99 mm, no cycle call"]


def test_a_motion_function_under_an_active_cycle_waits():
    """MNC-DRILL-G0: the block drills, the motion is kept for later, and that is told."""
    run = mnclab.run(HEAD + "T2\nG85 X5 Z-5 R2\nG1 X9\nG80\nX12\n", "mnc")
    assert [a.message for a in run.alarms] == ["G1 is kept for later: G85 is active and runs at this position"]
    assert run.toolpath[-1].kind == Kind.LINE and run.toolpath[-1].end[0] == 12


# --- closed forms over random parameters ------------------------------------------------------------------------------

tenths = st.integers(1, 500).map(lambda n: n / 10)
level = st.integers(-300, 300).map(lambda n: n / 10)
seconds = st.integers(0, 50).map(lambda n: n / 10)


@given(st.data(), level, tenths, tenths, tenths, seconds, st.sampled_from(["G98", "G99"]))
def test_g83_in_closed_form(data, r, above, depth, peck, dwell, back):
    """ceil(depth / K) pecks; retractions to R; feed length: the depth and c for each return; dwell once."""
    c = data.draw(st.sampled_from([0.2, 0.5, 1]))
    head = f"G54 G90 G0 X0 Y0 Z{r + above:.1f}\n{back} G83 X7 Z{r - depth:.1f} R{r:.1f} K{peck} P{dwell} F120\n"
    path = mnclab.run(head, "mnc", Setup(settings={"peck_clearance": c})).toolpath
    rows = path[path.line == 2]
    cut = rows.kind == Kind.LINE
    count = math.ceil(round(depth / peck, 9))
    assert cut.sum() == count
    assert rows.end[cut, 2] == pytest.approx([r - min(k * peck, depth) for k in range(1, count + 1)])
    extra = sum(min(c, k * peck) for k in range(1, count))
    assert rows.lengths[cut].sum() == pytest.approx(depth + extra)
    assert np.nansum(rows.time) == dwell and rows.end[-1][2] == pytest.approx(r + above if back == "G98" else r)
    assert set(rows.feed[cut].tolist()) == {120}


@given(level, tenths, tenths, tenths, tenths, seconds, seconds)
def test_g300_in_closed_form(surface, clearance, start, depth, infeed, top, bottom):
    """ceil(|H| / P) infeeds, one withdrawal fewer; it ends at max(z0, z_q)."""
    z0 = surface + start
    words = f"Q{clearance} H-{depth} P{infeed} Z{surface} F250 E{top} T{bottom}"
    path = mnclab.run(f"G54 G90 G0 Z{z0:.1f}\nG300 {words}\nX5 M99\n", "mnc").toolpath
    rows = path[path.line == 3]
    cut = rows.kind == Kind.LINE
    count = math.ceil(round(depth / infeed, 9))
    assert cut.sum() == count
    assert rows.end[cut, 2].min() == pytest.approx(surface - depth)
    assert rows.lengths[cut].sum() == pytest.approx(depth + count * clearance)
    assert np.nansum(rows.time) == pytest.approx(top * (count - 1) + bottom)
    assert rows.end[-1][2] == pytest.approx(max(z0, surface + clearance))
    fast = rows.end[rows.kind == Kind.RAPID]
    assert fast[:, 2].min() > surface - depth  # no rapid touches the bottom


@given(
    depth=tenths,
    infeed=tenths,
    least=tenths,
    shrink=seconds,
    breaks=st.integers(0, 3),
    back=st.sampled_from([0.1, 0.5]),
)
def test_g303_in_closed_form(depth, infeed, least, shrink, breaks, back):
    """Infeeds by the manual's formula; of the interruptions every (L + 1)-th is a withdrawal."""
    words = f"Q2 H-{depth} P{infeed} Z0 M{least} F150 V400 E0.5 T1 K{shrink} L{breaks} I{back}"
    path = mnclab.run(f"G54 G90 G0 Z50\nG303 {words}\nX5 M99\n", "mnc").toolpath
    reached, k = [0.0], 0
    while reached[-1] < depth - 1e-9:
        reached.append(min(reached[-1] + max(infeed - k * shrink, min(least, infeed)), depth))
        k += 1
    rows = path[path.line == 3]
    down = (rows.kind == Kind.LINE) & (rows.feed == 150)
    assert rows.end[down, 2] == pytest.approx([-d for d in reached[1:]], abs=1e-9)
    withdrawals = (k - 1) // (breaks + 1)
    assert np.nansum(rows.time) == pytest.approx(0.5 * withdrawals + 1)
    up = (rows.kind == Kind.LINE) & (rows.feed == 400)
    assert up.sum() == k  # k - 1 interruptions and the end
    assert (rows.end[up, 2] == 2).sum() >= withdrawals + 1


@given(depth=tenths, pitch=tenths, diameter=st.integers(81, 160).map(lambda n: n / 10), mode=st.sampled_from([1, -1]))
def test_g306_in_closed_form(depth, pitch, diameter, mode):
    """Turns (Q + |H|) / P on the radius D/2 - R; length of the helix turns * hypot(2 pi rho, P)."""
    tools = {1: Tool(radius=4)}
    program = f"T1 F200\nG0 Z50\nG306 Q2 H-{depth} Z0 P{pitch} D{diameter} L{mode}\nX5 M99\n"
    path = mnclab.run(program, "mnc", Setup(tools=tools)).toolpath
    helix, circle = path[path.kind == Kind.ARC]
    rho, turns = diameter / 2 - 4, (2 + depth) / pitch
    assert helix.sweep == pytest.approx(mode * math.tau * turns)
    assert circle.sweep == mode * math.tau and circle.end[2] == -depth
    lengths = path.lengths[path.kind == Kind.ARC]
    assert lengths == pytest.approx([turns * math.hypot(math.tau * rho, pitch), math.tau * rho])
    assert path.end[-2][:2] == pytest.approx([5, 0]) and path.end[-1][2] == 50


@given(depth=tenths, speed=st.integers(100, 5000), pitch=st.integers(-40, 40).filter(bool).map(lambda n: n / 10))
def test_g309_in_closed_form(depth, speed, pitch):
    """Down and up take (Q + |H|) / |P| turns each at the speed; the hand is the sign of P."""
    program = f"T2 S{speed} M3\nG0 Z50\nG309 Q2 H-{depth} Z0 P{pitch}\nX5 M99\n"
    path = mnclab.run(program, "mnc").toolpath
    thread = path[path.kind == Kind.LINE]
    assert thread.synchronous.all()
    minutes = thread.lengths / thread.feed
    assert minutes * speed == pytest.approx([(2 + depth) / abs(pitch)] * 2)
    assert thread.spindle.tolist() == [math.copysign(speed, pitch), -math.copysign(speed, pitch)]


@given(
    st.lists(
        st.sampled_from(["X5", "U3", "Y4 K2", "R3", "W4", "Z-9", "G91", "G90", "G98", "G99", "P1", "G84", "G85"]),
        max_size=9,
    )
)
def test_paths_of_fixed_cycles_are_continuous_and_labelled(words):
    """Whatever is refused, the rows before it hang together, and no cutting row is without a label."""
    path = mnclab.run(HEAD + "T2 S500 M3\nG83 X1 Z-5 R2\n" + "\n".join(words) + "\n", "mnc").toolpath
    for before, after in pairwise(path):
        assert before.end.tolist() == after.start.tolist()
    cuts = path[(path.kind == Kind.LINE)]
    assert all(cuts.labels[k].startswith("G8") for k in cuts.label)
