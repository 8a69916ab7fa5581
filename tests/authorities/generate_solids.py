"""What solids of `manifold3d` leave of a blank, for the programs of `solid_programs.py`: writes solids.json.

    python -m venv … && pip install numpy manifold3d        (3.5, Apache-2.0; outside the repository)
    python tests/authorities/generate_solids.py             (some minutes)

A tool is a convex body of facets, turned about its axis and high enough to stand out of the blank. Along a straight move it
sweeps the convex hull of both its ends; an arc is a chain of chords. All hulls are taken away from the blank together.
Circles are polygons of the same area. Everything is done twice, once with half as many corners and chords: `removed` (mm³)
is the finer answer, `coarse` the other, so a third of what lies between them is about how far the finer one is off.
`heights`: places x, y and the height of the material, by rays that start above; only where rays beside them agree.
"""

import json
import math
import random
from importlib.metadata import version
from pathlib import Path

import numpy as np
from manifold3d import Manifold, OpType
from solid_programs import STOCK, programs, record_of

TOP = 60.0  # mm, how high tools reach
FILE = Path(__file__).with_name("solids.json")
RAY, SPREAD, PLACES = 30.0, 0.03, 12


def body(sizes, corners):
    """A tool with its tip at the origin, as points (n, 3) of its convex hull."""
    radius, corner = sizes["radius"], sizes.get("corner", 0.0)
    profile = [(radius, TOP)]
    if sizes["kind"] in ("drill", "countersink", "chamfer"):
        rise = radius / math.tan(math.radians(sizes["angle"] / 2))
        profile += [(radius, rise), (0.0, 0.0)]
    else:
        rounds = corners // 4 if corner else 1
        angles = np.linspace(0, math.pi / 2, rounds + 1) if corner else [math.pi / 2]
        outer = corner * bulge(angles[1]) if corner else 0.0
        profile += [(radius - corner + outer * math.cos(a), corner - outer * math.sin(a)) for a in angles]
        if corner < radius:
            profile += [(radius - corner, corner - outer)]
    around = 2 * math.pi * np.arange(corners) / corners
    ring = bulge(around[1]) * np.stack([np.cos(around), np.sin(around)], axis=1)
    return np.concatenate([np.column_stack([rho * ring, np.full(corners, z)]) for rho, z in profile])


def bulge(step):
    """By how much the corners of a polygon, so many rad apart, lie outside the circle of the same area."""
    return math.sqrt(step / math.sin(step))


def ways(move, corners):
    """The straight pieces of a move: pairs of points."""
    if "line" in move:
        return [move["line"]]
    arc = move["arc"]
    first, second, third = arc["axes"]
    start, centre = np.array(arc["start"]), np.array(arc["centre"])
    u, v = start[first] - centre[first], start[second] - centre[second]
    angle = np.linspace(0, arc["turn"], max(int(abs(arc["turn"]) / (2 * math.pi) * corners), 8) + 1)
    out = bulge(abs(angle[1]))
    places = np.tile(start, (len(angle), 1))
    places[:, first] = centre[first] + out * (u * np.cos(angle) - v * np.sin(angle))
    places[:, second] = centre[second] + out * (u * np.sin(angle) + v * np.cos(angle))
    places[:, third] = start[third] + arc["rise"] * np.linspace(0, 1, len(angle))
    return list(zip(places[:-1], places[1:]))


def swept(program, corners):
    """The blank and what is left of it."""
    bodies = {number: body(sizes, corners) for number, sizes in program.tools.items()}
    low, high = np.array(STOCK)
    blank = Manifold.cube((high - low).tolist()).translate(low.tolist())
    hulls = []
    for move in program.moves:
        for start, end in ways(move, corners):
            if min(start[2], end[2]) >= high[2]:
                continue
            tool = bodies[move["tool"]]
            ends = np.concatenate([tool + np.array(start), tool + np.array(end)])
            hulls.append(Manifold.hull_points(ends))
    left = blank - Manifold.batch_boolean(hulls, OpType.Add)
    return blank, left


def height(left, x, y):
    """Where a ray from above meets the material; the lower side of the blank where it meets none."""
    hits = left.ray_cast((x, y, RAY), (x, y, -RAY))
    return RAY - 2 * RAY * hits[0].distance if hits else STOCK[0][2]


def heights(left, rng):
    """Places x, y, z away from walls."""
    found = []
    while len(found) < PLACES:
        x, y = round(rng.uniform(1, 59), 2), round(rng.uniform(1, 49), 2)
        here = height(left, x, y)
        around = [height(left, x + dx, y + dy) for dx in (-SPREAD, SPREAD) for dy in (-SPREAD, SPREAD)]
        cut = here < -1e-6
        if max(abs(z - here) for z in around) < 4 * SPREAD and (cut or rng.random() < 0.1):
            found.append([x, y, round(here, 5)])
    return found


def main():
    rng, records = random.Random(7), []
    for program in programs():
        fine = 96 if any("arc" in move for move in program.moves) else 128
        answers = {}
        for corners in (fine // 2, fine):
            blank, left = swept(program, corners)
            answers[corners] = blank.volume() - left.volume()
        removed, coarse = answers[fine], answers[fine // 2]
        print(f"{program.name:16} {removed:12.3f} mm³, {100 * (coarse / removed - 1):+.4f} % if coarser", flush=True)
        record = {"removed": round(removed, 4), "coarse": round(coarse, 4), "heights": heights(left, rng)}
        records.append(record_of(program) | record)
    FILE.write_text(json.dumps({"authority": f"manifold3d {version('manifold3d')}", "programs": records}, indent=1) + "\n")


if __name__ == "__main__":
    main()
