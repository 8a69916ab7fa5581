"""Milling a surface step by step: over lines or any other passes, layer by layer. Lengths in mm, feeds in mm/min.

Where a pass does not lead on to the next one the tool lifts, goes over its start and comes down again.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mnclab.machining.milling.clearing import Clearing, begin
from mnclab.machining.steps import Along, Go, Step


class Layer(NamedTuple):
    """One layer: its name and level, its passes, the feeds along them, between them and down to the level."""

    name: str
    level: float
    passes: Clearing
    feed: float | None
    link: float | None
    down: float | None


def face(layers: Sequence[Layer], above: float, lift: float = 0.0) -> Iterator[Step]:
    """To the start of the first layer and over all of them; `above` is the clearance level at the start, `lift` the way up
    between two passes of which one does not lead on to the other. Each layer begins where the one before it ends.
    """
    x, y = begin(layers[0].passes.passes[0]).tolist()
    yield Go("to the start", x=x, y=y)
    yield Go("to the clearance level", above)
    for layer in layers:
        name = f"{layer.name}, " if layer.name else ""
        yield Go(f"{name}down", layer.level, layer.down)
        linked = [linked for piece in layer.passes.pieces for linked in (False, *piece.linked)]
        columns = layer.passes.labels, layer.passes.passes, linked
        for k, (label, contour, joined) in enumerate(zip(*columns, strict=True)):
            x, y = begin(contour).tolist()
            if k and not joined:
                yield Go(f"{name}lift", layer.level + lift, layer.link)
                yield Go(f"{name}over the next {label.split()[0]}", None, layer.link, x, y)
                yield Go(f"{name}down", layer.level, layer.link)
            elif k:
                yield Go(f"{name}link", None, layer.link, x, y)
            yield Along(name + label, contour, layer.feed)
