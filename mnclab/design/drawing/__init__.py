"""Technical drawings: views with their dimensions on sheets, by the ISO standards of drawing practice.

`of_design` draws designs, `milled` and `turned` make their views; the rest knows nothing of designs. `view` holds the plain
data that a drawing is made of, `sheet` the paper with its frame and title block. `draw(views, title)` in `drawing` lays them
out: `dimension_places` offers where a dimension may stand, `placing` says which place is free and what it costs, `layout` takes
the best and puts the views on a sheet, at the largest scale that fits. What comes out are strokes,
arrowheads and labels in millimetres of the paper (`ink`), which `figure` draws with matplotlib and `dxf` writes for CAD.
"""

from mnclab.text.opening import require

require("matplotlib", "drawings")  # which measure their text with it, before they draw

from mnclab.design.drawing.of_design import drawing, plot, save  # noqa: E402

__all__ = ["drawing", "plot", "save"]
