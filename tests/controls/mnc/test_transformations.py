"""Scaling, mirror, rotation, work offsets and G92 in every order against plain 4x4 matrices made here (2.5 to 2.10).

A programmed point p is scaled, mirrored, turned; then come G92 and the work offset. `Model` is the account of one
machine kept with these matrices; nothing of mnclab.geometry takes part in it.
"""

import json
import math
from functools import partial
from itertools import permutations, product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tools import running
from tools.together import together

import mnclab
from mnclab import Kind, Setup, Tool

COMPENSATION = Path(__file__).parents[2] / "authorities" / "compensation.json"
EXACT = 1e-12  # of the largest coordinate
PLANES = {"G17": (0, 1, 2), "G18": (2, 0, 1), "G19": (1, 2, 0)}  # first axis, second axis, normal
DATUMS = {1: (31.5, -12.25, 8), 2: (-100, 50.125, -7.5), 3: (0.1, 0.2, 0.3)}
START = (5.0, -3.0, 11.0)


def shift(vector):
    matrix = np.eye(4)
    matrix[:3, 3] = vector
    return matrix


def scaled(factors):
    return np.diag([*factors, 1.0])


def mirrored(lines):
    """x' = 2 X - x for every axis that has a line."""
    matrix = np.eye(4)
    for k, line in lines.items():
        matrix[k, k], matrix[k, 3] = -1, 2 * line
    return matrix


def turned(plane, pole, degrees):
    """u' = U + (u - U) cos A - (v - V) sin A, v' = V + (u - U) sin A + (v - V) cos A."""
    (u, v, _), c, s = PLANES[plane], math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    matrix = np.eye(4)
    matrix[u, u], matrix[u, v], matrix[v, u], matrix[v, v] = c, -s, s, c
    matrix[u, 3] = pole[0] - c * pole[0] + s * pole[1]
    matrix[v, 3] = pole[1] - s * pole[0] - c * pole[1]
    return matrix


def image(matrix, point):
    return (matrix @ (*point, 1.0))[:3]


def words(letters, values):
    """Axis words with all digits; None is not written."""
    return " ".join(f"{a}{v:.15f}" for a, v in zip(letters, values) if v is not None)


class Model:
    """Where the tip stands and what the register holds, after the rules of the manual."""

    def __init__(self):
        self.datum, self.local = np.zeros(3), np.zeros(3)
        self.parts = {"scaling": np.eye(4), "mirror": np.eye(4), "rotation": np.eye(4)}
        self.tip = self.p = np.array(START)

    @property
    def inner(self):
        return self.parts["rotation"] @ self.parts["mirror"] @ self.parts["scaling"]

    @property
    def matrix(self):
        return shift(self.datum) @ shift(self.local) @ self.inner

    def move(self, values, incremental=False):
        old = self.p
        self.p = np.array([o if v is None else o + v if incremental else v for o, v in zip(old, values)])
        self.tip = image(self.matrix, self.p)

    def reread(self):
        """An axis that is not written keeps its place."""
        self.p = image(np.linalg.inv(self.matrix), self.tip)

    def select(self, row):
        self.datum, self.local = np.array(DATUMS[row], dtype=float), np.zeros(3)
        self.reread()

    def set_position(self, values):
        self.p = np.array([o if v is None else v for o, v in zip(self.p, values)])
        found = self.tip - self.datum - image(self.inner, self.p)
        self.local = np.array([o if v is None else f for o, v, f in zip(self.local, values, found)])

    def machine_move(self, values):
        """G53: datum and G92 count as zero, the transformations stay."""
        datum, local = self.datum, self.local
        self.datum = self.local = np.zeros(3)
        self.reread()
        self.move(values)
        self.datum, self.local = datum, local
        self.reread()


def switch(model, plane, name, rng):
    """One function of a kind with random values: its block, and the same in the model."""
    u, v, w = PLANES[plane]
    some = [round(x, 3) for x in rng.uniform(-30, 30, 3)]
    if name == "scaling":
        factors = [0.0] * 3
        factors[u] = factors[v] = round(rng.uniform(0.3, 2.5), 3)
        factors[w] = round(rng.uniform(0.3, 2.5), 3)
        model.parts[name] = scaled(factors)
        return "G37 " + words("XYZ", factors)
    if name == "mirror":
        lines = {int(k): some[k] for k in rng.permutation(3)[: rng.integers(1, 4)]}
        model.parts[name] = mirrored(lines)
        return "G51 " + words("XYZ", [lines.get(k) for k in range(3)])
    if name == "rotation":
        degrees = round(rng.uniform(-200, 200), 3)
        model.parts[name] = turned(plane, (some[u], some[v]), degrees)
        some[w] = None
        return f"G39 A{degrees} " + words("XYZ", some)
    if name == "datum":
        row = int(rng.integers(1, 4))
        model.select(row)
        return str(rng.choice([f"G{53 + row}", f"G147 Q{row}"]))
    if rng.random() < 0.3:  # increments from the new position to the old
        model.set_position([p - d for p, d in zip(model.p, some)])
        return "G92 " + words("UVW", some)
    model.set_position(some)
    return "G92 " + words("XYZ", some)


