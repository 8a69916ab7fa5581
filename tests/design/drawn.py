"""Views as they come: plates and shafts with dimensions of all kinds, for the drawing to be tried on."""

import math
import random

from shapely import Polygon, STRtree

from mnclab.design.drawing.view import (
    Angle,
    Axis,
    Cross,
    Cut,
    Diameter,
    Kind,
    Linear,
    Note,
    Radius,
    View,
    ViewLine,
    thread_circle,
    value,
)
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region

TOUCH = 0.02  # mm²: what rounding makes of boxes that touch


def covering(boxes):
    """Pairs of boxes of a drawing that cover a part of each other."""
    areas = [Polygon(box.corners) for box in boxes]
    for i, k in zip(*STRtree(areas).query(areas, predicate="intersects"), strict=True):
        if i < k and areas[i].intersection(areas[k]).area >= TOUCH:
            yield boxes[i], boxes[k]


ROUND = math.tan(math.pi / 8)


def rectangle(x0, y0, x1, y1, r=0.0):
    if not r:
        return Contour([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
    points = [(x0 + r, y0), (x1 - r, y0), (x1, y0 + r), (x1, y1 - r), (x1 - r, y1), (x0 + r, y1), (x0, y1 - r), (x0, y0 + r)]
    return Contour(points, [0, ROUND] * 4)


def tolerance(some):
    return some.choice([None, None, None, 0.1, 0.05, (-0.05, 0.1), (0, 0.021), "H7", "h6"])


def plate(seed, holes=None):
    """Views of a plate with a pocket and holes; each hole has three dimensions."""
    some = random.Random(seed)
    size = some.choice([25, 60, 110, 250, 600])
    wide, high, thick = (round(size * some.uniform(*span), some.choice([0, 1])) for span in ((0.7, 1), (0.4, 0.9), (0.1, 0.4)))
    lines, axes, dims = [ViewLine(rectangle(0, 0, wide, high))], [], []
    dims += [Linear((0, 0), (wide, 0), value(wide)), Linear((0, 0), (0, high), value(high, tolerance=tolerance(some)), "y")]
    x0, y0 = (round(some.uniform(0.2, 0.4) * side, 1) for side in (wide, high))
    x1, y1 = (round(some.uniform(0.6, 0.8) * side, 1) for side in (wide, high))
    r = round(0.2 * min(x1 - x0, y1 - y0), 1)
    lines.append(ViewLine(rectangle(x0, y0, x1, y1, r)))
    dims += [Linear((x0, y0), (x1, y0), value(x1 - x0, tolerance=tolerance(some))), Linear((0, 0), (x0, y0), value(x0))]
    dims += [Linear((x1, y0), (x1, y1), value(y1 - y0), "y"), Linear((x1, 0), (x1, y0), value(y0), "y")]
    dims.append(Radius((x1 - r, y1 - r), r, 0, math.pi / 2, value(r, "4× R")))
    for _ in range(some.randint(0, 6) if holes is None else holes):
        x, y = round(some.uniform(0.08, 0.92) * wide, 1), round(some.choice([0.1, 0.9]) * high, 1)
        d = round(some.uniform(0.03, 0.1) * min(wide, high), 1)
        lines.append(ViewLine(Contour.circle((x, y), d / 2)))
        axes.append(Cross((x, y), d / 2))
        if some.random() < 0.3:
            lines.append(thread_circle((x, y), d / 2 * 1.2))
            dims.append(Note((x, y), (f"M{d:g} ↧12", f"⌀{d:g} ↧16"), d / 2 * 1.2))
        else:
            more = ("⌴ ⌀11 ↧6.4",) if some.random() < 0.4 else ()
            dims.append(Diameter((x, y), d / 2, value(d, "⌀", tolerance(some)), more))
        dims += [Linear((0, 0), (x, y), value(x, tolerance=tolerance(some))), Linear((0, 0), (x, y), value(y), "y")]
    if some.random() < 0.5:
        dims.append(Note((wide, high), ("1×45°",)))
    cuts = (Cut(((0, high / 2), (wide, high / 2)), "A", (0, 1)),) if some.random() < 0.6 else ()
    plan = View("from above", tuple(lines), (), tuple(dims), tuple(axes), cuts, cell=(0, 1))
    depth = round(thick * 0.6, 1)
    floor = [(x1, thick), (x1, thick - depth), (x0, thick - depth), (x0, thick)]
    cut = Region.of(Contour([(0, 0), (wide, 0), (wide, thick), *floor, (0, thick)]))
    step = Contour(floor, closed=False)
    front_dims = [Linear((0, 0), (0, thick), value(thick), "y"), Linear((x1, thick - depth), (x1, thick), value(depth), "y")]
    front = View(
        "A–A", (ViewLine(rectangle(0, 0, wide, thick)), ViewLine(step)), (cut,) if cuts else (), tuple(front_dims),
        title="A–A" if cuts else "",
    )  # fmt: skip
    views = [plan, front]
    if some.random() < 0.4:
        inner = Contour([(y0, thick), (y0, thick - depth), (y1, thick - depth), (y1, thick)], closed=False)
        views.append(View("left", (ViewLine(rectangle(0, 0, high, thick)), ViewLine(inner, Kind.HIDDEN)), cell=(1, 0)))
    return views


def shaft(seed):
    """A turned part: steps with diameters and lengths, a taper with its angle, chamfers."""
    some = random.Random(seed)
    count = some.randint(2, 7)
    z, steps = 0.0, []
    for _ in range(count):
        length, diameter = round(some.uniform(4, 40), 1), round(some.uniform(8, 60), 1)
        steps.append((z, z + length, diameter))
        z = round(z + length, 1)
    upper = [(z0, 0.5 * d) for a, b, d in steps for z0 in (a, b)]
    outline = Contour([(0, 0), *upper, (z, 0)] + [(x, -y) for x, y in reversed(upper)])
    lines = [ViewLine(outline)]
    dims = [Linear((0, 0), (z, 0), value(z))]
    for k, (a, b, d) in enumerate(steps):
        if k < count - 1:
            start = 0.0 if some.random() < 0.5 else a
            if start != 0.0 or k == 0:
                length = value(b - a, tolerance=tolerance(some))
                dims.append(Linear((a, -d / 2), (b, -d / 2), length, side=some.choice(["", "below"])))
            else:
                dims.append(Linear((0, -steps[0][2] / 2), (b, -d / 2), value(b)))
        lines.append(ViewLine(Contour([(b, -d / 2), (b, d / 2)], closed=False)))
        dims.append(Linear((a, -d / 2), (b, d / 2), value(d, "⌀", tolerance(some)), "y", inside=True))
        if some.random() < 0.3:
            dims.append(Note((b, d / 2), ("1×45°",)))
    cone = round(some.uniform(5, 15), 1)
    way = 10 * math.tan(math.radians(cone))
    lines.append(ViewLine(Contour([(z, -5), (z + 10, -5 + way), (z + 10, 5 - way), (z, 5)], closed=False)))
    z_near = (5 - way) / math.sin(math.radians(cone))
    dims.append(Angle((z + 5 / math.tan(math.radians(cone)), 0), (z, 5), (z, -5), value(2 * cone, after="°"), z_near))
    return [View("front", tuple(lines), (), tuple(dims), (Axis((0, 0), (z + 10, 0)),))]
