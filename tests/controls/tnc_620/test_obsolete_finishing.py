"""Cycles 212 to 215 against numbers worked out from the manuals of earlier controls (TNC 426/430, 8.4; iTNC 530).

Over the centre to the start on its right, to the set-up clearance at rapid, down to each infeed at the plunge feed; tangentially
to the wall, once round in climb milling, tangentially off it and back; at the end over the centre.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

import mnclab as mnc
from mnclab import Kind, Setup, Tool

BOTH = {"Q200": 2, "Q201": -20, "Q206": 150, "Q202": 8, "Q207": 500, "Q203": 30, "Q204": 50, "Q216": 50, "Q217": 40}
RECTANGLE = {"Q218": 80, "Q219": 60, "Q220": 8, "Q221": 3}
OWN = {212: RECTANGLE, 213: RECTANGLE, 214: {"Q222": 79, "Q223": 80}, 215: {"Q222": 81, "Q223": 80}}
R = 5


def cut(number: int, radius: float = R, **changed: float) -> mnc.Run:
    values = BOTH | OWN[number] | changed
    lines = "".join(f"{address}={value}\n" for address, value in values.items())
    text = f"TOOL CALL 1 Z S1000\nL X+0 Y+0 Z+90 R0 FMAX M3\nCYCL DEF {number} X\n{lines}CYCL CALL\n"
    return mnc.run(text, "tnc-620", Setup(tools={1: Tool(radius=radius)}))


def round_(path: mnc.Toolpath) -> mnc.Toolpath:
    """The first way round."""
    return path[[path.labels[k].endswith("finishing 1 of 3") for k in path.label]]


#: On the right of the centre at X50: 212 at 40 - 5 - 3, 213 at 40 + 3 + 3.5 · 5, 214 at 39.5 - 5, 215 at 40.5 + 3.5 · 5
STARTS = {212: 32, 213: 60.5, 214: 34.5, 215: 58}


@pytest.mark.parametrize("number", STARTS)
def test_the_way_to_the_start_and_the_infeeds(rows, number: int) -> None:
    path = rows(cut(number))
    x = 50 + STARTS[number]
    assert path.end[:4].tolist() == [[50, 40, 90], [x, 40, 90], [x, 40, 32], [x, 40, 22]]
    downs = path[[path.labels[k].endswith("down") for k in path.label]]
    assert downs.end[:, 2].tolist() == [22, 14, 10] and (downs.feed == 150).all() and (downs.start[:, :2] == (x, 40)).all()
    assert path.end[-2:].tolist() == [[x, 40, 80], [50, 40, 80]] and path.kind[-2:].tolist() == [Kind.RAPID] * 2
    assert (path.feed[4:-2][path.kind[4:-2] != Kind.RAPID] % 350 == 150).all()


@pytest.mark.parametrize("number", STARTS)
def test_half_circles_lead_to_the_wall_and_off_it(rows, number: int) -> None:
    """At the right of the figure, 35 or 45 from the middle; inside counter-clockwise, about a stud clockwise.

    The arcs turn to the left: in a pocket as its wall does, at a stud away from it.
    """
    path, inside = rows(cut(number)), number in (212, 214)
    wall, sense = (35, 1) if inside else (45, -1)
    to, off = (path[[path.labels[k].endswith(f"1 of 3, {way} the wall") for k in path.label]] for way in ("to", "off"))
    assert to.end[0] == pytest.approx([50 + wall, 40, 22]) and off.start[0] == pytest.approx([50 + wall, 40, 22])
    assert to.start[0] == pytest.approx([50 + STARTS[number], 40, 22]) and off.end[0] == pytest.approx(to.start[0])
    assert [*to.sweep, *off.sweep] == pytest.approx([math.pi] * 2)
    assert round_(path).sweep.sum() == pytest.approx(sense * math.tau)


@pytest.mark.parametrize(("number", "corner"), [(212, 8), (212, 0), (212, 20), (213, 8), (213, 0), (213, 30)])
def test_what_a_rectangle_is(rows, number: int, corner: float) -> None:
    """The disc of the tool touches the wall all round and goes nowhere beyond it."""
    path = rows(cut(number, Q220=corner))
    r = max(corner, R) if number == 212 else corner
    figure = shapely.box(10 + r, 10 + r, 90 - r, 70 - r).buffer(r, quad_segs=512)
    way = shapely.LineString(round_(path).points(1e-4)[0][:, :2])
    away = [figure.exterior.distance(shapely.Point(p)) for p in way.coords]
    assert away == pytest.approx([R] * len(away), abs=2e-3)
    flat = path[(path.kind != Kind.RAPID) & (path.end[:, 2] == 22)].points(1e-3)[0][:, :2]
    beside = [figure.exterior.distance(p) for p in shapely.points(flat)]
    assert min(beside) > R - 2e-3 and all(figure.covers(shapely.Point(p)) == (number == 212) for p in flat)


@pytest.mark.parametrize(("allowance", "width"), [(0, 60), (50, 60), (0, 20), (8, 16)])
def test_in_a_pocket_without_a_way_the_tool_goes_down_in_its_middle(rows, allowance: float, width: float) -> None:
    """And on half circles no wider than the pocket, however narrow: from (85 - d, 40), d = the width less the tool."""
    path = rows(cut(212, Q221=allowance, Q219=width, Q220=0))
    to = path[[path.labels[k].endswith("1 of 3, to the wall") for k in path.label]]
    middle = allowance == 0 or allowance >= 35
    start = 50 if middle else 77
    down = path[[path.labels[k].endswith("1 of 3, down") for k in path.label]]
    assert down.end.tolist() == [[start, 40, 22]] and down.feed[0] == 150
    assert to.start[0] == pytest.approx([85 - min(85 - start, width - 10), 40, 22])
    flat = path[(path.kind != Kind.RAPID) & (path.end[:, 2] == 22)].points(1e-3)[0]
    assert np.abs(flat[:, 1] - 40).max() <= width / 2 - R + 1e-6


def test_in_a_round_pocket_without_a_blank_too(rows) -> None:
    path = rows(cut(214, Q222=0))
    assert path.end[0].tolist() == [50, 40, 90] and path.end[2].tolist() == [50, 40, 22]
    assert path[3].end == pytest.approx([85, 40, 22]) and path[3].sweep == pytest.approx(math.pi)


@pytest.mark.parametrize(("number", "reach"), [(214, 35), (215, 45)])
def test_what_a_circle_is(rows, number: int, reach: float) -> None:
    path = round_(rows(cut(number)))
    assert path.centre[:, :2] == pytest.approx(np.array([(50, 40)] * len(path)))
    assert np.hypot(*(path.end[:, :2] - (50, 40)).T) == pytest.approx(reach)


def test_the_stud_of_the_manual_s_example(rows) -> None:
    """16.14, PGM BEAMS: 213 with Q200=20, Q203=10, Q221=0 and the sides in Q1 and Q2; at Q218/2 + 3.5 R on the right."""
    text = """0 BEGIN PGM BEAMS MM
