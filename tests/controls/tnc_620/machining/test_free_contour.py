"""Contours drawn first, described by part of what can be measured on them, and found again."""

import math
import time

import numpy as np
import pytest

from mnclab.controls.tnc_620.free_contours.free_contour import FreeContour, known, normal_of
from mnclab.controls.tnc_620.free_contours.quadratics import Exhausted, Form, System, conics
from mnclab.controls.tnc_620.free_contours.readings import Contradiction, TooManyReadings

START = (3.0, -2.0)


def draw(random, count):
    """Elements in a row: (tangent, start, end, centre, signed radius, heading at the start, sweep)."""
    at, heading, drawn = np.array(START), random.uniform(-math.pi, math.pi), []
    for k in range(count):
        tangent = k > 0 and random.random() < 0.5
        straight = random.random() < 0.5
        if tangent and straight and drawn[-1][3] is None:
            straight = False
        if not tangent:
            heading += random.uniform(0.5, 2.5) * random.choice([-1, 1])
        ahead = np.array([math.cos(heading), math.sin(heading)])
        if straight:
            end, centre, radius, sweep = at + random.uniform(10, 60) * ahead, None, 0.0, 0.0
        else:
            radius = random.uniform(5, 30) * random.choice([-1, 1])
            sweep = math.copysign(random.uniform(0.5, 4.5), radius)
            centre = at + radius * np.array([-ahead[1], ahead[0]])
            c, s = math.cos(sweep), math.sin(sweep)
            end = centre + np.array([[c, -s], [s, c]]) @ (at - centre)
        drawn.append((tangent, at, end, centre, radius, heading, sweep))
        at, heading = end, heading + sweep
    return drawn


def somewhere(random, element):
    """A point of an element, and the unit normal there."""
    _, start, end, centre, _, heading, sweep = element
    share = random.uniform(0.2, 0.8)
    n = np.array([-math.sin(heading + share * sweep), math.cos(heading + share * sweep)])
    if centre is None:
        return start + share * (end - start), n
    c, s = math.cos(share * sweep), math.sin(share * sweep)
    return centre + np.array([[c, -s], [s, c]]) @ (start - centre), n


def measured(random, element):
    """Everything that may be told of an element, in random order."""
    centre = element[3]
    point, _ = somewhere(random, element)
    off = random.uniform(2, 9) * random.choice([-1, 1])
    foot, n = somewhere(random, element)
    kinds = ["x", "y", "direction", "length", "ix", "iy", ("through", point), ("beside", foot + off * n, abs(off))]
    if centre is not None:
        kinds += ["radius", "radius", "cx", "cy", "angle"]
    order = random.permutation(len(kinds))
    return [kinds[i] for i in order]


def tell(contour, k, element, datum):
    """One datum of element k."""
    _, start, end, centre, radius, heading, sweep = element
    kind, *rest = datum if isinstance(datum, tuple) else (datum,)
    told = contour.elements[k]
    sign = int(np.sign(radius))
    if kind in ("x", "y"):
        contour.equal(getattr(told.end, kind) - end["xy".index(kind)], datum)
    elif kind in ("ix", "iy"):
        i = "xy".index(kind[1])
        contour.equal(getattr(told.end, kind[1]) - getattr(told.start, kind[1]) - (end - start)[i], datum)
    elif kind in ("cx", "cy"):
        contour.equal(getattr(told.centre, kind[1]) - centre["xy".index(kind[1])], datum)
    elif kind == "direction":
        contour.direction(k, normal_of(heading), datum)
    elif kind == "length":
        contour.length(k, math.dist(start, end), datum)
    elif kind == "radius":
        contour.radius(k, abs(radius), sign, datum)
    elif kind == "angle":
        contour.central_angle(k, abs(sweep), sign, datum)
    elif kind == "through":
        contour.through(k, known(*rest[0]), datum)
    else:
        contour.beside(k, known(*rest[0]), rest[1], datum)


def told(drawn, data, settle=True):
    """The chain with its data, element by element as a program tells them."""
    contour = FreeContour(START)
    for k, element in enumerate(drawn):
        contour.line(element[0]) if element[3] is None else contour.arc(element[0])
        if element[3] is not None:
            contour.sense(k, int(np.sign(element[4])), "sense")
        for datum in data[k]:
            tell(contour, k, element, datum)
        if settle:
            contour.follow()
    return contour


def lacking(contour):
    """How many data are missing in the reading that lacks most."""
    return max(contour.missing(reading) for reading in contour.readings)


def enough(random, drawn):
    """As many random data as there are degrees of freedom, and more one by one while something is open."""
    free = [(1 if element[3] is None else 2) + (not element[0]) for element in drawn]
    pools = [[(k, datum) for datum in measured(random, element)] for k, element in enumerate(drawn)]
    if random.random() < 0.5:  # each element has its own
        pool = [item for k, items in enumerate(pools) for item in items[: free[k]]]
        pool += [item for k, items in enumerate(pools) for item in items[free[k] :]]
    else:
        pool = [item for items in pools for item in items]
        pool = [pool[i] for i in random.permutation(len(pool))]
    data = [[] for _ in drawn]
    for count, (k, datum) in enumerate(pool, 1):
        data[k].append(datum)
        if count >= sum(free) and not lacking(told(drawn, data, settle=False)):
            break
    return data


