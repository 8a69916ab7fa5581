"""Positioning of a probe is guarded: ball and stem against the part, the true probe, arcs (MNC 12.20, TNC 620 13.1)."""


import pytest

import mnclab as mnc

WALL = mnc.part.box((0, 0, -30), (100, 60, 0))
HEAD = "BEGIN PGM P MM\nTOOL CALL 7 Z\nL X-20 Y+20 Z+50 R0 FMAX\n"


def cycle(**changes):
    values = {"Q263": 0, "Q264": 20, "Q261": -5, "Q320": 0, "Q260": 20, "Q272": 1, "Q267": 1, "Q305": 0, "Q333": 0, "Q303": 1}
    words = "\n".join(f"{name}={value:g}" for name, value in (values | changes).items())
    return f"{HEAD}TCH PROBE 419 X\n{words}\nEND PGM P MM\n"


def run(text, part=WALL, radius=2.0, **setup):
    tools = {7: mnc.Tool(radius=radius, length=50, kind="probe")}
    return mnc.run(text, "tnc-620", mnc.Setup(tools=tools, part=part, start=(0, 0, 200), **setup))


def test_down_beside_a_wall_is_free():
    assert run(cycle()).ok


def test_down_into_the_part_stops_at_its_top():
    """A start over the part: the ball meets the top at Z0, 20 - 0 below the clearance height."""
    found = run(cycle(Q263=30))
    assert "path obstructed: the stylus touches the part at X26 Y20 Z0 while" in found.alarms[0].message
    assert found.toolpath.end[-1] == pytest.approx((26, 20, 0), abs=2e-6)


@pytest.mark.parametrize(("stem", "ok"), [(0.0, True), (0.49, True), (0.51, False), (0.8, False)])
def test_a_stem_under_an_overhang(stem, ok):
    """A ball of 1 touches the wall X0 with its centre at X-1: a stem beside an edge at X-0.5 may be 0.5 thick."""
    part = WALL | mnc.part.box((-0.5, 0, 5), (100, 60, 15))
    found = run(cycle(), part, radius=1.0, probe=mnc.Probe(stem=stem))
    assert found.ok == ok
    if not ok:
        assert "the stem of the probe touches the part before the ball does" in found.alarms[0].message
        assert found.toolpath.end[-1][0] == pytest.approx(-0.5 - stem, abs=0.02)


@pytest.mark.parametrize(("edge", "stem", "message"), [(-3.5, 0.3, "the stylus touches"), (-1.9, 1.6, "the stem of the probe")])
def test_down_beside_an_overhang(edge, stem, message):
    """The ball of 1 goes down at X-3, between X-4 and X-2: an edge at X-3.5 stops the ball, one at X-1.9 a stem of 1.6."""
    part = WALL | mnc.part.box((edge, 0, 5), (100, 60, 15))
    found = run(cycle(), part, radius=1.0, probe=mnc.Probe(stem=stem))
    assert f"path obstructed: {message}" in found.alarms[0].message


def test_the_clearance_of_a_probe_off_its_axis():
    """The table knows of no offset, but the ball stands 3 mm nearer to the wall: it meets the top where it should pass."""
    assert run(cycle(), probe=mnc.Probe(true_offset=(1.9, 0))).ok
    assert "path obstructed" in run(cycle(), probe=mnc.Probe(true_offset=(3, 0))).alarms[0].message


def test_what_is_not_calibrated_measures_wrong():
    """A ball of 2.03 taken for 2, 0.02 aside and 0.05 of deflection: the wall seems to be 2.05 - 0.03 - 0.02 off less."""
    found = run(
        cycle(Q305=3), true_tools={7: mnc.Tool(radius=2.03, length=50.01, kind="probe")},
        probe=mnc.Probe(true_offset=(0.02, 0), deflection=(0.05, 0, 0)),
    )  # fmt: skip
    assert found.tables.presets[3].x == pytest.approx(-0.03 - 0.02 + 0.05, abs=1e-9)


def test_the_spread_of_a_probe_has_a_seed():
    def wall(seed):
        return run(cycle(Q305=3), probe=mnc.Probe(spread=0.01, seed=seed)).tables.presets[3].x

    assert wall(1) == wall(1) != wall(2)
    many = [wall(seed) for seed in range(40)]
    assert 0.006 < (sum(x * x for x in many) / 40) ** 0.5 < 0.014


@pytest.mark.parametrize(("height", "doubtful"), [(-10, False), (-4, True)])
def test_a_contact_off_a_cut_edge_is_doubtful(height, doubtful):
    """A chamfer cut by a plane from (0, -5) on: a ball of 2 at Z-4 touches the edge, which no shape knows of."""
    part = WALL & mnc.part.plane((0, 0, -5), (-1, 0, 1))
    found = run(cycle(Q261=height), part)
    assert found.ok and len(found.touches) > 0
    assert any("off a cut edge of the part" in alarm.message for alarm in found.alarms) == doubtful


@pytest.mark.parametrize("height", [1.9999999, 2, 2.0000001])
def test_a_ball_that_rests_on_the_part_goes_on_to_the_wall(height):
    """A ball of 2 at Z2 rests on the upper side at Z0 when its touch begins; the wall stands at X30.25."""
    part = WALL | mnc.part.box((30.25, 0, -30), (100, 60, 20))
    found = run(cycle(Q263=30, Q261=height, Q260=40), part)
    assert found.measured["X"] == pytest.approx(30.25, abs=1e-6)


def test_a_way_along_the_upper_side_is_free_until_a_pin():
    """The clearance height is that of the upper side: the ball slides over 60 mm of it, a pin stops it.

    A pin of radius 0.05 that stands out by 0.02: a ball of 2 meets its edge at 0.05 + sqrt(2² - 1.98²) = 0.332.
    """
    text = f"{HEAD}L X+90 F1000\nL Z+0\n{cycle(Q263=0, Q260=0)[len(HEAD):]}"
    assert run(text).ok
    found = run(text, WALL | mnc.part.cylinder((50, 20, -10), (50, 20, 0.02), 0.05))
    assert "path obstructed: the stylus touches the part at X50.33 Y20 Z0" in found.alarms[0].message


def test_a_bounded_distance_is_told_where_it_stops_a_way():
    """A bore of 30 at X50 Y30, a lying one so that no prisms are left: it sticks out by 1, and a ball of 2 goes down in it."""
    lying = mnc.part.cylinder((90, -5, -15), (90, 65, -15), 3)
    part = WALL - lying - mnc.part.cylinder((50, 30, -30), (50, 30, 1), 15)
    found = run(cycle(Q263=54, Q264=30), part)
    assert "what is taken out of it should stick out by more than the ball" in found.alarms[0].hint


def test_a_deflection_goes_on():
    with pytest.raises(mnc.Alarm, match="the deflection of a probe must be at least 0 along each axis"):
        mnc.Probe(deflection=(0, -0.01, 0))
