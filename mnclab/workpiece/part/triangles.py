"""A body of triangles as a part: a file (STL and others), or what pyvista has."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mnclab.text.alarm import Alarm
from mnclab.text.given import shown
from mnclab.workpiece.part.part import Part

AT_ONCE = 16  # places that a probe looks at in one go: each of them searches the triangles


def mesh(given: Any) -> Part:
    """A closed body of triangles as a part, mm: the path of a file (STL, PLY, OBJ …), or a mesh of pyvista."""
    from mnclab.workpiece.part.mesh import SUFFIXES, is_mesh, mesh_of, read_mesh

    if isinstance(given, str | Path):
        if Path(given).suffix.lower() not in SUFFIXES:
            raise Alarm(f"a mesh is a file {', '.join(SUFFIXES)}, got {shown(str(given))}")
        body = read_mesh(Path(given))
    elif is_mesh(given):
        body = mesh_of(given)
    else:
        raise Alarm(f"a mesh is the path of a file or a body of pyvista, got {shown(given)}")
    return Part(body.distance, body.name, AT_ONCE, body.bounds)
