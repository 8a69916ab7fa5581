"""What the sample programs leave of their blanks: nothing collides, and what their comments promise is there, no more.

A mill is asked for heights at places (x, y), a lathe for radii at places along Z, worked out from the numbers that the
programs are written with. Blanks and tools are those of `data/setups`, or the program has a BLK FORM.
"""

from math import cos, pi, radians, sin, tan
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab.machine.setup_file import load

DATA = Path(__file__).parents[2] / "data"
PROGRAMS = {f"{path.parent.name}/{path.stem}": path for path in sorted(DATA.glob("programs/*/*"))}
SETUPS = {f"{path.parent.name}/{path.stem}": path for path in sorted(DATA.glob("setups/*/*.toml"))}
POINT = 4 / tan(radians(59))  # of the drill 8
#: Paths at Z0, or none at all: they show a function, and cut nothing.
NO_PART = {
    f"mnc/{name}" for name in (
        "arc_by_centre", "arcs_by_radius", "four_arcs", "full_circle", "hexagon", "hexagon_arc", "machine_coordinates",
        "mirrored", "scaled", "set_and_shift", "three_planes", "turned",
    )
} | {"tnc-620/ellipse_round"}  # fmt: skip


def on(centre, radius, *angles):
    return [(centre[0] + radius * cos(radians(a)), centre[1] + radius * sin(radians(a))) for a in angles]


def holes(depth, *places):
    """A drilled hole, 8 wide: the tip, the wall on both sides."""
    return {(x, y): depth for x, y in places} | {(x + 3.999, y): depth + POINT for x, y in places} | {
        (x, y + 4.001): 0 for x, y in places
    }


