"""A contour that never goes below the top of the blank: Z without its sign, a datum elsewhere. All is cut in the air.

On a lathe the same of a bar: no move comes as near to the axis as its surface. What only touches a mill's blank from the
side may be meant, for many a blank has the sizes of the part.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.limits import extents
from mnclab.runs.lint.once import once
from mnclab.runs.material import cutting_of
from mnclab.text.alarm import Alarm
from mnclab.workpiece.cutting import CUTS

if TYPE_CHECKING:
    from mnclab.runs.run import Run

NOISE = 1e-6  # mm


def remarks(run: Run) -> Iterator[Alarm]:
    """A warning at the first move at feed, if none of them comes to where material is."""
    stock, path = run.stock, run.toolpath
    axis, least = (0, NOISE) if path.lathe else (2, -NOISE)  # a bar that is only touched is turned to its own size
    cuts = np.isin(path.kind, CUTS)
    if not run.ok or stock is None or not stock.volume > 0 or not cuts.any():
        return
    top = stock.bounds[1, axis]
    if path.end[cuts, axis].min() < top - 1:  # the mills of a table are not as much longer as this
        return
    cutting = cutting_of(run)
    cuts &= np.array([tool.kind != "probe" for tool in cutting.tools])[cutting.which]
    if not cuts.any() or cutting.tilted is not None:
        return
    above = float(extents(cutting.path)[0][cuts, axis].min() - top)
    if above < least:
        return
    first = int(path.step[np.argmax(cuts)])
    if path.lathe:
        message = f"no move at feed comes to the bar: the nearest stays {above:.3f} mm beside it"
        yield once(run, [first], message, "is X a radius or a diameter here, and the datum on the axis?")
    else:
        where = f"stays {above:.3f} mm above it" if above > NOISE else "is at it"
        message = f"no move at feed goes below the top of the blank: the lowest {where}"
        yield once(run, [first], message, "depths below the top are negative, Z-5; or the blank stands too low")
