"""Random turned designs whose volume is known by hand: cylinders, frustums, and by Pappus what rounds and breaks corners."""

import math
import random

from mnclab.design.model import Bore, CentreHole, FaceGroove, RingGroove, Thread, TurnedDesign
from mnclab.workpiece.blank import cylinder

OFF = (10 - 3 * math.pi) / (3 * (4 - math.pi))  # from the corner to the middle of what a rounding leaves or takes, radius 1


def frustum(a, b, h):
    return math.pi * h * (a * a + a * b + b * b) / 3


def ring(outer, inner, width):
    return math.pi * (outer**2 - inner**2) * width


def spandrel(size, radius):
    """Between a rounding and its corner, at a radius of the corner; `radius` grows by the size if the corner is hollow."""
    return 2 * math.pi * size**2 * (1 - math.pi / 4) * radius


def rounded(r, size, hollow):
    """What a rounding of a right corner at radius r adds (hollow) or takes (negative)."""
    return spandrel(size, r + OFF * size) if hollow else -spandrel(size, r - OFF * size)


def chamfered(r, width, height, hollow):
    """The same of a chamfer, `width` along the axis and `height` across it."""
    area = math.pi * width * height  # 2 π times half of it
    return area * (r + height / 3) if hollow else -area * (r - height / 3)


def shaft(seed):
    """A random design and its volume: steps that grow to the back, a bore from the front, grooves, a centre hole at the back."""
    rnd = random.Random(seed)
    z, r = round(rnd.uniform(-5, 5), 2), round(rnd.uniform(12, 16), 2)
    points, roundings, chamfers, volume, steps = [(z, r)], {}, {}, 0.0, []
    high = z
    if rnd.random() < 0.6:
        width, angle = round(rnd.uniform(0.5, 2), 2), rnd.choice([None, 30])
        chamfers[0] = width if angle is None else (width, angle)
        volume += chamfered(r, width, width if angle is None else width * math.tan(math.radians(angle)), False)
    tapers = [False, *(rnd.random() < 0.3 for _ in range(rnd.randint(1, 3)))]  # they end in the shoulder of the next step
    for taper, next_one in zip(tapers, [*tapers[1:], False]):
        length = round(rnd.uniform(18, 30), 2)
        if taper:
            wider = round(r + rnd.uniform(0.5, 2), 2)
            volume += frustum(r, wider, length)
        else:
            wider = r
            volume += math.pi * r * r * length
            steps.append((z, r))
        z = round(z - length, 2)
        points.append((z, wider))
        rise = round(rnd.uniform(4, 6), 2)
        size, r = round(rnd.uniform(0.4, 1.5), 2), round(wider + rise, 2)
        if not taper and rnd.random() < 0.6:
            roundings[len(points) - 1] = size
            volume += rounded(wider, size, True)
        if not next_one and rnd.random() < 0.6:
            roundings[len(points)] = size
            volume += rounded(r, size, False)
        points.append((z, r))
    length = round(rnd.uniform(10, 20), 2)
    volume += math.pi * r * r * length
    low = round(z - length, 2)
    points.append((low, r))
    features, bore, deep = [], 0.0, high
    if rnd.random() < 0.7:
        bore, depth = round(rnd.uniform(2, 5), 2), round(rnd.uniform(8, 25), 2)
        point, mouth = rnd.choice([118.0, 90.0, 180.0]), round(rnd.choice([0, 0.5, 1]), 2)
        features.append(Bore(2 * bore, depth, point, chamfer=mouth))
        tip = 0 if point == 180 else bore / math.tan(math.radians(point / 2))
        volume -= math.pi * bore**2 * (depth + tip / 3) + math.pi * mouth**2 * (bore + mouth / 3)
        deep = high - depth
        if rnd.random() < 0.5:
            wide, out, place = 2.0, round(rnd.uniform(0.5, 1.5), 2), high - 4.5
            features.append(RingGroove(place, wide, depth=out, inside=True))
            volume -= ring(bore + out, bore, wide)
    for start, radius in steps:
        if rnd.random() < 0.6:
            width, depth = round(rnd.uniform(2, 4), 2), round(rnd.uniform(1, 3), 2)
            corner = round(rnd.choice([0, 0.3, 0.5]), 2)
            bottom = radius - depth
            how = {"depth": depth} if rnd.random() < 0.5 else {"diameter": 2 * bottom}
            features.append(RingGroove(start - 8, width, **how, corner=corner))
            volume -= ring(radius, bottom, width) - 2 * rounded(bottom, corner, True)
    if rnd.random() < 0.5:
        inner, wide, depth, corner = 15.0, 4.0, 3.0, rnd.choice([0, 0.5])
        features.append(FaceGroove(2 * inner, 2 * (inner + wide), depth, from_end="back", corner=corner))
        filled = rounded(inner, corner, True) - rounded(inner + wide, corner, False)
        volume -= ring(inner + wide, inner, depth) - filled
    if rnd.random() < 0.5:
        features.append(CentreHole(2.5, from_end="back"))
        sunk = (5.3 - 2.5) / 2 / math.tan(math.radians(30))
        volume -= frustum(2.65, 1.25, sunk) + math.pi * 1.25**2 * (4.6 - sunk + 1.25 / math.tan(math.radians(59)) / 3)
    if rnd.random() < 0.3:
        start, radius = steps[0]
        features.append(Thread(f"M{2 * radius:g}x1.5", start, start - 7.5))
    tolerances = {"diameter 1": rnd.choice(["h6", 0.1, (-0.2, 0.05)])} if rnd.random() < 0.5 else {}
    more = {"blank": cylinder(r + 2, low - 30, high + 1), "material": "C45"} if rnd.random() < 0.5 else {}
    design = TurnedDesign(
        points, features, roundings=roundings, chamfers=chamfers, tolerances=tolerances, title=f"shaft {seed}", **more
    )
    return design, volume, deep
