"""Right calls of what the front door and its shelves offer, and the same calls with one odd value."""

from __future__ import annotations

import inspect
import itertools
import tempfile
from pathlib import Path
from types import ModuleType

import numpy as np

import mnclab as mnc
from mnclab import Tool

ODD = (None, "abc", "", float("nan"), float("inf"), 1e-320, -1, 10**400, [], {}, object())
SQUARE = mnc.area.rectangle(60, 40, 5)
REGION = mnc.area.Region.of(SQUARE)
LINE = mnc.area.Contour([(0, 0), (40, 0)], closed=False)
TURNED = mnc.area.Contour([(0, 10), (-20, 10), (-20, 15), (-40, 15)], closed=False)
CIRCLE = [(10, 0), (0, 10), (-10, 0), (0, -10.01)]
SPACE = [(10, 0, 0), (0, 10, 0), (-10, 0, 0), (0, -10, 0), (0, 0, 10)]
BLANK = ((-30, -20, -20), (30, 20, 0))
GROOVE = mnc.schemes.grooves.Groove(-10, 8, 15, 20)
MILLED = "G54\nT1 S1000 M3\nG0 X-10 Y0 Z5\nG1 Z-2 F200\nG1 X10\nG0 Z5\n"
RUN = mnc.run(MILLED, "mnc", stock=BLANK)
PLAN = mnc.schemes.zigzag(TURNED, 20.0, 2.0)
ANSWERS = Path(tempfile.mkdtemp())
(ANSWERS / "mnc-07.mnc").write_text("G0 X0\n")
FEEDS = {kind: 0.2 for kind in ("rough", "pick-up", "clean-up", "plunge", "finish", "thread")}

