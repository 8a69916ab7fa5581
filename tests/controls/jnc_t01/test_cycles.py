"""Random calls of the cycles: what is cut, in which steps, and that no rapid goes through material.

Lengths are whole hundredths, so that counts and remainders can be said exactly. The stock of G77 and G78 is the rectangle
between the start and (X, Z); a pass clears it on the side of the start. The tool is a point.
"""

import math
import random

import numpy as np
import pytest
from shapely import LineString, Polygon, box
from tools.running import run

from mnclab import Kind

CALLS = 70  # of each cycle; several thousand were run once
PARTS = {"G77": (0, 2), "G78": (2, 0)}  # axis of the infeed, axis of the cut


def motion_of(program, x, z, **settings):
    found = run(f"F100 S500 M3\n{program}", "jnc-t01", start=(x / 100, 0, z / 100), **settings)
    cone = found.alarms and "without U and W the taper begins at the start: a cone is cut" in found.alarms[0].message
    assert found.ok and len(found.alarms) == int(bool(cone)), (program, found.alarms)
    assert bool(cone) == (program.split()[1] in ("G77", "G78") and not {"U", "W"} & {word[0] for word in program.split()})
    path = found.toolpath.motion
    assert path.end[-1] == pytest.approx((x / 100, 0, z / 100), abs=1e-12)  # every cycle returns
    assert (path.end[:, 1] == 0).all()
    return path


def word(rng, address, value, start):
    """A coordinate, or under G91 its distance from the start."""
    return f"{address}{(value - start) / 100:.2f}" if rng.relative else f"{address}{value / 100:.2f}"


def call(seed):
    """A source of numbers, one in three calls under G91."""
    rng = random.Random(seed)
    rng.relative = rng.random() < 1 / 3
    return rng, "G91 " if rng.relative else "G90 "


def between(rng, a, b):
    return rng.choice([a, b, rng.randint(min(a, b), max(a, b))])


def steps(total, step):
    """Depths after each pass: whole steps, and the remainder in the last."""
    whole, rest = divmod(total, step)
    return [step * k for k in range(1, whole + (rest > 0))] + [total] if total else []


