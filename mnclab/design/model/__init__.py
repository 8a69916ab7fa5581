"""The part as a drawing has it: features on a blank, with their exact body.

`shapes` are outlines by their sizes, `features` what a mill makes, `removals` the simple bodies that these take away,
`slabs` the part as a stack of them: section, volume, distance; `design` puts it together.

Turned parts: `turned_profile` the outline, `turned_features` and `turned_threads` what is cut into it, `turned_feature` what
all of them share and ask of the body, `turned_design` the whole.
"""

from mnclab.design.model.design import Design
from mnclab.design.model.feature import Feature
from mnclab.design.model.features import Chamfer, Face, Groove, Pocket, Slope, Slot, Stud
from mnclab.design.model.holes import Hole
from mnclab.design.model.shapes import Circle, Outline, Rectangle
from mnclab.design.model.turned_design import TurnedDesign
from mnclab.design.model.turned_feature import TurnedFeature
from mnclab.design.model.turned_features import Bore, CentreHole, FaceGroove, RingGroove
from mnclab.design.model.turned_threads import Thread, Undercut

__all__ = [
    "Bore", "CentreHole", "Chamfer", "Circle", "Design", "Face", "FaceGroove", "Feature", "Groove", "Hole", "Outline",
    "Pocket", "Rectangle", "RingGroove", "Slope", "Slot", "Stud", "Thread", "TurnedDesign", "TurnedFeature", "Undercut",
]  # fmt: skip
