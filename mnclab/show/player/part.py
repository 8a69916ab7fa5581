"""What the page needs to cut the part while it plays: the blank as two maps, and of each row its cutter and whether it cuts.

The page sweeps the cutters itself (`swept.js`), by the formulas of `workpiece/milling`; nothing is computed beforehand.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show.player.logs import log, parted
from mnclab.show.player.packing import Packer
from mnclab.text.alarm import several
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.cutters import cutter_of
from mnclab.workpiece.milling.raster import Raster

CELLS = 300  # along the longer side of the blank
PARTS = 1e4  # of a millimetre, of the blank's heights
#: What a row does to the part: nothing, cuts all along its way, or only where it arrives.
NOTHING, CUTS, ARRIVES = range(3)


def part(pack: Packer, cutting: Cutting, path: Toolpath) -> dict[str, Any]:
    """The part of a mill; `path` is the one that the page plays, which may stand lower than what is cut."""
    bounds = cutting.stock.bounds
    raster = Raster.over(bounds, float((bounds[1] - bounds[0])[:2].max()) / CELLS)
    y, x = (each.ravel() for each in np.meshgrid(raster.y, raster.x, indexing="ij"))
    low = float(bounds[0, 2])  # beside the blank nothing is left
    floor, top = (np.nan_to_num(side, nan=low) for side in cutting.stock.faces(x, y))
    tilted = np.zeros(len(path), dtype=bool) if cutting.tilted is None else cutting.tilted
    does = np.where(cutting.cuts & ~tilted, np.where(cutting.from_home, ARRIVES, CUTS), NOTHING)
    return {
        "low": list(raster.low),
        "high": bounds[1, :2].tolist(),
        "step": raster.step,
        "shape": list(raster.shape),
        "parts": PARTS,
        "top": pack.add(parted(top, PARTS)),
        "floor": pack.add(parted(floor, PARTS)),
        "cutters": [list(cutter_of(tool)) for tool in cutting.tools],
        "which": log(pack, cutting.which),
        "does": log(pack, does),
        "lift": log(pack, cutting.path.start[:, 2] - path.start[:, 2]),
        "note": _note(int((tilted & np.isin(path.kind, (Kind.LINE, Kind.ARC))).sum())),
    }


def _note(tilted: int) -> str:
    return f"{several(tilted, 'move')} of a tool not along Z: not cut here" if tilted else ""