def stock_removal(code, seed):
    rng, mode = call(seed)
    x1, z1 = rng.randint(-5000, 5000), rng.randint(-5000, 5000)
    x, z = (start + rng.choice([-1, 1]) * rng.randint(1, 4000) for start in (x1, z1))
    u, w = between(rng, x1, x), between(rng, z1, z)
    start, end, bevel = {0: x1, 2: z1}, {0: x, 2: z}, {0: u, 2: w}
    a, b = PARTS[code]
    total = abs(end[a] - start[a])
    depth = rng.choice([None, rng.randint(max(total // 12, 1), total + 500)])
    words = [word(rng, "X", x, x1), word(rng, "Z", z, z1), f"D{depth / 100:.2f}" if depth else ""]
    words += [word(rng, "U", u, x1)] if u != x1 or rng.random() < 0.5 else []
    words += [word(rng, "W", w, z1)] if w != z1 or rng.random() < 0.5 else []
    rng.shuffle(words)
    retract = rng.choice([0, 0.5, 2])
    wall = rng.choice(["rapid", "feed"])
    path = motion_of(f"{mode}{code} {' '.join(words)}", x1, z1, retract=retract, wall=wall)

    def point(across, along):
        return (across / 100, along / 100) if a == 0 else (along / 100, across / 100)

    sense, way = math.copysign(1, end[a] - start[a]), math.copysign(1, end[b] - start[b])
    levels = [start[a] + sense * depth for depth in steps(total, depth or total)]
    contour = [point(end[a], start[b]), point(end[a], bevel[b]), point(bevel[a], end[b]), point(start[a], end[b])]
    material = box(min(x, x1) / 100, min(z, z1) / 100, max(x, x1) / 100, max(z, z1) / 100)
    whole, allowed = material.area, Polygon([point(start[a], start[b]), *contour])
    expected_rest = abs(bevel[a] - end[a]) * abs(end[b] - bevel[b]) / 2e4
    cuts, removed, at_contour = [], 0.0, []
    for row in path:
        line = [tuple(row.start[[0, 2]]), tuple(row.end[[0, 2]])]
        last = "contour" in row.label
        if row.kind == Kind.RAPID:
            assert LineString(line).intersection(material.buffer(-1e-7)).length == 0, row
        elif last:
            at_contour.append(line)
        else:
            cuts.append(row.end[a] * 100)
            assert row.end[a] == row.start[a] and row.start[b] * 100 == pytest.approx(start[b])
            side = box(*np.sort([line[0], line[1]], axis=0).ravel())
            sweep = [point(cuts[-1], start[b]), point(cuts[-1], row.end[b] * 100)]
            sweep += [point(start[a], row.end[b] * 100), point(start[a], start[b])]
            cleared = Polygon(sweep) if side.length else side
            assert cleared.difference(allowed.buffer(1e-7)).area < 1e-6  # not beyond the contour
            assert LineString(contour).distance(LineString([line[1], line[1]])) < 1e-9 or row.end[b] == pytest.approx(
                end[b] / 100, abs=1e-9
            )
            removed += material.intersection(cleared).area
            material = material.difference(cleared)
    assert cuts == pytest.approx(levels[:-1], abs=1e-7)  # all D deep, from the start on
    deepest = np.abs(np.diff([start[a], *cuts, end[a]]))
    assert (deepest <= (depth or total) + 1e-7).all()
    assert deepest[-1] == pytest.approx(
        (total % depth or depth if depth <= total else total) if depth else total, abs=1e-7
    )
    wanted = [pair for pair in zip(contour[:3], contour[1:]) if pair[0] != pair[1]]
    wanted = wanted if wall == "feed" else [p for p in wanted if p[1] != contour[3] or p[0] != contour[2]]
    assert np.allclose(at_contour or [[(0, 0)] * 2], wanted or [[(0, 0)] * 2], rtol=0, atol=1e-9)
    removed += material.intersection(allowed).area
    assert removed == pytest.approx(whole - expected_rest, abs=1e-6)
    assert way in (-1, 1)


def drilling(code, seed):
    rng, mode = call(seed)
    x1, z1 = rng.randint(-5000, 5000), rng.randint(-5000, 5000)
    z = z1 + rng.choice([-1, 1]) * rng.randint(1, 5000)
    total, sense = abs(z - z1), 1 if z > z1 else -1
    peck, clear = (
        rng.choice([None, rng.randint(max(total // 15, 1), total + 300)]),
        rng.choice([None, 0, rng.randint(1, 700)]),
    )
    words = [
        word(rng, "Z", z, z1),
        f"D{peck / 100:.2f}" if peck else "",
        "" if clear is None else f"R{clear / 100:.2f}",
    ]
    rng.shuffle(words)
    path = motion_of(f"{mode}G73 {' '.join(words)}", x1, z1)
    assert (path.end[:, 0] == x1 / 100).all()
    depths = steps(total, peck or total)
    cut = (path[path.kind == Kind.LINE].end[:, 2] * 100 - z1) * sense
    assert cut == pytest.approx(depths, abs=1e-7)
    assert np.diff([0, *cut]).max() <= (peck or total) + 1e-7
    reached, again = 0.0, iter(depths)
    for row in path:
        here, there = ((p[2] * 100 - z1) * sense for p in (row.start, row.end))
        if row.kind == Kind.RAPID:
            assert max(here, there) <= reached + 1e-7  # only through the hole
            if there > 1e-7:  # back in
                assert there == pytest.approx(max(reached - (clear or 0), 0), abs=1e-7)
        else:
            assert here == pytest.approx(max(reached - (clear or 0), 0) if reached else 0, abs=1e-7)
            reached = next(again)
    assert reached == total


def grooving(code, seed):
    rng, mode = call(seed)
    start = {"X": rng.randint(-5000, 5000), "Z": rng.randint(-5000, 5000)}
    plunge, side = ("Z", "X") if code == "G74" else ("X", "Z")
    a, b = (0 if name == "X" else 2 for name in (plunge, side))
    bottom = start[plunge] + rng.choice([-1, 1]) * rng.randint(1, 3000)
    last = start[side] + rng.choice([-1, 0, 1]) * rng.randint(1, 4000)
    width = abs(last - start[side])
    step = rng.choice([None, rng.randint(max(width // 15, 1), width + 300)])
    words = [word(rng, plunge, bottom, start[plunge]), f"D{step / 100:.2f}" if step else ""]
    words += [word(rng, side, last, start[side])] if width or rng.random() < 0.5 else []
    rng.shuffle(words)
    path = motion_of(f"{mode}{code} {' '.join(words)}", start["X"], start["Z"])
    cuts = path[path.kind == Kind.LINE]
    sense = 1 if last > start[side] else -1
    places = [start[side] + sense * k for k in [0, *steps(width, step or max(width, 1))]]
    assert cuts.end[:, b] * 100 == pytest.approx(places, abs=1e-7)
    assert cuts.start[:, b].tolist() == cuts.end[:, b].tolist()
    assert np.abs(np.diff(places, prepend=start[side])).max() <= (step or width) + 1e-7
    assert cuts.end[:, a] * 100 == pytest.approx([bottom] * len(places), abs=1e-7)
    for row in path[path.kind == Kind.RAPID]:  # beside the part, or straight out of a groove
        beside = row.start[a] * 100 == pytest.approx(start[plunge]) == row.end[a] * 100
        out = row.start[a] * 100 == pytest.approx(bottom) and row.end[a] * 100 == pytest.approx(start[plunge])
        assert beside or out and row.start[b] == row.end[b]


CHECKS = {"G73": drilling, "G74": grooving, "G75": grooving, "G77": stock_removal, "G78": stock_removal}


@pytest.mark.parametrize("code", CHECKS)
def test_random_calls(code):
    for seed in range(CALLS):
        CHECKS[code](code, seed)
