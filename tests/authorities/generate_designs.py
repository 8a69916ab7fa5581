"""What solids of `manifold3d` say of designs: writes designs.json.

    python -m venv … && pip install numpy manifold3d        (3.5, Apache-2.0; outside the repository)
    python tests/authorities/generate_designs.py            (a minute)

Every design is written as its file (TOML) and made of solids at the same time: prisms, hulls and cones of facets, whose
polygons have the area of their circles. All is done twice, once with half as many corners: `volume` (mm³) is the finer
answer, `coarse` the other, so a third of what lies between them is about how far the finer one is off.
"""

import json
import math
import random
from importlib.metadata import version
from pathlib import Path

import numpy as np
from manifold3d import CrossSection, Manifold, OpType

FILE = Path(__file__).with_name("designs.json")
LENGTH, WIDTH, HEIGHT = 100.0, 60.0, 20.0
ABOVE = 30.0
COUNT, FINE = 120, 256


class Solids:
    """Bodies with circles of so many corners."""

    def __init__(self, corners):
        self.corners = corners

    def circle(self, x, y, radius):
        step = 2 * math.pi / self.corners
        around = step * (np.arange(self.corners) + 0.5)
        out = radius * math.sqrt(step / math.sin(step))
        return np.stack([x + out * np.cos(around), y + out * np.sin(around)], axis=1)

    def rectangle(self, x, y, length, width, corner=0.0, turned=0.0):
        """Its corners, each rounded by a polygon of the area of its quarter; where it begins and ends it is on the circle."""
        a, b, points = length / 2 - corner, width / 2 - corner, []
        quarter = self.corners // 4
        step = math.pi / 2 / quarter
        # two triangles r·out·sin/2 and the others out²·sin/2 make π/4·r²
        out = (math.sqrt(1 + (quarter - 2) * math.pi / 2 / math.sin(step)) - 1) / (quarter - 2) * corner
        for k, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
            for i in range(quarter + 1 if corner else 1):
                angle, r = math.pi / 2 * k + step * i, corner if i in (0, quarter) else out
                points.append((sx * a + r * math.cos(angle), sy * b + r * math.sin(angle)))
        c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
        return np.array([(x + c * u - s * v, y + s * u + c * v) for u, v in points])

    def prism(self, points, low, high):
        return CrossSection([points.tolist()]).extrude(high - low).translate([0, 0, low])

    def hull(self, lower, low, upper, high):
        points = [(x, y, low) for x, y in lower] + [(x, y, high) for x, y in upper]
        return Manifold.hull_points(np.array(points))

    def cone(self, x, y, r_low, low, r_high, high):
        """As a hull of polygons; a radius of 0 is a point."""
        lower = self.circle(x, y, r_low) if r_low else [(x, y)]
        upper = self.circle(x, y, r_high) if r_high else [(x, y)]
        return self.hull(lower, low, upper, high)

    def outline(self, shape, more=0.0):
        """A shape, by its keys in the file, grown by a distance: outside corners are rounded, inside ones stay sharp."""
        if "diameter" in shape:
            return self.circle(shape["x"], shape["y"], shape["diameter"] / 2 + more)
        corner = shape.get("corner", 0.0)
        round_ = max(corner + more, 0.0)
        return self.rectangle(
            shape["x"], shape["y"], shape["length"] + 2 * more, shape["width"] + 2 * more, round_, shape.get("turned", 0.0)
        )

    def capsule(self, start, end, width, low, high):
        (x0, y0), (x1, y1) = start, end
        turned = math.degrees(math.atan2(y1 - y0, x1 - x0))
        length = math.dist(start, end) + width
        return self.prism(self.rectangle((x0 + x1) / 2, (y0 + y1) / 2, length, width, width / 2, turned), low, high)

    def removed(self, each, features):
        """What a feature of the upper side takes away of a blank whose top is at 0."""
        kind, top = each["kind"], each.get("top", 0.0)
        if kind == "face":
            return [Manifold.cube([3 * LENGTH, 3 * WIDTH, ABOVE]).translate([-LENGTH, -WIDTH, top - each["depth"]])]
        if kind in ("pocket", "stud"):
            floor = top - each["depth"]
            if kind == "pocket":
                body = self.prism(self.outline(each), floor, ABOVE)
                studs = [stud for stud in features if "in the pocket" in stud.get("name", "")]
                studs = [stud for stud in studs if all(stud[key] == each[key] for key in ("x", "y", "depth"))]
                for island in each.get("islands", []) + studs:
                    body -= self.prism(self.outline(island), floor - 1, ABOVE + 1)
                return [body]
            if "pocket" in each["name"]:
                return []  # an island
            body = Manifold.cube([3 * LENGTH, 3 * WIDTH, ABOVE]).translate([-LENGTH, -WIDTH, floor])
            for stud in features:
                if stud["kind"] == "stud" and "pocket" not in stud["name"]:
                    body -= self.prism(self.outline(stud), floor - 1, floor + ABOVE + 1)
            return [body]
        if kind == "slot":
            return [self.capsule(each["start"], each["end"], each["width"], top - each["depth"], ABOVE)]
        if kind == "groove":
            floor = top - each["depth"]
            if "points" in each:
                ways = zip(each["points"], each["points"][1:])
                return [self.capsule(*way, each["width"], floor, ABOVE) for way in ways]
            shape, half = each.get("contour", each), each["width"] / 2
            return [self.prism(self.outline(shape, half), floor, ABOVE) - self.prism(self.outline(shape, -half), floor - 1, 40)]
        if kind == "hole":
            return self.hole(each, top)
        area = each.get("contour", each)
        width, deep = each["width"], top - each["width"] / math.tan(math.radians(each.get("angle", 90) / 2))
        if each.get("inside"):
            body = self.prism(self.outline(area, 5.0), deep, top)
            body -= self.hull(self.outline(area), deep, self.outline(area, -width), top)
            body = body ^ self.prism(self.outline(area), deep - 1, top + 1)
            above = self.prism(self.outline(area), top, ABOVE) - self.prism(self.outline(area, -width), top - 1, ABOVE + 1)
        else:
            body = self.hull(self.outline(area), deep, self.outline(area, width), top)
            body -= self.prism(self.outline(area), deep - 1, top + 1)
            above = self.prism(self.outline(area, width), top, ABOVE) - self.prism(self.outline(area), top - 1, ABOVE + 1)
        return [body, above]

    def hole(self, each, top):
        x, y, r = each["x"], each["y"], each["diameter"] / 2
        if "depth" not in each:
            bodies = [self.prism(self.circle(x, y, r), -HEIGHT - 5, ABOVE)]
        else:
            floor, point = top - each["depth"], each.get("point", 118)
            bodies = [self.prism(self.circle(x, y, r), floor, ABOVE)]
            if point < 180:
                bodies.append(self.cone(x, y, 0.0, floor - r / math.tan(math.radians(point / 2)), r, floor))
        seat = top
        if "counterbore" in each:
            wide, deep = each["counterbore"]
            seat = top - deep
            bodies.append(self.prism(self.circle(x, y, wide / 2), seat, ABOVE))
        if "countersink" in each:
            wide, angle = each["countersink"]
            deep = (wide / 2 - r) / math.tan(math.radians(angle / 2))
            bodies.append(self.cone(x, y, r, seat - deep, wide / 2, seat))
            bodies.append(self.prism(self.circle(x, y, wide / 2), seat, ABOVE))
        return bodies

    def blank(self, blank):
        if "radius" not in blank:
            return Manifold.cube([LENGTH, WIDTH, HEIGHT]).translate([0, 0, -HEIGHT])
        x, y, _ = blank["at"]
        body = self.prism(self.circle(x, y, blank["radius"]), -HEIGHT, 0)
        if "bore" in blank:
            body -= self.prism(self.circle(x, y, blank["bore"]), -HEIGHT - 1, 1)
        return body

    def takes(self, blank, feature, features):
        """Whether a feature takes something of a blank: a design refuses one that lies beside it."""
        bodies, body = self.removed(feature, features), self.blank(blank)
        return not bodies or any((body ^ each).volume() > 0 for each in bodies)

    def volume(self, blank, features, back):
        body = self.blank(blank)
        gone = [each for feature in features for each in self.removed(feature, features)]
        for feature in back:  # about X, in its place
            for each in self.removed(feature, back):
                gone.append(each.rotate([180, 0, 0]).translate([0, WIDTH, -HEIGHT]))
        return (body - Manifold.batch_boolean(gone, OpType.Add)).volume()


