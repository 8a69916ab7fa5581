"""Cutting data against closed forms: vc = π D n / 1000, fz = vf / (n z), hm = fz ae / (R φ) with cos φ = 1 - 2 ae / D."""

import math

import pytest

import mnclab
from mnclab import Alarm, Limits, Setup, Tool

BLANK = ((0, 0, -20), (60, 40, 0))
HEAD = "G17 G90 G54\nT1 S2000 M3\n"


def milled(y, z, tool=None, stock=BLANK, **more):
    """A straight cut along X at 400 mm/min; the tool's middle at y and z."""
    tool = tool or Tool(radius=5, teeth=4, kind="mill", name="end mill 10", centre_cutting=True)
    text = f"{HEAD}G0 X-10 Y{y} Z5\nG1 Z{z} F100\nX80 F400\nG0 Z5\n"
    return mnclab.run(text, "mnc", Setup(tools={1: tool}, stock=stock, **more)).cutting_data


@pytest.mark.parametrize("ae", [1, 2.5, 5, 7.5])
def test_a_side_cut_of_a_mill(ae):
    """The tool stands ae deep in the wall y = 0, 3 mm under the top."""
    (cut,) = milled(ae - 5, -3)()
    angle = math.acos(1 - 2 * ae / 10)
    assert cut.speed == (2000, 2000) and cut.feed == (400, 400)
    assert cut.surface == pytest.approx([math.pi * 10 * 2000 / 1000] * 2)
    assert cut.per_rev == pytest.approx([0.2] * 2) and cut.per_tooth == pytest.approx([0.05] * 2)
    assert cut.depth == pytest.approx([3, 3], abs=1e-6)
    assert cut.width == pytest.approx([ae, ae], abs=0.1)  # the rim is looked at degree by degree
    assert cut.chip == pytest.approx([0.05 * ae / (5 * angle)] * 2, rel=0.02)


def test_a_slot_and_a_small_width():
    """A slot: φ = π, so hm = 2 fz / π. Of a small width hm is about fz √(ae / D)."""
    (slot,) = milled(20, -3)()
    assert slot.width == pytest.approx([10, 10], abs=0.01) and slot.chip == pytest.approx([0.05 * 2 / math.pi] * 2, rel=1e-3)
    (light,) = milled(0.2 - 5, -3)()
    assert light.chip[0] == pytest.approx(0.05 * math.sqrt(0.2 / 10), rel=0.1)


@pytest.mark.parametrize("length", [8, 12, 30])
def test_a_short_part_in_a_long_row(length):
    """10 mm wide and 3 deep: what is in the air does not count."""
    (cut,) = milled(20, -3, stock=((0, 0, -20), (length, 40, 0)))()
    assert cut.depth == pytest.approx([3, 3], abs=1e-6) and cut.width == pytest.approx([10, 10], abs=0.01)
    assert cut.chip == pytest.approx([0.05 * 2 / math.pi] * 2, rel=1e-3)


def test_the_removal_rate_and_the_power():
    """In the slot 10 · 3 · 400 = 12000 mm³/min where it is full, whatever air its row has. kc 1800: Pc = Q kc / 60e6 kW."""
    (slot,) = milled(20, -3, limits=Limits(acceleration=1e9))(kc=1800)
    assert slot.rate[1] == pytest.approx(12000, rel=0.01) and slot.power == pytest.approx(slot.rate[1] * 1800 / 60e6)


def test_of_a_drill_without_a_blank():
    """fz = 120 / (1000 · 2), h = fz sin 59°."""
    text = "G17 G90 G54\nT2 S1000 M3\nG0 X10 Y10 Z5\nG1 Z-10 F120\nG0 Z5\n"
    found = mnclab.run(text, "mnc").cutting_data()
    assert found[0].per_tooth == pytest.approx([0.06] * 2)
    assert found[0].chip == pytest.approx([0.06 * math.sin(math.radians(59))] * 2)
    assert found[0].rate is None and "Without a blank" in " ".join(found.notes)
    assert found.rows() == [("T2 drill 8", "1000", "25.1", "120", "0.12", "0.06", "0.051")]


LATHE = "M3 T1\n{speed}\nG95 F0.2\nG00 X{x} Z2\nG01 Z-30\nG00 X40\n"


def turned(x, speed, radius=24, **more):
    setup = Setup(start=(40, 0, 20), stock=mnclab.blank.cylinder(radius, -60, 0), **more)
    return mnclab.run(LATHE.format(x=x, speed=speed), "jnc-t01", setup).cutting_data()


def test_turning_along_a_bar():
    """X is a radius: from 24 to 22 mm at 500 rev/min: vc = π 44 500 / 1000, vf = 0.2 · 500, ap = 2."""
    (cut,) = turned(22, "S500 G97")
    assert cut.surface == pytest.approx([math.pi * 44 * 500 / 1000] * 2) and cut.feed == pytest.approx([100, 100])
    assert cut.per_rev == pytest.approx([0.2, 0.2]) and cut.per_tooth is None
    assert cut.depth == pytest.approx([2, 2])