#: What stands where: (x, y) → z.
HEIGHTS = {
    "g43/bolt_circle": holes(-15, *on((0, 0), 30, *(22.5 + 45 * k for k in range(8)))) | {(0, 0): 0, (30, 0): 0},
    "g43/plate": holes(-12, *((x, y) for x in (15, 40, 65) for y in (15, 35))) | {(0.1, 49.9): -6, (79.9, 49.9): -6,
        (0.1, 0.1): 0, (10, 48): 0},
    "g43/six_holes": holes(-12, *((x, y) for x in (15, 60, 105) for y in (12, 58))) | {(4.9, 35): -5, (5.1, 35): 0, (1, 69): -5,
        (119, 69): -5, (60, 35): 0, **{place: -3 for r in (7.1, 22.9) for place in on((60, 35), r, 0, 120, 240)},
        **{place: 0 for r in (6.9, 23.1) for place in on((60, 35), r, 0, 120, 240)}},
    "g43/two_lengths": holes(-15, (20, 20)) | {(60, 20): -5, (97.9, 20): -5, (98.1, 20): 0, (75, 27.9): -5,
        (75, 28.1): 0},
    "mnc/compensated": {(40, 30): -4, (30, 39.9): 0, (34.9, 21): 0, (35.1, 30): -4, (60, 19.9): 0, (70.1, 10.1): -4,
        (69.8, 10): 0},
    "mnc/drilling_two_ways": holes(-18, (10, 10), (40, 10)),
    "mnc/first_path": holes(-12, (14, 14), (14, 46), (78, 46), (78, 14)) | {(1, 59): -6, (99, 59): -6, (50, 59.9): 0,
        (92.1, 24): -6, (91.9, 24): 0, (99, 1): -6, (0.1, 0.1): 0},
    "mnc/house": {(20, 0): -1, (40, 15): -1, (0, 15): -1, (20, 45): -1, (31, 42): -1, (20, 20): 0, (10, 42): 0},
    "mnc/keyhole": {(36, 20.1): -4, (36, 19.9): 0, (30.1, 30): -4, (29.9, 30): 0, (41.9, 30): -4, (42.1, 30): 0,
        (38.4, 49): -4, (38.6, 49): 0},
    "mnc/milled_plate": {(1, 1): 0, (129, 69): 0, (40, 35): -12, (102, 35): -8, (119.9, 35): -8, (120.1, 35): 0,
        **{place: -12 for place in on((40, 35), 29.9, 15, 195)}, **{place: 0 for place in
        on((40, 35), 30.1, 15, 195)}},
    "mnc/one_part": holes(-12, (15, 10), (45, 10), (75, 10)) | {(45, 30): -4, (62.6, 30): -4, (62.8, 30): 0,
        (89, 59): -6, (1, 59): 0, (70, 59.9): 0},
    "mnc/plate_absolute": {(25, 10): -1, (40, 15): -1, (32.5, 27.5): -1, (15, 35): -1, (10, 20): -1, (20, 20): 0},
    "mnc/plate_incremental": {(25, 10): -1, (40, 15): -1, (32.5, 27.5): -1, (15, 35): -1, (10, 20): -1, (20, 20): 0},
    "mnc/prepared_holes": {(15, 10): -3 / tan(radians(59)), (17.9, 10): -0.1 / tan(radians(59)), (18.1, 10): 0}
        | holes(-20, (40, 10)) | {(65, 10): -12, (71.9, 10): -12, (72.1, 10): 0, (90, 10): -12, (96.9, 10): -12,
        (97.9, 10): -10, (98.1, 10): 0},
    "mnc/row_of_holes": holes(-18, *((x, 10) for x in (10, 30, 70, 90))),
    "mnc/square": {(20, 0): -2, (40, 20): -2, (20, 40): -2, (0, 20): -2, (20, 20): 0, (5.1, 5.1): 0, (4.9, 20): -2,
        (-5.1, 20): 0},
    "mnc/stairs": {(5, 0): -1, (10, 5): -1, (40, 35): -1, (20, 20): -1, (0, 20): 0},
    "mnc/two_parts": {(x + dx, y): z for dx in (0, 60) for (x, y), z in {(15, 0): -1, (30, 20): -1, (15, 20): -1,
        (20, 15): 0}.items()},
    "mnc/window": {(x, y): -5 for x in range(1, 60, 2) for y in (9, 14, 20, 26, 31)} | {(30, 0.1): -5, (30, -0.1): 0,
        (59.9, 20): -5, (60.1, 20): 0, (1, 1): 0, (3, 3): -5},
    "tnc-620/bracket": {(30, 5.1): 0, (30, 4.9): -6, (30, 54.9): 0, (30, 55.1): -6, (5.1, 30): 0, (4.9, 30): -6,
        (49.9, 45): 0, (53, 38): -6, (70, 34.9): 0, (84.9, 20): 0, (85.1, 20): -6, (6, 6): -6, (6, 54): -6},
    "tnc-620/calls": holes(-20, *((x, 10) for x in (10, 30, 50, 70, 90))),
    "tnc-620/cam_plate": {(50, 89.9): 0, (50, 90.1): -8, (20.1, 50): 0, (19.9, 50): -8, (50, 10.1): 0, (50, 9.9): -8,
        (79.9, 56): 0, (80.1, 56): -8, (72.1, 44): -8, (71.9, 44): 0},
    "tnc-620/cover": holes(-15, (25, 25), (25, 55), (75, 25), (75, 55)) | {(9.9, 40): -5, (10.1, 40): 0, (50, 69.9): 0,
        (50, 70.1): -5, (87.9, 68): -5, (85, 66.9): 0, (12, 68): -5, (13.5, 66.5): 0, (89.9, 10.1): 0, (90.1, 9.9): -5},
    "tnc-620/dumbbell": {(10.1, 40): -10, (9.9, 40): 0, (124.9, 40): -10, (125.1, 40): 0, **{(67.5, 40 + q * side): z for side in
        (-1, 1) for q, z in ((6.9, -10), (7.1, 0))}, **{place: -10 for x in (35, 100) for place in on((x, 40), 24.9, 90, 135,
        270)}, **{place: 0 for x in (35, 100) for place in on((x, 40), 25.1, 90, 135, 270)}},
    "tnc-620/edge": {(5.9, 40): -12, (6.1, 40): 0, (60, 60): -12, (60, 42.1): -12, (60, 41.9): 0, (49, 43.3): -12,
        (48.4, 42.4): 0, (71, 43.3): -12, (71.6, 42.4): 0, (9.9, 68.3): -12, (10.3, 67.9): 0,
        **{place: -12 for place in on((21, 21), 15.1, 225)},
        **{place: 0 for place in on((21, 21), 14.9, 225)}, (1, 1): -12, (119, 77): -12},
    "tnc-620/ellipse": {(40, 0): -8, (-40, 0): -8, (0, 25): -8, (0, -25): -8, (0, 0): 0, (37.9, 0): 0, (45, 0): 0},
    "tnc-620/eyes": {(-19.9, 0): 0, (-20.1, 0): -4, (71.9, 0): 0, (72.1, 0): -4, (0, 19.9): 0, (0, 20.1): -4,
        (60, -12.2): -4},
    "tnc-620/flange": {place: -20 for place in [*on((0, 0), 45, *range(22, 360, 45)),
        *on((0, 0), 25, 30, 90, 150, 210, 270, 330), (0, 0), (52, 52), (-52, 52), (52, -52), (-52, -52)]} | {place: 0
        for place in on((0, 0), 45, *range(0, 360, 45))},
    "tnc-620/hexagon_and_bore": {place: 0 for place in on((50, 50), 32.8, *range(30, 360, 60))} | {place: -8 for place
        in on((50, 50), 33.1, *range(30, 360, 60))} | {(50, 50): -12, (58.9, 50): -12, (59.1, 50): 0},
    "tnc-620/hole_plate": {place: -12 for place in [*on((90, 34), 22, 180, 135, 90, 45, 0, -45, -90), *((x, 68) for x
        in (15, 33, 51, 69)), (12, 12), *on((12, 12), 12, 10, 100), *on((12, 12), 36, 10)]},
    "tnc-620/holes": {(15, 15): -15 - POINT, (18.99, 15): -15, (40, 15): -26, (15, 45): -30, (40, 45): -30,
        (75, 30): -12, (88.9, 30): -12, (89.1, 30): 0, (19.1, 15): 0},
    "tnc-620/lever": {(-19.9, 0): 0, (-20.1, 0): -8, (0, -19.9): 0, (81.9, 40): 0, (82.1, 40): -8, (70, 52.2): -8,
        (0, 0): 0},
    "tnc-620/lid": {(9.9, 40): 0, (10.1, 40): -15, (11, 63): 0, (12, 62): -15, (11, 17): 0, (69.9, 63.9): -15, (69.5, 64.1): 0,
        (27.9, 40): -15, (28.1, 40): 0, (47.9, 45.9): 0, (38, 46.1): -15, **{place: z for r, z in ((11.9, 0), (12.1, -15),
        (25.9, -15), (26.1, 0)) for place in on((80, 40), r, -90, -30, 0, 60)}},
    "tnc-620/name_plate": {(1, 1): 0, (119, 1): 0, (1, 79): 0, (119, 79): 0, (60, 40): 0},
    "tnc-620/one_part": holes(-12, (15, 10), (45, 10), (75, 10)) | {(45, 30): -4, (62.6, 30): -4, (62.8, 30): 0,
        (89, 59): -6},
    "tnc-620/oval": {(50 + 35 * cos(radians(a)), 40 + 20 * sin(radians(a))): -2 for a in range(0, 360, 5)} | {(50, 40): 0,
        (79.9, 40): 0, (90.1, 40): 0, (50, 54.9): 0, (50, 65.1): 0},
    "tnc-620/plate": {(1, 49): -4, (4, 46): 0, (40, 40.1): -4, (40, 39.9): 0, (79, 49): -4, (79, 1): -4, (72, 5): 0,
        (1, 1): 0},
    "tnc-620/pocket": {(0, 0): -10, (29.9, 0): -10, (30.1, 0): 0, (0, 19.9): -10, (0, 20.1): 0, (27.5, 17.5): -10,
        (29, 19): 0},
    "tnc-620/pockets": {(32, 30): -9, (86, 45): -6, (102.9, 45): -6, (103.1, 45): 0, (32, 70): -5, (32, 74.4): -5,
        (32, 74.8): 0, **{place: -4 for place in on((86, 45), 26, 60, 90, 120, 180, 210, 240, 300, 330, 360)},
        **{place: 0 for place in on((86, 45), 26, 30, 150, 270)}},
    "tnc-620/slide": {place: -15 for x in (20, 70) for y in (15, 35) for place in ((x, y), (x + 3.9, y))} | {(24.1, 15): 0,
        (4.9, 25): -4, (5.1, 25): 0, (85.1, 25): -4, (84.9, 25): 0, (45, 44.9): 0, (45, 45.1): -4, (5.5, 44.5): -4, (7, 43): 0},
    "tnc-620/square": {(20, 0): -2, (40, 20): -2, (20, 40): -2, (0, 20): -2, (20, 20): 0, (5.1, 5.1): 0,
        (4.9, 20): -2},
    "tnc-620/steps": {(10 * k, 20): -1 - k / 2 for k in range(5)} | {(5 + 10 * k, 20): 0 for k in range(5)},
    "tnc-620/studs": {(38, 34): 0, (122, 34): 0, (132.9, 34): 0, (133.1, 34): -8, (35, 84): 0, (130, 90): -5,
        (84, 90): 0, (130, 69): 0, **{place: 0 for place in on((38, 34), 17.9, 10, 190)}, **{place: -8 for place in
        on((38, 34), 18.1, 10, 190)}},
    "tnc-620/threads": {(15, 15): -20, (18.3, 15): -20, (18.9, 45): -16, (19.1, 15): 0, (40, 15): -15,
        (49.1, 15): -15, (50.1, 15): 0, (40, 45): -12, (45.9, 47): -1, (90, 30): 0, (100.9, 30): 0, (102.1, 30): -12,
        (115, 30): -12},
    "tnc-620/trochoid": {(50, 20): -15, (50, 26.9): -15, (50, 27.1): 0, (13.1, 20): -15, (12.9, 20): 0, (99.9, 38): -15,
        (100.1, 38): 0, (86.1, 38): -15, (85.9, 38): 0, (112, 79): -15, (118.9, 50): -15, (119.1, 50): 0, (112, 13.1): -15,
        (112, 12.9): 0},
}  # fmt: skip
#: On drums, which no part holds: between which u, y and height the middle of the tool is on the floor.
DRUMS = {
    "tnc-620/drum_cam": ((0, 20 - 1, -8), (2 * pi * 40, 50 + 1, -8)),
    "tnc-620/drum_window": ((30 * pi / 6 + 3, 15 + 3, -6), (30 * 2 * pi / 3 - 3, 65 - 3, -6)),
}
#: The radius at places along Z, then that of the bore. A nose of radius r leaves r (sin a + cos a - 1) / cos a on a cone of
#: the angle a, and the arcs of the recess 0.4 mm aside: these programs do not compensate it.
RADII = {
    "jnc-t01/flange": ({-0.5: 15 + 1.5 * 7 / 9 + 0.8 * (16 - 130**0.5) / 9, -9: 40, -12.5: 36, -14.5: 40, -16.5: 36, -18.5: 40,
                        -20.5: 36, -25: 40}, {-10: 5}),
    "jnc-t01/recess": ({-14.6: 30 - 200**0.5, -30: 24, -54.6: 30 - 200**0.5}, {}),
    "jnc-t01/shaft": ({-1: 11 + 0.4 * (2 - 2**0.5), -10: 13, -40: 20, -59.5: 20, -61: 30}, {}),
    "jnc-t01/thread": ({-30: 10, -50: 10}, {}),
    "nc-31/bush": ({-1: 25, -30: 25}, {-1: 15, -20: 15, -30: 5, -40: 5}),
    "nc-31/shaft": ({-25: 10.5, -29: 10.5, -35: 20}, {}),
    "nc-31/square": ({-5: 15, -18: 15, -21: 20}, {}),
    "nc-31/spiral_groove": ({-1.01: 50, -30: 50}, {}),  # no deeper than 1 mm; the turns of a feed not locked are not seen
}