1 TOOL CALL 1 Z S1000
2 Q1 = 60.5
3 Q2 = 40.5
4 L Z+100 R0 FMAX
5 CYCL DEF 213 FINISARE STIFT
Q200=20 ;DIST. DE SIGURANTA
Q201=-10 ;ADANCIME
Q206=150 ;VIT. AVANS PLONJARE
Q202=5 ;ADANCIME PLONJARE
Q207=500 ;VITEZA AVANS FREZARE
Q203=+10 ;COORDONATA SUPRAFATA
Q204=20 ;DIST. DE SIGURANTA 2
Q216=+50 ;CENTRU AXA 1
Q217=+50 ;CENTRU AXA 2
Q218=Q1 ;LUNGIME PRIMA LATURA
Q219=Q2 ;LUNG. A DOUA LATURA
Q220=0 ;RAZA COLT
Q221=0 ;ADAOS AXA 1
6 CYCL CALL M3
7 END PGM BEAMS MM
"""
    path = rows(mnc.run(text, "tnc-620", Setup(tools={1: Tool(radius=5)})))
    assert path.end[1].tolist() == [50 + 30.25 + 17.5, 50, 100] and path.end[:, 2].min() == 0
    sides = path.end[path.kind == Kind.LINE]
    assert sides[:, 1].max() == pytest.approx(50 + 20.25 + 5) and path.end[-1].tolist() == [50, 50, 30]
