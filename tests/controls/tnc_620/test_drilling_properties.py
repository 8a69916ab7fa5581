"""Whatever the parameters: a drilling cycle ends where it should, goes no deeper, and moves at rapid only where nothing is left.

Numbers are hundredths of a millimetre, so that sums of them are exact enough to count pecks by formulas.
"""

import math
from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab as mnc
from mnclab import Kind

pytestmark = pytest.mark.deep


def hundredths(least, most):
    return st.integers(round(least * 100), round(most * 100)).map(lambda n: n / 100)


CLEARANCE, SURFACE, SECOND = hundredths(0, 5), hundredths(-30, 30), hundredths(0, 40)
DEPTH, INFEED = hundredths(0.5, 60), hundredths(0.7, 70)
COMMON = {"clearance": CLEARANCE, "surface": SURFACE, "second": SECOND, "depth": DEPTH}
TOOL = mnc.Tool(radius=4, angle=118)
POINT = 4 / math.tan(math.radians(59))


def drilled(code, values, *, clearance, surface, second, depth, up=False):
    """The rows of one call of a cycle at X 30, Y 20, where the tool comes from Z 100."""
    q = {200: clearance, 203: surface, 204: second, 201: depth if up else -depth} | values
    lines = "\n".join(f"Q{number}={value if value == 'FMAX' else f'{value:.12g}'}" for number, value in q.items())
    text = f"TOOL CALL 2 Z S1000\nL Z+100 R0 FMAX\nCYCL DEF {code} X\n{lines}\nL X+30 Y+20 R0 FMAX M3\nCYCL CALL\n"
    found = mnc.run(text, "tnc-620", mnc.Setup(tools={2: TOOL}, settings={"depth_error": not up}))
    assert found.alarms == ()
    path = found.toolpath
    return path[path.line == path.line.max()]


def check(path, *, clearance, surface, second, bottom, top=None):
    """Over the hole, to the bottom and no deeper, no rapid into what is not cut yet, then out to the end plane."""
    sign = 1 if bottom < surface else -1
    rows = list(path[path.is_motion])
    leaving = next(k for k, row in enumerate(rows) if row.label.endswith("retract"))
    heights = [sign * row.end[2] for row in rows]
    assert heights[0] == pytest.approx(sign * surface + clearance)
    assert min(heights[:leaving]) == pytest.approx(sign * bottom, abs=1e-9)
    cut = sign * (surface if top is None else top)  # how deep the hole is
    for row, here in zip(rows[:leaving], heights, strict=False):
        assert row.kind != Kind.RAPID or here >= cut - 1e-9
        cut = min(cut, here)
    assert rows[-1].end == pytest.approx([30, 20, surface + max(clearance, second)])
    if sign > 0:
        assert heights[leaving - 1 :] == sorted(heights[leaving - 1 :])


def pecks(path):
    """The levels to which the tool drilled, and how often each thing was done."""
    names = [label.split(" ", 3)[3] for label in (row.label for row in path)]
    levels = [row.end[2] for row, name in zip(path, names, strict=True) if name.startswith(("peck", "drill"))]
    return levels, Counter(name for name in names)


def total(n, infeed, decrement, least):
    """What n infeeds add up to: those that shrink are an arithmetic series, the others are all the least."""
    least = min(least, infeed)
    shrinking = min(n, math.floor((infeed - least) / decrement + 1e-9) + 1) if decrement else n
    return shrinking * infeed - decrement * shrinking * (shrinking - 1) / 2 + (n - shrinking) * least


def so_many(n, depth, *shrinking):
    """n infeeds reach the depth, and n - 1 do not."""
    return total(n - 1, *shrinking) < depth - 1e-9 and depth <= total(n, *shrinking) + 1e-9


@given(**COMMON, infeed=INFEED, cylinder=st.booleans(), top=hundredths(0, 1), dwell=hundredths(0, 1))
def test_200_pecks_evenly(clearance, surface, second, depth, infeed, cylinder, top, dwell):
    planes = {"clearance": clearance, "surface": surface, "second": second}
    path = drilled(200, {206: 150, 202: infeed, 210: top, 211: dwell, 395: int(cylinder)}, depth=depth, **planes)
    total = depth + POINT * cylinder
    check(path, bottom=surface - total, **planes)
    levels, _ = pecks(path)
    assert len(levels) == math.ceil(total / infeed - 1e-9)
    steps = -np.diff([surface, *levels])
    assert steps.sum() == pytest.approx(total) and steps[:-1] == pytest.approx(infeed) and steps[-1] <= infeed + 1e-9
    waits = path[path.kind == Kind.DWELL].time.sum()
    assert waits == pytest.approx(len(levels) * dwell + (len(levels) - 1) * top)


