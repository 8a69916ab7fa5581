"""Cycles 210 and 211 against numbers worked out from the manuals of earlier controls (TNC 426/430, 8.4; iTNC 530).

Roughing: to the surface at the milling feed, obliquely to the other end and back, down to the depth, along the floor to
the other end; in 210 back to the middle. Finishing: up to the wall, once round in climb milling, and off it, on arcs.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

import mnclab as mnc
from mnclab import Kind, Setup, Tool

STRAIGHT = {"Q218": 80, "Q219": 12, "Q224": 0}
ROUND = {"Q244": 80, "Q219": 12, "Q245": 0, "Q248": 90}
BOTH = {
    "Q200": 2, "Q201": -20, "Q207": 500, "Q202": 5, "Q215": 0, "Q203": 30, "Q204": 50, "Q216": 50, "Q217": 40, "Q338": 0,
    "Q206": 150,
}  # fmt: skip


def cut(number: int, radius: float = 5, call: str = "CYCL CALL", **changed: float) -> mnc.Run:
    values = BOTH | (STRAIGHT if number == 210 else ROUND) | changed
    lines = "".join(f"{address}={value}\n" for address, value in values.items() if value is not None)
    text = f"TOOL CALL 1 Z S1000\nL X+0 Y+0 Z+100 R0 FMAX M3\nCYCL DEF {number} X\n{lines}{call}\n"
    return mnc.run(text, "tnc-620", Setup(tools={1: Tool(radius=radius)}))


def swept(path: mnc.Toolpath, level: float, radius: float) -> shapely.Geometry:
    flat = path[(path.kind != Kind.RAPID) & (abs(path.start[:, 2] - level) < 1e-9) & (abs(path.end[:, 2] - level) < 1e-9)]
    ways = [shapely.LineString(flat[k : k + 1].points(1e-4)[0][:, :2]) for k in range(len(flat))]
    return shapely.union_all(shapely.buffer(ways, radius, quad_segs=512))


def test_the_straight_slot_sinks_there_and_back(rows) -> None:
    """80 by 12: the arcs' centres are 34 from the middle. Half of Q202 each way, from the surface 30 down to 10."""
    path = rows(cut(210, Q215=1))
    assert path.end[:3].tolist() == [[16, 40, 100], [16, 40, 32], [16, 40, 30]]
    assert path.kind[:3].tolist() == [Kind.RAPID, Kind.RAPID, Kind.LINE] and (path.feed[2:-1] == 500).all()
    down = [[84 if k % 2 else 16, 40, 30 - 2.5 * k] for k in range(1, 9)]
    assert path.end[3:].tolist() == [*down, [84, 40, 10], [50, 40, 10], [50, 40, 80]]


def test_finishing_goes_round_from_the_middle(rows) -> None:
    """The half circle of 1 leads to the lower wall at X50; the way round touches all that 12 mm leave beyond the tool of 10."""
    path = rows(cut(210, Q215=2))
    assert path.end[:3].tolist() == [[50, 40, 100], [50, 40, 32], [50, 40, 10]] and path.feed[2] == 150
    assert path.end[3] == pytest.approx([50, 39, 10]) and path.sweep[3] == pytest.approx(math.pi)
    round_ = path[[path.labels[k].endswith("finishing") for k in path.label]]
    assert round_.end[:, :2] == pytest.approx(np.array([(84, 39), (85, 40), (84, 41), (16, 41), (15, 40), (16, 39), (50, 39)]))
    assert path.end[-2:] == pytest.approx(np.array([(50, 40, 10), (50, 40, 80)]))


def test_infeeds_of_finishing(rows) -> None:
    """8, 8 and the rest of 20, each from the middle of the slot; after roughing from the set-up clearance."""
    path = rows(cut(210, Q338=8))
    downs = path[[path.labels[k].endswith(", down") for k in path.label]]
    assert downs.end.tolist() == [[50, 40, 22], [50, 40, 14], [50, 40, 10]] and (downs.feed == 150).all()
    assert downs.start[0].tolist() == [50, 40, 32]


def test_without_q206_finishing_plunges_at_the_milling_feed(rows) -> None:
    path = rows(cut(210, Q215=2, Q206=None))
    assert (path.feed[path.kind != Kind.RAPID] == 500).all()


@pytest.mark.parametrize(("length", "width", "radius", "angle"), [(80, 12, 5, 30), (50, 20, 4, -120), (35, 16, 8, 90)])
def test_what_a_straight_slot_is(rows, length: float, width: float, radius: float, angle: float) -> None:
    path = rows(cut(210, radius, Q218=length, Q219=width, Q224=angle))
    half = (length - width) / 2 * np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    wanted = shapely.LineString([(50, 40) - half, (50, 40) + half]).buffer(width / 2, quad_segs=512)
    assert swept(path, 10, radius).symmetric_difference(wanted).area < 0.03
    assert wanted.buffer(1e-6).covers(shapely.MultiPoint(path.end[path.kind != Kind.RAPID, :2]).buffer(radius))


def test_the_round_slot_sinks_along_its_arc(rows) -> None:
    """A quarter about (50, 40), radius 40, from X90 to Y80, and back along it to where finishing begins."""
    path = rows(cut(211))
    assert path.end[:3].tolist() == [[90, 40, 100], [90, 40, 32], [90, 40, 30]]
    arcs = path[3:13]
    assert arcs.sweep == pytest.approx([math.pi / 2, -math.pi / 2] * 5)
    assert arcs.end[:, 2] == pytest.approx([27.5, 25, 22.5, 20, 17.5, 15, 12.5, 10, 10, 10])
    assert arcs.end[0] == pytest.approx([50, 80, 27.5]) and arcs.end[-1] == pytest.approx([90, 40, 10])
    to = path[13]
    assert to.end == pytest.approx([90, 39, 10]) and to.sweep == pytest.approx(math.pi)


def test_roughing_alone_ends_at_the_other_end(rows) -> None:
    assert rows(cut(211, Q215=1)).end[-1] == pytest.approx([50, 80, 80])


@pytest.mark.parametrize(("start", "sweep", "width", "radius"), [(0, 90, 12, 5), (-45, 250, 20, 4), (170, 20, 11, 5)])
def test_what_a_round_slot_is(rows, start: float, sweep: float, width: float, radius: float) -> None:
    path = rows(cut(211, radius, Q245=start, Q248=sweep, Q219=width))
    way = np.radians(start + sweep * np.linspace(0, 1, 4000))
    line = shapely.LineString(np.stack([50 + 40 * np.cos(way), 40 + 40 * np.sin(way)], axis=1))
    assert swept(path, 10, radius).symmetric_difference(line.buffer(width / 2, quad_segs=512)).area < 0.1


def test_a_slot_as_wide_as_the_tool_is_not_finished(rows) -> None:
    run = cut(210, Q219=10, Q215=2)
    assert [a.message for a in run.alarms] == ["CYCL DEF 210 Q215=2 finishes nothing: the slot is as wide as the tool"]
    assert not any("finishing" in label for label in rows(cut(210, Q219=10)).labels)


@pytest.mark.parametrize("number", [210, 211])
def test_the_place_of_a_call_is_added_to_its_own(rows, number: int) -> None:
    """3.1: the position of the cycle serves as a shift beside that of CYCL CALL POS."""
    there, here = rows(cut(number, call="CYCL CALL POS X+10 Y-20 Z+1 FMAX")), rows(cut(number, Q203=31))
    at_feed = there.end[there.kind != Kind.RAPID], here.end[here.kind != Kind.RAPID]
    assert at_feed[0] == pytest.approx(at_feed[1] + (10, -20, 0))