def run_of(name):
    return mnclab.run(PROGRAMS[name], setup=load(SETUPS[name]) if name in SETUPS else None)


def test_every_sample_is_asked_and_every_setup_has_its_program():
    assert {*HEIGHTS, *RADII, *DRUMS, *NO_PART} == {*PROGRAMS} and not NO_PART & {*HEIGHTS, *RADII, *DRUMS}
    assert {*SETUPS} <= {*PROGRAMS}


@pytest.mark.parametrize("name", [*HEIGHTS, *RADII])
def test_nothing_collides_and_only_threads_have_notes(name):
    run = run_of(name)
    assert run.collisions() == ()
    assert all(note.startswith("a thread is ") for note in run.workpiece().notes)


@pytest.mark.parametrize("name", sorted(NO_PART))
def test_a_path_that_shows_a_function_cuts_nothing_below_its_plane(name):
    path = mnclab.run(PROGRAMS[name]).toolpath
    assert path.end[:, 2].min() >= 0


@pytest.mark.parametrize("name", DRUMS)
def test_on_drums(name):
    flat = run_of(name).toolpath.unrolled().labelled("level 2 of 2")
    floor = np.concatenate([flat.labelled(what).end for what in ("contour", "wall")])
    assert [floor.min(axis=0), floor.max(axis=0)] == pytest.approx(np.array(DRUMS[name]), abs=1e-3)


