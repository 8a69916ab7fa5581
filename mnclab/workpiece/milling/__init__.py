"""What a mill leaves: its tools swept along their moves over a map of heights.

    moves    what a tool is below: flat, corner, cone; the rows of a path as straight moves and arcs of it
    swept    exact: how high each move leaves the material at points
    raster   the map: cells, tiles, and the order of moves over them
    sweep    the height at any points
    volumes  what was taken away, and by which row
    sections contours of the material
    erosion  of very many moves: the map, what was taken away, and by which row
    lattice  nodes over the map, and the walls between them at their true places
    solid    the part as a closed surface, and its edges
    engaged  what stands before a tool at a place of its way
    touched  the part as a probe meets it
    judging  the bodies of a tool, and where one of them is in the material before a move
    collisions  which of them must not be there, and what of a tool is in a fixture
    milled   what is left, as people ask for it
"""
