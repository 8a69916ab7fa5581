"""A run as a file: pictures (svg, pdf, png), the table of moves (csv), everything for other programs (json), drawings
(dxf), plain blocks (ngc), the part as a body or the path as bodies and lines in space (stl, gltf, glb, vtk).

The suffix says what is written, and exactly one file is. The same run gives the same bytes; text is UTF-8 with plain
line ends on every system. A new kind of file is a function here and a line in `WRITERS`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.path.toolpath import COLUMNS
from mnclab.show import export_mesh
from mnclab.show.export_drawing import write_dxf, write_true_size
from mnclab.show.export_gcode import write_gcode
from mnclab.text.alarm import Alarm
from mnclab.text.columns import filled, parts, spelled
from mnclab.text.file import named, save_as
from mnclab.text.given import choice
from mnclab.text.tables import write_picture


def save(run: Any, path: str | Path, **options: Any) -> Path:
    """Write a run to one file and return its path; an Alarm when nothing of this suffix can be written.

    Figures take the options of `Run.plot`; an svg also `true_size=True`, a drawing in true millimetres. Bodies (stl, gltf,
    glb, vtk) are those of the part, with `of="path"` those of the path. Where rotary axes swing the tip, all files say where
    it is on the part, as it lies with these axes at zero; only ngc says where the axes stand.
    """
    path, suffix = named(path, WRITERS, refused := "cannot write {} files")
    if suffix in BODIES:
        return save_as(run, path, {suffix: _body(run, suffix, **options)}, refused)
    return save_as(run, path, WRITERS, refused, **options)


def _body(run: Any, suffix: str, of: str = "part", **more: Any) -> Callable[..., None]:
    """What writes a body of the part or of the path; an Alarm where there is no part."""
    if more:
        raise Alarm(f"{suffix} files know the option of, got {', '.join(more)}")
    of_part, of_path = BODIES[suffix]
    if choice(of, "of", OF) == "path":
        return of_path
    if run.stock is None:
        raise Alarm("there is no blank, and so no part to write", hint='of="path" writes the path')
    return lambda run, path: of_part(run.workpiece(), path)


def write_csv(run: Any, path: Path) -> None:
    """The columns of the toolpath under their names; `kind` and `label` as text, numbers with all their digits."""
    with path.open("w", encoding="utf-8", errors="replace", newline="") as file:
        file.writelines(run.toolpath.csv_parts())


def write_json(run: Any, path: Path) -> None:
    """The run as one JSON object, see `document`."""
    with path.open("w", encoding="utf-8", newline="\n") as file:
        file.writelines(document(run))
        file.write("\n")


def document(run: Any) -> Iterator[str]:
    """Summary, alarms and columns of a run as the pieces of one JSON object: nan (no value) and inf (rapid feed) are null."""
    path, summary = run.toolpath, run.summary()
    for name, value in summary.items():
        if isinstance(value, float):
            summary[name] = round(value, 6) if np.isfinite(value) else None
    head = {
        "summary": summary,
        "ok": run.ok,
        "alarms": [alarm.without_folders().as_dict() for alarm in run.alarms],
        **({"measurements": run.measurements.as_dicts()} if run.measurements else {}),
        "lathe": path.lathe,
        "origin": path.origin.tolist(),
        "meaning": {name: ", ".join(filter(None, (each.meaning, each.unit))) for name, each in COLUMNS.items()},
    }
    yield json.dumps(head, allow_nan=False).removesuffix("}") + ', "columns": {'
    names = {name: [*map(json.dumps, texts)] for name, texts in path.names.items()}
    for k, (name, column) in enumerate(path.columns().items()):
        yield f'{", " * (k > 0)}"{name}": ['
        for rows in parts(len(path)):
            some = spelled(names[name], column[rows]) if name in names else _plain(column[rows])
            yield ", " * (rows.start > 0) + filled("%s, ", [some]).removesuffix(", ")
        yield "]"
    yield "}}"


def _plain(column: NDArray[Any]) -> NDArray[Any]:
    """A column (n,), not empty, as JSON has its values."""
    if column.strides == (0,):  # a constant
        return np.broadcast_to(_plain(column[:1].copy()), len(column))
    if column.dtype == np.bool_:
        return spelled(("false", "true"), column.view(np.uint8))
    known = np.isfinite(column)
    return column if known.all() else np.where(known, column.astype(object), "null")


OF = ("part", "path")
BODIES: dict[str, tuple[Callable[..., None], Callable[..., None]]] = {
    ".stl": (export_mesh.write_part_stl, export_mesh.write_stl),
    ".gltf": (export_mesh.write_part_gltf, export_mesh.write_gltf),
    ".glb": (export_mesh.write_part_gltf, export_mesh.write_gltf),
    ".vtk": (export_mesh.write_part_vtk, export_mesh.write_vtk),
}
WRITERS: dict[str, Callable[..., None]] = {
    ".svg": lambda run, path, true_size=False, **more: (write_true_size if true_size else write_picture)(run, path, **more),
    ".pdf": write_picture,
    ".png": write_picture,
    ".csv": write_csv,
    ".json": write_json,
    ".html": lambda run, path: run.player().write(path),
    ".dxf": write_dxf,
    ".ngc": write_gcode,
    **{suffix: of_path for suffix, (_, of_path) in BODIES.items()},
}