@pytest.mark.parametrize("name", HEIGHTS)
def test_heights(name):
    part = run_of(name).workpiece()
    found = {place: part.at(*place) for place in HEIGHTS[name]}
    assert found == pytest.approx(HEIGHTS[name], abs=0.011)


def test_letters_are_as_fine_as_their_engraver():
    """The stem of the P: 0.3 deep, 0.35 wide at its rim."""
    x = np.linspace(6, 8, 2001)
    stem = run_of("tnc-620/name_plate").workpiece().at(x, np.full_like(x, 70))
    assert stem.min() == pytest.approx(-0.3, abs=0.002)
    assert np.count_nonzero(stem < 0) / 1000 == pytest.approx(2 * 0.3 * tan(radians(30)), abs=0.003)


def test_a_milled_thread_begins_at_its_depth_and_climbs_a_pitch():
    part = run_of("tnc-620/threads").workpiece()
    found = [part.at(*place) for place in on((40, 15), 9.9, *range(0, 360, 15))]
    assert min(found) == pytest.approx(-12, abs=0.1) and max(found) <= min(found) + 1.5


@pytest.mark.parametrize("name", RADII)
def test_radii(name):
    part = run_of(name).workpiece()
    outside, bore = RADII[name]
    assert {z: part.at(z) for z in outside} == pytest.approx(outside, abs=1e-6)
    assert {z: part.bore_at(z) for z in bore} == pytest.approx(bore, abs=1e-6)