def distance(contour, reading, drawn):
    """The greatest distance of a reading's joints and centres from those that were drawn."""
    found = 0.0
    for piece, (_, _, end, centre, radius, _, _) in zip(contour.pieces(reading), drawn, strict=True):
        found = max(found, math.dist(piece.end, end))
        if centre is not None:
            found = max(found, math.dist(piece.centre, centre))
            assert piece.sense == np.sign(radius)
    return found


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(60))
def test_a_drawn_contour_is_found_again(seed):
    random = np.random.default_rng(seed)
    drawn = draw(random, int(random.integers(1, 4)))
    contour = told(drawn, enough(random, drawn))
    contour.follow(thoroughly=True)
    assert not any(contour.open_unknowns(reading) for reading in contour.readings)
    assert min(distance(contour, reading, drawn) for reading in contour.readings) < 1e-9


def test_a_contradiction_names_the_datum():
    contour = FreeContour((0, 0))
    contour.line()
    contour.same(contour.end(), known(30, 40), "end")
    contour.length(0, 51, "length")
    with pytest.raises(Contradiction) as found:
        contour.follow()
    assert found.value.label == "length"


def test_what_is_missing_is_counted():
    contour = FreeContour((0, 0))
    contour.line()
    contour.arc(tangent=True)  # its end and its radius
    contour.direction(0, normal_of(0.3), "direction")
    contour.follow()
    assert contour.missing(contour.readings[0]) == 3  # the length of the line too


def test_two_conics_meet_in_four_points():
    # x²/25 + y² = 1 and x² + y²/25 = 1 meet where x² = y² = 25/26
    flat, tall = np.diag([1 / 25, 1.0]), np.diag([1.0, 1 / 25])
    found = conics((flat, np.zeros(2), -1.0), (tall, np.zeros(2), -1.0))
    assert np.abs(found) == pytest.approx(math.sqrt(25 / 26), abs=1e-12)
    assert {tuple(np.sign(point)) for point in found} == {(1, 1), (1, -1), (-1, 1), (-1, -1)}
    assert conics((flat, np.zeros(2), -1.0), (flat, np.zeros(2), -1.0)) is None


def test_the_circles_of_apollonius():
    # circles of radius ρ that touch three of radius 1 about the corners of an equilateral triangle of side 4 from the
    # same side: about its middle, 4/√3 from the corners, so that |ρ - 1| = 4/√3
    x, y, r = (Form(0.0, {i: 1.0}) for i in range(3))
    corners = [(0.0, 0.0), (4.0, 0.0), (2.0, 2 * math.sqrt(3))]
    forms = [(x - a) * (x - a) + (y - b) * (y - b) - (r - 1.0) * (r - 1.0) for a, b in corners]
    found = System(forms, [0, 1, 2], np.full(3, np.nan), [1, 1, 1], 4.0).solve()
    assert sorted(value[2] for value in found) == pytest.approx([1 - 4 / math.sqrt(3), 1 + 4 / math.sqrt(3)])
    assert np.array(found)[:, :2] == pytest.approx(np.array([(2, 2 / math.sqrt(3))] * 2))


def test_a_circle_touched_within_the_precision_of_drawings_is_touched():
    for gap, count in ((0.0005, 1), (0.01, 0), (-0.01, 2)):
        x, y = (Form(0.0, {i: 1.0}) for i in range(2))
        forms = [x * x + y * y - 100.0, y - 10 - gap]
        assert len(System(forms, [0, 1], np.full(2, np.nan), [1, 1], 10.0).solve()) == count


def chain(elements):
    """Elements one after the other as a program tells them: "l" and "a", capital where they join tangentially."""
    contour = FreeContour((0, 0), heading=0.0)
    for letter in elements:
        k = contour.arc(letter.isupper()) if letter in "aA" else contour.line(letter.isupper())
        if letter == "A":
            contour.radius(k, 7.0, 0, "radius")
        contour.follow()
    return contour


UNFINISHED = ["aL" * 6, "AL" * 6, "AAAAAA", "aAAAaL", "lA" * 4, "A" * 3, "l" * 12, "aAlAaLAa"]


@pytest.mark.deep
@pytest.mark.parametrize("elements", UNFINISHED)
def test_a_contour_that_is_not_finished_is_given_up_soon_and_without_threads(elements):
    contour = chain("l")
    contour.follow(thoroughly=True)  # what is loaded once
    all_threads, mine = time.process_time(), time.thread_time()
    contour = chain(elements)
    contour.follow(thoroughly=True)
    mine, all_threads = time.thread_time() - mine, time.process_time() - all_threads
    assert contour.missing(contour.readings[0]) > 0
    assert contour.work.left > 0  # some steps of the search are left: tens of milliseconds; it was up to a minute
    assert all_threads - mine < 0.5 * mine + 0.1


@pytest.mark.deep
def test_the_search_is_bounded():
    contour = FreeContour((0, 0))
    with pytest.raises(TooManyReadings):
        for k in range(1, 12):  # each pair of lines bends to the left or to the right
            for length in (30, 40):
                contour.length(contour.line(), length, "length")
            contour.same(contour.end(), known(50 * k, 0), "end")
            contour.follow()
    contour = FreeContour((0, 0))
    for _ in range(3):
        contour.arc(tangent=bool(contour.elements))
    contour.work.left = 1000.0
    with pytest.raises(Exhausted):
        contour.follow(thoroughly=True)
    assert contour.open_unknowns(contour.readings[0]) and contour.missing(contour.readings[0]) == 7


def test_a_long_contour_of_known_elements_is_followed_to_its_end():
    contour = FreeContour((0, 0))
    for k in range(1, 400):
        contour.line()
        contour.same(contour.end(), known(k, k % 7), "end")
        contour.follow()
    contour.follow(thoroughly=True)
    assert len(contour.readings) == 1 and not contour.open_unknowns(contour.readings[0])
