"""Arcs under a jerk limit reach the speed of uniform motion, v³ = j r², and no axis is asked for more than it has.

Authority: the closed form of uniform circular motion, whose jerk is v³ / r² on an axis; and the third difference quotient
of the places that the profile gives.
"""

import math

import numpy as np
import pytest

from mnclab import Kind, Limits, Toolpath
from mnclab.path.profile import Profile, timing


def arcs(radius, sweeps, plane=(0, 1), rise=0.0, feed=60_000.0):
    """Arcs about the origin one after the other, `rise` mm a radian across their plane, ending in a stop."""
    angle = np.concatenate([[0.0], np.cumsum(sweeps)])
    points = np.zeros((len(angle), 3))
    points[:, plane[0]], points[:, plane[1]] = radius * np.cos(angle), radius * np.sin(angle)
    points[:, 3 - sum(plane)] = rise * angle
    axis = np.zeros((len(sweeps), 3))
    axis[:, 3 - sum(plane)] = 1.0
    many = {"kind": np.full(len(sweeps), Kind.ARC, np.uint8), "sweep": np.array(sweeps), "feed": np.full(len(sweeps), feed)}
    centre = np.zeros((len(sweeps), 3))
    centre[:, 3 - sum(plane)] = points[:-1, 3 - sum(plane)]
    return Toolpath.chain(points, {**many, "centre": centre, "axis": axis})


def greatest(profile, h=2e-5):
    """The greatest velocity, acceleration and jerk (3,) of the axes, all from places alone, within pieces."""
    t = np.random.default_rng(1).uniform(0, profile.time, 30_000)
    k = np.searchsorted(profile.t, t)
    t = t[(profile.t[k] - t > 3 * h) & (t - profile.t[k - 1] > 3 * h)]
    places = [profile.at(t + shift * h).position for shift in (-2, -1, 0, 1, 2)]
    speed = (places[3] - places[1]) / (2 * h)
    acceleration = (places[3] - 2 * places[2] + places[1]) / h**2
    now = [profile.at(t + shift * h).acceleration for shift in (-1, 1)]
    return [np.abs(each).max(axis=0) for each in (speed, acceleration, (now[1] - now[0]) / (2 * h))]


@pytest.mark.parametrize("plane", [(0, 1), (2, 0), (1, 2)])
@pytest.mark.parametrize("sweeps", [[2 * math.pi * 3], [2 * math.pi] * 3, [math.pi / 8] * 48, [-2 * math.pi] * 3])
def test_a_circle_reaches_the_speed_of_uniform_motion(plane, sweeps):
    """radius 5, j = 50000: v = (50000 · 25)^(1/3) = 107.7 mm/s; however many arcs the program writes for it."""
    profile = Profile(arcs(5, sweeps, plane), Limits(rapid=40_000, acceleration=5000, jerk=50_000, corner_tolerance=0.01))
    bound = math.cbrt(50_000 * 25)
    assert 0.99 * bound < profile.v.max() <= bound
    assert 30 * math.pi / bound < profile.time < 30 * math.pi / bound * 1.4
    speed, acceleration, jerk = greatest(profile)
    assert (acceleration <= 5000 * (1 + 1e-4)).all() and (jerk <= 50_000 * (1 + 1e-5)).all()


def test_the_circle_and_its_lines_agree():
    limits = Limits(rapid=40_000, acceleration=5000, jerk=50_000, corner_tolerance=0.01)
    angle = np.linspace(0, 6 * math.pi, 1081)
    points = np.stack([5 * np.cos(angle), 5 * np.sin(angle), 0 * angle], axis=1)
    lines = Toolpath.chain(points, {"kind": np.full(1080, Kind.LINE, np.uint8), "feed": np.full(1080, 60_000.0)})
    round_, straight = Profile(arcs(5, [2 * math.pi] * 3), limits), Profile(lines, limits)
    assert round_.time == pytest.approx(straight.time, rel=0.05)
    assert round_.v.max() == pytest.approx(straight.v.max(), rel=0.03)


@pytest.mark.parametrize("rise", [0.0, 0.4, 3.0])
@pytest.mark.parametrize("plane", [(0, 1), (2, 0), (1, 2)])
@pytest.mark.parametrize("feed", [3000.0, 60_000.0])
def test_no_axis_exceeds_unequal_limits(rise, plane, feed):
    most = Limits(rapid=(9000, 6000, 4000), acceleration=(2500, 1500, 700), jerk=(30_000, 20_000, 8000), corner_tolerance=0.01)
    path = arcs(8, [2.0, 2 * math.pi, 9.0, 0.3, 0.02, 5 * math.pi], plane, rise, feed)
    found = greatest(Profile(path, most))
    for name, values in zip(("rapid", "acceleration", "jerk"), found, strict=True):
        assert (values <= most.axes(name) * (1 + 1e-3)).all(), name


def test_an_axis_across_the_plane_is_no_bound_for_turning():
    """A flat helix: Z moves evenly, its jerk is none, so its jerk limit of a hundredth does not slow the circle."""
    limits = Limits(rapid=40_000, acceleration=5000, jerk=(50_000, 50_000, 500), corner_tolerance=0.01)
    slope = 1 + 0.1**2  # (ds / r dφ)²: ω = 1 / (r sqrt(slope)), the slope in the plane 1 / sqrt(slope)
    bound = math.cbrt(50_000 * 25) * math.sqrt(slope)
    found = Profile(arcs(5, [2 * math.pi * 40], rise=0.5), limits)
    assert 0.98 * bound < found.v.max() <= bound * (1 + 1e-9)


def test_stages_cost_nothing(monkeypatch):
    rng = np.random.default_rng(5)
    for _ in range(20):
        path = arcs(rng.uniform(1, 30), rng.uniform(0.05, 9, 12).tolist(), rise=rng.uniform(0, 1), feed=rng.uniform(500, 2e4))
        most = {"acceleration": rng.uniform(300, 5000), "jerk": 10 ** rng.uniform(3.5, 5.5)}
        limits = Limits(rapid=20_000, corner_tolerance=0.01, **most)
        staged = Profile(path, limits)
        with monkeypatch.context() as patched:
            patched.setattr(timing, "staged", lambda *_: None)
            assert staged.time <= Profile(path, limits).time * (1 + 1e-9)
        assert staged.seconds.sum() == pytest.approx(staged.time, abs=1e-9)
        assert np.abs(staged.at(staged.starts[1:]).position - path.end).max() < 1e-9
