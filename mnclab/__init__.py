"""mnclab: part programs of real CNC controls, obeyed exactly as their manuals say, and shown.

A part program is text; a control reads it into blocks; a machine obeys the blocks with a dozen verbs; every obeyed verb
is a row in a table of moves; everything one can look at is computed from that table.

The map of the house, floor by floor (a folder imports only from those above its line)::

    text        what a programmer wrote: Alarm, Program, words, expressions
    geometry    frames, arcs, contours, offsets, regions: numbers, no CNC word
    path        what the tool does: Toolpath in columns, passes over it (corners, compensation), and the feed profile
    workpiece   what the tool meets, and what is left: blank, milled and turned part, removal, collisions
    machining   how metal is cut, whatever the control: holes, milling, turning, as steps
    comparison  two paths, or strategies, side by side
    machine     what stands before a program runs: Machine, Setup, what a Control and a Cycle declare
    running     what runs: the interpreter, the handing out of words, the bulk tier, cycles carried out
    runs        what is there after: Run, its history, moments, explanations
    controls    who speaks: a folder a control
    show        what people see and take away: plots, player, files
    shell       what is typed in a terminal

and its wings, which may be left out and which no other room imports::

    controls/…  each control with what it alone needs: mnc, jnc_t01, nc_31, g43, tnc_620
    design      parts as drawn: designs, drawings, differences, recognition
    learning    exercises that grade the part: tasks, hints, classes
    lab         where one types and tries: forms, panels, editor, magics, sketches

This module is the front door, and nothing else: it imports numpy only. What needs more is opened when it is first asked
for, with its own signature; `part`, `blank`, `design`, `area`, `strategies`, `schemes` and `probing` are shelves: print
one to see what is on it.
"""

import sys as _sys
from pathlib import Path as _Path
from typing import TYPE_CHECKING, Any

from mnclab.controls import CONTROLS as controls
from mnclab.controls.choice import Help, modern, read, renumber, run
from mnclab.controls.choice import help as help
from mnclab.controls.survey import check
from mnclab.machine.probe import Probe, Setter
from mnclab.machine.setup import Datum, Setup
from mnclab.path.limits import Limits, machines
from mnclab.path.profile import Profile
from mnclab.path.tool import Tool, Wear
from mnclab.path.toolpath import RULE_NAMES, Kind, Toolpath
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.text.alarm import nearest as _nearest
from mnclab.text.opening import Shelf
from mnclab.text.program import Program
from mnclab.workpiece.blank import box, cylinder
from mnclab.workpiece.collision import Collision
from mnclab.workpiece.removal import Removal
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:  # what OPENED says, for editors and for mypy
    from mnclab.comparison.diff import diff as diff
    from mnclab.comparison.strategies import compare as compare
    from mnclab.comparison.tool_sets import tool_sets as tool_sets
    from mnclab.comparison.turning_schemes import compare as compare_turning
    from mnclab.controls.cycle_steps import steps as steps
    from mnclab.design.model import Design as Design
    from mnclab.design.model import TurnedDesign as TurnedDesign
    from mnclab.lab.editor import editor as editor
    from mnclab.lab.forms import compensation_panel as compensation_panel
    from mnclab.lab.forms import form as form
    from mnclab.lab.forms import panel as panel
    from mnclab.lab.forms import pocket_panel as pocket_panel
    from mnclab.lab.forms import profile_panel as profile_panel
    from mnclab.lab.magic import load_ipython_extension as load_ipython_extension
    from mnclab.learning.exercise import exercise as exercise
    from mnclab.learning.exercise import exercises as exercises
    from mnclab.learning.marking import mark as mark
    from mnclab.learning.progress import progress as progress
    from mnclab.path.profile.stopwatch import fit_limits as fit_limits
    from mnclab.show.plot.over_time import plot_profiles as plot_profiles
    from mnclab.show.plot.side_by_side import plot_runs as plot_runs

__version__ = "0.1.0"

#: What is opened when it is first asked for.
OPENED = Shelf("mnclab", "the names that need more than numpy", {
    "mnclab.controls.cycle_steps": "steps",
    "mnclab.comparison.diff": "diff",
    "mnclab.comparison.strategies": "compare",
    "mnclab.comparison.tool_sets": "tool_sets",
    "mnclab.comparison.turning_schemes": "compare as compare_turning",
    "mnclab.lab.editor": "editor",
    "mnclab.lab.forms": "compensation_panel, form, panel, pocket_panel, profile_panel",
    "mnclab.learning.exercise": "exercise, exercises",
    "mnclab.learning.marking": "mark",
    "mnclab.learning.progress": "progress",
    "mnclab.lab.magic": "load_ipython_extension",
    "mnclab.path.profile.stopwatch": "fit_limits",
    "mnclab.show.plot.over_time": "plot_profiles",
    "mnclab.show.plot.side_by_side": "plot_runs",
    "mnclab.design.model": "Design, TurnedDesign",
}, judges=False)  # fmt: skip

part = Shelf("mnclab.part", "what a probe touches, for Setup(part=…); parts combine: a | b, a & b, a - b", {
    "mnclab.workpiece.part": "Part, ball, boss, box, cone, contact, cylinder, foot, hole, mesh, plane, pocket, slot",
})  # fmt: skip

