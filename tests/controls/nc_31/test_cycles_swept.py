"""Cycles with random numbers: what they remove, where they go at rapid, how deep they cut, where they end.

Material is a polygon of (Z, radius), checked with shapely: a cut takes away what its edge passes over, and a move at rapid
must not touch what is left. The contour is written down here from the source's tables, not taken from the library. The
suite runs a few hundred programs; `python tests/controls/nc_31/test_cycles_swept.py 500` runs so many of each cycle.
"""

import math
import random
import sys

import numpy as np
import pytest
import shapely
from shapely import Polygon, box

import mnclab
from mnclab import Kind, Setup

pytestmark = pytest.mark.deep

EACH = 40
CODES = ("G70", "G71", "G77", "G78", "G74", "G75", "G73", "G72", "G31")
CLOSE = 1e-9


def frames(code, words, marks=""):
    return "\n".join(["S600", "F20", f"{code}{marks}*", *(f"{w}*" for w in words[:-1]), words[-1], ""])


def path_of(code, words, start, marks="~", **settings):
    run = mnclab.run(
        frames(code, words, marks), "nc-31", Setup(start=(start[0] / 200, 0, start[1] / 100), settings=settings)
    )
    assert not run.alarms, (run.alarms, frames(code, words, marks), start)
    path = run.toolpath.motion
    assert path.end[-1] == pytest.approx((start[0] / 200, 0, start[1] / 100), abs=CLOSE)
    return path


def points(path):
    """Begin and end of each move as (across, along) = (radius, Z)."""
    return path.start[:, [0, 2]], path.end[:, [0, 2]]


def end_points(random_):
    """A start (discretes: diameter, Z) and an end towards the axis or away from it, towards -Z or +Z."""
    x1, x = random_.sample(range(100, 20_000), 2)
    z1 = random_.randint(-5_000, 5_000)
    return (x1, z1), x, z1 + random_.choice((-1, 1)) * random_.randint(50, 20_000)


