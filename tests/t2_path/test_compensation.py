"""The equidistant: its distance from the contour, and what it keeps when the contour is turned, mirrored or reversed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Kind, Setup, Tool

R = 2.0


def program(points, side="G41", spin=0.0):
    """A closed convex contour with a tangential lead-in and lead-out, in MNC."""
    c, s = np.cos(spin), np.sin(spin)
    p = np.asarray(points) @ np.array([[c, s], [-s, c]])
    t = (p[1] - p[0]) / np.linalg.norm(p[1] - p[0])
    middle = (p[0] + p[1]) / 2
    way = [middle, *p[1:], p[0], middle + 1e-3 * t]
    lines = [f"X{x:.12f} Y{y:.12f}" for x, y in np.asarray(way).tolist()]
    head, tail = middle - 20 * t, middle + 25 * t
    return "\n".join(
        [
            "G17 G90 G54 T1",
            f"G0 X{head[0]:.12f} Y{head[1]:.12f}",
            f"{side} G1 {lines[0]} F100",
            *lines[1:],
            f"G40 X{tail[0]:.12f} Y{tail[1]:.12f}",
            "",
        ]
    )


def compensated(text, radius=R):
    run = mnclab.run(text, "mnc", Setup(tools={1: Tool(radius=max(radius, 0), dr=min(radius, 0))}))
    assert run.ok, run.alarms
    return run


def distances(points, contour):
    """Distance of points (m, 2) to a closed polygon (n, 2)."""
    a, b = contour, np.roll(contour, -1, axis=0)
    d = b - a
    t = np.clip(((points[:, None] - a) * d).sum(-1) / (d * d).sum(-1), 0, 1)
    return np.linalg.norm(points[:, None] - (a + t[..., None] * d), axis=-1).min(axis=1)


@st.composite
def convex(draw):
    """A convex polygon, counter-clockwise."""
    gaps = np.array(draw(st.lists(st.floats(1, 1.8), min_size=3, max_size=8)))
    angles = draw(st.floats(0, 6)) + np.cumsum(gaps) * 2 * np.pi / gaps.sum()
    size = draw(st.floats(30, 90))
    return np.round(size * np.stack([np.cos(angles), np.sin(angles)], axis=1), 4)


def body(path):
    """Points of the contour part of a path (without entry and exit)."""
    on = np.flatnonzero((path.side != 0) & path.is_motion)
    return path[on[1:]].points(0.001)[0][:, :2]


@given(convex(), st.sampled_from(["G42", "G41"]))
def test_the_centre_stays_at_the_radius(points, side):
    """Outside (G42 round a counter-clockwise contour) everywhere; inside the corners are cut but never nearer."""
    run = compensated(program(points, side))
    gap = distances(body(run.toolpath), points)
    assert (gap > R - 2e-3).all()
    if side == "G42":
        assert (gap < R + 2e-3).all()
        assert (run.toolpath.kind == Kind.ARC).sum() == len(points)


@given(convex(), st.floats(-3, 3))
def test_turning_the_contour_turns_the_path(points, spin):
    plain, turned = (compensated(program(points, "G42", a)).toolpath for a in (0.0, spin))
    c, s = np.cos(spin), np.sin(spin)
    assert np.allclose(plain.end[:, :2] @ np.array([[c, s], [-s, c]]), turned.end[:, :2], atol=1e-9)
    assert np.allclose(plain.sweep, turned.sweep, atol=1e-9)


@given(convex())
def test_reversing_the_contour_and_swapping_the_side_keeps_the_path(points):
    """The same closed equidistant, run the other way."""
    one = compensated(program(points, "G42")).toolpath
    other = compensated(program(points[::-1], "G41")).toolpath
    for path in (one, other):
        assert (path.kind == Kind.ARC).sum() == len(points)
    corners = [np.sort(p.centre[p.kind == Kind.ARC][:, 0]) for p in (one, other)]
    assert np.allclose(*corners, atol=1e-9)
    assert np.allclose(*[np.sort(np.abs(p.sweep[p.kind == Kind.ARC])) for p in (one, other)], atol=1e-9)


def test_radius_zero_is_the_contour():
    text = program(np.array([[0, 0], [40, 0], [40, 40], [0, 40.0]]))
    run = compensated(text, radius=0.0)
    assert run.toolpath is run.programmed


def test_a_negative_radius_is_the_other_side():
    text = program(np.array([[0, 0], [40, 0], [40, 40], [0, 40.0]]), "G42")
    other = program(np.array([[0, 0], [40, 0], [40, 40], [0, 40.0]]), "G41")
    assert np.allclose(compensated(text, R).toolpath.end, compensated(other, -R).toolpath.end)


def test_moves_along_z_between_keep_the_place():
    """A plunge and a dwell-like block between two elements happen at the end of the first offset."""
    run = compensated("G90 G54 T1\nG0 X-20\nG41 G1 X0 F100\nX30\nZ-5\nX50\nY20\nG40 Y40\n")
    z_row = run.toolpath[run.toolpath.line == 5]
    assert np.allclose(z_row.start[0], [30, R, 0]) and np.allclose(z_row.end[0], [30, R, -5])


@pytest.mark.parametrize("plane, first, second", [("G17", "X", "Y"), ("G18", "Z", "X"), ("G19", "Y", "Z")])
def test_the_three_planes_agree(plane, first, second):
    """Left of the travel is the same in every plane, seen from the positive end of its normal."""
    a, b = first, second
    run = compensated(f"{plane} G90 G54 T1\nG0 {a}-20\nG42 G1 {a}0 F100\n{a}30\n{b}20\nG40 {b}40\n")
    axes = {"X": 0, "Y": 1, "Z": 2}
    end = run.toolpath.end[:, [axes[a], axes[b]]]
    # right of the first axis lies -R; the corner turns left, so it is an outside corner for the right side
    assert np.allclose(end[-5:], [[0, -R], [30, -R], [30 + R, 0], [30 + R, 20], [0 + 30, 40]])


def test_a_run_that_breaks_off_does_not_know_its_last_element():
    """The corner at (30, 0) needs the block that was never read."""
    run = mnclab.run("G90 G54 T1\nG0 X-20\nG41 G1 X0 F100\nX30\nY20 U5\n", "mnc", Setup(tools={1: Tool(radius=R)}))
    assert [a.span.line for a in run.alarms] == [5]
    assert run.programmed.line.max() == 4 and run.toolpath.line.max() == 3


def test_a_fault_of_the_pass_cuts_path_history_and_state():
    """The short element of line 5 is found when line 6 is known; nothing from line 5 on counts."""
    text = "G90 G54 T1\nG0 X-20\nG42 G1 X0 F100\nX30\nX31 Y1\nX31 Y60 F300\nX0\nG40 Y90\nT3\n"
    run = mnclab.run(text, "mnc", Setup(tools={1: Tool(radius=9.0), 3: Tool(radius=1)}))
    inside = mnclab.run(text.replace("G42", "G41"), "mnc", Setup(tools={1: Tool(radius=9.0), 3: Tool(radius=1)}))
    assert run.ok and not inside.ok
    assert inside.alarms[0].span.line == 5 and "too short" in inside.alarms[0].message
    assert inside.programmed.line.max() == 4
    last = len(inside.steps.block) - 1
    assert inside.history.value("feed", last) == 100 and inside.at(step=last).line == 4
