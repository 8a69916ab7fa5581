"""What the page needs of a machine whose rotary axes swing the tip: its chain, lengths of tools, tilted planes."""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.path.toolpath import Toolpath
from mnclab.show.chains import tilted_planes
from mnclab.show.player.part import Packer, changes, log


def turns(path: Toolpath) -> bool:
    """Whether rotary axes swing the tip anywhere; what lies on a cylinder is shown on its drum."""
    return path.kinematics is not None and bool(path.rotary.any()) and not path.cylinders


def machine(pack: Packer, run: Any) -> dict[str, Any] | None:
    """The axes from the machine to the tool and to the part, centres of a table in coordinates of the path, those of a head from
    the spindle reference; None where nothing turns."""
    path, kinematics = run.toolpath, run.toolpath.kinematics
    if not turns(path):
        return None
    steps, planes = tilted_planes(run)
    head, table = (
        [{"name": axis.name, "number": axis.number, "centre": (np.array(axis.centre) - off).tolist(), "line": axis.direction}
         for axis in axes]
        for axes, off in ((kinematics.head, 0.0), (kinematics.table, path.origin))
    )  # fmt: skip
    return {
        "head": head,
        "table": table,
        "home": np.degrees(kinematics.home).tolist(),
        "length": log(pack, run.axes().lengths),
        "plane": changes(pack, steps, [None if plane is None else plane.tolist() for plane in planes]),
    }
