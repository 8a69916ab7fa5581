"""Ways to clear an area with a mill; mnclab.compare puts them side by side."""

from mnclab.machining.milling.adaptive import adaptive as adaptive
from mnclab.machining.milling.adaptive import peeling as peeling
from mnclab.machining.milling.engagement import engagement as engagement
from mnclab.machining.milling.engagement import stretches as stretches
from mnclab.machining.milling.entries import Entry as Entry
from mnclab.machining.milling.lines import one_way as one_way
from mnclab.machining.milling.lines import zigzag as zigzag
from mnclab.machining.milling.morphed import morphed_spiral as morphed_spiral
from mnclab.machining.milling.rest import rest_passes as rest_passes
from mnclab.machining.milling.rings import rings as rings
from mnclab.machining.milling.rounded import rounded_rings as rounded_rings
from mnclab.machining.milling.rounded import rounded_zigzag as rounded_zigzag
from mnclab.machining.milling.spirals import spiral as spiral
from mnclab.machining.milling.strategies import STRATEGIES as STRATEGIES
from mnclab.machining.milling.strategies import clear as clear
from mnclab.machining.milling.strategies import rest as rest
from mnclab.machining.milling.trochoids import trochoid as trochoid
from mnclab.machining.milling.trochoids import trochoidal as trochoidal
from mnclab.show.plot.pocketing import plot_times as plot_times
