"""What the page needs of a machine whose rotary axes swing the tip: its chain, lengths of tools, tilted planes."""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.geometry.kinematics import Kinematics
from mnclab.path.toolpath import Array, Toolpath
from mnclab.show.chains import tilted_planes
from mnclab.show.player.part import Packer, changes, log


def turns(path: Toolpath) -> bool:
    """Whether rotary axes swing the tip anywhere; what lies on a cylinder is shown on its drum."""
    return path.kinematics is not None and bool(path.rotary.any()) and not path.cylinders


def _chain(kinematics: Kinematics, origin: Array) -> dict[str, Any]:
    """Head and table, each from the machine on."""
    found = {}
    for side, axes, off in (("head", kinematics.head, 0.0), ("table", kinematics.table, origin)):
        told = [{"name": axis.name, "number": axis.number, "line": axis.direction} for axis in axes]
        found[side] = [one | {"centre": (np.array(axis.centre) - off).tolist()} for one, axis in zip(told, axes)]
    return found


def _last(path: Toolpath, step: int) -> int:
    """The last row of a step, from which on counts what it has corrected; the next row where it has none."""
    after = int(np.searchsorted(path.step, step, "right"))
    return after - 1 if after and path.step[after - 1] == step else after


def machine(pack: Packer, run: Any) -> dict[str, Any] | None:
    """The axes from the machine to the tool and to the part, centres of a table in coordinates of the path, those of a head from
    the spindle reference; the lengths are that before the first row and those after each. None where nothing turns."""
    path, kinematics = run.toolpath, run.toolpath.kinematics
    if not turns(path):
        return None
    (steps, planes), axes = tilted_planes(run), run.axes()
    corrected = [(_last(path, step), found) for step, found in run.history.changed("kinematics") if found != kinematics]
    return {
        **_chain(kinematics, path.origin),
        "corrected": [{"row": row, **_chain(found, path.origin)} for row, found in corrected],
        "home": np.degrees(kinematics.home).tolist(),
        "length": log(pack, np.append(axes.first, axes.lengths)),
        "plane": changes(pack, steps, [None if plane is None else plane.tolist() for plane in planes]),
    }
