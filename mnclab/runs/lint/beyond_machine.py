"""A speed or a feed that the machine does not have: it turns and moves as fast as it can, and no faster.

Said where somebody has said what the machine can do (`Setup.limits`): the usual limits are a guess, and say nothing of a
program. Manuals are silent about it, controls hold the speed at the limit without a word. A constant cutting speed (G96) is
held at the limit on purpose, threads have a remark of their own (`motion`). What an arc needs of an axis depends
on where it goes: of arcs only what no direction allows is named.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.limits import Limits
from mnclab.path.listing import figure
from mnclab.path.toolpath import Array, Index, Kind, Mask
from mnclab.runs.lint.once import warn_once
from mnclab.text.alarm import Alarm

if TYPE_CHECKING:
    from mnclab.runs.run import Run

MORE = 1 + 1e-9
SMALL = 1e-9  # mm


def remarks(run: Run) -> Iterator[Alarm]:
    """A warning at the first such speed and one at the first such feed, which count the others."""
    if run.setup.limits != Limits() and len(run.toolpath):
        yield from _speeds(run)
        yield from _feeds(run)


def _speeds(run: Run) -> Iterator[Alarm]:
    path, most = run.toolpath, run.setup.limits.spindle
    turning = np.abs(path.spindle)
    rows = _begun((turning > most * MORE) & np.isnan(path.surface), turning, np.arange(len(path)))
    if len(rows):
        message = f"the spindle cannot turn at {figure(float(turning[rows[0]]), 1)} rev/min: it goes {most:g} at most"
        yield warn_once(run, path.step[rows].tolist(), message, f"S{most:g} at most, or other limits of the machine", "S")


def _feeds(run: Run) -> Iterator[Alarm]:
    path, limits = run.toolpath, run.setup.limits
    arc, lengths = path.kind == Kind.ARC, path.lengths
    rate = np.where(np.isfinite(path.per_rev), path.per_rev * np.minimum(np.abs(path.spindle), limits.spindle), path.feed)
    plain = ((path.kind == Kind.LINE) | arc) & ~path.synchronous & np.isnan(path.time) & (lengths > SMALL) & np.isfinite(rate)
    plain &= np.isnan(path.surface) | np.isnan(path.per_rev)
    if not plain.any():
        return
    most = limits.axes("rapid") * 60
    share = np.abs(path.end - path.start) / np.maximum(lengths, SMALL)[:, None]
    allowed = np.where(arc, np.linalg.norm(most), (most / np.maximum(share, SMALL)).min(axis=1))
    rows = _begun(rate > allowed * MORE, rate, np.flatnonzero(plain))
    if len(rows):
        row, unit = int(rows[0]), path.unit
        fed, held = (f"{figure(float(each) / unit.length, 1)} {unit.short}/min" for each in (rate[row], allowed[row]))
        message = f"the machine cannot feed at {fed}: its axes go {held} at most on this way"
        yield warn_once(run, path.step[rows].tolist(), message, "a smaller feed, or other limits of the machine", "F")


def _begun(over: Mask, value: Array, rows: Index) -> Index:
    """Those of some rows where a value that is too great begins: it stays until another one is programmed."""
    over, value = over[rows], value[rows]
    goes_on = over[1:] & over[:-1] & (value[1:] == value[:-1])
    return np.asarray(rows[over & ~np.append(False, goes_on)])
