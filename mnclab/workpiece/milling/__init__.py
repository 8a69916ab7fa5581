"""What a mill leaves: its tools swept along their moves over a map of heights.

    cutters  what a tool is below: flat, corner, cone
    moves    the rows of a path as straight moves and arcs, each with its cutter
    swept    exact: how high each move leaves the material at points
    raster   the map: cells, tiles, and the order of moves over them
    sweep    the height at any points
    volumes  what was taken away, and by which row
    sections contours of the material
    limits   what a map of heights cannot hold, in words
    many     of very many moves: the map, what was taken away, and by which row
    erosion  their map: for each cell the tip that cuts deepest, and what its move leaves
    tips     where the tips of a cutter went, cell by cell
    search   which of all tips about a cell leaves the least height
    lattice  nodes over the map, and the walls between them at their true places
    divided  a cell that walls cross, as triangles
    solid    the part as a closed surface
    milled   what is left, as people ask for it
"""
