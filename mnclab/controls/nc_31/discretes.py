"""The scale of the integers: a program of the NC-31 has no decimal point, it counts in discretes.

The source gives the scale of F inside a cycle only; the others are adopted so that its example makes sense (diameter
105, a groove 0.3 to 1 mm deep with a lead of 2 mm, cut at 99 m/min).
"""

from __future__ import annotations

X = 200.0  # discretes in a millimetre of radius: X counts 0.01 mm on the diameter
Z = 100.0  # 0.01 mm
FREE_FEED = 100.0  # F as a frame of its own: 0.01 mm/rev
CYCLE_FEED = 10_000.0  # F inside a cycle: 0.0001 mm/rev
TRAVEL = 100.0  # machine parameters 8, 10, 11: 0.01 mm of true tool travel
