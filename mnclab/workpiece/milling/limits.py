"""What a map of heights cannot hold of a milled part, in sentences for people."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mnclab.path.toolpath import Array, Index, Kind
from mnclab.text.alarm import several
from mnclab.workpiece.blank import Revolved
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.moves import STILL
from mnclab.workpiece.milling.raster import NOISE
from mnclab.workpiece.milling.sweep import Sweep
from mnclab.workpiece.turning.revolved import overhangs

MANY = 20_000  # moves, beyond which undercuts are not looked for
THREADS = ("tap", "thread mill")


def notes_of(cutting: Cutting, sweep: Sweep) -> Iterator[str]:
    """What is left out, and what looks other than it is."""
    yield from cutting.notes()
    if cutting.tilted is not None and (out := cutting.cuts & cutting.tilted).any():
        number = int(out.sum())
        left = "is" if number == 1 else "are"
        yield f"{several(number, 'row')} of a tool not along Z {left} left out ({cutting.lines(out)})"
    cuts = cutting.cuts
    for kind in THREADS:
        numbers = [number for number, tool in enumerate(cutting.tools) if tool.kind == kind]
        if (threads := cuts & (cutting.path.kind != Kind.RAPID) & np.isin(cutting.which, numbers)).any():
            yield f"a thread is shown without its flanks, at the radius of the {kind} ({cutting.lines(threads)})"
    necks = np.array([_neck(tool.shank, tool.effective_radius) for tool in cutting.tools])[cutting.which]
    thin, under = cuts & np.isfinite(necks), np.zeros(len(cutting), dtype=bool)
    if thin.any() and len(sweep.moves) > MANY:
        yield f"undercuts are not looked for; there may be some where a tool is thinner above ({cutting.lines(thin)})"
    elif thin.any():
        under[undercuts(necks, sweep)] = True
    if under.any():
        yield f"what overhangs an undercut is not shown: there the part is open upwards ({cutting.lines(under)})"
    half = cutting.stock.half_section() if hasattr(cutting.stock, "half_section") else None
    if half is not None and overhangs(half[0]):
        yield "what overhangs in the turned blank is not shown: seen from above it is full down to its lowest place"
    if isinstance(cutting.stock, Revolved) and cutting.stock.axis != "Z" and cutting.stock.bore > 0:
        yield "the bore of a lying blank is not shown"


def undercuts(necks: Array, sweep: Sweep) -> Index:
    """Rows that take a tool sideways under material that reaches above its edges, which are `necks` (n,) high, mm."""
    moves, rows = sweep.moves, []
    neck = necks[moves.row]
    sideways = (np.hypot(*(moves.end - moves.start)[:, :2].T) > STILL) | moves.arc
    for tile in sweep.tiles:
        x, y = sweep.raster.middles(tile)
        for which, before, after in sweep.in_order(x, y):
            over = (before > after + neck[which, None] + NOISE).any(axis=1) & sideways[which]
            rows.append(moves.row[which[over]])
    return np.unique(np.concatenate([np.zeros(0, dtype=np.int64), *rows]))


def _neck(shank: tuple[float, float] | None, radius: float) -> float:
    """How far above the tip a tool becomes thinner, mm; infinite where it does not."""
    return shank[1] if shank is not None and shank[0] < radius - NOISE else np.inf
