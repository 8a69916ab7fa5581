"""Drawing with matplotlib: a file for each thing that is drawn.

`colours` is the one table of lines and marks, on that of `show.looks`; `picture` the figure that shows itself in Jupyter, how
views stand in it, tables of texts and rows of axes; `path` the tool path: `layers` is what one view draws (bands as wide as
the tool and the ghost of a former path too), `strokes` are its points, `classes` which of them share a colour, `placing`
where texts, symbols and arrowheads have room, `datums` the crosses at zero points and poles; `compensation` is the contour
and the tool centre beside it, `equidistant` one view of that; `part` is what is left of a blank, of a lathe the half section,
`sections` cut faces; `profile` is the feed over time, `over_time` what else goes with time, `measured` what a probe found,
`probed` the part behind it; `side_by_side` areas, runs, and one path over another, `pocketing` compared ways of clearing an
area. `overlay` says how an idea is drawn over a path: centres of arcs, polar rays; the `original` of what is turned, `holes`.
Pictures of one idea each are `set_up` (the blank, the zero points, the lengths of tools), `turning_schemes` and the `face` of
a lathe's part. The only folder that imports matplotlib, and of that never `pyplot`: figures are plain objects, so that they
can be drawn in any thread. A new picture is a file here, takes `ax=None` and draws with `colours`; it may import every floor
but `machine` and `controls`.
"""

from mnclab.text.opening import require

require("matplotlib", "pictures")  # once for all that draw, before they import it

from mnclab.show.plot.compensation import compensation  # noqa: E402

__all__ = ["compensation"]
