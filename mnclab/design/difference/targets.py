"""Whatever a part may be compared with: a design or its file, another workpiece, a run, a body from a file or a mesh."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mnclab.design.difference.body_target import MeshTarget, PartTarget
from mnclab.design.difference.drawn_target import DrawnTarget
from mnclab.design.difference.half_target import HalfTarget
from mnclab.design.difference.target import Target
from mnclab.design.model.design import Design
from mnclab.design.model.drawn import Drawn
from mnclab.design.model.drawn_turned import DrawnTurned
from mnclab.design.model.turned_design import TurnedDesign
from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import Array
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.part.mesh import Mesh, is_mesh, mesh_of, read_mesh
from mnclab.workpiece.turning.turned import Turned
from mnclab.workpiece.workpiece import Workpiece

HINT = "workpiece.compare(design), another workpiece or run, or the path of a .toml, .stl or .glb file"
NAMES = {True: "turned", False: "milled"}


def target_of(given: Any, workpiece: Milled, tolerance: float) -> Target:
    """What a milled part is compared with."""
    found = _found(given)
    if isinstance(found, Design):
        return DrawnTarget(found, tolerance)
    if isinstance(found, Milled):
        return PartTarget(found, _shift(found, workpiece), workpiece.step, tolerance)
    if isinstance(found, Mesh):
        return MeshTarget(found, tolerance)
    raise _other(found, lathe=False)


def half_target_of(given: Any, workpiece: Turned) -> HalfTarget:
    """What a turned part is compared with."""
    found = _found(given)
    if isinstance(found, TurnedDesign):
        return HalfTarget(found.title or "design", found.section, design=found)
    if isinstance(found, Turned):
        dz = float(_shift(found, workpiece)[2])
        section = [Contour(loop.points + (dz, 0.0), loop.bulge) for loop in found.section]
        return HalfTarget("the other workpiece", section, found.error)
    if isinstance(found, Mesh):
        return HalfTarget(found.name, found.half_section(workpiece.axis), found.error)
    raise _other(found, lathe=True)


def _found(given: Any) -> Any:
    """A design, a workpiece or a mesh, of whatever was given."""
    if isinstance(given, str | Path):
        if Path(given).suffix.lower() == ".toml":
            return Design.load(given)
        return read_mesh(Path(given))
    if isinstance(given, Drawn | DrawnTurned):
        return given.design
    if isinstance(given, Design | TurnedDesign | Workpiece):
        return given
    if is_mesh(given):
        return mesh_of(given)
    if hasattr(given, "toolpath") and hasattr(given, "workpiece"):  # a run, of whom this room knows nothing else
        return given.workpiece()
    raise Alarm(f"a part is compared with a design, another workpiece, a run or a mesh, got {shown(given)}", hint=HINT)


def _shift(other: Workpiece, workpiece: Workpiece) -> Array:
    """By how much (3,) another workpiece is moved into the coordinates of this one: both stand on one machine.

    What nothing cut, and stands at the zero of the machine, is taken to be in the coordinates of this one.
    """
    if not len(other.cutting) and not np.any(other.cutting.origin):
        return np.zeros(3)
    return np.asarray(np.subtract(other.cutting.origin, workpiece.cutting.origin), dtype=np.float64)


def _other(found: Any, lathe: bool) -> Alarm:
    return Alarm(f"a {NAMES[lathe]} part is compared with one that is {NAMES[lathe]}, got {shown(found)}", hint=HINT)
