"""A part as a probe meets it: a function from points to signed distance, negative inside the material.

Points `(n, 3)` in mm, distances `(n,)` in mm. Parts combine: `a | b` has the material of both, `a & b` what they share,
`a - b` is a less b. What is taken out of a face opens upwards without end, so it need not stick out of it:

    part = box((0, 0, -20), (100, 60, 0)) - hole((50, 30, 0), 24, 10) | boss((20, 30, 0), 8, diameter=12)
    contact(part, start=(50, 30, -5), direction=(1, 0, 0), radius=2, reach=20)      # 10.0
"""

from mnclab.workpiece.part.mesh import mesh
from mnclab.workpiece.part.part import Part
from mnclab.workpiece.part.shapes import ball, boss, box, cone, cylinder, hole, plane, pocket, slot
from mnclab.workpiece.part.touching import contact, foot

__all__ = ["Part", "ball", "boss", "box", "cone", "contact", "cylinder", "foot", "hole", "mesh", "plane", "pocket", "slot"]