# --- arcs ----------------------------------------------------------------------------------------------------------

QUARTERS = [(3, 4), (-4, 3), (-3, -4), (4, -3)]  # points of a circle of radius 5 about its centre
ARCS = [  # code, from, to (numbers of the points), how the centre is written, rise along the normal
    (3, 0, 1, "R", 0), (2, 1, 0, "IJK", 0), (2, 0, 1, "-R", 0), (3, 1, 3, "IJK", 0), (2, 3, 3, "IJK", 0),
    (3, 3, 2, "-R", -6), (2, 2, 2, "IJK", 9), (2, 2, 1, "R", 2.5),
]  # fmt: skip


def arc(plane, at, code, begin, end, by, rise):
    """The block of an arc from the point `at`, its end, and points along it in program coordinates."""
    u, v, w = PLANES[plane]
    begin, end = np.array(QUARTERS[begin], float), np.array(QUARTERS[end], float)
    centre, goal = np.array(at, dtype=float), np.array(at, dtype=float)
    centre[[u, v]] -= begin
    goal[[u, v]] += end - begin
    goal[w] += rise
    written = [goal[k] if k != w or rise else None for k in range(3)]
    if by == "IJK":
        shape = words("IJK", [None if k == w else centre[k] - at[k] for k in range(3)])
    else:
        shape = by.replace("R", "R5") if by == "R" else "R-5"
    angles = [math.atan2(p[1], p[0]) for p in (begin, end)]
    sense = 1 if code == 3 else -1
    sweep = sense * (((angles[1] - angles[0]) * sense) % math.tau or math.tau)
    points = []
    for t in np.linspace(0, 1, 9):
        point = centre.copy()
        point[u] += 5 * math.cos(angles[0] + t * sweep)
        point[v] += 5 * math.sin(angles[0] + t * sweep)
        point[w] = at[w] + t * rise
        points.append(point)
    return f"G{code} {words('XYZ', written)} {shape}", goal, points


def along(row, t):
    """A point of an arc or a helix, from start, centre, axis and sweep of its row."""
    arm, axis = row.start - row.centre, np.array(row.axis)
    angle, rise = t * row.sweep, (row.end - row.start) @ axis
    spun = arm * math.cos(angle) + np.cross(axis, arm) * math.sin(angle) + axis * (axis @ arm) * (1 - math.cos(angle))
    return row.centre + spun + axis * t * rise

run = partial(running.run, datums=DATUMS, start=START)


ORDERS = [
    order
    for size in (1, 2, 3)
    for order in permutations(("scaling", "mirror", "rotation", "datum", "set position"), size)
]


@together("plane order", product(PLANES, ORDERS), lambda plane, order: f"{plane}, {order[0]} first", deep_but_one_in=3)
def test_every_order_of_programming(plane, order):
    """Points, lines, arcs by R and by I J K, whole circles and helices after every pair and triple, in each order."""
    rng = np.random.default_rng([ORDERS.index(order), *plane.encode()])
    model, (u, v, w) = Model(), PLANES[plane]
    text, ends = [plane, "F100"], []
    for name in order:
        values = rng.integers(-40, 40, 3).tolist()
        text.append("G0 " + words("XYZ", values))
        model.move(values)
        ends.append(model.tip)
        text.append(switch(model, plane, name, rng))
    for code in (0, 1):
        values = rng.integers(-40, 40, 3).tolist()
        text.append(f"G{code} " + words("XYZ", values))
        model.move(values)
        ends.append(model.tip)
    curves = []
    for shape in ARCS:
        block, goal, points = arc(plane, model.p, *shape)
        text.append(block)
        model.move(goal)
        ends.append(model.tip)
        curves.append([image(model.matrix, point) for point in points])

    path = run("\n".join(text)).toolpath.motion
    origin, size = path.origin, np.abs(ends).max()
    assert np.abs(path.end + origin - ends).max() <= EXACT * size
    rows = [row for row in path if row.kind == Kind.ARC]
    turned_over = np.linalg.det(model.inner[:3, :3][np.ix_([u, v], [u, v])]) < 0
    factor = np.linalg.norm(model.inner[:3, u])
    for row, points, shape in zip(rows, curves, ARCS, strict=True):
        found = [along(row, t) + origin for t in np.linspace(0, 1, 9)]
        assert np.abs(np.array(found) - points).max() <= 4 * EXACT * size
        assert math.dist(row.start, row.centre) == pytest.approx(5 * factor, rel=1e-12)
        left = row.sweep * row.axis[w] > 0  # about the positive normal: a rotation in the plane does not turn it
        assert left == ((shape[0] == 3) != turned_over)


