"""Designs written to files: the design itself (toml), its drawing (svg, pdf, png, dxf), its body (stl, gltf, glb, vtk, csv)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mnclab.design.model.design_file import text_of
from mnclab.text.alarm import Alarm
from mnclab.text.file import named, replaced

DRAWN = (".svg", ".pdf", ".png", ".dxf")
BODIES = (".stl", ".gltf", ".glb", ".vtk", ".csv")


def save(design: Any, path: str | Path, **options: Any) -> Path:
    """Write one file and return its path; drawings take the options of `plot`, bodies those of `workpiece`."""
    path, suffix = named(path, (".toml", *DRAWN, *BODIES), "cannot write a design as {}")
    if suffix in DRAWN:
        return _drawing(design, path, **options)
    if suffix in BODIES:
        return Path(design.workpiece(**options).save(path))
    if options:
        raise Alarm(f"{suffix} files have no options, got {', '.join(options)}")
    text = text_of(design)
    with replaced(path) as beside:
        try:
            beside.write_text(text, encoding="utf-8", newline="\n")
        except UnicodeEncodeError as error:
            raise Alarm(f"the design cannot be written: {error.object[error.start]!r} is no character") from None
    return path


def _drawing(design: Any, path: Path, **options: Any) -> Path:
    from mnclab.design.drawing import save

    return save(design, path, **options)
