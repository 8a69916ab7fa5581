"""What a program cuts from, for Setup(stock=…), and what holds it, for Setup(fixtures=…)."""

from mnclab.workpiece.blank import Box as Box
from mnclab.workpiece.blank import Revolved as Revolved
from mnclab.workpiece.blank import box as box
from mnclab.workpiece.blank import chuck as chuck
from mnclab.workpiece.blank import cylinder as cylinder