blank = Shelf("mnclab.blank", "what a program cuts from, for Setup(stock=…), and what holds it, for Setup(fixtures=…)", {
    "mnclab.workpiece.blank": "Box, Revolved, box, chuck, cylinder",
})  # fmt: skip

design = Shelf("mnclab.design", "a part as drawn, Design(blank, features) or TurnedDesign(profile, features), and features", {
    "mnclab.workpiece.blank": "Box, Revolved",
    "mnclab.design.model":
        "Design, Chamfer, Circle, Face, Groove, Hole, Outline, Pocket, Rectangle, Slope, Slot, Stud, "
        "TurnedDesign, Bore, CentreHole, FaceGroove, RingGroove, Thread, Undercut",
}, _Path(__file__).parent / "design")  # fmt: skip

area = Shelf("mnclab.area", "contours and regions: by numbers, or out of a drawing or a path", {
    "mnclab.geometry.contours": "Contour, arc, polygon, rectangle, slot",
    "mnclab.geometry.regions": "Region",
    "mnclab.geometry.drawings": "area_of",
    "mnclab.geometry.dxf": "contours as dxf",
    "mnclab.geometry.svg": "contours as svg",
    "mnclab.path.plane": "outline, outlines",
    "mnclab.machining.milling.terraces": "DeepArea as Part, Joined, terraces",
    "mnclab.show.plot.side_by_side": "plot_regions as plot",
})  # fmt: skip

strategies = Shelf("mnclab.strategies", "ways to clear an area with a mill; mnclab.compare puts them side by side", {
    "mnclab.machining.milling.strategies": "STRATEGIES, clear, rest",
    "mnclab.machining.milling.adaptive": "adaptive, peeling",
    "mnclab.machining.milling.morphed": "morphed_spiral",
    "mnclab.machining.milling.lines": "one_way, zigzag",
    "mnclab.machining.milling.rings": "rings",
    "mnclab.machining.milling.rounded": "rounded_rings, rounded_zigzag",
    "mnclab.machining.milling.spirals": "spiral",
    "mnclab.machining.milling.trochoids": "trochoid, trochoidal",
    "mnclab.machining.milling.entries": "Entry",
    "mnclab.machining.milling.rest": "rest_passes",
    "mnclab.machining.milling.engagement": "engagement, stretches",
    "mnclab.show.plot.pocketing": "plot_times",
})  # fmt: skip

schemes = Shelf("mnclab.schemes", "ways to turn, groove and thread; mnclab.compare_turning puts them side by side", {
    "mnclab.machining.turning.schemes":
        "SCHEMES, combined, contour, descent, equidistant, loop, pick_up, semi_finish, zigzag",
    "mnclab.machining.turning.profiles": "zone_of, zones",
    "mnclab.machining.turning": "groove_schemes as grooves, threading as threads",
    "mnclab.machining.turning.groove_schemes": "Groove",
    "mnclab.comparison.turning_schemes": "toolpath",
    "mnclab.show.plot.turning_schemes": "plot_threads, plot_zones",
})  # fmt: skip

probing = Shelf("mnclab.probing", "what measured points are: circle(points), and how sure that is", {
    "mnclab.machining.probing.fits":
        "angle, centre_of_four, circle, corner, line, off_the_ball, plane, rectangle, reduced, sphere, uncertainty, width",
    "mnclab.machining.probing.found": "axes_on, spatial_angles, Circle, Line, Plane, Point, Rectangle, Sphere, Width",
})  # fmt: skip

__all__ = [
    "RULE_NAMES",
    "Alarm",
    "Collision",
    "Datum",
    "Design",
    "Help",
    "Kind",
    "Limits",
    "Probe",
    "Profile",
    "Program",
    "Removal",
    "Run",
    "Setter",
    "Setup",
    "Tool",
    "Toolpath",
    "TurnedDesign",
    "Wear",
    "Workpiece",
    "area",
    "blank",
    "box",
    "check",
    "compare",
    "compare_turning",
    "compensation_panel",
    "controls",
    "cylinder",
    "design",
    "diff",
    "editor",
    "exercise",
    "exercises",
    "fit_limits",
    "form",
    "machines",
    "mark",
    "modern",
    "panel",
    "part",
    "plot_profiles",
    "plot_runs",
    "pocket_panel",
    "probing",
    "profile_panel",
    "progress",
    "read",
    "renumber",
    "run",
    "schemes",
    "steps",
    "strategies",
    "tool_sets",
]  # without help, which would shadow the one of Python


def __getattr__(name: str) -> Any:
    if name in OPENED.__all__:
        return getattr(OPENED, name)
    shelves = {each: shelf for shelf in (part, blank, design, area, strategies, schemes, probing) for each in shelf.__all__}
    near = [] if name.startswith("_") else _nearest(name, dict.fromkeys([*__all__, *OPENED.__all__, *shelves]))
    said = ", ".join(f"{shelves[each].__name__}.{each}" if each in shelves and each not in __all__ else each for each in near)
    raise AttributeError(f"mnclab has no {name!r}" + (f" (near: {said})" if said else ""))


def __dir__() -> list[str]:
    return sorted({*__all__, *OPENED.__all__, "help", "__version__"} - {"load_ipython_extension"})


# In a notebook Tab completes the codes of a control from the first import on: who needs that does not know %load_ext mnclab.
if (_shell := getattr(_sys.modules.get("IPython"), "get_ipython", lambda: None)()) is not None:
    OPENED.load_ipython_extension(_shell)
