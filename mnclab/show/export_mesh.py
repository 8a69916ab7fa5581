"""Bodies as files for 3D programs, STL, glTF and VTK, written without any of them: the path of a run, and its part.

The path:

- STL holds the cuts as thin tubes and the tool where it ends, to lay over a part in another program. STL knows
  triangles alone: no colour, no rapids, no unit (the numbers are millimetres).
- glTF (`.gltf`, or `.glb` in one binary piece) holds lines in the colours of the pictures, the tool and the blank;
  metres and Y upwards, as the format wants it.
- VTK (legacy `.vtk`) holds a polyline for every move, double precision, with the columns of the path beside them:
  for ParaView and pyvista.
"""

from __future__ import annotations

import base64
import csv
import json
import struct
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from mnclab.show import looks
from mnclab.show.solids import Body, size_of, stock_of, strokes, tool_of, tubes
from mnclab.text.file import save_as
from mnclab.text.tables import write_picture
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled
    from mnclab.workpiece.turning.turned import Turned

CHORD = 0.01  # mm
TUBE = 1 / 500  # radius of a tube in parts of the path's size
BESIDE = ("kind", "line", "step", "tool", "feed", "spindle")  # columns that VTK gets
TO_GLTF = [0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1]  # mm and Z up -> m and Y up, by columns


def write_stl(run: Any, path: Path) -> None:
    """Write the cuts as tubes and the tool as a binary STL."""
    toolpath = run.toolpath
    bodies = [tubes(toolpath, TUBE * size_of(toolpath), CHORD), *filter(None, [tool_of(run)])]
    facets = np.concatenate([body.points[body.triangles] for body in bodies])
    path.write_bytes(stl_of(facets, "mnclab tool path, millimetres"))


