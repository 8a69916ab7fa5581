"""Where the balls of `opencamlib` stop on bodies of triangles: writes meshes.json.

    python -m venv … && pip install opencamlib               (2023.1.11, LGPL-2.1; outside the repository)
    python tests/authorities/generate_meshes.py              (a second)

A ball cutter is dropped from above, and pushed along X. It is a ball below a shaft of the same radius; the bodies do not
overhang, so the ball is what touches. `bodies`: triangles, corners in 1/64 mm, so that files hold them exactly. `drops`:
body, radius, x, y, and the height of the middle of the ball, null where it meets nothing. `pushes`: body, radius, y and
height of the middle, from where it is pushed, and the x at which it stops.
"""

import json
import math
import random
from pathlib import Path

import opencamlib as ocl

FILE = Path(__file__).with_name("meshes.json")
FAR = 100.0


def exact(point):
    """A place whose coordinates single precision holds."""
    return [round(64 * c) / 64 for c in point]


def tower(rings, low):
    """Closed triangles of rings of corners one above the other, from the widest one; the last one may be a tip."""
    rings = [[exact(p) for p in ring] for ring in rings]
    n, found = len(rings[0]), []
    base = [[x, y, low] for x, y, _ in rings[0]]
    middle = exact([sum(p[0] for p in base) / n, sum(p[1] for p in base) / n, low])
    found += [[middle, base[(k + 1) % n], base[k]] for k in range(n)]
    for lower, upper in zip([base, *rings], rings):
        for k in range(n):
            a, b, c, d = lower[k], lower[(k + 1) % n], upper[(k + 1) % n], upper[k]
            found += [t for t in ([a, b, c], [a, c, d]) if len({tuple(p) for p in t}) == 3]
    top = rings[-1]
    middle = exact([sum(p[0] for p in top) / n, sum(p[1] for p in top) / n, top[0][2]])
    if len({tuple(p) for p in top}) > 1:
        found += [[top[k], top[(k + 1) % n], middle] for k in range(n)]
    return found


def ring(radius, z, corners, turned=0.0, flat=1.0):
    """Corners of a polygon at a height."""
    angles = [math.tau * k / corners + turned for k in range(corners)]
    return [(radius * math.cos(a), flat * radius * math.sin(a), z) for a in angles]


BODIES = {
    "block": tower([ring(20, 10, 4, math.pi / 4)], -10),
    "pyramid": tower([ring(20, 0, 4, 0.3), ring(0, 15, 4)], -5),
    "stairs": tower([ring(24, 0, 6), ring(16, 0, 6), ring(16, 8, 6), ring(8, 8, 6), ring(8, 14, 6)], -6),
    "dome": tower([ring(20 * math.cos(a), 20 * math.sin(a), 24, 0.1) for a in (k * math.pi / 16 for k in range(8))], -4),
    "hull": tower([ring(22, 0, 7, 0.2, 0.6), ring(15, 6, 7, 0.25, 0.7), ring(5, 11, 7, 0.3)], -8),
}


def main():
    rng, drops, pushes = random.Random(19), [], []
    for name, triangles in BODIES.items():
        surface = ocl.STLSurf()
        for corners in triangles:
            surface.addTriangle(ocl.Triangle(*(ocl.Point(*p) for p in corners)))
        for radius in (0.5, 1.5, 3.0, 6.0):
            cutter = ocl.BallCutter(2 * radius, FAR)
            drop, push = ocl.BatchDropCutter(), ocl.BatchPushCutter()
            push.setXDirection()
            for each in (drop, push):
                each.setSTL(surface)
                each.setCutter(cutter)
            for _ in range(15):
                drop.appendPoint(ocl.CLPoint(*(round(rng.uniform(-21, 21), 3) for _ in range(2)), -FAR))
                y, z = round(rng.uniform(-18, 18), 3), round(rng.uniform(-2, 16), 3)
                push.appendFiber(ocl.Fiber(ocl.Point(-FAR, y, z - radius), ocl.Point(FAR, y, z - radius)))
            drop.run()
            push.run()
            drops += [[name, radius, p.x, p.y, None if p.z <= -FAR else round(p.z + radius, 8)] for p in drop.getCLPoints()]
            for fiber in push.getFibers():
                met = fiber.getInts()
                at = round(-FAR + 2 * FAR * min(each.lower for each in met), 8) if met else None
                pushes.append([name, radius, fiber.p1.y, round(fiber.p1.z + radius, 3), -FAR, at])
    record = {"authority": f"opencamlib {ocl.version()}", "bodies": BODIES, "drops": drops, "pushes": pushes}
    FILE.write_text(json.dumps(record) + "\n")


if __name__ == "__main__":
    main()