def step_for(random_, way):
    """A pitch that makes 1 to 30 steps, often one that divides the way."""
    count = random_.randint(1, 30)
    return max(way // count, 1) if random_.random() < 0.7 else min(max(way // count + random_.randint(0, 3), 1), way)


# --- G70, G71, G77, G78: the material between start and contour --------------------------------------------------------


def swept(a, b, x1, z1, facing):
    """What one straight cut removes: all between it and the start, across it for a longitudinal cut."""
    (xa, za), (xb, zb) = a, b
    ring = [(za, xa), (zb, xb), (zb, x1), (za, x1)] if not facing else [(za, xa), (zb, xb), (z1, xb), (z1, xa)]
    return Polygon(ring)


def contour_of(code, x1, z1, x, z, p1, p2, along_x=False):
    """The finished contour from its first to its last point, (radius, Z), as the tables say."""
    sx, sz = math.copysign(1, x1 - x), math.copysign(1, z1 - z)
    if code == "G70":
        return [(x, z1), (x, z + sz * p2), (x + sx * p1, z), (x1, z)]
    if code == "G71":
        return [(x1, z), (x + sx * p1, z), (x, z + sz * p2), (x, z1)]
    if code == "G77":
        return [(x, z1), (x, z + sz * p2), (x1, z)]
    return [(x1, z), (x, z + sz * p2), (x, z1)]


def check_shoulder(random_, code):
    (x1d, z1d), xd, zd = end_points(random_)
    facing, rough = code in ("G71", "G78"), code in ("G77", "G78")
    p2 = random_.choice((0, random_.randint(0, abs(z1d - zd)), abs(z1d - zd)))
    settings = {}
    if rough:
        p1 = step_for(random_, abs(z1d - zd) if facing else abs(x1d - xd))
        if random_.random() < 0.3:
            settings = {"parameter_10": random_.randint(200, 3_000), "parameter_11": random_.randint(0, 200)}
    else:
        p1 = random_.choice((0, random_.randint(0, abs(x1d - xd))))
    path = path_of(code, [f"X{xd}", f"Z{zd}", f"P{p1}", f"P{p2}"], (x1d, z1d), **settings)
    x1, z1, x, z = x1d / 200, z1d / 100, xd / 200, zd / 100
    wanted = contour_of(code, x1, z1, x, z, p1 / 200, p2 / 100)
    stock = box(min(z, z1), min(x, x1), max(z, z1), max(x, x1))
    to_remove = Polygon([(zz, xx) for xx, zz in wanted] + [(z1, x1)])

    begins, ends = points(path)
    left, last_level = stock, z1 if facing else x1
    levels = []
    for kind, a, b in zip(path.kind, begins, ends, strict=True):
        assert (np.minimum(a, b) >= (min(x, x1) - CLOSE, min(z, z1) - CLOSE)).all()  # nor beyond the stock
        assert (np.maximum(a, b) <= (max(x, x1) + CLOSE, max(z, z1) + CLOSE)).all()
        if kind == Kind.RAPID:
            way = shapely.LineString([a[::-1], b[::-1]])
            assert way.intersection(left.buffer(-1e-6)).length < 1e-6, (code, a, b)
            continue
        cut = swept(a, b, x1, z1, facing)
        if cut.area:
            left = left.difference(cut)
        if rough and abs(a[1 if facing else 0] - b[1 if facing else 0]) < CLOSE:
            levels.append(a[1 if facing else 0])
    tolerance = 1e-6 * max(stock.area, 1)
    assert abs(stock.area - left.area - to_remove.area) < tolerance
    assert to_remove.symmetric_difference(stock.difference(left)).area < tolerance

    # the last pass lies on the contour, point by point
    cuts = np.flatnonzero(path.kind == Kind.LINE)
    final = [p for k, p in enumerate(wanted) if k == 0 or math.dist(p, wanted[k - 1]) > CLOSE]
    walked = [ends[k] for k in cuts[len(cuts) - (len(final) - 1) :]]
    assert np.allclose(walked, final[1:], rtol=0, atol=CLOSE)
    if rough:  # as many levels as whole P1 fit, each P1 deeper, and less than P1 for the clean-up
        depth = p1 / (100 if facing else 200)
        way = abs(z1d - zd) if facing else abs(x1d - xd)
        finish = z if facing else x
        found = sorted({round(level, 9) for level in levels}, key=lambda level: abs(level - last_level))
        for level in found:
            assert abs(level - last_level) <= depth + CLOSE
            last_level = level
        assert not found or abs(found[-1] - finish) <= depth + CLOSE
        passes = len({label.split(",")[0] for label in path.labels if "pass" in label})
        assert passes == way // p1


# --- G74, G75: grooves, with a tool as wide as the pitch ---------------------------------------------------------------


def check_grooves(random_, code):
    (x1d, z1d), xd, zd = end_points(random_)
    face = code == "G74"
    way = abs(x1d - xd) if face else abs(z1d - zd)
    pitch = step_for(random_, way)
    path = path_of(code, [f"X{xd}", f"Z{zd}", f"P{pitch}"], (x1d, z1d), random_.choice(("~", "")))
    side, depth = (0, 1) if face else (1, 0)
    begins, ends = points(path)
    start, end = np.array([x1d / 200, z1d / 100]), np.array([xd / 200, zd / 100])
    plunges = (path.kind == Kind.LINE) & (np.abs(begins[:, side] - ends[:, side]) < CLOSE)
    at = ends[plunges, side]
    whole, rest = divmod(way, pitch)
    assert len(at) == whole + (rest > 0) + 1
    scale = 200 if face else 100
    steps = np.abs(np.diff(at)) * scale
    assert np.allclose(steps[:whole], pitch, rtol=0, atol=1e-6) and (not rest or abs(steps[-1] - rest) < 1e-6)
    assert abs(at[0] - start[side]) < CLOSE and abs(at[-1] - end[side]) < CLOSE
    assert np.allclose(ends[plunges, depth], end[depth], rtol=0, atol=CLOSE)

    width = pitch / scale  # the edge reaches from its point back against the direction of the steps
    back = -math.copysign(width, end[side] - start[side])
    low, high = sorted((start[depth], end[depth]))
    slots = [box(min(s, s + back), low, max(s, s + back), high) for s in at]
    removed = shapely.union_all(slots)
    wide = (way / scale + width) * (high - low)
    assert abs(removed.area - wide) < 1e-6 * max(wide, 1)
    for kind, a, b in zip(path.kind, begins, ends, strict=True):  # rapids: above the part, or out of a cut groove
        if kind == Kind.RAPID:
            above = abs(a[depth] - start[depth]) < CLOSE and abs(b[depth] - start[depth]) < CLOSE
            out = (
                abs(a[side] - b[side]) < CLOSE
                and min(abs(at - a[side])) < CLOSE
                and abs(b[depth] - start[depth]) < CLOSE
            )
            assert above or out


# --- G73, G72: a hole --------------------------------------------------------------------------------------------------


def check_hole(random_, code):
    (x1d, z1d), xd, zd = end_points(random_)
    radial = code == "G72"
    way, scale = (abs(x1d - xd), 200) if radial else (abs(z1d - zd), 100)
    peck, gap = step_for(random_, way), random_.randint(0, 300)
    words = [f"X{xd}"] * radial + [f"Z{zd}"] * (not radial) + [f"P{peck}"]
    path = path_of(code, words, (x1d, z1d), "", parameter_8=gap)
    axis = 0 if radial else 1
    start, end = (x1d / 200, xd / 200) if radial else (z1d / 100, zd / 100)
    begins, ends = (np.abs(p[:, axis] - start) for p in points(path))
    drilled, pecks = 0.0, []
    for kind, a, b in zip(path.kind, begins, ends, strict=True):
        if kind == Kind.RAPID:
            assert max(a, b) <= drilled + CLOSE  # never into what is not drilled
            if b > CLOSE:  # a return stops the gap before it
                assert b == pytest.approx(drilled - gap / 100, abs=CLOSE)
        else:
            pecks.append(b - drilled)
            drilled = max(drilled, b)
    whole, rest = divmod(way, peck)
    assert np.allclose(np.array(pecks) * scale, [peck] * whole + [rest] * (rest > 0), rtol=0, atol=1e-6)
    assert drilled == pytest.approx(abs(end - start), abs=CLOSE)


# --- G31: a thread -----------------------------------------------------------------------------------------------------


def check_thread(random_, code):
    (x1d, z1d), _, zd = end_points(random_)
    zd = z1d + (1 if zd > z1d else -1) * random_.randint(1_500, 9_000)
    outside = random_.choice((-1, 1))
    xd = x1d - outside * random_.randint(100, 400)
    depth, taper = random_.randint(1, 300), random_.choice((0, random_.randint(1, 200)))
    cut, pitch = step_for(random_, depth), random_.randint(2_000, 60_000)
    angle, tenths = random_.choice((0, random_.randint(1, 40))), random_.choice((0, random_.randint(1, 20)))
    words = [f"X{xd}", f"Z{zd}", f"F{pitch}", f"P{depth}", f"P{cut}", f"P{taper}"]
    path = path_of(code, words, (x1d, z1d), "", parameter_6=angle, parameter_7=tenths)
    x1, z1, x, z, sz = x1d / 200, z1d / 100, xd / 200, zd / 100, math.copysign(1, zd - z1d)
    run_out = tenths * pitch / 100_000
    begins, ends = points(path)
    threads = np.flatnonzero(path.synchronous)
    cuts = threads[:: 2 if tenths else 1]
    whole, rest = divmod(depth, cut)
    depths = np.array([*(cut * k for k in range(1, whole + 1)), *[depth] * (rest > 0)]) / 100
    assert len(cuts) == len(depths)
    for k, deep in zip(cuts, depths, strict=True):
        assert ends[k][1] == pytest.approx(z - sz * run_out, abs=CLOSE)
        assert begins[k][1] == pytest.approx(z1 + sz * deep * math.tan(math.radians(angle)), abs=CLOSE)
        for px, pz in (begins[k], ends[k]):  # on the cone that the taper makes of the root
            root = x - outside * (deep + taper / 200 * (z - pz) / (z - z1))
            assert px == pytest.approx(root, abs=CLOSE)
    if tenths:
        assert np.allclose(ends[threads[1::2]], (x1, z), rtol=0, atol=CLOSE)
    along = np.abs(ends - begins)[threads, 1]
    advance = path.per_rev[threads] * along / path.lengths[threads]
    assert np.allclose(advance, pitch / 10_000, rtol=0, atol=CLOSE)
    for kind, a, b in zip(path.kind, begins, ends, strict=True):  # rapids: clear of the part, or straight in or out
        if kind == Kind.RAPID:
            assert (abs(a[0] - x1) < CLOSE and abs(b[0] - x1) < CLOSE) or abs(a[1] - b[1]) < CLOSE


CHECKS = {
    **dict.fromkeys(("G70", "G71", "G77", "G78"), check_shoulder), **dict.fromkeys(("G74", "G75"), check_grooves),
    **dict.fromkeys(("G72", "G73"), check_hole), "G31": check_thread,
}  # fmt: skip


@pytest.mark.parametrize("code", CODES)
def test_swept(code):
    for seed in range(EACH):
        CHECKS[code](random.Random(f"{code} {seed}"), code)


if __name__ == "__main__":
    for code in CODES:
        for seed in range(int(sys.argv[1])):
            CHECKS[code](random.Random(f"{code} {seed}"), code)
        print(code, "done")