def stl_of(facets: NDArray[np.float64], title: str) -> bytes:
    """Triangles (m, 3, 3) as a binary STL."""
    table = np.zeros(len(facets), dtype=[("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("more", "<u2")])
    normal = np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    table["normal"], table["corner"] = normal / np.where(length > 0, length, 1.0), facets
    return title.encode().ljust(80) + struct.pack("<I", len(table)) + table.tobytes()


Parts = list[dict[str, Any]]


class Gltf:
    """The parts of a glTF document: a buffer, and what points into it; `name` is that of the whole."""

    def __init__(self, name: str) -> None:
        self.name, self.buffer = name, bytearray()
        self.views, self.accessors, self.materials, self.meshes = Parts(), Parts(), Parts(), Parts()

    def array(self, values: NDArray[Any], kind: str, target: int) -> int:
        """An array in the buffer; float32 points or uint32 indices."""
        points = kind == "VEC3"
        data = np.ascontiguousarray(values, dtype="<f4" if points else "<u4")
        self.views.append({"buffer": 0, "byteOffset": len(self.buffer), "byteLength": data.nbytes, "target": target})
        self.buffer += data.tobytes()
        limits = {"min": data.min(axis=0).tolist(), "max": data.max(axis=0).tolist()} if points else {}
        accessor = {"bufferView": len(self.views) - 1, "componentType": 5126 if points else 5125, "type": kind}
        self.accessors.append({**accessor, "count": len(data), **limits})
        return len(self.accessors) - 1

    def material(self, name: str, colour: str, alpha: float = 1.0) -> int:
        """A colour; glTF counts linearly, the colours here are those of a screen."""
        linear = [((c + 0.055) / 1.055) ** 2.4 if c > 0.04 else c / 12.92 for c in looks.rgb(colour)]
        surface = {"baseColorFactor": [*linear, alpha], "metallicFactor": 0, "roughnessFactor": 0.7}
        look = {"name": name, "pbrMetallicRoughness": surface}
        self.materials.append(look | ({"alphaMode": "BLEND"} if alpha < 1 else {}))
        return len(self.materials) - 1

    def lines(self, name: str, pieces: NDArray[np.float64], colour: str) -> None:
        """Separate strokes (n, 2, 3)."""
        if len(pieces):
            part = {"attributes": {"POSITION": self.array(pieces.reshape(-1, 3), "VEC3", 34962)}, "mode": 1}
            self.meshes.append({"name": name, "primitives": [part | {"material": self.material(name, colour)}]})

    def body(self, name: str, body: Body, colour: str, alpha: float = 1.0) -> None:
        part = {"attributes": {"POSITION": self.array(body.points, "VEC3", 34962)}, "mode": 4}
        part["indices"] = self.array(body.triangles.ravel(), "SCALAR", 34963)
        self.meshes.append({"name": name, "primitives": [part | {"material": self.material(name, colour, alpha)}]})

    def document(self, uri: str | None) -> bytes:
        """The JSON part, with the buffer beside it or in it as `uri`."""
        count = len(self.meshes)
        nodes: Parts = [{"name": mesh["name"], "mesh": k} for k, mesh in enumerate(self.meshes)]
        root: dict[str, Any] = {"name": self.name, "matrix": TO_GLTF}
        parts: dict[str, Any] = {"asset": {"version": "2.0", "generator": "mnclab"}, "scene": 0}
        nodes.append(root | ({"children": [*range(count)]} if count else {}))
        parts |= {"scenes": [{"nodes": [count]}], "nodes": nodes}
        if count:
            buffer = {"byteLength": len(self.buffer)} | ({"uri": uri} if uri else {})
            parts |= {"meshes": self.meshes, "materials": self.materials, "accessors": self.accessors}
            parts |= {"bufferViews": self.views, "buffers": [buffer]}
        return json.dumps(parts, separators=(",", ":")).encode()

    def write(self, path: Path) -> None:
        """Write the document as text with its buffer in it, or as one binary piece where the suffix is .glb."""
        data = bytes(self.buffer)
        if path.suffix.lower() != ".glb":
            uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
            path.write_bytes(self.document(uri) + b"\n")
            return
        text = self.document(None)
        text += b" " * (-len(text) % 4)
        data += bytes(-len(data) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        if data:
            chunks += struct.pack("<I4s", len(data), b"BIN\0") + data
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def write_gltf(run: Any, path: Path) -> None:
    """Write lines, tool and blank as glTF; the suffix .glb makes the binary form."""
    gltf = Gltf("tool path")
    pieces, row = strokes(run.toolpath, CHORD)
    for move in looks.MOVES:
        gltf.lines(move.name, pieces[np.isin(run.toolpath.kind[row], move.kinds)], move.line.colour)
    if tool := tool_of(run):
        gltf.body("tool", tool, looks.TOOL_BODY)
    if stock := stock_of(run):
        gltf.body("blank", stock, looks.BLANK_BODY, 0.3)
    gltf.write(path)


def write_vtk(run: Any, path: Path) -> None:
    """Write every move as a polyline of a legacy VTK file, with columns of the path as data of the cells."""
    toolpath = run.toolpath
    xyz, row = toolpath.points(CHORD)
    moves, count = np.unique(row[1:], return_counts=True)
    # every move has its start and then its points: a start stands before the first point of each move
    first = np.cumsum(count) - count
    points = np.insert(xyz[1:], first, toolpath.start[moves], axis=0)
    size = count + 1
    cells = np.insert(np.arange(len(points)), np.cumsum(size) - size, size)
    head = "# vtk DataFile Version 3.0\ntool path of mnclab, millimetres\nBINARY\nDATASET POLYDATA\n"
    head += f"POINTS {len(points)} double\n"
    with path.open("wb") as file:
        file.write(head.encode() + points.astype(">f8").tobytes())
        file.write(f"\nLINES {len(moves)} {len(cells)}\n".encode() + cells.astype(">i4").tobytes())
        file.write(f"\nCELL_DATA {len(moves)}\n".encode())
        for name in BESIDE:
            column = getattr(toolpath, name)[moves]
            real = column.dtype.kind == "f"
            file.write(f"SCALARS {name} {'double' if real else 'int'} 1\nLOOKUP_TABLE default\n".encode())
            file.write(column.astype(">f8" if real else ">i4").tobytes() + b"\n")


# A part as a file: a closed body (stl, gltf, glb, vtk), a picture (svg, pdf, png), or its numbers (csv).
# Bodies are in millimetres, glTF in metres with Y upwards as the format wants it. VTK holds the row, line and tool that
# cut each triangle. The table of a milled part has its heights at the middles of the cells, X to the right and Y downwards;
# that of a turned one the corners of its half section.


def save(workpiece: Workpiece, path: str | Path, **options: Any) -> Path:
    """Write a part to one file and return its path; pictures take the options of `Workpiece.plot`."""
    return save_as(workpiece, path, WRITERS, "cannot write a part as {}", **options)


def write_part_stl(workpiece: Workpiece, path: Path) -> None:
    """The part as a binary STL, which knows no unit: the numbers are millimetres."""
    solid = workpiece.solid()
    path.write_bytes(stl_of(solid.points[solid.triangles], "mnclab part, millimetres"))


def write_part_gltf(workpiece: Workpiece, path: Path) -> None:
    """The part as glTF; the suffix .glb makes the binary form."""
    solid = workpiece.solid()
    gltf = Gltf("part")
    gltf.body("part", Body(solid.points, solid.triangles), looks.BLANK_BODY)
    gltf.write(path)


def write_part_vtk(workpiece: Workpiece, path: Path) -> None:
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
    ".stl": write_part_stl,
    ".gltf": write_part_gltf,
    ".glb": write_part_gltf,
    ".vtk": write_part_vtk,
    **dict.fromkeys((".svg", ".pdf", ".png"), write_picture),
    ".csv": write_csv,
}
