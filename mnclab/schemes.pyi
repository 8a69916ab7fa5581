"""Ways to turn, groove and thread; mnclab.compare_turning puts them side by side."""

from mnclab.comparison.turning_schemes import toolpath as toolpath
from mnclab.machining.turning import groove_schemes as grooves
from mnclab.machining.turning import threading as threads
from mnclab.machining.turning.groove_schemes import Groove as Groove
from mnclab.machining.turning.profiles import zone_of as zone_of
from mnclab.machining.turning.profiles import zones as zones
from mnclab.machining.turning.schemes import SCHEMES as SCHEMES
from mnclab.machining.turning.schemes import combined as combined
from mnclab.machining.turning.schemes import contour as contour
from mnclab.machining.turning.schemes import descent as descent
from mnclab.machining.turning.schemes import equidistant as equidistant
from mnclab.machining.turning.schemes import loop as loop
from mnclab.machining.turning.schemes import pick_up as pick_up
from mnclab.machining.turning.schemes import semi_finish as semi_finish
from mnclab.machining.turning.schemes import zigzag as zigzag
from mnclab.show.plot.turning_schemes import plot_threads as plot_threads
from mnclab.show.plot.turning_schemes import plot_zones as plot_zones

__all__ = ["grooves", "threads"]  # names that are others there; all others are exported by their "as"
