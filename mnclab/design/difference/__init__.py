"""The part as drawn against the part as cut.

`target` is what a comparison asks of a design, `drawn_target` a milled design that answers; `deviations` looks at all faces,
`measuring` reads the sizes off, `comparing` puts it together into a `Difference`, which `plot` and `scene` show and `export`
writes. Turned parts: `half_target`, `turned_comparing`, `turned_measuring`.
"""

from mnclab.design.difference.difference import Difference, Worst

__all__ = ["Difference", "Worst"]
