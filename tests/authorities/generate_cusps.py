"""Random contours that turn back on themselves, with LinuxCNC's tool-centre path: writes cusps.json.gz.

    python3 tests/authorities/generate_cusps.py

A joint turns by 170 to 180 degrees: bumps and walls that touch, spikes, hooks whose barb is shorter than the tool is wide.
None is chosen by what LinuxCNC says to it; it looks at the next element only and takes many a joint for an outside corner
that none is, so `clear` says whether its path keeps the tool out of the whole contour. The records are those of
generate_contours.py; `elements` are start, end, centre and turn of every element besides, mm.
"""

import math
import random
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

from contours import UNIT, VECTORS, Element, angle_between, direction, line_to, moved, tangent_arc, tangent_line, turned
from generate_compensation import Program
from generate_contours import record, write
from recording import TICKS, mm
from shapes import at

SEED = 20261122
EACH = 200
RADII = [1, 2, 3, 4, 2.5, 3.175]


def nearly_back(rng, along):
    """A vector of length 325 that leads back, exactly or by up to ten degrees beside it."""
    back = moved((0, 0), along, -1)
    near = [v for v in VECTORS if 0 < abs(angle_between(back, v)) < math.radians(10)]
    return back if rng.random() < 0.5 or not near else rng.choice(near)


def run_up(rng, along):
    """What leads to the joint at the origin: a line or an arc that arrives along a vector."""
    back = moved((0, 0), along, -1)
    piece = (
        tangent_line((0, 0), back, rng.uniform(5, 30))
        if rng.random() < 0.5
        else tangent_arc(rng, (0, 0), back, rng.uniform(4, 25), rng.choice([1, -1]), most=3.1)
    )
    return Element(piece.end, piece.start, piece.centre, -piece.turn)


def run_off(rng, along, arc=None):
    """What leads away from the origin along a vector: a line or an arc."""
    if not (rng.random() < 0.5 if arc is None else arc):
        return tangent_line((0, 0), along, rng.uniform(5, 30))
    return tangent_arc(rng, (0, 0), along, rng.uniform(4, 25), rng.choice([1, -1]), most=3.1)


def walls(rng, element, share):
    """Sometimes one more line before (share 0) or after (1) an element, to any side."""
    if rng.random() < 0.5:
        return []
    here = element.end if share else element.start
    x, y = element.tangent(share)
    angle = math.atan2(y, x) + rng.uniform(-2.4, 2.4)
    there = moved(here, at(rng.uniform(8, 30), angle), 1 if share else -1)
    return [line_to(here, there) if share else line_to(there, here)]


def cusp(rng, side, radius):
    """Two elements, one an arc at least, whose joint turns back."""
    along = rng.choice(VECTORS)
    first = run_up(rng, along)
    second = run_off(rng, nearly_back(rng, along), None if first.turn else True)
    return [*walls(rng, first, 0), first, second, *walls(rng, second, 1)]


def bumps(rng, side, radius):
    """Bumps on the side of the tool, or one and a wall, side by side: the tool goes down to where it touches both."""
    along = rng.choice(VECTORS)
    first, second = run_up(rng, along), run_off(rng, moved((0, 0), along, -1))
    sizes = [rng.uniform(1.2 * radius, 25), rng.uniform(1.2 * radius, 25)]
    if rng.random() < 0.7 or not second.turn:
        arc = tangent_arc(rng, (0, 0), moved((0, 0), along, -1), sizes[0], side, least=1.2, most=3.1)
        first = Element(arc.end, arc.start, arc.centre, -side)
    if rng.random() < 0.7:
        second = tangent_arc(rng, (0, 0), moved((0, 0), along, -1), sizes[1], -side, least=1.2, most=3.1)
    return [*walls(rng, first, 0), first, second, *walls(rng, second, 1)]


def spike(rng, side, radius):
    """There and back by lines, exactly or nearly, and on."""
    length, angle = rng.uniform(4, 30), math.radians(rng.choice([0, 0, rng.uniform(-10, 10), rng.uniform(-0.1, 0.1)]))
    first = line_to((-mm(length), 0), (0, 0))
    second = line_to((0, 0), at(rng.uniform(4, 30), math.pi + angle, 1))
    return [*walls(rng, first, 0), first, second, *walls(rng, second, 1)]


def hook(rng, side, radius):
    """After the joint a piece shorter than the tool is wide, then on in any direction."""
    along = rng.choice(VECTORS)
    first, barb = run_up(rng, along), rng.uniform(0.1, 1.9) * radius
    second = tangent_line((0, 0), nearly_back(rng, along), max(barb, 0.1))
    step = moved((0, 0), direction(second, 1) or (UNIT, 0), 1)
    goes = rng.choice([step, turned(step), moved((0, 0), turned(step), -1), rng.choice(VECTORS)])
    third = run_off(rng, goes)
    third = Element(*[moved(p, second.end) if p else None for p in third[:3]], third.turn)
    contour = [*walls(rng, first, 0), first, second, third]
    if rng.random() < 0.5:  # the barb first
        contour = [Element(e.end, e.start, e.centre, -e.turn) for e in reversed(contour)]
    return contour


FAMILIES = {"cusp": cusp, "bumps": bumps, "spike": spike, "hook": hook}


def programs(rng):
    """Random programs, family by family."""
    for family, contour_of in FAMILIES.items():
        count = EACH + 100 * (family in ("cusp", "bumps"))
        while count:
            side, radius = rng.choice([1, -1]), rng.choice(RADII)
            contour = contour_of(rng, side, radius)
            if any(math.dist(e.start, e.end) < 0.05 * TICKS for e in contour):
                continue
            count -= 1
            yield family, Program(rng, contour, radius, side)


def cusp_record(named):
    """What LinuxCNC says to a program, and its elements."""
    elements = [
        [*(v / TICKS for v in (*e.start, *e.end)), *([*(v / TICKS for v in e.centre), e.turn] if e.turn else [])]
        for e in named[1].contour
    ]
    return record(named) | {"side": named[1].side, "elements": elements}


def main():
    with ThreadPoolExecutor(2) as pool:
        records = list(pool.map(cusp_record, programs(random.Random(SEED))))
    tally = Counter(
        (r["family"], r.get("refused", "clear" if r.get("clear") else "meets the contour")) for r in records
    )
    for (family, answer), count in sorted(tally.items()):
        print(f"{count:5} {family:10} {answer}")
    write("cusps.json.gz", SEED, records)


if __name__ == "__main__":
    main()
