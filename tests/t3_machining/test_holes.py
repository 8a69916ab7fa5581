"""Strategies at a hole: depths, counts and order against closed forms; the controls' examples are tested with the controls."""

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.machining.depths import MOST, TooMany, advanced_stops, infeeds
from mnclab.machining.holes import DIRECTIONS, back_bore, back_to_axis, bore, drill, guided, gun_drill, ream
from mnclab.machining.steps import RAPID, Coolant, Go, Orient, Spin, Wait

sizes = st.integers(1, 4000).map(lambda n: n / 100)


def cuts(steps, feed):
    """Levels reached at a feed."""
    return [step.z for step in steps if isinstance(step, Go) and step.feed == feed]


def waits(steps, label):
    return sum(step.seconds for step in steps if isinstance(step, Wait) and step.label == label)


@given(depth=sizes, step=sizes, decrement=st.integers(1, 300).map(lambda n: n / 100), least=sizes)
def test_infeeds_that_shrink(depth, step, decrement, least):
    """e_k = max(P - (k - 1) K, M), never above P; the depths are their sums, the last one the depth itself."""
    levels = infeeds(0, -depth, step, decrement, least)
    reached, k = 0.0, 0
    expected = []
    while reached < depth - 1e-9:
        reached += max(step - k * decrement, min(least, step))
        k += 1
        expected.append(min(reached, depth))
    assert levels == pytest.approx([-level for level in expected], abs=1e-9)
    assert levels[-1] == -depth


def test_a_decrement_without_a_least_infeed_may_never_arrive():
    """5 + 4 + 3 + 2 + 1 = 15, and then nothing."""
    assert infeeds(0, -15, 5, 1) == (-5, -9, -12, -14, -15)
    with pytest.raises(TooMany, match="5 less 1 each time divides 15.1 into more than 10000 infeeds"):
        infeeds(0, -15.1, 5, 1)


@pytest.mark.parametrize("step", [1e-300, 1e-9, 0.999 / MOST])
def test_too_many_infeeds_are_refused_before_they_are_made(step):
    with pytest.raises(TooMany):
        infeeds(0, -1.5, step)
    assert len(infeeds(0, -1, 1 / MOST)) == MOST


def test_advanced_stops_go_evenly_from_the_first_to_the_last():
    """TNC 620, 4.8: linear over the re-entries; a single one takes the first."""
    assert advanced_stops(0.5, 1.1, 4) == (0.5, 0.7, 0.9, 1.1)
    assert advanced_stops(0.5, 1, 1) == (0.5,) and advanced_stops(0.5, 1, 0) == ()


@given(depth=sizes, step=sizes, breaks=st.integers(0, 4))
def test_so_many_chip_breaks_before_each_withdrawal(depth, step, breaks):
    """n infeeds have n - 1 interruptions; every (breaks + 1)-th is a withdrawal, the others are chip breaks."""
    levels = infeeds(0, -depth, step)
    steps = list(drill(levels, above=2, feed=100, reenter=1, withdraw=300, breaks=breaks, back=0.2, dwell_top=0.5))
    out = [step.z for step in steps if step.label == "clear the chips"]
    broken = [step.z for step in steps if step.label == "break the chip"]
    assert cuts(steps, 100) == list(levels)
    assert len(out) == (len(levels) - 1) // (breaks + 1) and set(out) <= {2}
    assert len(broken) == len(levels) - 1 - len(out)
    assert broken == [z + 0.2 for k, z in enumerate(levels[:-1], 1) if k % (breaks + 1)]
    assert waits(steps, "dwell at the top") == pytest.approx(0.5 * len(out))


def test_a_return_stops_above_the_last_depth_but_not_above_the_hole():
    steps = drill([-1, -5, -9], above=2, feed=100, reenter=4)
    assert [step.z for step in steps if step.label == "return"] == [2, -1]
    upwards = drill([1, 5, 9], above=-2, feed=100, reenter=4)
    assert [step.z for step in upwards if step.label == "return"] == [-2, 1]


def test_one_distance_for_each_return():
    steps = drill([-4, -8, -12], above=2, feed=100, reenter=advanced_stops(1, 0.5, 2))
    assert [step.z for step in steps if step.label == "return"] == [-3, -7.5]


def test_chips_broken_within_an_infeed():
    """Every 3 of an infeed of 8: at 3 and 6, back by 0.5, to the depth again at 700."""
    steps = list(drill([-8, -16], above=2, feed=100, reenter=1, withdraw=250, break_every=3, back=0.5, approach=700))
    assert cuts(steps, 100) == [-1, -4, -7, -8, -11, -14, -16]  # the first infeed counts from 2
    assert cuts(steps, 700) == [-1, -4, -7, -11, -14]
    assert cuts(steps, 250) == [-0.5, -3.5, -6.5, 2, -10.5, -13.5]


def test_dwells_at_each_level_and_at_the_last():
    steps = list(drill([-5, -10, -15], above=2, feed=1, reenter=1, dwell_each=0.1, dwell_bottom=0.7))
    assert waits(steps, "dwell") == pytest.approx(0.2) and waits(steps, "dwell at the bottom") == 0.7


def test_reaming_in_and_out():
    steps = list(ream(-5, above=2, feed=80, retract=120, dwell=1))
    assert [(step.z, step.feed) for step in steps if isinstance(step, Go)] == [(-5, 80), (2, 120)]


