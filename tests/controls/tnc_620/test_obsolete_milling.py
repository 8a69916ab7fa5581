"""Cycles 3, 4 and 5 against numbers worked out from the manuals of earlier controls (TNC 407, 8.2; TNC 426/430, 8.4).

What is cut is held against the figure as an area: the disc of the tool along the path at the bottom.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

import mnclab as mnc
from mnclab import Kind, Setup, Tool


def cut(sub_blocks: str, radius: float, x: float = 0, y: float = 0, z: float = 2, **settings: object) -> mnc.Run:
    number = sub_blocks.split(".")[0]
    lines = "".join(f"CYCL DEF {line}\n" for line in [f"{number}.0 X", *sub_blocks.split("\n")])
    text = f"TOOL CALL 1 Z S1000\nL X{x:+g} Y{y:+g} Z{z:+g} R0 FMAX M3\n{lines}CYCL CALL\n"
    return mnc.run(text, "tnc-620", Setup(tools={1: Tool(radius=radius)}, settings=settings))


def area(path: mnc.Toolpath, level: float, radius: float) -> shapely.Geometry:
    """What the disc of the tool sweeps at feed on one level."""
    flat = path[(path.kind != Kind.RAPID) & (abs(path.start[:, 2] - level) < 1e-9) & (abs(path.end[:, 2] - level) < 1e-9)]
    ways = []
    for k in range(len(flat)):
        points, _ = flat[k : k + 1].points(1e-4)
        ways.append(shapely.LineString(points[:, :2]))
    return shapely.union_all(shapely.buffer(ways, radius, quad_segs=512))


SLOT = "3.1 SET UP 2\n3.2 DEPTH -15\n3.3 PECKG 5 F80\n3.4 X{}\n3.5 Y{}\n3.6 F120"


def test_a_slot_in_its_example(rows) -> None:
    """50 by 15 with a tool of 10: 2.5 inwards, three infeeds between 7.5 and 42.5 from the end; the last one ends far away.

    The tool stands 5 within the left end at X5: the centres of the round ends are X7.5 and X42.5, and the way to the wall is
    a quarter circle of 2.5 about (40, 2.5): from the far end, along the upper wall first.
    """
    path = rows(cut(SLOT.format(50, 15), 5, x=5))
    roughing = path[[path.labels[k].endswith(("down", "along the slot")) for k in path.label]]
    assert roughing.end[:6].tolist() == [
        [7.5, 0, -5], [42.5, 0, -5], [42.5, 0, -10], [7.5, 0, -10], [7.5, 0, -15], [42.5, 0, -15],
    ]  # fmt: skip
    assert roughing.feed[:6].tolist() == [80, 120] * 3
    to = path[path.labels.index("CYCL DEF 3 finishing, to the wall") == path.label]
    assert to.end[0] == pytest.approx([40, 2.5, -15]) and to.centre[0] == pytest.approx([40, 0, -15])
    assert to.sweep[0] == pytest.approx(math.pi / 2)
    assert path.end[-2:].tolist() == [[42.5, 0, 2], [5, 0, 2]] and (path.kind[-2:] == Kind.RAPID).all()


@pytest.mark.parametrize(
    ("x", "y", "radius", "infeed"), [(50, 15, 5, 5), (-50, 15, 5, 4), (12, 60, 6, 5), (20, -23, 6, 8), (17, 15, 4, 5)]
)
def test_what_a_slot_is(rows, x: float, y: float, radius: float, infeed: float) -> None:
    """All within half the width of a line as much shorter than the slot as that is wide; the tool stood within its begin."""
    long, width = (x, abs(y)) if abs(x) > abs(y) else (y, abs(x))
    ahead = np.array([1, 0] if abs(x) > abs(y) else [0, 1]) * math.copysign(1, long)
    path = rows(cut(SLOT.format(f"{x:+g}", f"{y:+g}").replace("PECKG 5", f"PECKG {infeed}"), radius, x=3, y=4))
    begin = np.array([3, 4]) + ahead * (width / 2 - radius)
    wanted = shapely.LineString([begin, begin + ahead * (abs(long) - width)]).buffer(width / 2, quad_segs=512)
    assert area(path, -15, radius).symmetric_difference(wanted).area < 0.02
    assert path.end[-1].tolist() == [3, 4, 2] and path.end[:, 2].min() == -15


def test_a_slot_as_wide_as_the_tool_has_no_finishing(rows) -> None:
    path = rows(cut(SLOT.format(50, 10), 5))
    assert not any("finishing" in label for label in path.labels) and path.motion.end[-3].tolist() == [40, 0, -15]


POCKET = "4.1 SET UP 2\n4.2 DEPTH -20\n4.3 PECKG 10 F80\n4.4 X{}\n4.5 Y{}\n4.6 F100 DR{} RADIUS {}"


@pytest.mark.parametrize(("x", "y", "first"), [(80, 40, (20, 0)), (40, 80, (0, 20)), (60, 60, (0, 5))])
@pytest.mark.parametrize("sense", ["+", "-"])
def test_a_pocket_begins_along_its_longer_side(rows, x: float, y: float, sense: str, first: tuple[float, float]) -> None:
    """Positive, as far as the sides differ (40 / 2); of two equal ones along Y, by one stepover of 5: 25 / 5."""
    path = rows(cut(POCKET.format(x, y, sense, 10), 5))
    assert path.end[0].tolist() == [0, 0, -10] and path.feed[0] == 80
    assert path.end[1] == pytest.approx([*first, -10]) and path.feed[1] == 100
    arcs = path[(path.kind == Kind.ARC)]
    assert (np.sign(arcs.sweep) == (1 if sense == "+" else -1)).all()


@pytest.mark.parametrize(("x", "y", "corner", "radius", "overlap"), [(80, 40, 10, 5, 1), (50, 70, 0, 6, 1.4), (60, 60, 8, 5, 2)])
def test_what_a_pocket_is(rows, x: float, y: float, corner: float, radius: float, overlap: float) -> None:
    path = rows(cut(POCKET.format(x, y, "+", corner), radius, x=7, y=-3, overlap=overlap))
    r = max(corner, radius)
    box = shapely.box(7 - x / 2 + r, -3 - y / 2 + r, 7 + x / 2 - r, -3 + y / 2 - r).buffer(r, quad_segs=512)
    for level in (-10, -20):
        assert area(path, level, radius).symmetric_difference(box).area < 0.02
    assert path.end[-1].tolist() == [7, -3, 2]


CIRCLE = "5.1 SET UP 2\n5.2 DEPTH -12\n5.3 PECKG 6 F80\n5.4 RADIUS {}\n5.5 F100 DR{}"


@pytest.mark.parametrize("sense", ["+", "-"])
def test_a_circular_pocket_in_its_example(rows, sense: str) -> None:
    """R 35 with a tool of 5: 30 to go, six turns of twelve half circles, each 2.5 farther out, and a full one."""
    path = rows(cut(CIRCLE.format(35, sense), 5))
    turn = 1 if sense == "+" else -1
    assert path.end[0].tolist() == [0, 0, -6] and path.feed[:2].tolist() == [80, 100]
    spiral = path[1:13]
    assert spiral.end[:, 0] == pytest.approx([2.5 * k * (-1) ** k for k in range(1, 13)])
    assert spiral.sweep == pytest.approx([turn * math.pi] * 12)
    assert path[13].sweep == pytest.approx(turn * math.tau) and path.end[13].tolist() == [30, 0, -6]


@pytest.mark.parametrize(("size", "radius", "overlap"), [(35, 5, 1), (20, 8, 1.5), (12, 10, 1), (50, 6, 1.9)])
def test_what_a_circular_pocket_is(rows, size: float, radius: float, overlap: float) -> None:
    path = rows(cut(CIRCLE.format(size, "+"), radius, overlap=overlap))
    wanted = shapely.Point(0, 0).buffer(size, quad_segs=512)
    for level in (-6, -12):
        assert area(path, level, radius).symmetric_difference(wanted).area < 0.03
    assert path.end[-1].tolist() == [0, 0, 2]


def test_a_tool_that_fills_the_pocket_goes_down_and_up(rows) -> None:
    assert rows(cut(CIRCLE.format(5, "+"), 5)).end[:, 2].tolist() == [-6, -4, -12, 2]
