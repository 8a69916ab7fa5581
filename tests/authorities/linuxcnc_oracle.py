"""The motion that LinuxCNC's interpreter makes of a program, in mm and full double precision.

    /usr/bin/python3 tests/authorities/linuxcnc_oracle.py PROGRAM.ngc …

Needs Debian's package `linuxcnc-uspace`, which brings the module `gcode` for Debian's own Python. It prints
one JSON object a line for each program: `ok`, `error` and `line` of a refused program, and `motion`, a list of

    kind     "rapid", "feed", "arc" or "probe", which meets nothing
    line     line of PROGRAM.ngc, 1-based
    to       [x, y, z], the end point in mm, machine coordinates: G5x, G92, the rotation of G10 and the tool offset
             of G43.1 are applied
    feed     mm/min (not for rapids)
    centre   [x, y, z] of arcs; along the normal of the plane it has the end point's coordinate
    turns    of arcs: + counter-clockwise, - clockwise, 1 up to one full turn, 2 up to two turns ...
    plane    of arcs: "XY", "ZX" or "YZ"
    rotation of arcs: rad about Z by which G10 has turned the system, if it has

Nothing imports this file: it is a program to be called. Tool changes must stay out of PROGRAM.ngc (`T.. M6`
crashes the module); write the cutter diameter as `G41.1 D..` or `G42.1 D..`.
"""

import json
import math
import os
import sys
import tempfile

import gcode

MM = 25.4  # the module hands every length over in inches
PLANES = {1: "XY", 2: "YZ", 3: "ZX"}  # numbers of the canonical call set_plane
ORDER = {"XY": (0, 1, 2), "ZX": (2, 0, 1), "YZ": (1, 2, 0)}  # first axis, second axis, normal


class Canon:
    """The canonical calls of the interpreter, written down as motion."""

    def __init__(self, folder):
        self.parameter_file = os.path.join(folder, "fresh.var")  # a new one each run: LinuxCNC rewrites it
        with open(self.parameter_file, "w"):
            pass
        self.motion = []
        self.line = 0
        self.feed = 0.0
        self.plane = "XY"
        self.g5x = self.g92 = self.offset = (0.0, 0.0, 0.0)
        self.rotation = 0.0

    def __getattr__(self, name):
        """Every other canonical call (spindle, messages ...) makes no motion."""
        if name.startswith("__") or name == "use_move_batches":
            raise AttributeError(name)
        return lambda *arguments: None

    # What the interpreter asks.

    def get_external_length_units(self):
        return 1.0

    def get_external_angular_units(self):
        return 1.0

    def get_axis_mask(self):
        return 7

    def get_block_delete(self):
        return False

    def get_tool(self, pocket):
        return (-1, *(0.0,) * 12, 0)

    # What the interpreter tells.

    def next_line(self, state):
        self.line = state.sequence_number

    def set_plane(self, number):
        self.plane = PLANES[number]

    def set_feed_rate(self, feed):
        self.feed = MM * feed

    def set_g5x_offset(self, number, x, y, z, *rotary):
        self.g5x = (x, y, z)

    def set_g92_offset(self, x, y, z, *rotary):
        self.g92 = (x, y, z)

    def tool_offset(self, x, y, z, *rotary):
        self.offset = (x, y, z)

    def set_xy_rotation(self, degrees):
        self.rotation = math.radians(degrees)

    def straight_traverse(self, x, y, z, *rotary):
        self.add("rapid", to=self.machine(x, y, z))

    def straight_feed(self, x, y, z, *rotary):
        self.add("feed", to=self.machine(x, y, z), feed=self.feed)

    def straight_probe(self, x, y, z, *rotary):
        self.add("probe", to=self.machine(x, y, z), feed=self.feed)

    def arc_feed(self, end1, end2, centre1, centre2, turns, end3, *rotary):
        end, centre = [0.0] * 3, [0.0] * 3
        for axis, value in zip(ORDER[self.plane], (end1, end2, end3), strict=True):
            end[axis] = value
        for axis, value in zip(ORDER[self.plane], (centre1, centre2, end3), strict=True):
            centre[axis] = value
        self.add(
            "arc",
            to=self.machine(*end),
            feed=self.feed,
            centre=self.machine(*centre),
            turns=turns,
            plane=self.plane,
            **({"rotation": self.rotation} if self.rotation else {}),
        )

    def machine(self, x, y, z):
        """Machine coordinates in mm of a point in inches of the program's coordinates."""
        x, y, z = x + self.g92[0], y + self.g92[1], z + self.g92[2]
        cos, sin = math.cos(self.rotation), math.sin(self.rotation)
        x, y = x * cos - y * sin, x * sin + y * cos
        place = zip((x, y, z), self.g5x, self.offset, strict=True)
        return [MM * (value + shift + offset) for value, shift, offset in place]

    def add(self, kind, **more):
        self.motion.append({"line": self.line, "kind": kind, **more})


def answer(path):
    """What LinuxCNC makes of the program in the file `path`."""
    with tempfile.TemporaryDirectory() as folder:
        canon = Canon(folder)
        result, line = gcode.parse(path, canon, "G21", "")
    refused = result > gcode.MIN_ERROR
    return {
        "ok": not refused,
        "error": gcode.strerror(result) if refused else None,
        "line": line if refused else None,
        "motion": canon.motion,
    }


if __name__ == "__main__":
    for program in sys.argv[1:]:
        print(json.dumps(answer(program)), flush=True)
