"""The tool-centre path beside a programmed contour.

With R the tool radius, s = +1 to the left of the travel and -1 to the right, t the unit tangent and
n(t) = s (-t_v, t_u) the normal towards the tool, a corner P between two elements turns by tau; s tau < 0 is an outside
corner. The offsets end at A1 = P + R n1 and begin at A2 = P + R n2::

        A1 ___ A2          A1 --- I            an inside corner is cut off at I, where the offsets meet; an outside
      -----+   \\         -----+    |            corner is closed by an arc about P (G160), or both offsets are
           P \\  |              P \\  |            prolonged to I (G161); G162 takes the arc for acute corners only
              \\ |                 \\ |

A joint that turns by less than 0.001 degrees (`elements.TANGENT`) counts as tangent: the offsets meet there as they are.
Every greater turn is a corner, exact however small. At 180 degrees less that angle lines run there and back, and the tool
rolls round their end; where an arc turns back by more than 170 degrees (`elements.CUSP`), what the elements do beside the
joint decides between inside and outside.

`elements` are the rows that move in the plane, `equidistant` finds all corners at once, `fit` looks for places where the
tool has no room, over any number of blocks, with `neighbours` for what lies close by along the contour and `ends` for where it
arrives, leaves and crosses itself; `moving_ends` makes the path, `construction` shows people how it was found. Everything is
done in columns.
"""

from __future__ import annotations

from mnclab.path.compensation.elements import ACUTE, CORNER, ROUND, STRAIGHT, Compensation, Gouge, Report
from mnclab.path.compensation.moving_ends import apply

__all__ = ["ACUTE", "CORNER", "ROUND", "STRAIGHT", "Compensation", "Gouge", "Report", "apply"]
