"""How a scene stands in its picture: all of it in sight, with rulers at the edges of its box and a grid behind it.

The camera has no perspective, so a pixel is the same length everywhere: rulers are drawn in the plane of the screen, with
numbers between round ones that do not touch each other. What turns in a browser has VTK's own rulers instead.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from mnclab.path.listing import MM, Unit
from mnclab.path.toolpath import Array

INK, GRID = "#3a3f44", "#dfe3e6"
FONT, HIGH, WIDE = 12, 15.0, 7.0  # of the numbers: size; pixels of a line and of a letter
TICK, AWAY, APART = 6.0, 9.0, 56.0  # pixels: of a tick, from its end to a number, from number to number at least
MARGINS = (78.0, 40.0, 30.0, 66.0)  # pixels to the left, right, above and below what is shown
BAR = 128.0  # pixels at the right for a scale of colours
THIN = 24.0  # pixels: an axis that is shorter has no ruler
GAP = 4.0  # pixels between two texts


class Look(NamedTuple):
    """The screen in space: unit vectors (3,) to the right, up and to the eye, and mm in a pixel."""

    right: Array
    up: Array
    eye: Array
    scale: float

    def flat(self, points: Array) -> Array:
        """Points (n, 3) on the screen (n, 2), pixels."""
        return np.asarray(points) @ np.stack([self.right, self.up], axis=1) / self.scale

    def moved(self, points: Array, way: Array) -> Array:
        """Points (n, 3) shifted by pixels (2,) of the screen."""
        return np.asarray(points) + (way[0] * self.right + way[1] * self.up) * self.scale


def frame(
    plotter: Any, seen: Array, towards: Sequence[float], lathe: bool,
    *, unit: Unit = MM, axes: bool = True, ruled: Array | None = None,
) -> None:  # fmt: skip
    """Look from a side so that points (n, 3) fill the picture; rulers around the points `ruled` (default: all of them).

    On a lathe X stands upright and counts diameters.
    """
    eye = np.asarray(towards, dtype=np.float64) / np.linalg.norm(towards)
    plotter.view_vector(eye.tolist(), (1, 0, 0) if lathe else (0, 0, 1))
    plotter.enable_parallel_projection()
    seen = seen[np.isfinite(seen).all(axis=1)]
    if not len(seen):
        return
    around = seen if ruled is None else ruled[np.isfinite(ruled).all(axis=1)]
    box = np.stack([around.min(axis=0), around.max(axis=0)])
    if axes:  # the whole of the box that the rulers stand around
        seen = np.concatenate([seen, np.array([*product(*box.T)])])
    upright = np.eye(3)[0 if lathe else 2]
    if abs(upright @ eye) > 0.999:  # from above: Y stands upright
        upright = np.eye(3)[1]
    right = np.cross(upright, eye)
    right /= np.linalg.norm(right)
    look = Look(right, np.cross(eye, right), eye, 1.0)
    width, height = plotter.window_size
    left, beside, above, below = MARGINS if axes else (16.0,) * 4
    beside += BAR if len(plotter.scalar_bars) else 0.0
    flat = look.flat(seen)
    low, high = flat.min(axis=0), flat.max(axis=0)
    room = np.maximum([width - left - beside, height - above - below], 20.0)
    look = look._replace(scale=float(max(((high - low) / room).max(), 1e-9)))
    middle, off = (low + high) / 2, np.array([beside - left, above - below]) / 2 * look.scale
    depths = seen @ eye
    centre = right * (middle[0] + off[0]) + look.up * (middle[1] + off[1]) + eye * depths.mean()
    far = 10 * float(np.ptp(depths)) + 10 * height * look.scale
    plotter.camera.focal_point, plotter.camera.up = centre.tolist(), look.up.tolist()
    plotter.camera.position = (centre + far * eye).tolist()
    plotter.camera.parallel_scale = height * look.scale / 2
    plotter.camera.clipping_range = (far / 1e3, 3 * far)
    if axes:
        add_rulers(plotter, box, look, lathe, unit)


def add_rulers(plotter: Any, box: Array, look: Look, lathe: bool, unit: Unit) -> None:
    """Grid, ticks, numbers and titles around a box (2, 3), as actors "grid", "ticks", "numbers" and "titles"."""
    ticks = {axis: some for axis in range(3) if (some := ticks_of(axis, box, look, lathe, unit)) is not None}
    grid, marks = _grid(ticks, box, look), list[Array]()
    texts: list[tuple[Array, str]] = []
    names: list[tuple[Array, str]] = []
    taken = list[Array]()
    for axis in ticks:
        out, edge = _edge(axis, box, look, 0 if lathe else 2)
        places, numbers = ticks[axis]
        points = np.repeat(edge[:1], len(places), axis=0)
        points[:, axis] = places
        marks += [np.stack([one, look.moved(one, TICK * out)]) for one in points]
        longest = max(map(len, numbers), default=0)
        for one, number in zip(points, numbers):
            _put(texts, taken, look.moved(one, (TICK + AWAY + WIDE / 2 * len(number) * abs(out[0])) * out), number, look)
        title = f"{'XYZ'[axis]}{' (diameter)' if lathe and axis == 0 else ''}, {unit.short}"
        if abs(out[1]) < 0.5:  # beside an upright edge there is more room above it
            top = edge[np.argmax(look.flat(edge)[:, 1])]
            _put(names, taken, look.moved(top, np.array([0.0, 1.2 * HIGH])), title, look, sure=True)
        else:
            below = TICK + AWAY + 1.5 * HIGH + WIDE * longest * abs(out[0])
            _put(names, taken, look.moved(edge.mean(axis=0), below * out), title, look, sure=True)
    for name, lines, shade, wide in (("grid", grid, GRID, 1.0), ("ticks", marks, INK, 1.4)):
        if lines:
            plotter.add_lines(np.concatenate(lines), color=shade, width=wide, name=name)
    look_of: dict[str, Any] = {"shape": None, "show_points": False, "always_visible": True, "text_color": INK, "bold": False}
    look_of |= {"justification_horizontal": "center", "justification_vertical": "center", "font_size": FONT}
    plotter.titles = tuple(text for _, text in names)
    for name, found in (("numbers", texts), ("titles", names)):
        if found:
            plotter.add_point_labels(np.array([at for at, _ in found]), [text for _, text in found], name=name, **look_of)


def turning_rulers(plotter: Any) -> None:
    """In place of the rulers of a still picture those that follow a camera; none where there were none."""
    if "ticks" not in plotter.actors:
        return
    titles = dict.fromkeys(("xtitle", "ytitle", "ztitle"), "")
    titles |= {f"{text[0].lower()}title": text for text in plotter.titles}
    for name in ("grid", "ticks", "numbers", "titles"):
        plotter.remove_actor(name, render=False)
    look: dict[str, Any] = {"color": INK, "font_size": 9, "fmt": "%.6g", "bold": False, "use_3d_text": False}
    plotter.show_bounds(grid="back", location="outer", ticks="outside", **look, **titles)


def ticks_of(axis: int, box: Array, look: Look, lathe: bool, unit: Unit) -> tuple[Array, list[str]] | None:
    """Places along an axis with round numbers, mm, and these numbers; None of an axis that is seen from its end."""
    across = float(np.hypot(look.right[axis], look.up[axis])) / look.scale  # pixels to a mm
    low, high = box[:, axis]
    if (lathe and axis == 1) or across * max(high - low, 0.0) < THIN:
        return None  # a body that turns has no Y of its own
    counts = unit.length / (2 if lathe and axis == 0 else 1)  # mm to 1 of the ruler
    step = rounded(min(APART / across, 0.4 * (high - low)) / counts)  # a short axis has two numbers at least
    digits = max(0, -int(np.floor(np.log10(step) + 1e-9)))
    first, last = np.ceil(low / counts / step - 1e-6), np.floor(high / counts / step + 1e-6)
    values = step * np.arange(first, last + 1)
    shown = np.abs(values) if lathe and axis == 0 else values
    numbers = [f"{value:z.{digits}f}".replace("-", "\N{MINUS SIGN}") for value in shown]
    return values * counts, numbers


def rounded(least: float) -> float:
    """The next of 1, 2, 5, 10 … that is not below."""
    power = 10.0 ** np.floor(np.log10(least))
    return float(next(factor * power for factor in (1, 2, 5, 10) if factor * power >= least * (1 - 1e-9)))


def _edge(axis: int, box: Array, look: Look, upright: int) -> tuple[Array, Array]:
    """Which edge of a box has the ruler of an axis: the way out of the picture there (2,), and its ends (2, 3).

    Of the axis that stands upright it is the one most to the left, of others the lowest one.
    """
    others = [each for each in range(3) if each != axis]
    edges = []
    for sides in product((0, 1), repeat=2):
        ends = np.repeat(box[:1], 2, axis=0)
        ends[:, axis] = box[:, axis]
        for other, side in zip(others, sides):
            ends[:, other] = box[side, other]
        edges.append(ends)
    middles = np.array([look.flat(ends).mean(axis=0) for ends in edges])
    along = np.diff(look.flat(edges[0]), axis=0)[0]
    stands = axis == upright or abs(along[0]) < 0.2 * abs(along[1])
    best = int(np.lexsort((middles[:, 1], middles[:, 0]) if stands else (middles[:, 0], middles[:, 1]))[0])
    out = np.array([-along[1], along[0]]) / np.linalg.norm(along)
    away = middles[best] - middles.mean(axis=0)
    towards = away if np.linalg.norm(away) > 1e-9 else np.array([-1.0, 0.0] if stands else [0.0, -1.0])
    return (out if out @ towards >= 0 else -out), edges[best]


def _grid(ticks: dict[int, tuple[Array, list[str]]], box: Array, look: Look) -> list[Array]:
    """Lines (2, 3) on the sides of the box behind all that is seen: one at each tick, and the border."""
    found, behind = [], float(np.ptp(box, axis=0).sum()) * look.eye  # without perspective nothing looks nearer for it
    for axis in range(3):
        side = box[0 if look.eye[axis] > 0 else 1, axis]
        if abs(look.eye[axis]) < 1e-6:
            continue
        one, other = (each for each in range(3) if each != axis)
        for along, across in ((one, other), (other, one)):
            places = [*(ticks[across][0] if across in ticks else ()), *box[:, across]]
            for place in places:
                line = np.zeros((2, 3))
                line[:, axis], line[:, across], line[:, along] = side, place, box[:, along]
                found.append(line - behind)
    return found


def _put(texts: list[tuple[Array, str]], taken: list[Array], at: Array, text: str, look: Look, sure: bool = False) -> None:
    """Write a text about a place unless it would lie on one before it; a `sure` one is written all the same."""
    half = np.array([WIDE * len(text) + GAP, HIGH + GAP]) / 2
    middle = look.flat(at[None])[0]
    box = np.concatenate([middle - half, middle + half])
    if not sure and any((box[:2] < other[2:]).all() and (other[:2] < box[2:]).all() for other in taken):
        return
    taken.append(box)
    texts.append((at, text))

