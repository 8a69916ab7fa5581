"""What the page needs of a part that a probe meets: the map of its heights, and the touches with their numbers."""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.path.toolpath import Toolpath
from mnclab.show.felt import Felt
from mnclab.show.player.logs import log, parted
from mnclab.show.player.packing import Packer
from mnclab.show.player.part import NOTHING, PARTS
from mnclab.workpiece.milling.raster import Raster

CELLS = 200  # along the longer side of the part
DIGITS = 4


def felt_part(pack: Packer, found: Felt, path: Toolpath) -> dict[str, Any]:
    """The part as `player.part` has a blank, which no row cuts."""
    ends = _ends(found, path)
    step = float((ends[1] - ends[0])[:2].max()) / CELLS
    ends[0, :2], ends[1, :2] = ends[0, :2] - step, ends[1, :2] + step  # all its sides are walls of the map
    raster = Raster.over(ends, step)
    y, x = (each.ravel() for each in np.meshgrid(raster.y, raster.x, indexing="ij"))
    low, high = ends[:, 2].tolist()
    top = np.nan_to_num(found.heights(x, y, low, high, raster.step), nan=low)
    nothing = np.zeros(len(path))
    return {
        "low": list(raster.low),
        "high": ends[1, :2].tolist(),
        "step": raster.step,
        "shape": list(raster.shape),
        "parts": PARTS,
        "top": pack.add(parted(top, PARTS)),
        "floor": pack.add(parted(np.full(len(top), low), PARTS)),
        "cutters": [],
        "which": log(pack, nothing),
        "does": log(pack, np.full(len(path), NOTHING)),
        "lift": log(pack, nothing),
        "note": "",
    }


def felt_touches(found: Felt | None, path: Toolpath) -> dict[str, Any]:
    """The corners of what is to be seen, the ends of a beam, and of each touch its row, its place and what is written there."""
    if found is None:
        return {"corners": [], "touches": [], "beam": []}
    touches = zip(found.rows, found.places.round(DIGITS).tolist(), found.texts)
    corners = _ends(found, path).round(DIGITS).tolist() if found.part is not None or found.beam is not None else []
    beam = [] if found.beam is None else found.beam.round(DIGITS).tolist()
    told = [{"row": row, "at": at, "text": text} for row, at, (text, _) in touches]
    return {"corners": corners, "touches": told, "beam": beam}


def _ends(found: Felt, path: Toolpath) -> Any:
    return found.ends(path.bounds if len(path) else np.zeros((2, 3)))
