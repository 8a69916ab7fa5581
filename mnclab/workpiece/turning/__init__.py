"""What the tools of a lathe leave: their inserts swept over the half section, exact in lines and arcs.

    section    what a convex contour covers that moves, and the blank without that, row by row as well
    strokes    the rows of a path as such contours: outside, inside, on the axis, threads
    revolved   a half section turned about its axis: volume, radii, distance, surface
    turned     what is left, as people ask for it

What they meet that they must not: `collisions`, row by row, with bars, chucks, and what is behind an insert;
`edges`, with what is beyond the end of an edge.
"""
