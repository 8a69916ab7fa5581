"""Turning: a bar in its chuck, Z to the right, with both its sides, so that a diameter is one."""

from __future__ import annotations

from mnclab.lab.sketches.ink import Point, Sheet, box
from mnclab.lab.sketches.kinds import Draw, Kind

AXIS, FACE, STOP, BEVEL = 35, 80, 40, 50  # the axis, the end face with its datum, where a cut ends, where its bevel begins
OUTER, INNER, PASS = 22, 10, 16  # radii: of the bar, of what is finished, after a pass; the bevel ends at PASS too
THREAD = tuple((STOP + 5 * k, 12 + 9 * (k % 2)) for k in range(9))
TAPPED = tuple((FACE - 4 * k, 5 + 3 * (k % 2)) for k in range(9))
TURNED = ((STOP, OUTER), (STOP, PASS), (BEVEL, INNER), (FACE, INNER))

#: what is cut -> its outline over the axis, as (z, radius)
OUTLINES: dict[str, tuple[Point, ...]] = {
    "along": TURNED, "across": TURNED,
    "thread": ((STOP - 6, OUTER), (STOP - 6, 12), *THREAD),
    "groove": (*((z + dz, r) for z in (28, 54) for dz, r in ((0, OUTER), (0, INNER), (6, INNER), (6, OUTER))), (FACE, OUTER)),
    "face groove": ((FACE, OUTER), *((z, r + dr) for r in (12, 4) for z, dr in ((FACE, 5), (60, 5), (60, 0), (FACE, 0)))),
    "hole": ((FACE, OUTER), (FACE, 6), (46, 6), (STOP, 0)),
    "tap": ((FACE, OUTER), *TAPPED, (STOP, 5), (STOP, 0)),
    "radial hole": ((46, OUTER), (46, 8), (52, 4), (58, 8), (58, OUTER), (FACE, OUTER)),
    "taper": ((STOP, OUTER), (FACE, INNER)),
}  # fmt: skip


def bar(s: Sheet, figure: str) -> None:
    """The chuck, the bar and what is made of it."""
    s.draw("fill", *box(3, 8, 12, 62), closed=True)
    s.draw("edge", *box(3, 8, 12, 62), closed=True)
    shape = ((12, OUTER), *OUTLINES[figure])
    other = shape if figure != "radial hole" else ((12, OUTER), (FACE, OUTER))
    around = (*((z, AXIS - r) for z, r in shape), *((z, AXIS + r) for z, r in other[::-1]))
    s.draw("fill", *around, closed=True)
    s.draw("edge", *around)
    s.draw("dash", (1, AXIS), (94, AXIS))
    if figure in ("along", "across"):
        s.draw("dash", (STOP, AXIS - OUTER), (FACE, AXIS - OUTER), (FACE, AXIS - INNER))


def diameter(r: float) -> Draw:
    """A diameter, beyond the end of the bar."""

    def draw(s: Sheet, kind: Kind) -> None:
        bar(s, kind.figure)
        s.address = "⌀" + s.address
        z = min(z for z, radius in OUTLINES[kind.figure] if radius == r)
        s.measure((88, AXIS - r), (88, AXIS + r), (z, AXIS - r), (z, AXIS + r))

    return draw


def radius(r: float, z: float) -> Draw:
    """From the axis to a place on one side."""

    def draw(s: Sheet, kind: Kind) -> None:
        bar(s, kind.figure)
        s.measure((88, AXIS), (88, AXIS - r), (88, AXIS), (z, AXIS - r))

    return draw


def along(z: float, r: float) -> Draw:
    """From the datum in the end face to a place along Z."""

    def draw(s: Sheet, kind: Kind) -> None:
        bar(s, kind.figure)
        s.datum(FACE, AXIS)
        s.measure((FACE, 6), (z, 6), (FACE, AXIS), (z, AXIS - r))

    return draw


def step(a: Point, b: Point, part: str = "", dashed: tuple[Point, ...] = (), figure: str = "") -> Draw:
    """From one (z, radius) to another, along X at the right of the bar, or along Z over it; `part` of what is written."""

    def draw(s: Sheet, kind: Kind) -> None:
        bar(s, figure or kind.figure)
        s.address += part
        s.draw("dash", *((z, AXIS - r) for z, r in dashed))
        feet = [(z, AXIS - r) for z, r in (a, b)]
        ends = [(x, 6) for x, _ in feet] if a[1] == b[1] else [(88, y) for _, y in feet]
        s.measure(ends[0], ends[1], *feet)

    return draw


