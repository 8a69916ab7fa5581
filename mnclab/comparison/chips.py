"""Feeds that keep a chip thickness along the path of a mill. Lengths in mm, feeds in mm/min.

A tooth that feeds by f_z = feed / (speed · teeth) cuts a chip of the thickness f_z·cos θ where it stands at the angle θ from the
heading. Where the engagement φ begins at a side of the tool, θ reaches from 90° down to 90° - φ:

    greatest chip = f_z·sin φ for φ < 90°, f_z from there on
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.geometry.curves import Floats, counted
from mnclab.path.limits import Limits
from mnclab.path.places import divided
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, plain, shown

BAND = 0.9  # of the thickness: where it changes more, a row is parted
NEAR = 1e-9  # mm


def tooth_rate(tool: Any, radius: float, chip: Any, spindle: Any, limits: Limits | None) -> float:
    """How many teeth of a tool cut in a minute; an Alarm where that is not known, or where the `chip` makes no sense."""
    if not isinstance(tool, Tool) or not tool.teeth:
        hint = f"mnclab.Tool(radius={radius:g}, teeth=3) in place of it"
        raise Alarm(f"the thickness of a chip (chip=, spindle=) needs a tool with teeth, got {shown(tool)}", hint=hint)
    if spindle is None:
        raise Alarm("the thickness of a chip needs the speed of the spindle", hint="spindle=8000, in rev/min")
    check_number(spindle, "the speed of the spindle (rev/min)", above=0, at_most=limits.spindle if limits else None)
    if chip is not None:
        check_number(chip, "the greatest chip (mm)", above=0)
    return float(plain(spindle) * tool.teeth)


def fed(path: Toolpath, level: float, way: Floats, thickness: Floats, most: float, rate: float) -> tuple[Toolpath, Floats]:
    """A path whose rows at a level feed by at most rate / thickness and by `most`, and the feeds (n,) at some places.

    The places stand after a `way` (n,) along those rows, entries left out, in order; `thickness` (n,) is that of the chip there
    as a share of the feed per tooth. Rows are parted at the places where it comes into another band, of two such at the thinner.
    """
    rows = np.flatnonzero(_at_level(path, level))
    upto = np.cumsum(path.lengths[rows])
    band = np.floor(np.log(np.maximum(thickness, rate / most)) / np.log(BAND))  # the higher, the thinner
    before = np.flatnonzero(np.diff(band))
    cuts = np.unique(way[before + (band[before] < band[before + 1])])
    row = np.minimum(np.searchsorted(upto, cuts), len(rows) - 1)
    share = 1 - (upto[row] - cuts) / path.lengths[rows[row]]
    row, share = row[(share > NEAR) & (share < 1 - NEAR)], share[(share > NEAR) & (share < 1 - NEAR)]
    more = np.bincount(row, minlength=len(rows))
    counts = np.ones(len(path), dtype=np.int64)
    counts[rows] += more
    until = np.ones(counts.sum())
    until[(np.cumsum(counts) - counts)[rows[row]] + counted(more)[1]] = share
    path, source = divided(path, counts, until)
    rows = np.flatnonzero(np.isin(source, rows))
    end = np.cumsum(path.lengths[rows])
    # What counts for a row is from the last place before it to the first one behind it: nothing is thicker between two places.
    first = np.maximum(np.searchsorted(way, end - path.lengths[rows] + NEAR, side="right") - 1, 0)
    last = np.minimum(np.searchsorted(way, end - NEAR) + 1, len(way))
    thickest = np.maximum.reduceat(np.append(thickness, 0.0), np.stack([first, last], axis=1).ravel())[::2]
    feeds, feed = np.minimum(most, rate / np.maximum(thickest, 1e-300)), path.feed.copy()
    feed[rows] = feeds
    return path.replace(feed=feed), feeds[np.minimum(np.searchsorted(end, way - NEAR), len(rows) - 1)]


def _at_level(path: Toolpath, level: float) -> np.ndarray:
    """Which rows run at a level, those of entries left out."""
    flat = (np.abs(path.start[:, 2] - level) < NEAR) & (np.abs(path.end[:, 2] - level) < NEAR) & (path.kind != Kind.RAPID)
    entry = np.array([label.startswith("entry") for label in path.labels])
    return np.asarray(flat & ~entry[path.label])
