"""Contours and regions: by numbers, or out of a drawing or a path."""

from mnclab.geometry.contours import Contour as Contour
from mnclab.geometry.contours import arc as arc
from mnclab.geometry.contours import polygon as polygon
from mnclab.geometry.contours import rectangle as rectangle
from mnclab.geometry.contours import slot as slot
from mnclab.geometry.drawings import area_of as area_of
from mnclab.geometry.dxf import contours as dxf
from mnclab.geometry.regions import Region as Region
from mnclab.geometry.svg import contours as svg
from mnclab.machining.milling.terraces import DeepArea as Part
from mnclab.machining.milling.terraces import Joined as Joined
from mnclab.machining.milling.terraces import terraces as terraces
from mnclab.path.plane import outline as outline
from mnclab.path.plane import outlines as outlines
from mnclab.show.plot.side_by_side import plot_regions as plot

__all__ = ["dxf", "svg", "Part", "plot"]  # names that are others there; all others are exported by their "as"