# --- random programs -------------------------------------------------------------------------------------------------

some_axes = st.lists(st.one_of(st.none(), st.integers(-40, 40)), min_size=3, max_size=3)
blocks = st.one_of(
    st.tuples(st.just("move"), some_axes),
    st.tuples(st.just("machine"), some_axes),
    st.tuples(st.sampled_from(["scaling", "mirror", "rotation", "datum", "set position"]), st.integers(0, 10**6)),
    st.tuples(st.just("off"), st.sampled_from(["scaling", "mirror", "rotation"])),
    st.tuples(st.just("dimension"), st.booleans()),
)
OFF = {"scaling": "G36", "rotation": "G38", "mirror": "G50"}


@given(st.sampled_from(list(PLANES)), st.lists(blocks, max_size=14))
def test_random_programs(plane, todo):
    """Switches and moves in any order, axes left out, G91, G53: every end, and the register after every block."""
    model, text, incremental, expected = Model(), [plane + " G0"], False, []
    sizes = [1.0]
    for kind, value in todo:
        if kind == "dimension":
            incremental = value
            text.append("G91" if incremental else "G90")
        elif kind == "off":
            model.parts[value] = np.eye(4)
            text.append(OFF[value])
        elif kind == "move":
            text.append(words("XYZ", value))
            if any(v is not None for v in value):
                model.move(value, incremental)
        elif kind == "machine":
            text.append("G53 " + words("XYZ", value))
            model.machine_move(value) if any(v is not None for v in value) else model.reread()
        else:
            text.append(switch(model, plane, kind, np.random.default_rng(value)))
        expected.append((model.tip, model.p))
        sizes.append(max(np.abs(model.tip).max(), np.abs(model.p).max()) * np.linalg.cond(model.matrix[:3, :3]))
    found, size = run("\n".join(text)), max(sizes)
    path = found.toolpath
    for line, (tip, p) in enumerate(expected, 2):
        if not text[line - 1]:
            continue
        moment = found.at(line)
        assert np.abs(np.array(moment.position) - p).max() <= 10 * EXACT * size
        end = path.end[moment.rows.stop - 1] + path.origin if moment.rows.stop else np.array(START)
        assert np.abs(end - tip).max() <= 10 * EXACT * size


# --- what the manual says in words -----------------------------------------------------------------------------------


def ends(text, **setup):
    """Ends of the moves in machine coordinates, from machine zero."""
    path = mnclab.run(text, "mnc", Setup(datums=DATUMS, **setup)).toolpath.motion
    return np.round(path.end + path.origin, 9).tolist()


def test_a_switch_keeps_the_programmed_coordinates():
    """2.9.3: the block after G39 writes one coordinate and both axes move; after G38 they come back."""
    text = "G0 X10\nG39 A90\nY0\nY5\nG38\nX10\nG51 X4\nZ1\nG50\nG37 X3\nY5\nG36\nG91\nZ1\n"
    assert ends(text) == [[10, 0, 0], [0, 10, 0], [-5, 10, 0], [10, 5, 0], [-2, 5, 1], [30, 5, 1], [10, 5, 2]]


@pytest.mark.parametrize("select", ["G55", "G147 Q2"])
def test_a_work_offset_keeps_the_place(select):
    """2.5, 2.7: X and Y are not written and stay where they are, also turned, and also with increments."""
    text = f"G54\nG0 X1 Y2 Z3\n{select}\nZ0\nG39 A90\nX0 Y0 Z0\nG54\nZ1\nG91\nX1\n{select}\nY1\n"
    x, y, z = DATUMS[1]
    a, b, c = DATUMS[2]
    turned_back = [[a, b, c], [a, b, z + 1], [a, b + 1, z + 1], [a - 1, b + 1, z + 1]]
    assert ends(text) == [[x + 1, y + 2, z + 3], [x + 1, y + 2, c], *turned_back]


def test_transformations_survive_a_work_offset_and_a_machine_block():
    """2.6, 2.7: G53 counts from the machine zero, turned and mirrored all the same; afterwards X stays."""
    x, y, z = DATUMS[1]
    text = "G54\nG51 Y0\nG39 A90\nG0 X3 Y2 Z1\nG53 X7 Y1\nZ5\nG53 Z0\nX0 Y0\n"
    expected = [[x + 2, y + 3, z + 1], [1, 7, z + 1], [1, 7, z + 5], [1, 7, 0], [x, y, 0]]
    assert ends(text) == np.round(expected, 9).tolist()


