"""A control that knows few blocks ahead, and limits learned by the stop-watch, against closed forms.

From a node the tool must be able to stop in the n blocks that are known: v² <= 2 a n L on equal blocks of length L.
"""

import math

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Alarm, Kind, Limits, Profile, Toolpath


def straight(blocks, length, feed=6000.0):
    x = np.arange(blocks + 1) * length
    columns = {"kind": np.full(blocks, Kind.LINE), "feed": np.full(blocks, feed)}
    return Toolpath.chain(np.stack([x, 0 * x, 0 * x], axis=1), columns)


def ring(blocks, radius=20.0):
    turn = np.linspace(0, 6, blocks + 1)
    text = [f"G3 X{radius * math.cos(t) - radius:.6f} Y{radius * math.sin(t):.6f} R{radius:g}" for t in turn[1:]]
    return mnc.run("\n".join(["G21 G90 G54 G1 X0 Y0 F6000", *text]), "g43").toolpath


@pytest.mark.parametrize("known", [1, 2, 3, 4])
def test_in_the_middle_of_equal_blocks_the_time_of_each_is_known(known):
    # at the nodes v² = 2 a n L, in the middle of a block a L more: each block takes 2 (v_m - v_n) / a
    a, length = 1000.0, 1.0
    profile = Profile(straight(60, length), Limits(acceleration=a, look_ahead=known))
    ends, middle = math.sqrt(2 * a * known * length), math.sqrt(2 * a * known * length + a * length)
    assert profile.seconds[20:40] == pytest.approx(2 * (middle - ends) / a, abs=1e-12)
    assert profile.v.max() == pytest.approx(middle, abs=1e-9)


def test_under_a_jerk_limit_the_speed_at_a_node_stops_within_the_known_blocks():
    # a ramp from v to rest over n L with a = v / T + ...: L = v (v / a + a / j) / 2, solved for v
    a, j, length, known = 1000.0, 50_000.0, 4.0, 2
    profile = Profile(straight(40, length, 60_000), Limits(rapid=1e6, acceleration=a, jerk=j, look_ahead=known))
    v = (-a / j + math.sqrt((a / j) ** 2 + 8 * known * length / a)) * a / 2
    at_nodes = profile.v[np.searchsorted(profile.move, np.arange(10, 30))]
    assert at_nodes == pytest.approx(v, rel=1e-9)


@pytest.mark.parametrize("jerk", [None, 50_000.0])
@pytest.mark.parametrize("path", [straight(50, 0.7), ring(50)], ids=["line", "circle"])
def test_more_look_ahead_is_never_slower_and_all_of_it_is_as_none(path, jerk):
    times = [Profile(path, Limits(jerk=jerk, look_ahead=known)).time for known in (0, 1, 2, 4, 8, 16, 32, len(path), 10**6)]
    assert (np.diff(times) <= 1e-9).all()
    assert times[0] > 2 * times[-1]
    assert times[-2:] == pytest.approx([Profile(path, Limits(jerk=jerk)).time] * 2, abs=1e-9)


def test_without_look_ahead_every_block_ends_in_a_stop():
    path = straight(5, 3.0)
    assert Profile(path, Limits(look_ahead=0)).seconds == pytest.approx(2 * math.sqrt(3.0 / 1000), abs=1e-12)
    twin = ring(7)
    assert Profile(twin, Limits(look_ahead=0)).v[np.searchsorted(Profile(twin, Limits(look_ahead=0)).move, range(7))].max() == 0


@pytest.mark.parametrize("bad", [-1, 1.5, "many", math.inf, math.nan])
def test_a_look_ahead_is_a_whole_number(bad):
    with pytest.raises(Alarm, match="look_ahead"):
        Limits(look_ahead=bad)


# --- limits learned from five times ----------------------------------------------------------------------------------

LENGTHS = (5.0, 20.0, 50.0, 200.0, 500.0)


def times_of(v, a):
    """Seconds of moves from stop to stop, v mm/s: L / v + v / a, or 2 sqrt(L / a) where v is not reached."""
    return {x: x / v + v / a if x >= v * v / a else 2 * math.sqrt(x / a) for x in LENGTHS}


@pytest.mark.parametrize("v, a", [(200.0, 800.0), (500.0, 5000.0), (20.0, 100.0), (1000.0, 9000.0), (166.7, 250.0)])
def test_limits_are_learned_from_exact_times(v, a):
    found = mnc.fit_limits(times_of(v, a))
    assert (found.limits.rapid, found.limits.acceleration) == pytest.approx((60 * v, a), rel=1e-9)
    assert np.abs(found.off).max() < 1e-9


def test_a_jerk_limit_is_learned_too():
    # T = L / v + v / a + a / j where v and a are reached, 4 (L / 2 j)^(1/3) where neither is
    v, a, j = 200.0, 2000.0, 40_000.0
    long = {x: x / v + v / a + a / j for x in (50.0, 200.0, 500.0)}
    short = {x: 4 * (x / (2 * j)) ** (1 / 3) for x in (1.0, 4.0)}
    found = mnc.fit_limits(short | long, jerk=True)
    assert (found.limits.rapid, found.limits.acceleration, found.limits.jerk) == pytest.approx((60 * v, a, j), rel=1e-7)


@pytest.mark.parametrize("reading", [0.01, None])
def test_the_uncertainty_has_the_limits_within_it_in_95_cases_of_100(reading):
    """Of 100 draws with a chance of 0.954 each, 91 or more are within it but in 3 cases of 100."""
    rng, within = np.random.default_rng(1), np.zeros(2)
    for _ in range(100):
        read = {x: t + rng.normal(0, 0.01) for x, t in times_of(200.0, 800.0).items()}
        found = mnc.fit_limits(read, reading=reading)
        off = np.array([found.limits.rapid - 12_000, found.limits.acceleration - 800])
        within += np.abs(off) <= [*found.uncertainty.values()]
    assert (within >= 91).all(), within


def test_what_stays_unknown_is_said():
    with pytest.raises(Alarm, match="do not say the rapid"):  # no move is long enough
        mnc.fit_limits({x: 2 * math.sqrt(x / 500) for x in (1.0, 2.0, 5.0, 9.0)})
    with pytest.raises(Alarm, match="acceleration and jerk apart|do not say the jerk"):  # all are long
        mnc.fit_limits({x: x / 200 + 0.4 for x in (100.0, 200.0, 300.0, 400.0, 500.0)}, jerk=True)
    with pytest.raises(Alarm, match="a longer move takes longer"):
        mnc.fit_limits({10.0: 1.0, 20.0: 0.9, 30.0: 2.0})
    with pytest.raises(Alarm, match="2 limits need 3 times"):
        mnc.fit_limits({10.0: 1.0, 20.0: 1.5})
    assert mnc.fit_limits({10.0: 0.3, 400.0: 2.5}, reading=0.05).uncertainty["rapid"] > 0
    for odd in (None, [1, 2], {"a": 1.0}, {1.0: None}, {0: 1.0}, {1.0: math.nan}, {1.0: -1, 2.0: 1, 3.0: 2}):
        with pytest.raises(Alarm):
            mnc.fit_limits(odd)
