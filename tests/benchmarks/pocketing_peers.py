"""Run by the peers' own Python: clears one area with the packages `pocketing` and `hsm-nibble`, prints JSON lines.

The area comes on standard input: {"outer": [[x, y], …], "holes": [[…], …], "step": mm}; it is where the tool centre may go.
"""

import json
import math
import sys
import time

from shapely.geometry import LineString, Polygon


def contour_parallel(area, step):
    from pocketing.contour import contour_parallel as clear

    return [LineString(path) for path in clear(area, step)]


def nibble(area, step):
    from hsm_nibble.arc_utils import ArcDir, LineData, MoveStyle
    from hsm_nibble.geometry import Pocket

    ways = []
    for row in Pocket(area, step, ArcDir.CW, generate=False).path:
        if isinstance(row, LineData) and row.move_style != MoveStyle.CUT and row.move_style != MoveStyle.RAPID_INSIDE:
            continue
        ways.append(row.path)
    return ways


given = json.load(sys.stdin)
region = Polygon(given["outer"], given["holes"])
for name, how in (("pocketing contour_parallel", contour_parallel), ("hsm-nibble", nibble)):
    begin = time.process_time()
    try:
        ways = how(region, given["step"])
        row = {"name": name, "seconds": time.process_time() - begin, "length": math.fsum(way.length for way in ways)}
        row["paths"] = [list(way.coords) for way in ways]
    except Exception as error:  # a peer that cannot do it is a row of the table too
        row = {"name": name, "error": f"{type(error).__name__}: {error}"}
    print(json.dumps(row))