SOME = Solids(64)


def designs():
    """(name, blank, features, back), by chance."""
    rng = random.Random(16)
    for number in range(COUNT):
        blank = {"low": [0, 0, -HEIGHT], "high": [LENGTH, WIDTH, 0]}
        if number % 5 == 3:
            blank = {"radius": 30, "low": -HEIGHT, "high": 0, "at": [50, 30, 0]}
            if rng.random() < 0.5:
                blank["bore"] = rng.choice([5, 8])
        sides = [_side(rng, blank) for _ in range(2 if number % 4 == 1 else 1)]
        sides = [[each for each in side if SOME.takes(blank, each, side)] for side in sides]
        yield f"design {number}", blank, sides[0], sides[1] if len(sides) > 1 else []


def _side(rng, blank):
    r = lambda low, high: round(rng.uniform(low, high), 2)  # noqa: E731
    found = []
    if rng.random() < 0.2:
        found.append({"kind": "face", "depth": r(0.3, 1.5)})
    if rng.random() < 0.3:
        depth = r(2, 5)
        for k in range(rng.choice([1, 2])):
            if rng.random() < 0.6:
                size = {"length": r(15, 30), "width": r(15, 30), "corner": r(0, 6)}
            else:
                size = {"diameter": r(15, 30)}
            stud = {"kind": "stud", "name": f"stud {k}", "x": 32 + 36 * k + r(-2, 2), "y": r(25, 35)}
            found.append(stud | size | {"depth": depth})
    for _ in range(rng.randint(1, 4)):
        kind = rng.choice(["pocket", "pocket", "slot", "hole", "hole", "hole", "groove", "chamfer"])
        x, y = r(15, 85), r(12, 48)
        top = {"top": r(-2, 0)} if rng.random() < 0.15 else {}
        if kind == "pocket":
            shape = _shape(rng, r, x, y)
            pocket = {"kind": kind, **shape, "depth": r(1, 9), **top}
            if rng.random() < 0.2:
                pocket["depth"] = 25.0  # through
            small = {"x": x, "y": y, "diameter": r(2, 5)}
            if rng.random() < 0.25:
                pocket["islands"] = [small]
            elif rng.random() < 0.3:
                found.append({"kind": "stud", "name": f"in the pocket {len(found)}", **small, "depth": pocket["depth"], **top})
            found.append(pocket)
            if rng.random() < 0.4:
                found.append(_chamfer(rng, r, shape, False, top))
        elif kind == "slot":
            angle, reach = rng.uniform(0, math.pi), r(5, 20)
            ends = [[round(x + s * reach * math.cos(angle), 3), round(y + s * reach * math.sin(angle), 3)] for s in (-0.5, 0.5)]
            found.append({"kind": kind, "start": ends[0], "end": ends[1], "width": r(3, 9), "depth": r(1, 8), **top})
        elif kind == "groove":
            groove = {"kind": kind, "width": r(1, 3), "depth": r(1, 4), **top}
            if rng.random() < 0.5:
                points = [[x, y], [r(15, 85), r(12, 48)], [r(15, 85), r(12, 48)]]
                found.append(groove | {"points": points, "closed": False})
            else:
                shape = _shape(rng, r, x, y)
                found.append(groove | (shape if "diameter" in shape else {"contour": shape}))
        elif kind == "hole":
            found.append(_hole(rng, r, x, y) | top)
        elif "radius" in blank:
            found.append(_chamfer(rng, r, {"x": 50, "y": 30, "diameter": 60}, True, {}))
        else:
            found.append(_chamfer(rng, r, {"x": 50, "y": 30, "length": LENGTH, "width": WIDTH}, True, {}))
    return found


