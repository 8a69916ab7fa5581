"""A part as a file: a closed body (stl, gltf, glb, vtk), a picture (svg, pdf, png), or its numbers (csv).

Bodies are in millimetres, glTF in metres with Y upwards as the format wants it. VTK holds the row, line and tool that
cut each triangle. The table of a milled part has its heights at the middles of the cells, X to the right and Y downwards;
that of a turned one the corners of its half section.
"""

from __future__ import annotations

import csv
from collections.abc import Callable
from inspect import signature
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from mnclab.show.export_mesh import STOCK, Gltf, stl_of
from mnclab.show.solids import Body
from mnclab.text.alarm import Alarm
from mnclab.text.file import named, replaced
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled
    from mnclab.workpiece.turning.turned import Turned


def save(workpiece: Workpiece, path: str | Path, **options: Any) -> Path:
    """Write a part to one file and return its path; pictures take the options of `Workpiece.plot`."""
    path, suffix = named(path, WRITERS, "cannot write a part as {}")
    writer = WRITERS[suffix]
    if options and len(signature(writer).parameters) == 2:
        raise Alarm(f"{suffix} files have no options, got {', '.join(options)}")
    with replaced(path) as beside:
        writer(workpiece, beside, **options)
    return path


def write_stl(workpiece: Workpiece, path: Path) -> None:
    """The part as a binary STL, which knows no unit: the numbers are millimetres."""
    solid = workpiece.solid()
    path.write_bytes(stl_of(solid.points[solid.triangles], "mnclab part, millimetres"))


def write_gltf(workpiece: Workpiece, path: Path) -> None:
    """The part as glTF; the suffix .glb makes the binary form."""
    solid = workpiece.solid()
    gltf = Gltf("part")
    gltf.body("part", Body(solid.points, solid.triangles), STOCK)
    gltf.write(path)


def write_vtk(workpiece: Workpiece, path: Path) -> None:
    """A legacy VTK file of triangles; row, line and tool are -1 where the blank is untouched."""
    points, triangles, row = workpiece.solid()
    cutting = workpiece.cutting
    cells = np.insert(triangles, 0, 3, axis=1)
    head = "# vtk DataFile Version 3.0\npart of mnclab, millimetres\nBINARY\nDATASET POLYDATA\n"
    with path.open("wb") as file:
        file.write(f"{head}POINTS {len(points)} double\n".encode() + points.astype(">f8").tobytes())
        file.write(f"\nPOLYGONS {len(cells)} {cells.size}\n".encode() + cells.astype(">i4").tobytes())
        file.write(f"\nCELL_DATA {len(cells)}\n".encode())
        for name, column in (("row", np.arange(len(cutting))), ("line", cutting.path.line), ("tool", cutting.numbers)):
            values = np.where(row >= 0, cutting.of_rows(column, row), -1)
            file.write(f"SCALARS {name} int 1\nLOOKUP_TABLE default\n".encode() + values.astype(">i4").tobytes() + b"\n")


def write_figure(workpiece: Workpiece, path: Path, **options: Any) -> None:
    """The picture of `Workpiece.plot`."""
    from mnclab.show.plot.part import plot_part
    from mnclab.show.plot.picture import write

    write(plot_part(workpiece, **options), path)


def write_csv(workpiece: Workpiece, path: Path) -> None:
    """Heights of a milled part as a table, corners of the half section of a turned one."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if workpiece.cutting.lathe:
            writer.writerow(["contour", "z", "radius", "bulge"])
            for number, contour in enumerate(cast("Turned", workpiece).section):
                corners = zip(*contour.points.T.tolist(), contour.bulge.tolist())
                writer.writerows((number, *corner) for corner in corners)
            return
        part = cast("Milled", workpiece)
        writer.writerow(["y", *part.x.tolist()])
        writer.writerows([y, *heights] for y, heights in zip(part.y.tolist(), part.heights.tolist()))


WRITERS: dict[str, Callable[..., None]] = {
    ".stl": write_stl,
    ".gltf": write_gltf,
    ".glb": write_gltf,
    ".vtk": write_vtk,
    ".svg": write_figure,
    ".pdf": write_figure,
    ".png": write_figure,
    ".csv": write_csv,
}