#: The right values of a parameter: of one function ("area.polygon corners"), or of all with this name.
RIGHT = {
    "area.arc radius": 10, "area.polygon corners": 6, "begin": 0, "sweep": 90, "radius": 5.0, "length": 60.0, "width": 40.0,
    "area.slot width": 10.0, "line": LINE, "points": CIRCLE, "area.Part region": REGION, "contours": [SQUARE],
    "path": RUN.toolpath, "exercise id": "mnc-07", "mark folder": ANSWERS,
    "area.terraces formula": mnc.area.Part(REGION, 5.0), "whole": 10.0, "regions": {"a": REGION}, "operator": "+",
    "left": mnc.area.Part(REGION, 5.0), "right": mnc.area.Part(REGION, 5.0), "depth": 2.0, "stepover": 2.0, "region": REGION,
    "strategy": "zigzag", "coarse_radius": 10.0, "moves": (SQUARE,), "strategies.trochoid width": 20.0,
    "strategies.trochoid step": 1.0,
    "profile": TURNED, "blank": 20.0, "step": 2.0, "plan": PLAN, "feeds": FEEDS, "infeeds": {"radial": (0.0, 0.1, 0.2)},
    "depths": (0.2, 0.4, 0.5), "positions": (0.0, 0.1, 0.2), "groove": mnc.schemes.grooves.Groove(-10, 30, 15, 20),
    "Axis name": "A", "Kinematics table": (mnc.Axis("C"),),
    "tool": 3.0, "total": 1.0, "passes": 4, "pitch": 2.0,
    "schemes.threads.thread start": 5.0, "schemes.threads.thread end": -20.0, "schemes.grooves.plunges right": -10.0,
    "schemes.grooves.plunges width": 8.0, "schemes.grooves.side_steps width": 8.0, "rim": 20.0,
    "schemes.grooves.Groove bottom": 15.0,
    "schemes.grooves.Groove right": -10.0, "schemes.Groove right": -10.0, "schemes.Groove bottom": 15.0,
    "schemes.Groove width": 8.0,
    "first": (0.0, 0.0), "second": (10.0, 0.0), "balls": [(0.0, 0.0), (10.0, 0.0)], "directions": [(1.0, 0.0), (1.0, 0.0)],
    "probing.corner first": mnc.probing.Line(0, 0, 0), "probing.corner second": mnc.probing.Line(0, 0, 1.0), "angle": 30.0,
    "probing.plane points": SPACE, "probing.sphere points": SPACE, "fit": mnc.probing.circle, "spread": 0.01,
    "normal": (0.0, 0.0, 1.0),
    "axes": np.eye(3), "x": 1.0, "y": 2.0, "z": 3.0, "up": (0.0, 0.0, 1.0), "centre": (0.0, 0.0, 0.0), "height": 10.0,
    "part.boss diameter": 10.0, "part.box first": (0, 0, -10), "opposite": (10, 10, 0), "bottom": (0, 0, -10),
    "top": (0, 0, 0),
    "part": mnc.part.box((0, 0, -10), (10, 10, 0)), "part.contact start": (5, 5, 10), "direction": (0, 0, -1), "reach": 50.0,
    "diameter": 10.0, "point": (0, 0, 0), "part.pocket width": 10.0, "part.pocket length": 10.0, "part.pocket depth": 5.0,
    "part.slot start": (0, 0, 0), "part.slot end": (10, 0, 0), "part.slot width": 5.0, "part.slot depth": 5.0,
    "blank.box length": 80.0, "blank.box width": 60.0, "blank.box height": 20.0, "blank.chuck radius": 40.0, "back": -60.0,
    "box length": 80.0, "box width": 60.0, "box height": 20.0, "blank.cylinder radius": 20.0, "cylinder radius": 20.0,
    "blank.cylinder low": -60.0, "cylinder low": -60.0, "low": (0.0, 0.0), "high": (1.0, 1.0),
    "source": MILLED, "control": "mnc", "code": "G83", "one": RUN, "other": RUN, "prove a": RUN, "prove b": RUN,
    "compare tool": Tool(5.0), "tools": [Tool(5.0)],
    "compare_turning tool": Tool(kind="turning"), "plot_runs run": RUN, "plot_profiles profile": RUN.profile(),
    "design.Chamfer contour": SQUARE, "contour": SQUARE, "design.Chamfer width": 1.0, "design.Groove width": 3.0,
    "start": (0.0, 0.0),
    "end": (10.0, 0.0), "start_depth": 1.0, "end_depth": 2.0, "design.Thread thread": "M20", "design.Thread start": 0.0,
    "design.Thread end": -15.0, "thread": "M20", "pilot": 4.0, "inner": 10.0, "outer": 20.0, "design.RingGroove width": 3.0,
    "design.RingGroove depth": 1.0, "design.RingGroove z": -10.0, "Design blank": BLANK, "TurnedDesign profile": TURNED,
    "design.Outline points": ((0, 0), (10, 0), (0, 10)), "design.Undercut z": -10.0, "given": None,
    "times": {10.0: 0.3, 100.0: 0.9, 400.0: 2.4},
    "blank.Revolved profile": ((20, -60), (20, 0)),
    "blank.Box low": (0, 0, 0), "blank.Box high": (1, 1, 1), "kind": "vertical", "design.Design blank": BLANK,
    "design.TurnedDesign profile": TURNED, "slope": 0.0, "r": 16.0, "area.Contour points": CIRCLE,
}  # fmt: skip
#: Not called: what is no value of a user, opens files or folders, or has a page of its own tests.
LEFT = {
    "Alarm", "Collision", "Help", "Kind", "Program", "Run", "Removal", "Workpiece", "Profile", "Toolpath", "check", "editor",
    "run_many", "form", "panel", "profile_panel", "compensation_panel", "pocket_panel", "area.svg", "area.dxf", "part.Part",
    "part.mesh", "modern", "help", "renumber", "area.Joined", "design.Design", "design.TurnedDesign",
}  # fmt: skip
#: What has public methods that are called: name -> the thing.
THINGS = {
    "Contour": SQUARE, "Region": REGION, "toolpath": RUN.toolpath, "Design": mnc.Design(BLANK), "Setup": mnc.Setup(),
    "Tool": Tool(5.0),
    "run": RUN, "axes": RUN.axes(), "workpiece": RUN.workpiece(step=1.0), "profile": RUN.profile(),
    "part": mnc.part.box((0, 0, -10), (10, 10, 0)),
    "box": mnc.blank.box(80, 60, 20), "cylinder": mnc.blank.cylinder(20, -60), "Circle": mnc.probing.Circle(0, 0, 10),
    "Line": mnc.probing.Line(0, 0, 0), "Plane": mnc.probing.Plane(0, 0, 0, (0, 0, 1)),
    "Sphere": mnc.probing.Sphere(0, 0, 0, 5),
    "Rectangle": mnc.probing.Rectangle(0, 0, 10, 5), "Width": mnc.probing.Width(0, 0, 5), "groove": GROOVE,
    "limits": mnc.Limits(),
    "Hole": mnc.design.Hole(0, 0, 5, 5), "collisions": RUN.collisions(), "holes": RUN.holes(), "removal": RUN.removal(),
}  # fmt: skip
#: The right values of methods, by name of the parameter.
OF_METHODS = RIGHT | {
    "run.at line": 4, "run.explain line": 4, "Line.towards direction": (0.0, 1.0),
    "points": [(0.0, 0.0), (5.0, 5.0)], "fraction": 0.5, "first": 0.0, "last": 0.5, "distance": 1.0, "matrix": np.eye(3),
    "step": 2.0,
    "other": REGION, "start": (0.0, 0.0, 5.0), "end": (1.0, 0.0, 5.0), "piece": "line", "chord_error": 0.1,
    "by": (1.0, 0.0, 0.0),
    "z": -1.0, "x": np.array([1.0]), "y": np.array([1.0]), "right": 0, "up": 1, "others": [REGION], "frame": np.eye(4),
    "angle": 0.1,
    "point": (0.0, 0.0), "direction": (1.0, 0.0), "ball": 1.0, "target": mnc.Design(BLANK), "plane": "XY", "at": 0.0,
    "what": "line",
    "degrees": 90.0, "axis": "x", "line": 4, "program": 0, "condition": "z < 0", "t": 0.1, "key": "line", "name": "rapid",
    "t_": 0.0,
    "middle": 0.0, "dx": 1.0, "dy": 1.0, "dz": 1.0, "setup": mnc.Setup(), "limits": mnc.Limits(), "radius": 3.0, "count": 3,
    "pitch_diameter": 40.0, "columns": 2, "rows": 2, "spacing": 10.0, "depth": 5.0, "about": (0.0, 0.0), "of": "line",
    "Circle.grown by": 1.0, "Sphere.grown by": 1.0, "Rectangle.grown by": 1.0, "Width.grown by": 1.0, "Line.towards by": 1.0,
    "Plane.towards by": 1.0, "Plane.towards direction": (0.0, 0.0, 1.0), "Plane.distance points": [(0.0, 0.0, 1.0)],
    "Contour.nearest point": (0.0, 0.0), "Region.holds start": (0.0, 0.0), "Region.holds end": (1.0, 0.0),
    "Region.contains points": CIRCLE,
    "Contour.circle centre": (0.0, 0.0), "Contour.circle start": 0.0, "Hole.circle x": 0.0, "Hole.circle y": 0.0,
    "Hole.circle first": 0.0,
    "Hole.grid x": 0.0, "Hole.grid y": 0.0, "Hole.row x": 0.0, "Hole.row y": 0.0,
}  # fmt: skip
#: Methods of the inside, or that write files and draw at length; of those that only take options, none is odd.
NOT_CALLED = {
    "save", "scene", "player", "report", "setup_sheet", "tool_sheet", "measuring_sheet", "load", "ahead", "at_most", "reach",
    "made_by", "removals", "from_top", "raised", "replace", "through", "chain", "annotated", "kept", "proves", "place",
    "told", "again", "some", "to_pandas",
    "faces_over", "cutting_data", "plot_lengths", "surface", "largest_radius", "plot_face", "plot_measured", "executions",
    "place_of_line", "union_of", "of", "with_errors",
}  # fmt: skip


