"""Milling cycles against the sequence of the manual, written out a second time for random parameters; feeds, notices,
what a block may hold. Lists of moves here know nothing of passes: corners, centres and levels are formulas.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools.running import run

import mnclab
from mnclab import Kind, Setup, Tool

INF = math.inf


def number(least, greatest):
    """Numbers as programs write them: three decimals."""
    return st.floats(least, greatest).map(lambda value: round(value, 3))


def milled(block, *, radius=5.0, plunge_angle=0.0, start=(0.0, 0.0, 40.0), head="T1\n"):
    return run(block, before=head, tools={1: Tool(radius=radius, plunge_angle=plunge_angle)}, start=start)


def cycle_rows(found):
    """The motion of the last block."""
    path = found.toolpath
    return path[(path.line == path.line.max()) & path.is_motion]


def block(code, values):
    return " ".join([code, *(f"{address}{value:.9f}" for address, value in values.items())]) + "\n"


class Moves:
    """The moves that are expected: target, feed, sweep; those that go nowhere are none."""

    def __init__(self, x, y, z):
        self.here, self.moves = (x, y, z), []

    def to(self, x=None, y=None, z=None, f=INF, sweep=0.0, centre=None):
        place = tuple(b if a is None else a for a, b in zip((x, y, z), self.here))
        if sweep or math.dist(place, self.here) > 1e-9:
            self.moves.append((place, f, sweep, centre))
        self.here = place

    def same_as(self, rows):
        assert len(rows) == len(self.moves), f"{len(rows)} rows, expected {len(self.moves)}\n{rows}"
        for row, (place, feed, sweep, centre) in zip(rows, self.moves):
            assert row.end.tolist() == pytest.approx(place, abs=1e-6)
            assert row.feed == pytest.approx(feed)
            assert row.sweep == pytest.approx(sweep, abs=1e-6)
            if sweep:
                assert row.centre[:2].tolist() == pytest.approx(centre, abs=1e-6)


def down(moves, top, bottom, step):
    """Depths of infeeds, the last one smaller."""
    count = math.ceil((top - bottom) / step - 1e-9) if step else 1
    return [max(top - step * k, bottom) if step else bottom for k in range(1, count + 1)]


# --- pockets ----------------------------------------------------------------------------------------------------------


def pockets(draw_of_shape):
    """Random parameters of what both pockets share, with those of a shape."""
    return st.fixed_dictionaries(
        {
            "M": st.sampled_from([0, 1, 2]), **draw_of_shape,
            "Z": number(-20, 20), "H": number(-20, -2), "P": number(1.5, 12), "Q": number(0.5, 12),
            "U": st.sampled_from([0.0, 0.3]), "W": st.sampled_from([0.0, 0.4]), "I": st.sampled_from([0.0, 3.0]),
            "K": number(0.4, 1.4), "F": number(100, 900), "V": number(50, 90), "L": st.sampled_from([1, -1]),
            "T": number(1000, 2000),
        }
    )  # fmt: skip


def mill_pocket(v, radius, rings, wall, room, corner, turn, start):
    """Steps 1 to 8 of 10.3 and 10.4 with the plunge J0.

    `rings(allowance)` gives the passes of a level, each as a function that runs it; `wall` is where a round begins
    and ends, `corner(place, direction)` turns a direction of the wall.
    """
    x0, y0, z0 = start
    z, floor = v["Z"], v["Z"] + v["H"]
    rest = floor + v["W"]
    m = Moves(*start)

    def at(u, w):
        return x0 + math.cos(turn) * u - math.sin(turn) * w, y0 + math.sin(turn) * u + math.cos(turn) * w

    def arc_at_wall(far, rho, f, towards):
        """A quarter circle that touches the wall at (far, 0), or (0, far) where the longer axis is Y."""
        u, w = (far - rho) * corner[0], (far - rho) * corner[1]
        beside = rho * v["L"] * (1 if not towards else -1)
        along = (-corner[1] * beside, corner[0] * beside)  # the direction of travel there is that of L
        end = at(far * corner[0], far * corner[1]) if towards else at(u + along[0], w + along[1])
        m.to(*end, f=f, sweep=v["L"] * math.pi / 2, centre=at(u, w))

    def clear(level, allowance, f, rho):
        m.to(z=level, f=v["V"])
        for ring in rings(allowance):
            ring(m, at, f)
        if room(allowance) > 0:
            arc_at_wall(wall(allowance), rho, f, False)

    def back(level):
        m.to(z=level + v["Q"])
        m.to(x0, y0)

    if v["M"] == 2 and not (v["U"] or v["W"]):
        return m
    m.to(z=z + v["Q"])
    if v["M"] != 2:
        for level in down(m, z, rest, v["P"]):
            clear(level, v["U"], v["F"], min(v["Q"], room(v["U"])))
            back(level)
    rho = min(v["U"] + v["Q"], room(0))
    if v["M"] != 1 and v["U"]:
        m.to(z=z + v["Q"])
        for level in down(m, z, rest, v["I"]):
            far = wall(0)
            m.to(
                *at(
                    (far - rho) * corner[0] + rho * v["L"] * corner[1],
                    (far - rho) * corner[1] - rho * v["L"] * corner[0],
                )
            )
            m.to(z=level, f=v["V"])
            arc_at_wall(far, rho, v["T"], True)
            rings(0)[-1](m, at, v["T"])
            arc_at_wall(far, rho, v["T"], False)
            back(level)
    if v["M"] != 1 and v["W"]:
        m.to(z=rest + v["Q"])
        clear(floor, 0, v["T"], rho)
        back(floor)
    m.to(z=max(z0, z + v["Q"]))
    return m


@settings(max_examples=60)
@given(
    v=pockets({"D": number(11, 70)}), radius=number(1.5, 5),
    start=st.tuples(number(-50, 50), number(-50, 50), number(-5, 60)),
)  # fmt: skip
def test_a_circular_pocket_is_the_sequence_of_the_manual(v, radius, start):
    def rings(allowance):
        reach = v["D"] / 2 - radius - allowance
        count = math.ceil(reach / (v["K"] * radius) - 1e-9)

        def ring(r):
            def go(m, at, f):
                m.to(*at(r, 0), f=f)
                m.to(f=f, sweep=v["L"] * math.tau, centre=at(0, 0))

            return go

        return [ring(reach * k / count) for k in range(1, count + 1)]

    def reach(allowance):
        return v["D"] / 2 - radius - allowance

    expected = mill_pocket(v, radius, rings, reach, reach, (1, 0), 0.0, start)
    expected.same_as(cycle_rows(milled(block("G344", v), radius=radius, start=start)))


@settings(max_examples=60)
@given(
    v=pockets({"A": number(11, 70), "B": number(11, 70), "E": number(-360, 360)}), radius=number(1.5, 5),
    corner=st.floats(0, 1), start=st.tuples(number(-50, 50), number(-50, 50), number(-5, 60)),
)  # fmt: skip
def test_a_rectangular_pocket_is_the_sequence_of_the_manual(v, radius, corner, start):
    v["R"] = round(corner * (min(v["A"], v["B"]) / 2 - 1e-3), 3)
    long = (1, 0) if v["A"] >= v["B"] else (0, 1)

    def rings(allowance):
        a, b = v["A"] / 2 - radius - allowance, v["B"] / 2 - radius - allowance
        least = min(a, b)
        count = math.ceil(least / (v["K"] * radius) - 1e-9)

        def line(m, at, f):
            far = (a - least) * long[0], (b - least) * long[1]
            for sign in (1, -1, 1):
                m.to(*at(sign * far[0], sign * far[1]), f=f)

        def ring(back):
            half, r = (a - back, b - back), max(0.0, max(v["R"], radius) - radius - allowance - back)

            def go(m, at, f):
                way = 1 if v["L"] == 1 else -1
                sides = [(1, 0), (0, 1), (-1, 0), (0, -1)]  # normals, counter-clockwise
                first = sides.index(long)
                far = half[first % 2]
                m.to(*at(long[0] * far, long[1] * far), f=f)
                for k in range(4):
                    n, following = sides[(first + way * k) % 4], sides[(first + way * (k + 1)) % 4]
                    reach, other = half[abs(n[1])], half[abs(following[1])]
                    corner = (n[0] * reach + following[0] * (other - r), n[1] * reach + following[1] * (other - r))
                    m.to(*at(*corner), f=f)
                    if r > 0:
                        middle = corner[0] - n[0] * r, corner[1] - n[1] * r
                        end = middle[0] + following[0] * r, middle[1] + following[1] * r
                        m.to(*at(*end), f=f, sweep=way * math.pi / 2, centre=at(*middle))
                m.to(*at(long[0] * far, long[1] * far), f=f)

            return go

        return [line, *(ring(least * (count - k) / count) for k in range(1, count + 1))]

    def room(allowance):
        return min(v["A"], v["B"]) / 2 - radius - allowance

    def wall(allowance):
        return max(v["A"], v["B"]) / 2 - radius - allowance

    expected = mill_pocket(v, radius, rings, wall, room, long, math.radians(v["E"]), start)
    expected.same_as(cycle_rows(milled(block("G343", v), radius=radius, start=start)))


@pytest.mark.parametrize("code", ["G343 A60 B40", "G344 D40"])
@pytest.mark.parametrize("plunge_angle", [2.0, 15.0, 90.0])
def test_every_way_down_keeps_to_the_plunge_angle(code, plunge_angle):
    """Plunges begin at the level already cut, at V; no slope is steeper than the angle, no level move is at V."""
    for strategy in (1, 2) if "G343" in code else (1,):
        found = milled(f"{code} Z0 H-8 P3 Q2 U0.5 W0.2 K1 J{strategy} F500 V150\n", plunge_angle=plunge_angle)
        rows = cycle_rows(found)
        rows = rows[rows.kind != Kind.RAPID]
        flat = np.where(rows.kind == Kind.ARC, np.abs(rows.sweep) * np.hypot(*(rows.start - rows.centre).T[:2]), 0)
        flat = np.where(rows.kind == Kind.LINE, np.hypot(*(rows.end - rows.start).T[:2]), flat)
        drop = rows.start[:, 2] - rows.end[:, 2]
        sloping = (drop > 0) & (flat > 0)
        assert (drop >= 0).all()
        assert sloping.any() == (plunge_angle < 90)
        assert (drop[sloping] <= flat[sloping] * math.tan(math.radians(plunge_angle)) + 1e-9).all()
        assert set(rows.feed[drop > 0]) == {150} and set(rows.feed[drop == 0]) == {500}
        levels = [0, -3, -6, -7.8, -8]
        for top, bottom in zip(levels, levels[1:]):
            straight = (drop > 0) & (flat == 0) & (rows.end[:, 2] == (bottom if plunge_angle == 90 else top))
            assert straight.any()


@pytest.mark.parametrize(("mode", "sense"), [(1, 1), (0, 1), (-1, -1)])
def test_the_helix_turns_as_the_pocket_is_milled(mode, sense):
    rows = cycle_rows(milled(f"G344 D40 Z0 H-3 P3 Q2 K1 J1 L{mode} F500 V150\n", plunge_angle=3))
    arcs = rows[rows.kind == Kind.ARC]
    assert (np.sign(arcs.sweep) == sense).all()


# --- surfaces ---------------------------------------------------------------------------------------------------------

SURFACE = {
    "X": number(-50, 50), "Y": number(-50, 50), "Z": number(-10, 10), "A": number(0, 80),
    "B": number(0, 80), "Q": number(0.5, 5), "V": number(100, 200), "F": number(300, 400),
    "T": number(500, 600),
}  # fmt: skip


@settings(max_examples=40)
@given(v=st.fixed_dictionaries(SURFACE | {"K": st.integers(1, 12)}), radius=number(1, 10), z0=number(-20, 60))
def test_line_milling_is_the_sequence_of_the_manual(v, radius, z0):
    left, right, above = v["X"] - radius, v["X"] + v["A"] + radius, v["Z"] + v["Q"]
    span = v["B"] - 2 * radius
    lines = [v["Y"] + radius + span * k / (v["K"] - 1) for k in range(v["K"])] if v["K"] > 1 and span > 0 else []
    m = Moves(1, 2, z0)
    m.to(z=max(z0, above))
    m.to(left, v["Y"] + radius)
    m.to(z=above)
    m.to(z=v["Z"], f=v["V"])
    for k, y in enumerate(lines or [v["Y"] + radius]):
        m.to(y=y, f=v["T"])
        m.to(x=left if k % 2 else right, f=v["F"])
    m.to(z=above)
    m.same_as(cycle_rows(milled(block("G320", v), radius=radius, start=(1, 2, z0))))


FACE = SURFACE | {
    "L": st.sampled_from([0, 1, 2]), "W": number(-20, -11), "P": number(1, 30), "K": number(0.3, 1.999),
    "I": number(0.5, 5), "U": st.sampled_from([0.0, 0.3]),
}  # fmt: skip


@settings(max_examples=40)
@given(v=st.fixed_dictionaries(FACE), radius=number(1, 10), z0=number(-20, 60))
def test_face_milling_is_the_sequence_of_the_manual(v, radius, z0):
    span, height = v["B"] - 2 * radius, v["Z"] - v["W"] - v["U"]
    count = max(1, math.ceil(span / (v["K"] * radius) - 1e-9))
    lines = [v["Y"] + radius + span * k / count for k in range(count + 1)] if span > 0 else [v["Y"] + v["B"] / 2]
    infeeds = math.ceil(height / v["P"] - 1e-9)
    levels = [v["Z"] - height * k / infeeds for k in range(1, infeeds + 1)] + ([v["W"]] if v["U"] else [])
    out = radius + v["I"]
    ends = [v["X"] - out, v["X"] + v["A"] + out]
    turns = [v["X"] + radius, v["X"] + v["A"] - radius] if v["L"] == 1 else ends
    if turns[1] < turns[0]:
        turns = [v["X"] + v["A"] / 2] * 2
    m, above = Moves(1, 2, z0), v["Z"] + v["Q"]
    m.to(z=max(z0, above))
    m.to(ends[0], lines[0])
    m.to(z=above)
    right = True  # which way the next line runs
    for number, level in enumerate(levels):
        cut = v["T"] if v["U"] and number == len(levels) - 1 else v["F"]
        m.to(z=level, f=v["F"] if v["L"] == 1 and number else v["V"])
        for k, y in enumerate(lines if number % 2 == 0 else lines[::-1]):
            if k and v["L"] == 2:
                right = not right
                m.to(z=level + v["Q"], f=v["V"])
                m.to(turns[0 if right else 1], y, f=v["V"])
                m.to(z=level, f=v["V"])
            elif k:
                m.to(y=y, f=cut if v["L"] == 1 else v["V"])
            m.to(x=turns[1 if right else 0], f=cut)
            right = not right
    m.to(z=max(z0, above))
    m.same_as(cycle_rows(milled(block("G321", v), radius=radius, start=(1, 2, z0))))


# --- notices, and what a block may hold ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "notice"),
    [
        ("G320 X0 Y0 Z0 A50 B40 K0 V150 F400 Q2", "G320 K (number of lines) is 0: nothing is milled"),
        ("G320 X0 Y0 Z0 A50 B10 K3 V150 F400 Q2", "G320 one line is as wide as B10: K3 lines are not needed"),
        (
            "G320 X0 Y0 Z0 A50 B40 K3 V150 F400 Q2",
            "G320 K3 lines leave strips uncut: they lie 15 mm apart, the tool is 10",
        ),
        (
            "G320 X0 Y0 Z0 A50 B40 K1 V150 F400 Q2",
            "G320 one line leaves strips uncut: B40 is wider than the tool, 10 mm",
        ),
        ("G321 X0 Y0 Z5 W5 A50 B40 Q2 P2 K1 F400 V900 I2", "G321 Z and W are the same height: nothing is milled"),
        ("G343 M2 A60 B40 Z0 H-5 P5 Q2 K1 F400 V150", "G343 M2 finishes nothing: neither U nor W is given"),
        ("G344 M2 D40 Z0 H-5 P5 Q2 K1 F400 V150", "G344 M2 finishes nothing: neither U nor W is given"),
        ("G344 D14 Z0 H-5 P5 Q2 K1 J1 F400 V150", "G344 J1 has a narrow helix: its radius is 2, that of the tool 5"),
    ],
)
def test_what_a_program_is_told_about(text, notice):
    found = milled(text + "\n", plunge_angle=3)
    assert [a.message.startswith(notice) for a in found.alarms] == [True] and found.alarms[0].span[:2] == (2, 1)
    if "nothing" in notice:
        assert not found.toolpath.is_motion.any()


def test_a_tool_that_fills_its_pocket_only_plunges():
    rows = cycle_rows(milled("G344 D10 Z0 H-8 P3 Q2 K1 F400 V150\n"))
    assert (rows.end[:, :2] == 0).all()
    assert rows.end[rows.kind == Kind.LINE][:, 2].tolist() == [-3, -6, -8]


@pytest.mark.parametrize(
    "code", ["G343 A60 B40 Z0 H-4 P4 Q2 U0.2 W0.1 K1 V150", "G344 D40 Z0 H-4 P4 Q2 U0.2 W0.1 K1 V150"]
)
def test_left_out_feeds(code):
    """F is the modal feed, T is F; T0 too. None becomes the modal feed, and G95 reads that one per revolution."""
    for words, roughing, finishing in (
        ("", 320, 320),
        (" F500", 500, 500),
        (" F500 T0", 500, 500),
        (" F500 T90", 500, 90),
    ):
        rows = cycle_rows(found := milled(code + words + "\n", head="T1 F320\n"))
        cutting = rows[(rows.kind != Kind.RAPID) & (rows.start[:, 2] == rows.end[:, 2])]
        names = [cutting.labels[k] for k in cutting.label]
        assert {f for f, name in zip(cutting.feed, names) if "layer" in name} == {roughing}
        assert {f for f, name in zip(cutting.feed, names) if "finishing" in name} == {finishing}
        assert found.at(2).state["feed"] == 320
    rows = cycle_rows(milled(code + "\n", head="T1 S1000 M3 G95 F0.2\n"))
    level = (rows.kind != Kind.RAPID) & (rows.start[:, 2] == rows.end[:, 2])
    assert set(rows.feed[level]) == {200} and set(rows.feed[(rows.kind == Kind.LINE) & ~level]) == {150}


def test_coordinates_are_absolute_under_g91():
    """MNC-MILL-ABS: X, Y, Z and W; A and B are distances in any case."""
    for text in ("G320 X5 Y6 Z-1 A50 B20 K3 V150 F400 Q2\n", "G321 X5 Y6 Z0 W-3 A50 B40 Q2 P2 K1 F400 V900 I2\n",
                 "G344 D40 Z-1 H-4 P4 Q2 K1 F400 V150\n"):  # fmt: skip
        rows = [cycle_rows(milled(text, head=f"{dimension} T1\n")) for dimension in ("G90", "G91")]
        assert np.array_equal(rows[0].end, rows[1].end)


@pytest.mark.parametrize("plane", ["G17", "G18", "G19"])
def test_a_plane_does_not_turn_the_pocket(plane):
    text = "G343 A60 B40 R8 Z0 H-4 P4 Q2 U0.2 K1 J1 F400 V150\n"
    rows, flat = (cycle_rows(milled(text, plunge_angle=3, head=f"T1 {which}\n")) for which in (plane, "G17"))
    assert np.array_equal(rows.end, flat.end) and np.array_equal(rows.sweep, flat.sweep)
    assert (rows.axis[rows.kind == Kind.ARC] == (0, 0, 1)).all()


def test_it_runs_once_and_leaves_the_prepared_cycle():
    """G320 to G344 are in no group: the next positions only move, M99 still runs what was prepared, G83 goes on."""
    pocket = "G344 D40 Z0 H-4 P4 Q2 K1 F400 V150\n"
    found = milled("G300 Q2 H-5 Z0 F90\n" + pocket + "G0 X30\nX40 M99\n", head="T1\n")
    labels = {
        n: {found.toolpath.labels[k][:4] for k in found.toolpath.label[found.toolpath.line == n]} for n in (3, 4, 5)
    }
    assert labels == {3: {"G344"}, 4: {""}, 5: {"", "G300"}}
    found = milled("G83 X5 Z-5 R2 F90\n" + pocket + "X30\n", head="T1\n")
    assert "G83" in {found.toolpath.labels[k][:3] for k in found.toolpath.label[found.toolpath.line == 4]}


def test_a_frame_mirrors_turns_and_scales_a_pocket():
    """Climb stays what L says of the program: under one mirror the tool goes round the other way (MNC-POCKET-L).

    A scale does not change the tool (MNC-G37-SCOPE): twice the pocket of a tool of half the radius.
    """
    text, start = "G344 D40 Z0 H-4 P4 Q2 U0.2 K1 F400 V150\n", (10, 5, 40)
    for frame, (x, y), sense in (("G51 X0", (-1, 1), -1), ("G51 X0 Y0", (-1, -1), 1), ("G37 X2 Y2", (2, 2), 1)):
        plain = cycle_rows(milled(text, start=start, radius=5 / abs(x)))
        rows = cycle_rows(milled(f"{frame}\n{text}", start=start))
        assert np.allclose(rows.end, plain.end * (x, y, 1))
        assert np.allclose(rows.sweep, plain.sweep * sense)
    refused = mnclab.run("T1\nG37 X2 Y1\n" + text, "mnc", Setup(start=start))
    assert refused.alarms[0].message == "G344 cannot run under unequal scales of the plane"


EXTREME = st.sampled_from([1e-9, 1e-6, 2.0, 10.0, 10.000000001, 10.0000001, 50.0, 999999999.0])
SOME = st.sampled_from([0.0, 1e-9, 0.3, 6.0])


@settings(max_examples=150)
@given(
    code=st.sampled_from(["G320", "G321", "G343", "G344"]), sizes=st.tuples(EXTREME, EXTREME, EXTREME),
    p=st.sampled_from([1e-9, 2.0, 999999999.0]), q=EXTREME, u=SOME, w=SOME, r=SOME, j=st.sampled_from([0, 1, 2]),
    m=st.sampled_from([0, 1, 2]), k=st.sampled_from([0.4, 1.4]), angle=st.sampled_from([1e-9, 3.0, 89.99999, 90.0]),
)  # fmt: skip
def test_whatever_the_numbers_a_cycle_runs_or_says_what_is_wrong(code, sizes, p, q, u, w, r, j, m, k, angle):
    a, b, h = (f"{size:.9f}" for size in sizes)
    pocket = f"M{m} Z0 H-{h} P{p:.9f} Q{q:.9f} U{u:.9f} W{w:.9f} K{k} J{j} V90 F400"
    text = {
        "G320": f"X{b} Y0 Z0 A{a} B{b} K3 V90 F400 Q{q:.9f}",
        "G321": f"L{j} X{b} Y0 Z0 W-{h} A{a} B{b} Q{q:.9f} P{p:.9f} K{k} V900 F400 I{h} U{u:.9f}",
        "G343": f"A{a} B{b} R{r:.9f} E30 {pocket}", "G344": f"D{a} {pocket}",
    }[code]  # fmt: skip
    found = mnclab.run(f"T1\n{code} {text}\n", "mnc", Setup(tools={1: Tool(radius=5, plunge_angle=angle)}))
    assert found.ok or any(code in alarm.message for alarm in found.alarms)
    assert np.isfinite(found.toolpath.end).all()
