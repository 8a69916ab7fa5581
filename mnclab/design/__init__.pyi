"""A part as drawn, Design(blank, features) or TurnedDesign(profile, features), and features."""

from mnclab.design.model import Bore as Bore
from mnclab.design.model import CentreHole as CentreHole
from mnclab.design.model import Chamfer as Chamfer
from mnclab.design.model import Circle as Circle
from mnclab.design.model import Design as Design
from mnclab.design.model import Face as Face
from mnclab.design.model import FaceGroove as FaceGroove
from mnclab.design.model import Groove as Groove
from mnclab.design.model import Hole as Hole
from mnclab.design.model import Outline as Outline
from mnclab.design.model import Pocket as Pocket
from mnclab.design.model import Rectangle as Rectangle
from mnclab.design.model import RingGroove as RingGroove
from mnclab.design.model import Slope as Slope
from mnclab.design.model import Slot as Slot
from mnclab.design.model import Stud as Stud
from mnclab.design.model import Thread as Thread
from mnclab.design.model import TurnedDesign as TurnedDesign
from mnclab.design.model import Undercut as Undercut
from mnclab.workpiece.blank import Box as Box
from mnclab.workpiece.blank import Revolved as Revolved
