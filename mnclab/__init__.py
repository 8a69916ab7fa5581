"""mnclab: part programs of real CNC controls, obeyed exactly as their manuals say, and shown.

A part program is text; a control reads it into blocks; a machine obeys the blocks with a dozen verbs; every obeyed verb
is a row in a table of moves; everything one can look at is computed from that table.

The map of the house, floor by floor (a folder imports only from those above its line)::

    text        what a programmer wrote: Alarm, Program, words, expressions
    geometry    frames, arcs, contours, offsets, regions: numbers, no CNC word
    path        what the tool does: Toolpath in columns, passes over it (corners, compensation), and the feed profile
    workpiece   what the tool meets: the part a probe touches
    machining   how metal is cut, whatever the control: depths, holes, threads, pockets, facing, turning
    comparison  two paths, or strategies, side by side
    machine     who obeys: Machine, Control, Cycle, interpreter, bulk tier, history, Run
    controls    who speaks: a folder a control
    show        what people see and take away: plots, forms, files

This module is the front door, and nothing else: it imports numpy only.
"""

from typing import TYPE_CHECKING

from mnclab.controls import CONTROLS as controls
from mnclab.controls.choice import Help, help, modern, read, run
from mnclab.machine.setup import Datum, Probe, Setup
from mnclab.path.kinds import Kind
from mnclab.path.limits import Limits
from mnclab.path.profile import Profile
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Toolpath
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown
from mnclab.text.program import Program

if TYPE_CHECKING:
    from mnclab.comparison.deviation import Deviation

__version__ = "0.1.0"
__all__ = [
    "Alarm",
    "Datum",
    "Help",
    "Kind",
    "Limits",
    "Probe",
    "Profile",
    "Program",
    "Run",
    "Setup",
    "Tool",
    "Toolpath",
    "compare",
    "compare_turning",
    "controls",
    "diff",
    "editor",
    "form",
    "help",
    "modern",
    "panel",
    "read",
    "run",
]


def compare(region: object, tool: object, *strategies: object, **options: object) -> object:
    """Strategies for clearing an area side by side, a table when shown (needs shapely): `comparison.strategies`."""
    from mnclab.comparison.strategies import compare as build
    from mnclab.geometry.regions import Region

    if not isinstance(region, Region):
        raise TypeError(f"compare takes a Region first, got {type(region).__name__}")
    return build(region, tool, *strategies, **options)  # type: ignore[arg-type]


def compare_turning(profile: object, blank: float, *arguments: object, **options: object) -> object:
    """Roughing schemes of turning on a profile side by side, a table when shown: `comparison.turning` (needs shapely).

    `profile` is an open contour of points (z, r) from the face to the chuck, `blank` the radius of the blank, mm.
    """
    from mnclab.comparison.turning_schemes import compare as build
    from mnclab.geometry.contours import Contour

    if not isinstance(profile, Contour):
        raise TypeError(f"compare_turning takes a Contour first, got {type(profile).__name__}")
    return build(profile, blank, *arguments, **options)  # type: ignore[arg-type]


def diff(one: Run | Toolpath, other: Run | Toolpath, step: float | None = None) -> "Deviation":
    """Two runs, or two paths, laid over one another: the largest deviation (mm) and where; `.plot()` shows both.

    Two programs, two controls, two tool radii, two limits (of their setups: the times differ); `step` mm is how
    closely the paths are looked at.
    """
    from mnclab.comparison.deviation import deviation

    for each in (one, other):
        if not isinstance(each, Run | Toolpath):
            raise Alarm(f"two runs or two paths can be compared, got {shown(each)}", hint="diff(run(…), run(…))")
    times = None
    if isinstance(one, Run) and isinstance(other, Run):
        times = one.profile().time, other.profile().time
    paths = [each.toolpath if isinstance(each, Run) else each for each in (one, other)]
    names = [each.program.title if isinstance(each, Run) else "path" for each in (one, other)]
    if names[0] == names[1]:
        controls = [each.control.name if isinstance(each, Run) else "" for each in (one, other)]
        marks = ["first", "second"] if controls[0] == controls[1] else controls
        names = [f"the {mark} {name}" for mark, name in zip(marks, names)]
    return deviation(paths[0], paths[1], (names[0], names[1]), step, times=times)


def editor(path: str, control: str | None = None, setup: Setup | None = None) -> object:
    """A part program to type in, with alarms and picture that follow, and a button that saves it (needs ipywidgets)."""
    from mnclab.show.editor import editor as build

    return build(path, control, setup)


def form(code: str, control: str) -> object:
    """The parameters of a cycle as a form with a live picture (needs ipywidgets and matplotlib)."""
    from mnclab.show.forms import form as build

    return build(code, control)


def panel(template: str, control: str | None = None, /, **numbers: object) -> object:
    """Number boxes for the places {name} of a program, with a live picture (needs ipywidgets and matplotlib)."""
    from mnclab.show.forms import panel as build

    return build(template, control, **numbers)  # type: ignore[arg-type]


def load_ipython_extension(shell: object) -> None:
    """What `%load_ext mnclab` calls: makes the cell magic `%%mnc`."""
    from mnclab.show.magic import load_ipython_extension as load

    load(shell)
