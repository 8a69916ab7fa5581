"""What every design can be asked for from outside: a file, a drawing, a body in space."""

from __future__ import annotations

from abc import ABC, abstractmethod
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mnclab.text.given import fitting_class

if TYPE_CHECKING:
    import pyvista
    from matplotlib.figure import Figure

    from mnclab.workpiece.workpiece import Workpiece


@fitting_class
class AsDrawn(ABC):
    """A part as drawn, milled or turned: its doors."""

    @abstractmethod
    def workpiece(self, step: float | None = None) -> Workpiece:
        """The finished part, as `run.workpiece()` would have it of a perfect program; `step` mm of its cells."""

    @staticmethod
    def load(path: str | Path) -> Any:
        """The design of a TOML file, a `Design` or a `TurnedDesign`; an Alarm shows the line that is wrong."""
        from mnclab.design.model.design_file import load

        return load(path)

    def save(self, path: str | Path, **options: Any) -> Path:
        """Write one file: toml the design; svg, pdf, png, dxf its drawing; stl, gltf, glb, vtk, csv its body."""
        from mnclab.design.model.saving import save

        return save(self, path, **options)

    def plot(self, **options: Any) -> Figure:
        """The dimensioned drawing in true size; `size` "A4", "A4 landscape", "A3" or "A2", `scale` 0.5 for 1:2, and `sheet`."""
        from mnclab.design.drawing import plot

        return plot(self, **options)

    def scene(self, **options: Any) -> pyvista.Plotter:
        """The part as a body (needs pyvista)."""
        return self.workpiece().scene(**{"colour": "none"} | options)