def test_g53_counts_absolutely_under_g91_and_leaves_g92_alone():
    text = "G54\nG92 X1 Y1 Z1\nG91\nG0 X4\nG53 X9\nX4\nG90\nX1 Y1 Z1\n"
    assert ends(text) == [[4, 0, 0], [9, 0, 0], [13, 0, 0], [0, 0, 0]]


def test_at_power_on_machine_coordinates_count():
    """2.6: until a work offset is selected or G92 is set; G91 stays G91 in that state."""
    assert ends("G0 X5\nG91\nX5\nG90\nX5\nG92 X0\nX1\n") == [[5, 0, 0], [10, 0, 0], [5, 0, 0], [6, 0, 0]]
    assert ends("G0 X5\nG54\nX5\n") == [[5, 0, 0], [36.5, 0, 0]]


def test_g92_under_a_transformation_gives_a_notice():
    """MNC-G92-XFORM: the values are programmed coordinates."""
    found = mnclab.run("G39 A90\nG0 X10 Y4\nG92 X0 Y0\nX2\nG38\nG92 X0\n", "mnc")
    assert [(a.severity, a.span.line) for a in found.alarms] == [("warning", 3)]
    assert found.toolpath.end[-1].tolist() == pytest.approx([-4, 12, 0])


def test_the_last_function_of_a_kind_counts():
    """A second G37, G39 or G51 replaces the first; the angle is not added (MNC-G39-ABSANGLE)."""
    text = "G37 X2 Y5\nG37 X3\nG51 Y9\nG51 X1\nG39 X5 A30\nG39 A90\nG0 X1 Y2\n"
    assert ends(text) == [[-2, -1, 0]]  # 3, 2 -> -1, 2 -> -2, -1


# --- radius compensation ---------------------------------------------------------------------------------------------

CONTOURS = json.loads(COMPENSATION.read_text(encoding="utf-8"))["records"]
FRAMES = {  # head, matrix, factor of the tool radius for which the compensated path is the image of the recorded one
    "mirror X": ("G51 X7.5", mirrored({0: 7.5}), 1),
    "mirror Y": ("G51 Y-3", mirrored({1: -3}), 1),
    "mirror X Y": ("G51 X1 Y2", mirrored({0: 1, 1: 2}), 1),
    "mirror Z": ("G51 Z4", mirrored({2: 4}), 1),
    "turned": ("G39 X10 Y-4 A35", turned("G17", (10, -4), 35), 1),
    "mirrored and turned": ("G39 X1 A-120 // \nG51 Y2", turned("G17", (1, 0), -120) @ mirrored({1: 2}), 1),
    "scaled": ("G37 X2 Y2 Z3", scaled((2, 2, 3)), 2),
    "scaled and mirrored": ("G37 X0.5 Y0.5\nG51 X6", mirrored({0: 6}) @ scaled((0.5, 0.5, 1)), 0.5),
}


@together(
    "frame record", product(FRAMES, CONTOURS),
    lambda frame, record: f"{frame}, {record['name'].rpartition('_')[0]}", lambda frame, record: record["name"],
    deep_but_one_in=8,
)  # fmt: skip
def test_a_compensated_contour_is_the_image_of_the_recorded_one(frame, record):
    """G41 of a mirrored contour is the mirror image of G41. The tool is not scaled: for the image take a scaled one."""
    head, matrix, factor = FRAMES[frame]
    text = f"{head}\n{record['mnc']}"
    found = mnclab.run(text, "mnc", Setup(tools={1: Tool(radius=record["radius"] * factor)}))
    assert found.ok == ("refused" not in record)
    if not found.ok:
        return
    moves, rows = record["motion"], found.toolpath.motion
    images = np.array([image(matrix, move["to"]) for move in moves])
    assert np.abs(rows.end + rows.origin - images).max() <= 1e-9 * factor
    over = np.linalg.det(matrix[:2, :2]) < 0
    for row, move in zip(rows, moves, strict=True):
        assert row.line == move["line"] + head.count("\n") + 1
        if row.kind == Kind.ARC:
            assert np.abs(row.centre + rows.origin - image(matrix, move["centre"])).max() <= 1e-9 * factor
            assert row.sweep * row.axis[2] == pytest.approx(move["sweep"] * (-1 if over else 1), abs=1e-9)
            assert row.side * row.axis[2] == (-1 if over else 1) * (1 if "G41" in record["mnc"] else -1)
