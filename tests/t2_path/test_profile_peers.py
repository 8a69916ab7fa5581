"""Profiles against ruckig, toppra and the optimum of a linear program (tests/authorities/generate_profiles.py).

All contours of a group of limits are planned as one path, each ending in an exact stop.
"""

import base64
import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest

from mnclab import Kind, Limits, Toolpath
from mnclab.path.profile import Profile, ramps

AUTHORITIES = Path(__file__).resolve().parents[1] / "authorities"
spec = importlib.util.spec_from_file_location("profile_cases", AUTHORITIES / "profile_cases.py")
cases = importlib.util.module_from_spec(spec)
spec.loader.exec_module(cases)
RECORDED = json.loads((AUTHORITIES / "profile.json").read_text())
MOVES, ALL, SIZE = cases.moves(), cases.contours(), cases.CONTOURS // cases.GROUPS
FAST = 1e9  # mm/min: only accelerations act


def recorded(name):
    return np.frombuffer(base64.b64decode(RECORDED[name]), "<f8")


def test_single_moves_take_as_long_as_ruckig_says():
    length, v0, v1, v, a, j = (np.array(column) for column in zip(*MOVES, strict=True))
    above = ramps.peak(length, v0, v1, v, a, j)
    seconds = ramps.phases(length, v0, v1, above, a, j)
    assert len(length) >= 5000
    assert np.abs(seconds.sum(axis=1) - recorded("ruckig")).max() < 1e-9
    reached_feed = np.maximum(v0, v1) + above >= v
    reached_a = seconds[:, 1] > 0
    both = [(f & r).sum() for f in (reached_feed, ~reached_feed) for r in (reached_a, ~reached_a)]
    assert min(both) > 200  # every combination is among them
    s, speed, rate, jerk = ramps.starts(seconds, v0, a, j)
    t = seconds[:, 6]
    assert np.abs(s[:, 6] + t * (speed[:, 6] + t * (rate[:, 6] / 2 + t * jerk[:, 6] / 6)) - length).max() < 1e-9


def test_a_profile_of_stops_takes_as_long_as_ruckig_says():
    for k in range(0, 300, 3):  # every third is from stop to stop
        length, _, _, v, a, j = MOVES[k]
        line = Toolpath.chain(
            np.array([[0, 0, 0], [0, length, 0]]), {"kind": np.array([1], np.uint8), "feed": np.array([60 * v])}
        )
        profile = Profile(line, Limits(rapid=FAST, acceleration=a, jerk=j))
        assert profile.time == pytest.approx(recorded("ruckig")[k], abs=1e-9)


def joined(contours):
    """The contours one after the other, each ending in an exact stop, and the row (c + 1,) where each begins."""
    vertices, rows, first = [np.zeros(3)], [], [0]
    for contour in contours:
        origin = vertices[-1]
        for i, (x, y, sweep, cx, cy) in enumerate(contour):
            vertices.append(origin + (x, y, 0.0))
            kind = Kind.ARC if sweep else Kind.LINE
            rows.append((kind, sweep, origin + (cx, cy, 0.0), i == len(contour) - 1))
        first.append(len(rows))
    kind, sweep, centre, exact = (np.array(column) for column in zip(*rows, strict=True))
    columns = {"kind": kind.astype(np.uint8), "sweep": sweep, "centre": centre, "exact": exact}
    return Toolpath.chain(np.array(vertices), {**columns, "feed": np.full(len(kind), FAST)}), first


@pytest.mark.parametrize("group", range(cases.GROUPS))
def test_contours_are_close_to_the_best_and_never_beyond(group):
    most = (*cases.accelerations()[group], 1000.0)
    part = slice(group * SIZE, (group + 1) * SIZE)
    path, first = joined(ALL[part])
    profile = Profile(path, Limits(rapid=FAST, acceleration=most))
    time = np.add.reduceat(profile.seconds, first[:-1])
    best, bound = recorded("optimum")[part], recorded("toppra")[part]
    assert (time >= best * (1 - 1e-6)).all()
    assert (time <= 1.05 * best).all()
    known = (bound > 0) & (bound <= best * 1.001)  # elsewhere toppra found no optimum
    assert known.mean() > 0.6
    assert (time[known] >= bound[known] * (1 - 1e-3)).all()
    assert (time[known] <= 1.05 * bound[known]).all()
    now = profile.at(np.linspace(0, profile.time, 40_001))
    assert (np.abs(now.acceleration) <= np.array(most) * (1 + 1e-6)).all()
    assert np.abs(profile.at(profile.starts[1:]).position - path.end).max() < 1e-9
    assert abs(profile.seconds.sum() - profile.time) < 1e-9


@pytest.mark.parametrize("group", range(cases.GROUPS))
@pytest.mark.parametrize("tolerance", [0.0, 0.05])
def test_no_axis_exceeds_speed_acceleration_or_jerk(group, tolerance):
    path, _ = joined(ALL[group * SIZE : (group + 1) * SIZE])
    tilt = path.end.copy()
    vertices = np.concatenate([path.start[:1], tilt])
    vertices[:, 2] = np.cumsum(np.sin(np.arange(len(vertices)) * 1.7) * 3)  # helices and slanting lines
    centre = path.centre.copy()
    columns = {"kind": path.kind, "sweep": path.sweep, "centre": centre, "exact": path.exact}
    path = Toolpath.chain(vertices, {**columns, "feed": np.full(len(path), 4000.0 + 900 * group)})
    most = Limits(
        rapid=(6000, 9000, 3000), acceleration=(*cases.accelerations()[group], 700.0), jerk=(2e4, 1e4 * (1 + group), 8e3),
        corner_tolerance=tolerance,
    )  # fmt: skip
    profile = Profile(path, most)
    rng = np.random.default_rng(group)
    h = 1e-5
    t = rng.uniform(0, profile.time, 20_000)
    t = t[profile.t[np.searchsorted(profile.t, t)] - t > 2 * h]  # within one piece
    t = t[t - profile.t[np.searchsorted(profile.t, t) - 1] > 2 * h]
    before, now, after = (profile.at(t + shift) for shift in (-h, 0, h))
    assert (np.abs(now.velocity) <= most.axes("rapid") * (1 + 1e-6)).all()
    assert (np.abs(now.acceleration) <= most.axes("acceleration") * (1 + 1e-6)).all()
    jerk = (after.acceleration - before.acceleration) / (2 * h)
    assert (np.abs(jerk) <= most.axes("jerk") * (1 + 1e-6) + 1e-3).all()
    assert np.abs(profile.at(profile.starts[1:]).position - path.end).max() < 1e-9