@given(**COMMON, infeed=INFEED, decrement=hundredths(0, 2), least=hundredths(0.5, 6), breaks=st.integers(0, 4),
       back=hundredths(0, 0.5), out=st.sampled_from([0, 500, "FMAX"]))  # fmt: skip
def test_203_breaks_chips_between_retractions(
    clearance, surface, second, depth, infeed, decrement, least, breaks, back, out
):
    planes = {"clearance": clearance, "surface": surface, "second": second}
    values = {206: 150, 202: infeed, 210: 0, 212: decrement, 213: breaks, 205: least, 211: 0, 208: out, 256: back}
    path = drilled(203, values, depth=depth, **planes)
    check(path, bottom=surface - depth, **planes)
    levels, done = pecks(path)
    n = len(levels)
    assert so_many(n, depth, infeed, decrement, least)
    assert -np.diff([surface, *levels]).sum() == pytest.approx(depth)
    assert done["clear the chips"] == (n - 1) // (breaks + 1)
    assert done["break the chip"] == (n - 1 - (n - 1) // (breaks + 1)) * (back > 0)
    feeds = {row.feed for row in path if row.label.endswith(("clear the chips", "break the chip"))}
    assert feeds <= {math.inf if out == "FMAX" else out or 150}


@given(**COMMON, infeed=INFEED, decrement=hundredths(0, 2), least=hundredths(0.5, 6), every=hundredths(0.4, 9),
       back=hundredths(0.1, 0.5), part=st.sampled_from([0, 0.1, 0.5, 0.9]),
       stops=st.tuples(hundredths(0, 2), hundredths(0, 2)))  # fmt: skip
def test_205_clears_chips_inside_its_guide(
    clearance, surface, second, depth, infeed, decrement, least, every, back, part, stops
):
    planes = {"clearance": clearance, "surface": surface, "second": second}
    there = round(part * depth, 2)
    values = {206: 150, 202: infeed, 212: decrement, 205: least, 258: stops[0], 259: stops[1], 257: every, 256: back,
              211: 0, 379: there, 253: 750, 208: 900}  # fmt: skip
    path = drilled(205, values, depth=depth, **planes)
    check(path, bottom=surface - depth, top=surface - there, **planes)
    _, done = pecks(path)
    ends = [row.start[2] for row in path if row.label.endswith("clear the chips")]
    levels = [surface - there, *ends, surface - depth]
    n = len(levels) - 1
    assert so_many(n, depth - there, infeed, decrement, least)
    breaks = sum(math.ceil(e / every - 1e-9) - 1 for e in -np.diff(levels))
    assert done["break the chip"] == 2 * breaks  # back, and again to the depth
    clear = surface - there + min(0.8 * there, clearance) if there else surface + clearance
    assert all(row.end[2] == pytest.approx(clear) for row in path if row.label.endswith("clear the chips"))


@given(
    **COMMON,
    infeed=INFEED,
    part=st.sampled_from([0, 0.1, 0.5, 0.9]),
    dwell=hundredths(0.1, 1),
    pause=st.sampled_from([0, 0.95]),
)
def test_241_does_not_come_out_between(clearance, surface, second, depth, infeed, part, dwell, pause):
    planes = {"clearance": clearance, "surface": surface, "second": second}
    there, waiting = round(part * depth, 2), round(pause * depth, 4)
    values = {206: 150, 211: dwell, 379: there, 253: 750, 208: 1000, 426: 4, 427: 25, 428: 500, 429: 8, 430: 9, 435: waiting,
              401: 50, 202: infeed}  # fmt: skip
    path = drilled(241, values, depth=depth, **planes)
    check(path, bottom=surface - depth, top=surface - there, **planes)
    levels, _ = pecks(path)
    assert (np.diff(levels) <= 1e-9).all() and levels[-1] == pytest.approx(surface - depth)
    n = math.ceil((depth - there) / infeed - 1e-9)
    bottoms = {surface - there - k * infeed for k in range(1, n)} | {surface - depth}
    apart = waiting and min(abs(surface - waiting - b) for b in bottoms) > 1e-9
    assert path[path.kind == Kind.DWELL].time.sum() == pytest.approx((n + apart) * dwell)
    slow = path.feed[(path.kind == Kind.LINE) & (path.end[:, 2] < surface - waiting - 1e-9) & (path.feed < 500)]
    assert set(slow.tolist()) <= ({75.0} if waiting else {150.0})
    begins = surface - there + min(0.2 * there, clearance) if there else surface + clearance
    fast = path[np.abs(path.spindle) == 500]
    assert fast[fast.is_motion].start[0, 2] == pytest.approx(begins)
    assert path.spindle[-1] == -25


@given(
    **COMMON, out=st.sampled_from([0, 90, 400]), code=st.sampled_from([201, 202]), way=st.sampled_from([0, 1, 2, 3, 4])
)
def test_201_and_202_come_out_at_feed(clearance, surface, second, depth, out, code, way):
    planes = {"clearance": clearance, "surface": surface, "second": second}
    more = {214: way, 336: 30} if code == 202 else {}
    path = drilled(code, {206: 100, 211: 0, 208: out} | more, depth=depth, **planes)
    check(path, bottom=surface - depth, **planes)
    back = next(row for row in path if row.label.endswith("retract"))
    assert back.feed == (out or 100) and back.kind == Kind.LINE
    if code == 202:
        off = {0: (0, 0), 1: (-0.2, 0), 2: (0, -0.2), 3: (0.2, 0), 4: (0, 0.2)}[way]
        assert back.end[:2] - [30, 20] == pytest.approx(off)
        assert back.spindle == 0 and path.spindle[-1] == 1000


@given(**COMMON, diameter=hundredths(0.1, 8), by_diameter=st.booleans())
def test_240_centres_as_deep_as_its_cone(clearance, surface, second, depth, diameter, by_diameter):
    planes = {"clearance": clearance, "surface": surface, "second": second}
    path = drilled(240, {343: int(by_diameter), 344: -diameter, 206: 100, 211: 0}, depth=depth, **planes)
    bottom = surface - (diameter / 2 / math.tan(math.radians(59)) if by_diameter else depth)
    check(path, bottom=bottom, **planes)


@given(**COMMON, diameter=hundredths(8.02, 16), pitch=hundredths(0.5, 90), climb=st.sampled_from([1, -1, 0]))
def test_208_is_a_helix_and_three_circles(clearance, surface, second, depth, diameter, pitch, climb):
    """Two half circles of half the radius are as long as half the circle; the helix is the hypotenuse of its unrolling."""
    planes = {"clearance": clearance, "surface": surface, "second": second}
    path = drilled(208, {206: 100, 334: pitch, 335: diameter, 342: 0, 351: climb}, depth=depth, **planes)
    check(path, bottom=surface - depth, **planes)
    radius, down = diameter / 2 - 4, clearance + depth
    around = 2 * math.pi * radius
    cut = path[path.kind == Kind.ARC]
    assert cut.length == pytest.approx(1.5 * around + math.hypot(around * down / pitch, down))
    assert (np.sign(cut.sweep) == (-1 if climb < 0 else 1)).all() and set(cut.feed.tolist()) == {100}
    spokes = np.linalg.norm(cut.end[:-1, :2] - [30, 20], axis=1)
    assert spokes == pytest.approx(radius)


@given(thickness=hundredths(5, 40), part=st.sampled_from([0.1, 0.5, 0.9]), off=hundredths(0.5, 5), edge=hundredths(1, 20),
       way=st.sampled_from([1, 2, 3, 4]), clearance=CLEARANCE, surface=SURFACE, second=SECOND)  # fmt: skip
def test_204_goes_through_its_hole_off_the_axis(thickness, part, off, edge, way, clearance, surface, second):
    """Between the upper surface and the counterbore the bar is nowhere but at its off-centre distance."""
    counterbore = round(part * thickness, 2)
    values = {249: counterbore, 250: thickness, 251: off, 252: edge, 253: 750, 254: 200, 255: 0, 214: way, 336: 0}
    q = values | {200: clearance, 203: surface, 204: second}
    lines = "\n".join(f"Q{number}={value:.12g}" for number, value in q.items())
    text = f"TOOL CALL 2 Z S1000\nL Z+100 R0 FMAX\nCYCL DEF 204 X\n{lines}\nL X+30 Y+20 R0 FMAX M4\nCYCL CALL\n"
    path = mnc.run(text, "tnc-620", mnc.Setup(tools={2: TOOL})).toolpath
    path = path[path.line == path.line.max()]
    assert path.end[-1] == pytest.approx([30, 20, surface + max(second, clearance)])
    lower = surface - thickness - edge
    for row in path[path.is_motion]:
        away = math.dist(row.end[:2], (30, 20))
        if row.start[2] != row.end[2] and min(row.start[2], row.end[2]) < surface:
            inside = max(row.start[2], row.end[2]) > lower + counterbore + 1e-9
            assert away == pytest.approx(off if inside else 0)
    bored = path[path.feed == 200]
    assert bored.end[:, 2] == pytest.approx([lower + counterbore]) and (bored.spindle == -1000).all()


UPWARDS = {
    200: {206: 150, 202: 5, 210: 0, 211: 0},
    201: {206: 100, 211: 0, 208: 0},
    202: {206: 100, 211: 0, 208: 0, 214: 1, 336: 0},
    203: {206: 150, 202: 5, 210: 0, 212: 1, 213: 1, 205: 3, 211: 0, 208: 500, 256: 0.2},
    205: {206: 150, 202: 5, 212: 0, 205: 3, 258: 0.5, 259: 1, 257: 2, 256: 0.2, 211: 0, 379: 0.4, 253: 750, 208: 900},
    208: {206: 100, 334: 2, 335: 12, 342: 0, 351: 1},
    241: {206: 150, 211: 0, 379: 0.4, 253: 750, 208: 1000, 426: 3, 427: 25, 428: 500, 429: 8, 430: 9},
}


@settings(max_examples=60)
@given(**COMMON, code=st.sampled_from(list(UPWARDS)))
def test_a_positive_depth_is_the_mirror_image(clearance, surface, second, depth, code):
    """Where it is allowed: every level is as far on the other side of the surface; the end plane stays above."""
    planes = {"clearance": clearance, "surface": surface, "second": second}
    down = drilled(code, UPWARDS[code], depth=depth, **planes)
    up = drilled(code, UPWARDS[code], depth=depth, up=True, **planes)
    check(up, bottom=surface + depth, top=surface + UPWARDS[code].get(379, 0), **planes)

    def at_feed(path):
        """Not the way out of the hole, which may have two legs or one."""
        rows = [row for row in path if row.kind in (Kind.LINE, Kind.ARC) and not row.label.endswith("retract")]
        return [abs(row.end[2] - surface) for row in rows]

    assert at_feed(up) == pytest.approx(at_feed(down), abs=1e-9)


INCHES = UPWARDS | {
    204: {249: 5, 250: 20, 251: 3.5, 252: 15, 253: 750, 254: 200, 255: 0, 214: 1, 336: 0},
    240: {343: 1, 344: -6, 206: 100, 211: 0.5},
}


@pytest.mark.parametrize("code", INCHES)
def test_a_program_in_inches_drills_the_same_hole(code):
    """Lengths are divided by 25.4 and feeds by 2.54 (tenths of an inch); times, speeds, counts, choices and angles are not."""
    values = {200: 2, 203: 7, 204: 30, 201: -20} | INCHES[code]
    if code == 204:
        del values[201]
    units = {p.address: p.unit for p in mnc.controls["tnc-620"].cycles[f"CYCL DEF {code}"].parameters()}
    paths = []
    for unit, inch in (("MM", 1), ("INCH", 25.4)):
        by = {"mm": inch, "mm/min": inch if inch == 1 else inch / 10}
        lines = [f"Q{q}={v / by.get(units[f'Q{q}'], 1):.12g}" for q, v in values.items()]
        text = "\n".join(
            [f"BEGIN PGM A {unit}", "TOOL CALL 2 Z S1000", f"CYCL DEF {code} X", *lines, "CYCL CALL M3", ""]
        )
        found = mnc.run(text, "tnc-620", mnc.Setup(tools={2: TOOL}))
        assert found.alarms == ()
        paths.append(found.toolpath)
    metric, inches = paths
    for column in ("end", "feed", "time", "spindle", "sweep"):
        assert getattr(inches, column) == pytest.approx(getattr(metric, column), abs=1e-6, nan_ok=True)