def test_the_depth_of_turning_before_a_shoulder():
    """From 24 to 22 down to Z-10, then to 20 down to Z-20: 2 mm, and 2 and then 4 mm; 100 mm of air change nothing."""
    text = "M3 T1\nS500 G97\nG95 F0.2\nG00 X22 Z100\nG01 Z-10\nG00 X26\nG00 Z2\nG00 X20\nG01 Z-20\nG00 X40\n"
    setup = Setup(start=(40, 0, 20), stock=mnclab.blank.cylinder(24, -60, 0), limits=Limits(acceleration=1e9))
    (cut,) = mnclab.run(text, "jnc-t01", setup).cutting_data()
    assert cut.depth == pytest.approx([2, 4]) and cut.rate[1] == pytest.approx(math.pi * (24**2 - 20**2) * 100)


def test_a_cut_across_the_face():
    """2 mm at 0.2 mm a turn; Q is below 2 π 24 · 2 · 100, for the nose and the edge are not as far out as the rim."""
    text = "M3 T1\nS500 G97\nG95 F0.2\nG00 X30 Z-2\nG01 X0\nG00 Z2\n"
    setup = Setup(start=(40, 0, 20), stock=mnclab.blank.cylinder(24, -60, 0), limits=Limits(acceleration=1e9))
    (cut,) = mnclab.run(text, "jnc-t01", setup).cutting_data()
    assert cut.depth == pytest.approx([2, 2]) and 0.95 < cut.rate[1] / (2 * math.pi * 24 * 2 * 100) < 1


def test_constant_cutting_speed_and_the_limit_of_the_spindle():
    """G96 S120 at radius 22: n = 120000 / (2 π 22) = 868; a spindle of 500 turns at 500, and vc falls to 2 π 22 · 0.5."""
    (free,), (held,) = turned(22, "G96 S120"), turned(22, "G96 S120", limits=Limits(spindle=500))
    assert free.surface == pytest.approx([120, 120]) and free.speed == pytest.approx([120_000 / (2 * math.pi * 22)] * 2)
    assert held.speed == (500, 500) and held.surface == pytest.approx([2 * math.pi * 22 * 0.5] * 2)


def test_what_is_above_its_limit_is_named():
    data = milled(20, -3, limits=Limits(spindle=1500, rapid=300))
    assert data()[0].beyond == ("n above 1500", "vf above 300")
    inside = milled(20, -3)
    assert inside()[0].beyond == () and "within the default limits (none were given), each axis 10000 mm/min." in repr(inside())
    assert inside(vc=60, fz={1: 0.04})[0].beyond == ("vc above 60", "fz above 0.04")
    assert inside(vc=63, fz={1: 0.05})[0].beyond == ()
    assert "vc above 60" in inside(vc=60)._repr_html_()


@pytest.mark.parametrize(
    ("options", "said"),
    [({"vc": "fast"}, "greatest vc"), ({"fz": {99: 0.1}}, "not in the table, 99"), ({"kc": 0}, "kc"), ({"vc": {1: -1}}, "vc")],
)
def test_limits_that_make_no_sense_are_refused(options, said):
    with pytest.raises(Alarm, match=said):
        milled(20, -3)(**options)


def test_in_inches():
    """Half an inch at 2500 rev/min: π · 0.5 / 12 · 2500 ft/min; 10 in/min with 4 teeth: 0.001 in."""
    text = "G20\nT1 M6\nS2500 M3\nG43 H1 G0 X-1 Y0 Z.1\nG1 Z-.1 F10\nX2\n"
    tool = Tool(radius=6.35, teeth=4, kind="mill", centre_cutting=True)
    found = mnclab.run(text, "g43", Setup(tools={1: tool})).cutting_data()
    head, (row,), _ = found.table()
    told = dict(zip(head, row))
    assert told["vc\nft/min"] == f"{math.pi * 0.5 / 12 * 2500:.1f}" and told["fz\nin"] == "0.001" and told["vf\nin/min"] == "10"


@pytest.mark.parametrize("text", ["", "G0 X1\n", "G1 X,1\n", "G1 X5 F100\n"])
def test_nothing_is_cut(text):
    found = mnclab.run(text, "mnc").cutting_data()
    assert len(found) == 0 and "nothing is cut" in repr(found) + found._repr_html_()


def test_the_notes_name_what_stands_in_the_table():
    """Of a tool without teeth hm is not known, of a turning tool ae neither."""
    plain, turned = milled(5, -3, Tool(radius=5))(), Tool(corner=0.4, main_angle=95, auxiliary_angle=30, kind="turning")
    assert "; ap and ae are the most of a row." in repr(plain) and "hm" not in repr(plain)
    assert "hm goes with its most Q" in repr(milled(5, -3)())
    text = "M3 S500 T1\nG95 F0.2\nG00 X18 Z2\nG01 Z-30\nG00 X40\n"
    run = mnclab.run(text, "jnc-t01", Setup(tools={1: turned}, stock=mnclab.blank.cylinder(20, -60, 0)))
    assert "; ap is the most of a row." in repr(run.cutting_data())


def test_speeds_and_feeds_alone_are_those_of_the_rows_that_cut():
    """S2000 F400 with four teeth; the plunge at F100 stands beside the blank."""
    found = milled(5, -3)(material=False)
    assert (found[0].speed, found[0].feed, found[0].per_tooth) == ((2000, 2000), (400, 400), (0.05, 0.05))
    assert (found[0].depth, found[0].width, found[0].chip, found[0].rate) == (None, None, None, None)
    assert "Q were not asked for." in repr(found) and "Q most" not in repr(found)