def _shape(rng, r, x, y):
    if rng.random() < 0.35:
        return {"x": x, "y": y, "diameter": r(7, 20)}
    length, width = r(8, 30), r(8, 20)
    corner = rng.choice([0.0, r(1.5, 3.5)])
    return {"x": x, "y": y, "length": length, "width": width, "corner": corner, "turned": rng.choice([0.0, r(-45, 45)])}


def _chamfer(rng, r, shape, inside, top):
    found = {"kind": "chamfer", "width": r(0.3, 1.4), "angle": rng.choice([90, 90, 60]), "inside": inside, **top}
    return found | (shape if "diameter" in shape else {"contour": shape})


def _hole(rng, r, x, y):
    found = {"kind": "hole", "x": x, "y": y, "diameter": r(3, 10)}
    if rng.random() < 0.6:
        found |= {"depth": r(6, 14), "point": rng.choice([118, 118, 90, 180])}
    if rng.random() < 0.3:
        found["counterbore"] = [round(found["diameter"] + r(2, 5), 2), r(1, 5)]
    elif rng.random() < 0.4:
        found["countersink"] = [round(found["diameter"] + r(1, 4), 2), rng.choice([90, 90, 60, 120])]
    return found


def written(blank, features, back):
    """The file of a design."""
    parts = [["[blank]", *_lines(blank)]]
    parts += [[f"[[{side}]]", *_lines(each)] for side, some in (("features", features), ("back", back)) for each in some]
    return "\n\n".join("\n".join(part) for part in parts) + "\n"


def _lines(table):
    return [f"{key} = {_value(value)}" for key, value in table.items()]


def _value(value):
    if isinstance(value, dict):
        return f"{{ {', '.join(_lines(value))} }}"
    return f"[{', '.join(map(_value, value))}]" if isinstance(value, list) else json.dumps(value)


def main():
    records = []
    for name, blank, features, back in designs():
        volume, coarse = (Solids(corners).volume(blank, features, back) for corners in (FINE, FINE // 2))
        print(f"{name:12} {volume:13.4f} mm³, {coarse - volume:+.5f} if coarser", flush=True)
        text = written(blank, features, back)
        records.append({"name": name, "text": text, "volume": round(volume, 5), "coarse": round(coarse, 5)})
    FILE.write_text(json.dumps({"authority": f"manifold3d {version('manifold3d')}", "designs": records}, indent=1) + "\n")


if __name__ == "__main__":
    main()
