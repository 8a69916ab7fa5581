"""When something becomes true: closed forms on lines and arcs, and a dense look at any path."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab
from mnclab.path.places import points_at

PROGRAM = "G90 G54 S100 M3\nG0 X0 Y0 Z10\nG1 Z-10 F100\nG3 X0 Y0 I20 J0\nX40 Y40 Z0\nT2\nG0 Z50\nG1 Z5\n"


#: From the right, x + 2 y = 20 + 20 √5 cos(t - atan 2) first reaches 64 before its top, at 64.7.
LEAST = math.atan(2) - math.acos(44 / (20 * math.sqrt(5)))
#: x = 5 + y / 100 on the lower half of (x - 20)² + y² = 400: (y / 100 - 15)² + y² = 400.
ON_ARC = (0.3 - math.sqrt(0.09 + 4 * 1.0001 * 175)) / 2 / 1.0001


@pytest.mark.parametrize(
    ("question", "line", "point"),
    [
        ("z < -5", 3, (0, 0, -5)),
        ("z <= -10", 3, (0, 0, -10)),
        ("y > 19", 4, (20 + math.sqrt(400 - 361), 19, -10)),  # (x - 20)² + y² = 20², coming from the right
        ("y >= 20", 4, (20, 20, -10)),  # the very top of the arc: touched in one place
        ("y > 20", 5, (20, 20, -5)),  # never on the arc
        ("x^2 + y^2 > 900", 4, (22.5, -math.sqrt(900 - 22.5**2), -10)),  # two circles: 40 x = 900
        ("x + y > 61", 5, (40 * 61 / 80, 61 / 2, 61 / 8 - 10)),  # the arc's x + y is 20 + 20 √2 at most: 48.3
        ("x + 2 * y > 64", 4, (20 + 20 * math.cos(LEAST), 20 * math.sin(LEAST), -10)),
        ("x > 5 + y / 100 and not z > -3 * tool", 4, (5 + ON_ARC / 100, ON_ARC, -10)),
        ("tool == 2 and z > 20", 7, (40, 40, 20)),
        ("feed == 100", 3, (0, 0, 10)),
        ("spindle > 0", 1, (0, 0, 0)),
        ("line == 5", 5, (0, 0, -10)),
    ],
)
def test_the_first_moment_in_closed_form(run, question, line, point):
    moment = run.when(question)[0]
    assert moment.line == line
    assert moment.point == pytest.approx(point, abs=1e-8)


def test_what_is_linear_is_exact_and_what_is_looked_at_says_so(run):
    for question in ("z < 1", "x + 2*y > z / 4 and tool < 3", "not (x - y) * 2 < 3"):
        assert run.when(question).exact
    for question in ("x*y > 5", "abs(x) > 5", "z < 1 or x^2 > 4", "1 / z > 3"):
        assert not run.when(question).exact
        assert "looked at in 16 places" in run.when(question)._repr_html_() or run.when(question) == ()


def test_a_sum_that_a_short_touch_would_hide():
    """An arc of 20 mm whose x + y exceeds its bound by a hundredth of a micrometre, between any sixteen looks."""
    run = mnclab.run("G90 F100\nG0 X20\nG3 X-20 Y0 I-20 J0\n", "mnc")
    top = 20 * math.sqrt(2)
    (moment,) = run.when(f"x + y > {top - 1e-5}")
    assert moment.point == pytest.approx((top / 2, top / 2, 0), abs=0.05) and moment.point[0] > top / 2
    assert run.when(f"x + y > {top + 1e-5}") == ()


def test_rotary_axes_can_be_asked_for():
    text = "BEGIN PGM A MM\nL X+0 A+0 R0 F100\nL X+10 A+30 C-90\nL A+40\nEND PGM A MM\n"
    run = mnclab.run(text, "tnc-620")
    (moment,) = run.when("a > 12")
    assert (moment.line, moment.point[0]) == (3, pytest.approx(4))
    (moment,) = run.when("a + x > 20 and c < 0")  # 40 share = 20
    assert (moment.line, moment.share) == (3, pytest.approx(0.5))
    (moment,) = run.when("a > 35")
    assert (moment.line, moment.share) == (4, pytest.approx(0.5))


def test_all_moments_come_in_order(run):
    found = run.when("5 < x < 6")
    assert [moment.line for moment in found] == [4, 4, 5]
    assert [moment.point[0] for moment in found] == pytest.approx([5, 6, 5])
    assert run.when("z > 1000") == () and str(run.when("z > 1000")) == "z > 1000: never"
    assert ">4</td>" in found._repr_html_() and "X6 Y14.2829" in str(found)


def test_a_variable_in_a_loop():
    text = "BEGIN PGM A MM\nFN 0: Q5 = +1\nL X+5 R0 F100\nLBL 1\nFN 1: Q5 = +Q5 + +1\nL IX+5\nCALL LBL 1 REP 5\nEND PGM A MM\n"
    run = mnclab.run(text, "tnc-620")
    (moment,) = run.when("Q5 > 3")
    assert (moment.line, moment.changed["Q5"], moment.row, moment.point) == (5, 4.0, -1, (15.0, 0.0, 0.0))
    assert moment.step == 11  # 7 blocks to the first call, then 3 a round: the second of the second round
    (both,) = run.when("Q5 > 3 and x > 17")
    assert (both.line, both.point[0]) == (6, pytest.approx(17))


def test_without_motion_or_steps():
    assert mnclab.run("G90\n", "mnc").when("z < -1") == ()
    assert mnclab.run("", "mnc").when("z < 1") == ()


COORDINATE = st.integers(-20, 20)
BLOCKS = st.lists(
    st.tuples(COORDINATE, COORDINATE, COORDINATE).map("G1 X{0[0]} Y{0[1]} Z{0[2]}".format)
    | st.tuples(st.sampled_from("23"), st.integers(1, 9), st.integers(-9, 9)).map("G{0[0]} I{0[1]} J{0[2]}".format),
    min_size=1, max_size=5,
)  # fmt: skip
QUESTIONS = st.sampled_from(
    [
        "x > 7.5",
        "z < -2.5 and y > 1.5",
        "not (y < 3.3 or x < 0.5)",
        "x + y > 4.1",
        "x - 2 * y + z / 3 > 1.7",
        "0.5 < z < 9.5",
    ]
)


@settings(max_examples=40)
@given(BLOCKS, QUESTIONS)
def test_a_dense_look_sees_the_same(blocks, question):
    """4000 looks a move: every change they see lies within one look of a moment that was found."""
    run = mnclab.run("G90 F100\n" + "\n".join(blocks) + "\n", "mnc")
    path, dense = run.toolpath, 4000
    rows = np.repeat(np.arange(len(path)), dense + 1)
    share = np.tile(np.linspace(0, 1, dense + 1), len(path))
    x, y, z = points_at(path, rows, share).T
    python = (
        question.replace("0.5 < z < 9.5", "(z > 0.5) & (z < 9.5)").replace(" and ", ") & (").replace(" or ", ") | (")
    )
    python = python if "z > 0.5" in python else f"({python})"
    if question.startswith("not"):
        python = "~((y < 3.3) | (x < 0.5))"
    true = eval(python, {}, {"x": x, "y": y, "z": z}) if len(path) else np.empty(0, bool)
    begins = np.flatnonzero(true & ~np.concatenate([[False], true[:-1]]))
    found = [(moment.row + moment.share) for moment in run.when(question)]
    for at in begins:
        assert min((abs(place - rows[at] - share[at]) for place in found), default=9) < 1.01 / dense
    for moment in run.when(question):  # and just after each of them it is true
        after = np.flatnonzero((rows == moment.row) & (share >= moment.share))
        assert moment.share > 1 - 1 / dense or true[after[:3]].any() or moment.share == 1


FACING = "{turn}\nG96 S120\nG95 F0.2\nG0 X30 Z0\nG1 X0\n"  # n = 1000 v / (2 π X), at most 3000


@pytest.mark.parametrize(
    ("question", "x"),
    [
        ("spindle >= 1500", 120_000 / (2 * math.pi * 1500)),
        ("spindle >= 3000", 120_000 / (2 * math.pi * 3000)),  # the limit, where the speed stays
        ("line == 5 and feed > 200", 0.2 * 120_000 / (2 * math.pi * 200)),
        ("spindle > 1000 and x < 10", 10),
    ],
)
def test_at_constant_cutting_speed_the_spindle_follows_the_tool(question, x):
    run = mnclab.run(FACING.format(turn="M3"), "jnc-t01", mnclab.Setup(start=(40, 0, 20)))
    (moment,) = run.when(question)
    assert (moment.line, moment.point[0]) == (5, pytest.approx(x, abs=1e-9))


def test_a_spindle_that_turns_left_is_negative():
    run = mnclab.run(FACING.format(turn="M4"), "jnc-t01", mnclab.Setup(start=(40, 0, 20)))
    assert run.when("spindle >= 1500") == ()
    assert run.when("spindle <= -1500")[0].point[0] == pytest.approx(120_000 / (2 * math.pi * 1500), abs=1e-9)


def test_a_lathe_says_that_x_is_a_radius():
    """A diameter of 40 mm is 20 mm from the axis."""
    run = mnclab.run("G94 F100\nT1 S500 M3\nG0 X40 Z5\nG1 Z-20\nG0 X50\n", "jnc-t01", settings={"diameter": True})
    assert "programmed point  X20 (radius) Z-20" in str(run.at(line=4))
    assert "X20 (radius) Z-7" in str(run.when("z < -7"))
    assert "go to X20 (radius) Z-20" in str(run.start_at(5).alarms[0])


def test_places_of_a_program_in_inches():
    """The condition counts mm, as `PLACE` says; the place is told as the listing has it: 25.4 mm are 1 in."""
    found = mnclab.run("G20 G17 G90 S100 M3\nG0 X0 Y0\nG1 X2 F10\n", "g43").when("x > 25.4")
    told = ["line 3: X1 Y0 Z0  50 %      G1 X2 F10", "the condition counts mm, the places count inches"]
    assert str(found).splitlines() == told
    assert "the condition counts mm" in found._repr_html_()
    metric = mnclab.run("G21 G17 G90 S100 M3\nG0 X0 Y0\nG1 X2 F10\n", "g43").when("x > 1")
    assert str(metric) == "line 3: X1 Y0 Z0  50 %      G1 X2 F10"


def test_moments_are_made_when_they_are_asked_for(monkeypatch):
    """Of 300 strokes down through Z0 a page shows the first 50, and nothing else is worked out."""
    run = mnclab.run("G90 F100\n" + "G1 Z1\nZ-1\n" * 300, "mnc")
    asked, at = [], type(run).at
    monkeypatch.setattr(type(run), "at", lambda self, *given, **more: asked.append(more["step"]) or at(self, *given, **more))
    found = run.when("z < 0")
    assert (len(found), asked) == (300, [])
    assert [found[k].line for k in (0, 1, -1)] == [3, 5, 601] and asked == [2, 4, 600]
    assert "250 more" in found._repr_html_() and max(asked[3:]) == 100
    assert found[10:12] == (found[10], found[11]) and found[5].share == 0.5
    with pytest.raises(IndexError):
        found[300]