#: what is cut -> the way of the tool in the cut, as (z, radius)
WAYS = {
    "along": ((FACE + 10, PASS), (STOP + 2, PASS)), "across": ((64, 32), (64, INNER + 2)), "groove": ((57, 32), (57, INNER + 2)),
    "face groove": ((FACE + 12, 14.5), (62, 14.5)), "hole": ((FACE + 13, 0), (48, 0)), "radial hole": ((52, 32), (52, 8)),
}  # fmt: skip


def feed(s: Sheet, kind: Kind) -> None:
    """The tool in the cut."""
    bar(s, kind.figure)
    (z, r), (u, v) = WAYS[kind.figure]
    s.move((z, AXIS - r), (u, AXIS - v))
    s.anchor = (70, 6)


LATHE = (
    ("along|across", "diameter of the finished surface on diameter", diameter(INNER)),
    ("along|across", "end of the (pass|passes|cut along Z)", along(STOP, PASS)),
    ("along|across", "end of the cut along X", radius(INNER, FACE)),
    ("along|across", "X of the bevel", radius(PASS, STOP)),
    ("along|across", "Z of the bevel", along(BEVEL, INNER)),
    ("along|across", "size of the bevel along X on diameter", step((STOP, PASS), (BEVEL, INNER), "/2")),
    ("along|across", "size of the bevel along Z", step((STOP, PASS), (BEVEL, PASS))),
    ("along", "stock removed per pass on diameter", step((FACE, OUTER), (FACE, PASS), "/2", ((STOP, PASS), (FACE, PASS)))),
    ("along", "depth of cut", step((FACE, OUTER), (FACE, PASS), "", ((STOP, PASS), (FACE, PASS)))),
    ("across", "stock removed per pass along Z|depth of cut", step((64, OUTER), (FACE, OUTER), "", ((64, OUTER), (64, INNER)))),
    ("groove", "bottom of the groove on diameter", diameter(INNER)),
    ("groove", "bottom of the groove", radius(INNER, 60)),
    ("groove", "start of the last groove|place of the last groove or cut", along(28, OUTER)),
    ("groove", "pitch of the grooves|step between the cuts", step((28, OUTER), (54, OUTER))),
    ("face groove", "bottom of the groove", along(60, 17)),
    ("face groove", "start of the last groove on diameter", diameter(4)),
    ("face groove", "place of the last groove or cut", radius(4, FACE)),
    ("face groove", "step between the cuts", step((FACE, 4), (FACE, 12))),
    ("face groove", "pitch of the grooves on diameter", step((FACE, 4), (FACE, 12), "/2")),
    ("hole", "bottom of the hole", along(STOP, 0)),
    ("hole", "depth drilled (per|in a) pass", step((FACE, 6), (66, 6), "", ((66, 6), (66, -6)))),
    ("hole", "distance from the depth reached at the return", step((56, 6), (66, 6), "", ((56, 6), (56, -6)))),
    ("radial hole", "bottom of the hole on diameter", diameter(4)),
    ("radial hole", "depth drilled per pass on diameter", step((58, OUTER), (58, PASS), "/2", ((46, PASS), (58, PASS)))),
    ("thread", "crest diameter, or root with no P on diameter", diameter(21)),
    ("thread|tap", "end of the thread", along(STOP, 5)),
    ("thread", "pitch", step((65, 21), (75, 21))),
    ("tap", "pitch", step((68, 8), (76, 8))),
    ("thread", "depth of the thread on radius", step((75, 21), (80, 12))),
    ("thread", "depth of cut per pass on radius", step((75, 21), (75, 17), "", ((STOP, 17), (FACE, 17)))),
    ("thread", "taper on diameter", step((FACE, OUTER), (FACE, INNER), "/2", ((STOP, OUTER), (FACE, OUTER)), "taper")),
    ("along|across|(face )?groove|(radial )?hole", "feed of the (cycle|roughing passes)", feed),
)