@pytest.mark.parametrize("direction", [0, *DIRECTIONS])
def test_boring_leaves_the_wall_with_the_spindle_stopped(direction, trace):
    found = trace(bore(-5, above=2, feed=80, retract=120, angle=45, direction=direction), 2)
    kinds = [type(step) for step, _ in found]
    assert kinds.index(Orient) < len(kinds) - (2 if direction else 1)
    x, y, z = found[-1][1]
    assert z == 2 and math.hypot(x, y) == pytest.approx(0.2 if direction else 0)
    assert (x, y) == tuple(0.2 * part for part in DIRECTIONS.get(direction, (0, 0)))


def test_back_boring_passes_the_hole_only_off_its_axis(trace):
    """Lower surface -20, clearance 2, edge 12 above the end: free below -34, counterbore of 5 at -27."""
    found = trace(
        back_bore(above=2, below=-34, bottom=-27, eccentricity=3.5, direction=3, angle=0, feed=200, travel=750,
                  dwell=1, turning=-1), 2,
    )  # fmt: skip
    points = [(0.0, 0.0, 2.0), *(point for _, point in found)]
    for (x, _, above), (_, _, below) in pairwise(points):
        if max(above, below) > -27:
            assert x in (0.0, 3.5) and (above == below or x == 3.5)
    turning = False
    for step, (x, _, z) in found:
        turning = turning if not isinstance(step, Spin | Orient) else isinstance(step, Spin)
        assert turning == (x == 0 and z <= -27) or isinstance(step, Orient) or (x, z) == (0, -34)
    assert points[-1] == (3.5, 0.0, 2.0)


def test_gun_drilling_pauses_on_the_way_and_goes_on_slower():
    steps = list(
        gun_drill([-10, -20, -30], above=2, start=-3, feed=100, approach=700, retract=900, entry=(-1, 25), speed=500,
                  dwell=0.5, pause=-14, feed_after=60)
    )  # fmt: skip
    assert cuts(steps, 100) == [-10, -14] and cuts(steps, 60) == [-20, -30]
    assert [step.seconds for step in steps if isinstance(step, Wait)] == [0.5] * 4
    kinds = [step for step in steps if isinstance(step, Spin | Coolant)]
    assert [k[1:] for k in kinds] == [(-1, 25), (1, 500), (True,), (False,), (-1, 25)]
    assert cuts(steps, 700) == [-3] and cuts(steps, 900) == [2] and cuts(steps, RAPID) == []


@given(deepened=sizes, clearance=sizes, up=st.sampled_from([1, -1]))
def test_a_guided_drill_begins_and_clears_inside_the_hole(deepened, clearance, up):
    """TNC 620, Q379: never above 0.8 or 0.2 of the depth, never more than the clearance above its end."""
    planes = guided(10, deepened, clearance, up)
    start, clear = (up * (10 - level) for level in planes)  # below the surface
    assert start == pytest.approx(deepened - min(deepened / 5, clearance))
    assert clear == pytest.approx(deepened - min(deepened * 4 / 5, clearance))
    assert guided(10, 0, clearance, up) == (10 + up * clearance,) * 2


def test_the_first_infeed_may_count_from_below_the_withdrawal():
    """From -2, drilled in a guide that ends at -1; chips broken every 3 at a feed of their own."""
    steps = list(
        drill([-9, -12], above=-1, start=-2, feed=100, reenter=0.5, break_every=3, back=0.5, back_feed=60, approach=700)
    )
    assert cuts(steps, 100) == [-5, -8, -9, -12]
    assert cuts(steps, 60) == [-4.5, -7.5] and cuts(steps, RAPID) == [-1, -8.5]


def gun(**more):
    return list(gun_drill([-10, -20, -30], above=2, start=-3, feed=100, approach=700, retract=900, entry=(1, 25), speed=500,
                          dwell=0.5, **more))  # fmt: skip


def test_gun_drilling_pauses_at_a_level_only_once():
    steps = gun(pause=-20, feed_after=60)
    assert cuts(steps, 100) == [-10, -20] and cuts(steps, 60) == [-30]
    assert [step.seconds for step in steps if isinstance(step, Wait)] == [0.5] * 3


@pytest.mark.parametrize("pause", [-3, 0, 5, -30.5])
def test_gun_drilling_does_not_pause_where_it_does_not_drill(pause):
    assert cuts(gun(pause=pause, feed_after=60), 100) == [-10, -20, -30]


def test_the_coolant_of_gun_drilling_is_named_and_may_stay_on_until_the_spindle_is_slow():
    last = [step for step in gun(coolant=("M8", "M9"), cool_until_slow=True) if isinstance(step, Spin | Coolant)][-2:]
    assert [step.label for step in last] == ["spindle for the exit", "M9"]
    assert [step.label for step in gun() if isinstance(step, Spin | Coolant)][-2:] == [
        "coolant off",
        "spindle for the exit",
    ]
    assert not any(isinstance(step, Coolant) for step in gun(coolant=("", "")))


def test_out_of_a_bore_along_it_first(trace):
    found = trace([Go("", -5, x=0.2, y=0.0), *back_to_axis(9, -1)], 2)
    assert [point for _, point in found][1:3] == [(0.2, 0, 9), (0, 0, 9)]
    assert found[-1][0][1:] == (-1, None)


def test_back_boring_cools_while_it_bores():
    steps = back_bore(above=2, below=-34, bottom=-27, eccentricity=3.5, direction=3, angle=0, feed=200, travel=750, dwell=1,
                      turning=1, coolant=True)  # fmt: skip
    order = [step.label for step in steps if isinstance(step, Coolant) or "counterbore" in step.label]
    assert order == ["coolant on", "counterbore", "leave the counterbore", "coolant off"]