def doors():
    """Name and function or class of all that is offered."""
    for name in dir(mnc):
        found = getattr(mnc, name)
        if name.startswith("_"):
            continue
        if isinstance(found, ModuleType):
            for each in found.__all__:
                inner = getattr(found, each)
                if isinstance(inner, ModuleType):
                    own = [n for n in dir(inner) if getattr(getattr(inner, n), "__module__", "") == inner.__name__]
                    yield from ((f"{name}.{each}.{n}", getattr(inner, n)) for n in own if not n.startswith("_"))
                else:
                    yield f"{name}.{each}", inner
        else:
            yield name, found


def calls():
    """Name, function and right values of every door and method."""
    for name, door in doors():
        if callable(door) and name not in LEFT:
            yield name, door, right(name, door, RIGHT)
    for name, thing in THINGS.items():
        for each in dir(type(thing)):
            method = inspect.getattr_static(type(thing), each)
            public = isinstance(method, classmethod) or inspect.isfunction(method)
            if public and not each.startswith("_") and each not in NOT_CALLED and each not in dir(tuple):
                yield f"{name}.{each}", getattr(thing, each), right(f"{name}.{each}", getattr(thing, each), OF_METHODS)


def right(name, door, known):
    """The right values by the names of parameters, of those without a default."""
    found = {}
    for each in inspect.signature(door).parameters.values():
        if each.kind in (each.VAR_KEYWORD, each.VAR_POSITIONAL):
            continue
        if (key := f"{name} {each.name}") in known:
            found[each.name] = known[key]
        elif each.default is each.empty:
            found[each.name] = known.get(each.name, "MISSING " + name)
    return found


def called(door, values):
    """A call with values, the first ones in their order and the others by their names."""
    takes = inspect.signature(door).parameters
    inorder = [name for name, each in takes.items() if each.kind in (each.POSITIONAL_ONLY, each.POSITIONAL_OR_KEYWORD)]
    first = list(itertools.takewhile(values.__contains__, inorder))
    found = door(*(values[name] for name in first), **{name: value for name, value in values.items() if name not in first})
    return list(found) if inspect.isgenerator(found) else found


def parameters(door):
    """The names of the parameters that take a value each, without the options that are handed on."""
    takes = inspect.signature(door).parameters.values()
    return [each.name for each in takes if each.kind not in (each.VAR_KEYWORD, each.VAR_POSITIONAL) and each.default is not ...]
