"""Slots: cut to and fro along their centre line, or on circles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mnclab.geometry.contours import Contour
from mnclab.machining.milling.clearing import Clearing, begin, numbered
from mnclab.machining.milling.entries import Descent, descend, stroke_count, vertical
from mnclab.machining.milling.entries import along as ramp
from mnclab.machining.milling.pocket_steps import Down, LevelFeeds, PocketWork, along
from mnclab.machining.milling.trochoids import Wall
from mnclab.machining.steps import Along, Go, Step

# Slots cut along their centre line, to and fro: with straight infeeds at the ends, or sinking on the way. Lengths in mm.
# straight    ↓───►        oblique   ╲ there            both end with the whole line cut on the last level
#             ◄───↓                  ╱ and back

def straight_infeeds(line: Contour, levels: Sequence[float], feeds: LevelFeeds) -> Iterator[Step]:
    """Down where the tool stands, at the begin of the line, along it, down at its end, and back along it: as many as levels."""
    for k, (name, level) in enumerate(zip(numbered("infeed", len(levels)), levels, strict=True)):
        yield Go(f"{name}, down", level, feeds.plunge)
        yield Along(f"{name}, along the slot", line.reversed() if k % 2 else line, feeds.level)


def oblique_infeeds(line: Contour, surface: float, levels: Sequence[float], feed: float) -> Iterator[Step]:
    """From the begin of the line at the `surface`, there and back to each of the levels, evenly down; at last level, there."""
    top, back = surface, line.reversed()
    for name, level in zip(numbered("infeed", len(levels)), levels, strict=True):
        middle = (top + level) / 2
        yield Along(f"{name}, there", line, feed, _evenly(line, top, middle))
        yield Along(f"{name}, back", back, feed, _evenly(back, middle, level))
        top = level
    yield Along("along the floor", line, feed)


def _evenly(line: Contour, top: float, bottom: float) -> list[float]:
    """The heights of the points of an open contour whose pieces are alike."""
    last = len(line.points) - 1
    return [top + (bottom - top) * k / last for k in range(last + 1)]


# Milling a trochoidal slot step by step: circles level by level, then its walls, then its floor. Lengths in mm.
# rough     ↓ to the level at the begin of the line, a spiral, circles to its end, ↑ and back above it     for each layer
# walls     ↓ on the centre line, a half circle to the wall, along it, off it                               for each infeed
# floor     as a layer                                                                                      once

def way_down(line: Contour, radius: float, angle: float) -> Down:
    """To and fro along the first two tool diameters of a line at a plunge angle (degrees), back at its begin; or straight."""

    def down(top: float, bottom: float) -> Descent:
        if angle == 90:
            return vertical(line.points[0], top, bottom)
        stroke = line.between(0.0, min(line.length, 4 * radius))
        stroke_count(stroke.length, top, bottom, angle)  # no more than somebody would wait for
        return ramp(stroke, top, bottom, angle)

    return down


def rough(clearing: Clearing, work: PocketWork, down: Down, up: Sequence[float]) -> Iterator[Step]:
    """Every layer; after each `up` to one height after the other, and back over the begin."""
    top = work.surface
    for name, level in zip(numbered("layer", len(work.layers)), work.layers, strict=True):
        yield from _clear(name, clearing, down(top, level), top + work.lift, work.feeds[0], work.side)
        yield from _back(name, clearing, up)
        top = level


def finish_walls(walls: Sequence[Wall], work: PocketWork, up: Sequence[float]) -> Iterator[Step]:
    """Round every wall on all levels, from a place on the centre line and back to it, and `up`."""
    _, feeds, _ = work.feeds
    for which, wall in zip(numbered("wall", len(walls)), walls, strict=True):
        x, y = wall.place.tolist()
        yield Go(f"{which}, over the start", x=x, y=y)
        yield Go(f"{which}, to the set-up clearance", work.above)
        for label, level in zip(numbered("infeed", len(work.walls)), work.walls, strict=True):
            name = f"side finishing, {which}, {label}" if len(walls) > 1 else f"side finishing, {label}"
            yield Go(f"{name}, down", level, feeds.plunge)
            ways = (*wall.arcs[:1], wall.contour, *wall.arcs[1:])
            names = (f"{name}, to the wall", name, f"{name}, off the wall") if wall.arcs else (name,)
            yield Go(f"{name}, to the wall", None, feeds.level, *begin(ways[0]).tolist())
            for step_name, way in zip(names, ways, strict=True):
                yield from along(step_name, way, feeds.level, feeds.edge, work.side)
            yield Go(f"{name}, back to the start", None, feeds.level, x, y)
        yield from (Go(f"{which}, lift", height) for height in up)


def finish_floor(clearing: Clearing, work: PocketWork, down: Down, up: Sequence[float]) -> Iterator[Step]:
    """From what roughing has left to the floor, as a layer, and `up`."""
    for level in work.floor:
        x, y = begin_of(clearing)
        yield Go("floor finishing, over the start", x=x, y=y)
        down_to = down(work.left_over, level)
        yield from _clear("floor finishing", clearing, down_to, work.left_over + work.lift, work.feeds[2], work.side)
        yield from _back("floor finishing", clearing, up)


def begin_of(clearing: Clearing) -> tuple[float, float]:
    """Where the tool goes down."""
    x, y = clearing.pieces[0].entry.tolist()
    return x, y


def _clear(name: str, clearing: Clearing, down: Descent, above: float, feeds: LevelFeeds, side: int) -> Iterator[Step]:
    yield Go(f"{name}, to the clearance level", above)
    yield Go(f"{name}, down to what is cut", float(down.heights[0]), feeds.plunge)
    yield from descend(down._replace(label=f"{name}, {down.label}"), feeds.plunge, feeds.level)
    for label, contour in zip(clearing.labels, clearing.passes, strict=True):
        yield from along(f"{name}, {label}", contour, feeds.level, feeds.edge, side)


def _back(name: str, clearing: Clearing, up: Sequence[float]) -> Iterator[Step]:
    x, y = begin_of(clearing)
    yield from (Go(f"{name}, lift", height) for height in up)
    yield Go(f"{name}, back to the start", x=x, y=y)
