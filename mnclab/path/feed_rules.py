"""Feeds that depend on where a move leads: slower on the way down, and constant at the cutting edge along arcs.

A control names the rule in a block and it holds from there on. The rows keep the feed that was programmed until the whole
path is known; these functions change the feeds of the tool-centre path, which is what the machine drives.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.path.columns import Array
from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath

SMALLEST = 1e-9  # mm, radius of the contour at a corner


class FeedRule(NamedTuple):
    """What holds from a `step` on: the share of the feed that a move may have downwards, and whether the feed of
    compensated arcs counts at the cutting edge ("", "inside" or "everywhere")."""

    step: int
    plunging: float = 1.0
    edge: str = ""


def apply(path: Toolpath, rules: list[FeedRule]) -> Toolpath:
    """The path with the feeds of these rules, in the order of their steps; the same path if they change nothing."""
    if not rules or not len(path):
        return path
    which = np.searchsorted([rule.step for rule in rules], path.step, "right")
    cuts = ((path.kind == Kind.LINE) | (path.kind == Kind.ARC)) & ~path.synchronous
    down = np.array([1.0, *(rule.plunging for rule in rules)])[which]
    edge = np.array(["", *(rule.edge for rule in rules)])[which]
    factor = plunging(path, down) * at_edge(path, edge)
    if not (factor[cuts] != 1).any():
        return path
    factor = np.where(cuts, factor, 1.0)
    return path.replace(feed=path.feed * factor, per_rev=path.per_rev * factor)


def plunging(path: Toolpath, share: Array) -> Array:
    """Factor (n,) of the feed that keeps its component downwards, along -Z, at a share (n,) of the programmed feed."""
    drop, length = path.start[:, 2] - path.end[:, 2], path.lengths
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(drop > 0, np.minimum(1.0, share * length / drop), 1.0)


def at_edge(path: Toolpath, where: NDArray[np.str_]) -> Array:
    """Factor (n,) that makes the feed of the centre that of the cutting edge on compensated arcs. Inside an arc the
    edge has the longer way and the centre is slowed down; "everywhere" outside it is made faster, too."""
    radius = np.linalg.norm(path.start - path.centre, axis=1)  # of the way of the centre
    inside = path.side * np.sign(path.sweep) > 0
    contour = np.where(inside, radius + path.radius, radius - path.radius)
    acts = (path.side != 0) & (contour > SMALLEST) & ((inside & (where != "")) | (where == "everywhere"))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(acts, radius / contour, 1.0)
