"""The part as a drawing has it: features on a blank, with their exact body.

`shapes` are outlines by their sizes, `features` what a mill makes, `removals` the simple bodies that these take away,
`slabs` the part as a stack of them: section, volume, distance; `design` puts it together.
"""

from mnclab.workpiece.design.design import Design
from mnclab.workpiece.design.features import Chamfer, Face, Feature, Groove, Hole, Pocket, Slot, Stud
from mnclab.workpiece.design.shapes import Circle, Outline, Rectangle

__all__ = [
    "Chamfer", "Circle", "Design", "Face", "Feature", "Groove", "Hole", "Outline", "Pocket", "Rectangle", "Slot", "Stud",
]  # fmt: skip
