"""What a probe touches, for Setup(part=…); parts combine: a | b, a & b, a - b."""

from mnclab.workpiece.part import Part as Part
from mnclab.workpiece.part import ball as ball
from mnclab.workpiece.part import boss as boss
from mnclab.workpiece.part import box as box
from mnclab.workpiece.part import cone as cone
from mnclab.workpiece.part import contact as contact
from mnclab.workpiece.part import cylinder as cylinder
from mnclab.workpiece.part import foot as foot
from mnclab.workpiece.part import hole as hole
from mnclab.workpiece.part import mesh as mesh
from mnclab.workpiece.part import plane as plane
from mnclab.workpiece.part import pocket as pocket
from mnclab.workpiece.part import slot as slot
