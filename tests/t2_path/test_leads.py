"""Approaches, departures, roundings and chamfers: what geometry says of them, and what turning, mirroring and reversing keep."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import mnclab
from mnclab import Kind, Setup, Tool
from mnclab.path.leads import Lead, way
from mnclab.path.toolpath import PathFault

R = 2.0  # of the tool, mm
FORMS = {"LT": "LEN7", "LN": "LEN6", "CT": "CCA70 R+5", "LCT": "R4"}


# --- the way itself ---------------------------------------------------------------------------------------------------

angles, places = st.floats(-3.1, 3.1), st.floats(-50, 50)


def unit(angle: float) -> np.ndarray:
    return np.array([math.cos(angle), math.sin(angle)])


@given(
    angles, places, places, st.sampled_from([1, -1]), st.floats(0.5, 20), st.floats(0.1, 6.2), st.sampled_from([1, -1])
)
def test_an_arc_touches_the_contour_on_its_side(course, x, y, side, radius, angle, sign):
    """CT: the centre lies R beside the contact, towards the tool for R > 0; the chord to H is 2 R sin(CCA/2) long."""
    t, to = unit(course), np.array([x, y])
    found = way(Lead("CT", 0, side, radius=sign * radius, angle=angle), np.zeros(2), to, t)
    assert found.centre is not None
    beside = found.centre - to
    assert abs(beside @ t) < 1e-9 and t[0] * beside[1] - t[1] * beside[0] == pytest.approx(side * sign * radius)
    assert np.hypot(*(found.by - to)) == pytest.approx(2 * radius * math.sin(angle / 2))
    assert found.sweep == pytest.approx(side * sign * angle)


@given(angles, places, places, st.floats(1, 15), places, places)
def test_line_and_arc_are_tangent_to_each_other_and_to_the_contour(course, x, y, radius, u, v):
    """LCT: the line stands square on the spoke at H, H and the contact lie on the circle, and the travel goes on there."""
    t, to, start = unit(course), np.array([x, y]), np.array([u, v])
    lead = Lead("LCT", 0, 1, radius=radius)
    away = start - to
    assume(abs(t[0] * away[1] - t[1] * away[0]) > 1e-3)
    centre = to + radius * np.sign(t[0] * away[1] - t[1] * away[0]) * np.array([-t[1], t[0]])
    if np.hypot(*(start - centre)) < radius - 1e-6:
        with pytest.raises(PathFault, match="inside of its arc"):
            way(lead, start, to, t)
        return
    assume(np.hypot(*(start - centre)) > radius + 1e-3)
    found = way(lead, start, to, t)
    assert found.centre is not None and np.allclose(found.centre, centre)
    spoke, line = found.by - centre, found.by - start
    assert np.hypot(*spoke) == pytest.approx(radius, rel=1e-9)
    assert abs(spoke @ line) < 1e-7 * max(1.0, np.hypot(*line))
    sense = math.copysign(1, found.sweep)
    assert sense * (spoke[0] * line[1] - spoke[1] * line[0]) > 0  # the arc goes on as the line travels
    c, s = math.cos(found.sweep), math.sin(found.sweep)
    assert np.allclose(centre + [c * spoke[0] - s * spoke[1], s * spoke[0] + c * spoke[1]], to, atol=1e-7)
    assert abs(found.sweep) < 2 * math.pi


def test_straight_ahead_needs_no_arc():
    found = way(Lead("LCT", 0, 1, radius=5), np.array([-20.0, 3]), np.array([0.0, 3]), np.array([1.0, 0]))
    assert found.centre is None and found.by.tolist() == [0, 3]


# --- whole contours ---------------------------------------------------------------------------------------------------


@st.composite
def open_contours(draw):
    """Corners of an open contour, how each is cut off, and where the tool comes from and goes to."""
    turns = draw(st.lists(st.floats(-1.7, 1.7).filter(lambda a: abs(a) > 0.1), min_size=1, max_size=5))
    course = draw(st.floats(-3, 3))
    points = [np.array([draw(places), draw(places)])]
    for turn in [0.0, *turns]:
        course += turn
        points.append(points[-1] + draw(st.floats(30, 60)) * unit(course))
    joints = [draw(st.sampled_from(["", "RND R3", "RND R4.5 F70", "CHF 3", "CHF 4 F80"])) for _ in turns]
    leads = draw(st.sampled_from(sorted(FORMS))), draw(st.sampled_from(sorted(FORMS)))
    first, last = points[1] - points[0], points[-1] - points[-2]
    back, on = -first / np.hypot(*first), last / np.hypot(*last)
    bend = draw(st.floats(-1, 1)), draw(st.floats(-1, 1))
    ends = points[0] + 40 * _spun(back, bend[0]), points[-1] + 40 * _spun(on, bend[1])
    return np.array(points), joints, leads, ends


def _spun(v, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * v[0] - s * v[1], s * v[0] + c * v[1]])


def program(points, joints, leads, ends, side="RL"):
    """In Klartext, from one end to the other."""
    here = [f"X{x:+.9f} Y{y:+.9f}" for x, y in np.asarray(points).tolist()]
    begin, stop = (f"X{x:+.9f} Y{y:+.9f}" for x, y in np.asarray(ends).tolist())
    lines = ["TOOL CALL 1 Z S1000 F500", f"L {begin} R0 F100", f"APPR {leads[0]} {here[0]} {FORMS[leads[0]]} {side}"]
    for joint, point in zip(["", *joints], here[1:], strict=True):
        lines += [joint] * bool(joint) + [f"L {point}"]
    lines += [f"DEP {leads[1]} {stop if leads[1] == 'LCT' else ''} {FORMS[leads[1]]}", f"L {stop} R0"]
    return "\n".join(lines) + "\n"


def path_of(text):
    """The motion from the first end to the other."""
    run = mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=R)}))
    assert run.ok, (run.alarms, text)
    return run.toolpath.motion[1:]


@settings(deadline=None, max_examples=40)
@given(open_contours(), st.floats(-3, 3))
def test_turning_the_program_turns_the_path(contour, spin):
    points, joints, leads, ends = contour
    plain = path_of(program(points, joints, leads, ends))
    turned = path_of(program([_spun(p, spin) for p in points], joints, leads, [_spun(p, spin) for p in ends]))
    assert plain.kind.tolist() == turned.kind.tolist() and plain.feed.tolist() == turned.feed.tolist()
    assert np.allclose([_spun(p, spin) for p in plain.end[:, :2]], turned.end[:, :2], atol=1e-6)
    assert np.allclose(plain.sweep, turned.sweep, atol=1e-6)


@settings(deadline=None, max_examples=40)
@given(open_contours())
def test_mirroring_the_program_and_the_side_mirrors_the_path(contour):
    points, joints, leads, ends = contour
    flip = np.array([-1, 1])
    plain = path_of(program(points, joints, leads, ends))
    other = path_of(program(points * flip, joints, leads, np.array(ends) * flip, "RR"))
    assert plain.kind.tolist() == other.kind.tolist()
    assert np.allclose(plain.end[:, :2] * flip, other.end[:, :2], atol=1e-7)
    assert np.allclose(plain.sweep, -other.sweep, atol=1e-7)


@settings(deadline=None, max_examples=40)
@given(open_contours())
def test_reversing_the_program_reverses_the_path(contour):
    points, joints, leads, ends = contour
    plain = path_of(program(points, joints, leads, ends))
    back = path_of(program(points[::-1], joints[::-1], leads[::-1], ends[::-1], "RR"))
    assert plain.kind.tolist() == back.kind.tolist()[::-1]
    assert np.allclose(plain.start[::-1, :2], back.end[:, :2], atol=1e-7)
    assert np.allclose(plain.sweep, -back.sweep[::-1], atol=1e-7)
    assert np.allclose(plain.centre[::-1], back.centre, atol=1e-6, equal_nan=True)


@settings(deadline=None, max_examples=40)
@given(open_contours())
def test_the_path_has_no_kinks_where_forms_are_tangent(contour):
    """From the auxiliary point on an approach LT, CT or LCT goes smoothly into the contour, and out of it again."""
    points, joints, leads, ends = contour
    path = path_of(program(points, joints, leads, ends))
    labels = np.array([path.labels[k] for k in path.label])
    for k in range(len(path) - 1):
        a, b = labels[k], labels[k + 1]
        if (a == "approach" and leads[0] != "LN" and (b != "approach" or leads[0] == "LCT")) or (
            b == "departure" and leads[1] != "LN"
        ):
            assert np.allclose(tangent(path[k], True), tangent(path[k + 1], False), atol=1e-6)


def tangent(move, at_end):
    """The direction (2,) of a move at its end or start."""
    if move.kind != Kind.ARC:
        d = (move.end - move.start)[:2]
    else:
        spoke = ((move.end if at_end else move.start) - move.centre)[:2]
        d = math.copysign(1, move.sweep) * np.array([-spoke[1], spoke[0]])
    return d / np.hypot(*d)


@settings(deadline=None, max_examples=40)
@given(st.floats(-2.5, 2.5).filter(lambda a: abs(a) > 0.05), st.floats(0.2, 6), st.booleans())
def test_corners_in_closed_form(turn, size, chamfer):
    """Two lines of 40 mm that turn by w: RND begins R tan(w/2) before the corner and turns by w; CHF its length before."""
    cut = size if chamfer else size * math.tan(abs(turn) / 2)
    joint = f"CHF {size:.9f}" if chamfer else f"RND R{size:.9f}"
    x, y = 40 + 40 * math.cos(turn), 40 * math.sin(turn)
    text = f"TOOL CALL 1 Z F100\nL X+40 Y+0\n{joint}\nL X{x:+.9f} Y{y:+.9f}\n"
    run = mnclab.run(text, "tnc-620")
    if cut > 40:
        assert not run.ok and "too short" in run.alarms[0].message
        return
    first, between, last = run.toolpath.motion
    assert first.end[:2] == pytest.approx([40 - cut, 0], abs=1e-6)
    assert last.start[:2] == pytest.approx([40 + cut * math.cos(turn), cut * math.sin(turn)], abs=1e-6)
    assert between.kind == (Kind.LINE if chamfer else Kind.ARC)
    if not chamfer:
        assert between.sweep == pytest.approx(turn, abs=1e-6)
        assert between.centre[:2] == pytest.approx([40 - cut, math.copysign(size, turn)], abs=1e-6)
