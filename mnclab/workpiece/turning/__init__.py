"""What the tools of a lathe leave: their inserts swept over the half section, exact in lines and arcs.

    sweeping   what a convex contour covers that moves along a line or an arc
    strokes    the rows of a path as such contours: outside, inside, on the axis, threads
    section    the blank without them, lines and arcs found again, row by row as well
    revolved   a half section turned about its axis: volume, radii, distance, surface
    turned     what is left, as people ask for it

What they meet that they must not: `collisions`, row by row, with `bodies` (bars, chucks, what is behind an insert) and
`backs` (what the back of an insert takes away).
"""
