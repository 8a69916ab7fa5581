"""From a run to its part: what its rows cut with, where the blank and what holds it stand."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from mnclab.machine.axes import CHAIN
from mnclab.machine.coordinates import LOG
from mnclab.machine.cutting import TILT, directions_of_rows, lifted, round_tables, start_known, tools_of_rows, true_path
from mnclab.path.limits import Limits
from mnclab.path.profile import Profile
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.text.alarm import Alarm, Span
from mnclab.text.given import check_number, fitting, shown, whole
from mnclab.text.opening import opened
from mnclab.text.program import NUMBER, Program
from mnclab.workpiece.blank import Revolved, blank, from_datum
from mnclab.workpiece.collision import Collision, Collisions
from mnclab.workpiece.cutting import Cutting, numbers_of, tool_exists
from mnclab.workpiece.cutting_data import CuttingData
from mnclab.workpiece.cutting_data import cutting_data as data_of
from mnclab.workpiece.part import Part
from mnclab.workpiece.removal import Removal
from mnclab.workpiece.workpiece import Workpiece, no_blank

if TYPE_CHECKING:
    from mnclab.design.recognition.proposal import Proposal
    from mnclab.design.recognition.turned import TurnedProposal
    from mnclab.runs.run import Run


# Which tool cuts in a program of a control that has no tool words: every cycle has the one that is made for it.
# The operator changed tools at such a control. A control names the tools of its magazine by the codes of cycles
# (`Control.cycle_tools`, "" for moves of none, "inside G77" where that cuts away from the axis). A tool 0 that the setup
# gives a body stands for all of them.


INSIDE, PLAIN = "inside ", ""


def cycle_tools(run: Run, tools: list[Tool], which: Index) -> tuple[list[Tool], Index]:
    """The tools and which of them each row has (n,), with those of cycles where a row has none."""
    by_code, table = run.control.cycle_tools, {**(run.setup.tools or {}), **run.setup.true_tools}
    if not by_code:
        return tools, which
    path, bare = run.toolpath, ~np.array([tool_exists(tool) for tool in tools])[which]
    if tool_exists(own := table.get(0, Tool())):
        return [*tools, own], np.where(bare, len(tools), which)
    place = {code: len(tools) + k for k, code in enumerate(by_code)}
    chosen = np.array([place[code] for code in _codes(path, tuple(by_code))], dtype=np.int64)
    own_ones = [replace(table.get(number, Tool()), number=number) for number in by_code.values()]
    return [*tools, *own_ones], np.where(bare, chosen, which)


def _codes(path: Toolpath, known: tuple[str, ...]) -> list[str]:
    """The code of the cycle that a row (n,) belongs to. A rapid between cycles brings the tool of the next one."""
    of_label = [next((code for code in known if code and label.split(" ")[0] == code), PLAIN) for label in path.labels]
    codes = [of_label[k] for k in path.label.tolist()]
    codes = _inside(path, codes, known)
    ahead = next((code for code in reversed(codes) if code), PLAIN)
    for row in range(len(codes) - 1, -1, -1):
        if codes[row]:
            ahead = codes[row]
        elif path.kind[row] not in (Kind.LINE, Kind.ARC):
            codes[row] = ahead
    return codes


def _inside(path: Toolpath, codes: list[str], known: tuple[str, ...]) -> list[str]:
    """The same, with a name of its own for turning along Z that is never nearer to the axis than where it began."""
    found, step = list(codes), path.step
    for number in np.unique(step[[INSIDE + code in known for code in codes]]):
        rows = np.flatnonzero(step == number)
        cuts = rows[path.kind[rows] == Kind.LINE]
        along = cuts[path.start[cuts, 2] != path.end[cuts, 2]]
        start = path.start[rows[0], 0]
        if len(along) and path.end[along, 0].min() > start:
            for row in rows:
                found[row] = INSIDE + codes[row]
    return found



Made = TypeVar("Made")
KEPT = 8  # parts, removals and lists of collisions that a run keeps
JUDGED = 3000  # rows up to which a player asks for collisions


def cutting_of(run: Run, stock: Any = None, named: bool = True) -> Cutting:
    """What a run cuts; `stock` in machine coordinates instead of its own blank. An Alarm without any.

    Without `named` the tool's place is known where every axis has moved, not where each was named: that takes less time.
    """
    path, origin = run.toolpath, run.toolpath.origin
    body = run.stock if stock is None else blank(stock)
    if body is None:
        wanted = "three sizes, two corners (x, y, z), or a blank"
        raise no_blank() if stock is None else Alarm(f"stock must be {wanted}, got {shown(stock)}")
    if not body.volume > 0:
        raise Alarm(f"there is nothing to cut: the blank is {shown(body)}")
    body = body if stock is None else from_datum(body, origin)
    tools, which, lift = _held(run)
    start, changed = run.setup.start, run.history.changed
    path = true_path(path, run.setup, changed("tool"), run.first_length, changed(CHAIN))
    directions = directions_of_rows(path, changed(TILT), changed(LOG))
    known = start_known(path, start, *(() if any(start) or not named else _named(run)))
    fixtures = tuple(_placed(run, each) for each in run.setup.fixtures)
    said: dict[str, Any] = {"name": run.place_of_line, "origin": tuple(origin.tolist()), "reach": run.reach}
    said["across"] = run.control.across(run.settings)
    path = lifted(round_tables(path.on_workpiece(), directions), lift, directions)
    return Cutting(path, tools, which, body, *known, directions, fixtures, **said)


def tools_that_cut(run: Run) -> tuple[dict[int, Tool], Index]:
    """The tools by their numbers as the tables stand at the end, and the number of each row of the path (n,)."""
    tools, which, _ = _held(run)
    return {tool.number: tool for tool in tools} | run.tables.tools, numbers_of(run.toolpath, tools, which)


def tip_lift(run: Run) -> Array:
    """How much higher than on its path the tip of each row (n,) really is, mm: where a tool is not as its table says."""
    return np.asarray(_held(run)[2])


def truly_higher(run: Run, step: int) -> float:
    """The same after a step."""
    row = int(np.searchsorted(run.toolpath.step, step, "right")) - 1
    return float(tip_lift(run)[row]) if row >= 0 else 0.0


def _held(run: Run) -> tuple[list[Tool], Index, Any]:
    step, setup, history = run.toolpath.step, run.setup, run.history
    tools, which, lift = tools_of_rows(step, history.changed("tool"), setup.tools, history.value, setup.true_tools)
    return *cycle_tools(run, tools, which), lift


def _named(run: Run) -> tuple[Mask, Mask]:
    """The axes (n, 3) whose words stand in the block of a row, and those in a positioning block before it: it may have
    moved nothing, as X0 does where a machine starts."""
    step = run.toolpath.step
    found, earlier = np.zeros((2, len(step), 3), dtype=bool)
    for index, program in enumerate(run.programs):
        mine = run.steps.program == index
        block = np.where(mine, run.steps.block, 0)
        positioning = _positioning(program)[block]
        for axis, letter in enumerate("XYZ"):
            here = mine & _has(program, letter)[block]
            before = np.flatnonzero(here & positioning)
            found[:, axis] |= here[step]
            earlier[:, axis] |= step > before[0] if len(before) else False
    return found, earlier


def _positioning(program: Program) -> Mask:
    """The blocks (b,) whose X, Y and Z are places to go to: plain ones, those with G0 or G1, L of Klartext."""
    straight = program.keywords.index("L") if "L" in program.keywords else -1
    return program.plain | (program.keyword == straight) | _has(program, "G", (0.0, 1.0))


def _has(program: Program, address: str, values: Collection[float] | None = None) -> Mask:
    """The blocks (b,) with an address, of certain values."""
    found = np.zeros(len(program), dtype=bool)
    if address in program.addresses:
        words = program.address == program.addresses.index(address)
        if values is not None:
            words &= (program.form == NUMBER) & np.isin(program.value, list(values))
        found[np.repeat(np.arange(len(program)), np.diff(program.first))[words]] = True
    return found


def _placed(run: Run, fixture: Any) -> Any:
    """A fixture in the coordinates of the path."""
    if isinstance(fixture, Part):
        frame = np.eye(4)
        frame[:3, 3] = -run.toolpath.origin
        return fixture.placed(frame)
    body = blank(fixture)
    return body.moved(-run.toolpath.origin) if body else body


def rows_from_home(run: Run) -> int:
    """How many rows of a path bring the tool from home to a blank; none where there is no blank or drum, or nothing else."""
    path = run.toolpath
    known = start_known(path, run.setup.start)[1]
    first = known - 1 if 0 < known <= len(path) and path.kind[known - 1] != Kind.RAPID else known
    return first if (run.stock is not None or path.cylinders) and path.is_motion[first:].any() else 0


def workpiece(
    run: Run, line: int | None = None, pass_: int = 1, row: int | None = None, step: float | None = None, stock: Any = None
) -> Workpiece:
    """What is left after a run, a pass of a line, or a row."""
    last = None
    if row is not None and line is not None:
        raise Alarm(f"a part is that after a line or after a row, got line {shown(line)} and row {shown(row)}")
    if row is not None:
        last, n = whole(row, "the row"), len(run.toolpath)
        if not -n <= last < n:
            raise Alarm(f"row must be 0 … {n - 1}, got {row}")
        last %= n
    elif line is not None:
        last = run.at(line, pass_).rows.stop - 1
    return _kept(run, ("workpiece", last, step), stock, lambda: _workpiece(run, last, step, stock))


def _workpiece(run: Run, last: int | None, step: float | None, stock: Any) -> Workpiece:
    cutting, whole = cutting_of(run, stock), None
    if last is not None:
        cutting, whole = cutting.until(last), cache(lambda: workpiece(run, step=step, stock=stock))
    if cutting.lathe:
        from mnclab.workpiece.turning.turned import Turned

        return Turned(cutting, step, whole)
    from mnclab.workpiece.milling.milled import Milled

    return Milled(cutting, step, whole)


def removal(run: Run, profile: Profile, step: float | None = None) -> Removal:
    """How much material goes, and how fast under the limits of a profile."""
    return _kept(run, ("removal", profile.limits, step), None, lambda: Removal(workpiece(run, step=step), profile))


def design(run: Run, stock: Any = None) -> Proposal | TurnedProposal:
    """The design that a run makes, with the name of its program."""
    cutting, title = cutting_of(run, stock), Path(run.program.name).stem
    proposed = opened(f"mnclab.design.recognition.{'turned' if cutting.lathe else 'proposal'}", "proposed")
    found: Proposal | TurnedProposal = replace(proposed(cutting), title=title)
    return found


def collisions(run: Run, stock: Any = None, step: float | None = None) -> Collisions:
    """What a run meets that it must not; the cut that would have left the travel of the machine among it."""
    return _kept(run, ("collisions", step), stock, lambda: _collisions(run, stock, step))


def _collisions(run: Run, stock: Any, step: float | None) -> Collisions:
    cutting = cutting_of(run, stock)
    if cutting.lathe:
        from mnclab.workpiece.turning.collisions import collisions_of as of_lathe

        found = of_lathe(cutting, step)
    else:
        from mnclab.workpiece.milling.collisions import collisions_of as of_mill

        found = of_mill(cutting, step)
    if run.settings["stopped_spindle"] == "accept":
        kept = (each for each in found if each.kind != "spindle" or run.toolpath.spindle[each.row])
        found = Collisions(kept, found.notes)
    notes = *found.notes, *cutting.bare_told()
    reach = run.reach or ("" if run.toolpath.is_motion.any() else "since nothing moves")
    part = partial(workpiece, run, step=step, stock=stock)
    return Collisions([*found, *_beyond_travel(run)], notes, reach, part)


def _beyond_travel(run: Run) -> Iterator[Collision]:
    """The block at which the run was stopped; its `row` is the last one before it."""
    if run.stopped is None:
        return
    place, depth, alarm = run.stopped
    x, y, z = np.subtract(place, run.toolpath.origin).tolist()
    span = alarm.span or Span(0, 0)
    file = run.programs[span.program].name
    unit = run.toolpath.unit
    message = f"{alarm.message}, {depth / unit.length:.3f} {unit.short} beyond"
    yield Collision("travel", message, span.line, span.program, len(run.toolpath) - 1, (x, y, z), depth, file)


def _kept(run: Run, key: tuple[Any, ...], stock: Any, make: Callable[[], Made]) -> Made:
    """What a run was asked for, made once as long as it is one of the last few; of another blank every time.

    The last of a key is the step.
    """
    if key[-1] is not None:
        check_number(key[-1], "the step of a workpiece (mm)", above=0)
    if stock is not None:
        return make()
    found: Made = run.made.pop(key) if key in run.made else make()
    run.made[key] = found
    if len(run.made) > KEPT:
        del run.made[next(iter(run.made))]
    return found


def played(run: Run) -> tuple[Cutting | None, Collisions]:
    """What a player cuts and marks: nothing without a blank, no collisions where finding them takes long."""
    stock = run.stock
    if stock is None or not stock.volume > 0:
        return None, Collisions()
    judged = len(run.toolpath) <= JUDGED
    if run.toolpath.lathe:
        from mnclab.workpiece.turning.turned import turns

        if not turns(stock):  # a body that lies across, one that was milled
            return None, Collisions()
        judged &= not (isinstance(stock, Revolved) and any(stock.at[:2]))  # what runs out of true is not judged
    return cutting_of(run), collisions(run) if judged else Collisions()


# The cutting data of a run, tool by tool, against the limits of its machine and of its tools; and its sheets.

MOVES = 200_000  # beyond which what they take away is not worked out

Most = float | Mapping[int, float] | None


@fitting
def cutting_data(
    run: Run, limits: Limits | str | None = None, *, machine: Limits | str | None = None,
    vc: Most = None, fz: Most = None, kc: float | None = None, material: bool = True,
) -> CuttingData:  # fmt: skip
    """Spindle and cutting speed, feed a tooth, depth and width of cut, mean chip thickness and removal rate of each tool.

    `limits` or `machine` as in `profile`; `vc` m/min and `fz` mm are the greatest that a tool bears, a number for all or a
    dict by tool number; with `kc` N/mm², the specific cutting force of the material, it has the power at the spindle. Without
    `material` there are speeds and feeds alone, which takes half the time. The formulas are in `mnclab.workpiece.cutting_data`.
    """
    (tools, numbers), profile = run.tools_that_cut, run.profile(limits, machine=machine)
    most = {name: _of_tools(given, name, tools) for name, given in (("vc", vc), ("fz", fz)) if given is not None}
    if kc is not None:
        check_number(kc, "the specific cutting force kc (N/mm²)", above=0)
    found, unknown = None, "Without a blank"
    if run.stock is not None and run.stock.volume > 0:
        unknown = f"Of more than {MOVES:,} moves"
        if int(run.toolpath.is_motion.sum()) <= MOVES:
            try:
                found = removal(run, profile)
            except Alarm as alarm:  # such as of a blank that no lathe turns
                unknown = f"Of this blank ({alarm.message})"
    return data_of(
        run.toolpath, tools, numbers, profile.limits, found, most=most, kc=kc, reach=run.reach, unknown=unknown, material=material
    )


def depths_of_passes(run: Run, number: int) -> dict[float, int]:
    """The depths of the passes on a lathe and of the pecks of a drill, by the volume that each takes away on its whole way, and
    the line of each.

    The shoulder that a pass meets at its end is so no depth of it. None of a mill.
    """
    path, (tools, numbers), volumes = run.toolpath, run.tools_that_cut, run.removal().volumes
    rows = np.flatnonzero((numbers == number) & (volumes > 0))
    tool, area = tools[number], volumes[rows] / np.pi
    if tool.kind == "drill":
        deep = area / tool.effective_radius**2
    elif path.lathe:  # V = π L ((r + a)² − r²) outside, π L (r² − (r − a)²) inside
        r, out = np.abs(path.start + path.end)[rows, 0] / 2, -1 if tool.kind == "boring" else 1
        deep = out * (np.sqrt(np.maximum(r**2 + out * area / path.lengths[rows], 0)) - r)
    else:
        return {}
    return dict(zip(deep.tolist(), path.line[rows].tolist()))


def _of_tools(given: Any, name: str, tools: Mapping[int, Any]) -> dict[int, float]:
    """A limit by tool number; an Alarm for what is none."""
    what = f"the greatest {name} of a tool ({'m/min' if name == 'vc' else 'mm'})"
    if not isinstance(given, Mapping):
        check_number(given, what, above=0)
        return dict.fromkeys(tools, float(given))
    for number, value in given.items():
        if number not in tools:
            known = ", ".join(f"{each}" for each in sorted(tools) if each)
            raise Alarm(f"{name} is given for a tool that is not in the table, {shown(number)}", hint=f"tools: {known}")
        check_number(value, what, above=0)
    return {int(number): float(value) for number, value in given.items()}


@fitting
def setup_sheet(
    run: Run, path: str | Path, title: str | None = None, *, material: str = "", date: str = "", author: str = ""
) -> Path:  # fmt: skip
    """Write the set-up sheet, .html or .pdf: zero points, blank with a drawing, fixtures, tools, correctors.

    `material`, `date` and `author` stand above; of what is not given there is a line to fill in.
    """
    from mnclab.show.report.gathering import save_sheet

    return save_sheet(run, "setup", path, title, material=material, date=date, author=author)


@fitting
def tool_sheet(run: Run, path: str | Path, title: str | None = None) -> Path:
    """Write the tool sheet, .html or .pdf: the tools with their sizes, and how they cut."""
    from mnclab.show.report.gathering import save_sheet

    return save_sheet(run, "tools", path, title)


@fitting
def measuring_sheet(run: Run, path: str | Path, title: str | None = None) -> Path:
    """Write the measuring record, .html or .pdf, with its pictures; an Alarm where nothing was measured."""
    from mnclab.show.report.gathering import save_sheet

    return save_sheet(run, "measuring", path, title)
