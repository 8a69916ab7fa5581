"""What was asked for beside the part: codes, blocks, values, cutting data, time and length."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import numpy as np

from mnclab.learning.exercise import Exercise
from mnclab.learning.findings import ASKED, SLOW, Finding
from mnclab.path.toolpath import Kind
from mnclab.runs.material import cutting_of, depths_of_passes
from mnclab.runs.run import Run


def wishes(exercise: Exercise) -> int:
    """How many things are asked for."""
    asked = exercise.asked
    cutting = sum(max(1, sum(value is not None for value in each[1:])) for each in asked.cutting)
    codes, blocks = len(asked.must) + len(asked.must_not), asked.blocks is not None
    return codes + len(asked.values) + cutting + blocks + bool(asked.cabinet)


def of_asked(exercise: Exercise, run: Run) -> Iterator[Finding]:
    """What an answer has not that it was asked for, and what it has that it must not."""
    asked, lines = exercise.asked, list(executed(run))
    for code in asked.must:
        if (line := first_line(code, lines)) is None:
            yield _without(code)
        elif code in SIDES and run.stock is not None and not _compensated(run):
            yield Finding(ASKED, f"without {code}", line, (f"the task asks for {code}, and it is not on where the tool cuts",))
    for code in asked.must_not:
        if (line := first_line(code, lines)) is not None:
            yield Finding(ASKED, f"with {code}", line, (f"the task does not allow {code}",))
    if asked.blocks is not None and len(run.program) > asked.blocks:
        told = f"the program has {len(run.program)} blocks, {asked.blocks} are allowed"
        yield Finding(ASKED, "blocks", 0, (told, f"{told}: what is written more than once?"))
    for name, (least, most) in asked.values.items():
        value = run.variables.get(name, run.measured.get(name))
        if not isinstance(value, int | float) or not least <= value <= most:
            found = "has no value" if value is None else f"is {value:g}" if isinstance(value, int | float) else "is no number"
            yield Finding(ASKED, f"value {name}", 0, (f"{name} is not right at the end", f"{name} {found} at the end"))
    if asked.cutting:
        yield from _of_cutting(exercise, run)
    if asked.cabinet:
        yield from _of_cabinet(exercise, run)


def unwritten(exercise: Exercise, run: Run) -> Iterator[Finding]:
    """What a program that stops was asked for and does not have in any block: G42 is written where G41 was meant."""
    lines = [(0, " ".join(run.program.code_of(k))) for k in range(len(run.program))]
    return (_without(code) for code in exercise.asked.must if first_line(code, lines) is None)


SIDES = ("G41", "G42", "RL", "RR")  # written and taken back in the air they are no compensation


def _compensated(run: Run) -> bool:
    """Whether a contour is cut with radius compensation."""
    return any(run.history.value("side", step) for step in set(run.toolpath.step[cutting_of(run).inside].tolist()))


def _without(code: str) -> Finding:
    return Finding(ASKED, f"without {code}", 0, (f"the task asks for {code}, and no block that was run has it",))


NAMES = {
    "n": ("speed", "the spindle speed"), "vf": ("feed", "the feed"), "vc": ("surface", "the cutting speed"),
    "fz": ("per_tooth", "the feed a tooth"), "f": ("per_rev", "the feed a revolution"),
    "ap": ("depth", "the depth of cut"), "ae": ("width", "the width of cut"),
}  # fmt: skip


def _of_cutting(exercise: Exercise, run: Run) -> Iterator[Finding]:
    asked, tools = exercise.asked.cutting, run.tools_that_cut[0]
    mills = {number for number, tool in tools.items() if not run.toolpath.lathe and tool.kind != "drill"}
    material = any(each.ae or (each.ap and each.tool in mills) for each in asked)  # others have the depth of their passes
    found = {cut.tool: cut for cut in run.cutting_data(material=material)}
    for wanted in asked:
        cut = found.get(wanted.tool)
        if cut is None:
            told = f"tool {wanted.tool} cuts nothing: does its spindle turn, and does it move at feed?"
            yield Finding(ASKED, f"tool {wanted.tool} cuts", 0, (told,))
            continue
        for name, (column, said) in NAMES.items():
            if (limits := getattr(wanted, name)) is None:
                continue
            deep = depths_of_passes(run, wanted.tool) if name == "ap" else {}
            have = (min(deep), max(deep)) if deep else getattr(cut, column)
            low, high = have if have is not None else (0.0, math.inf)  # what is not known is not right
            slack = 1e-9 * abs(limits[1])
            if not (limits[0] - slack <= low and high <= limits[1] + slack):
                way = "low" if low < limits[0] else "high"
                told = f"{said} of tool {wanted.tool} is not as asked for"
                line = deep[low if way == "low" else high] if deep else _line_of_tool(run, wanted.tool)
                yield Finding(ASKED, f"{name} of tool {wanted.tool}", line, (told, f"{said} of tool {wanted.tool} is too {way}"))


def _of_cabinet(exercise: Exercise, run: Run) -> Iterator[Finding]:
    """The tools at work that neither the machine has nor the cabinet offers."""
    tools, numbers = run.tools_that_cut
    for number in np.unique(numbers[run.toolpath.is_motion & (numbers > 0)]).tolist():
        tool, theirs = tools[number], (exercise.setup.tools or {}).get(number)
        offered = (all(getattr(tool, name) in (value if isinstance(value, list) else [value]) for name, value in row.items())
                   for row in exercise.asked.cabinet)  # fmt: skip
        if tool != theirs and not any(offered):
            told = f"tool {number} is none of those in the cabinet: compare its kind, angles and sizes"
            yield Finding(ASKED, "cabinet", _line_of_tool(run, number), (told,))


def _line_of_tool(run: Run, number: int) -> int:
    """The line of the first cut of a tool."""
    rows = np.flatnonzero((run.tools_that_cut[1] == number) & run.toolpath.is_motion)
    return int(run.toolpath.line[rows[0]]) if len(rows) else 0


NAMED = re.compile(r'"[^"]*"|(?<=PGM )\s*\S+')  # LBL "RL" and BEGIN PGM RL are no compensation


def executed(run: Run) -> Iterator[tuple[int, str]]:
    """The lines of the program that were run, each with its text before a comment, without names, in capitals."""
    program = run.program
    blocks = np.unique(run.steps.block[run.steps.program == 0])
    for block in blocks[blocks < len(program)].tolist():
        line = int(program.line_of(block))
        yield line, NAMED.sub(" ", " ".join(program.code_of(block)).upper())


def first_line(code: str, lines: list[tuple[int, str]]) -> int | None:
    """The first line that has a code: "G1" is found in N10G01X5, not in G10."""
    found = ((part.rstrip("0123456789"), part) for part in code.upper().split())
    parts = [(letters, part[len(letters) :].lstrip("0") or "0") if part != letters else (letters, "") for letters, part in found]
    written = r"\s+".join(re.escape(letters) + (rf"\s*0*{number}" if number else "") for letters, number in parts)
    follows = "A-Z" if not code[-1:].isdigit() else "0-9" if not parts[-1][0] else "0-9."  # CYCL DEF 10 is written 10.0, 10.1
    wanted = re.compile(rf"(?<![A-Z_]){written}(?![{follows}])")
    return next((line for line, text in lines if wanted.search(text)), None)


def economy(exercise: Exercise, run: Run) -> tuple[float, list[Finding]]:
    """The mark for time and length, from 1 within what was stated down to 0 at twice as much, and what to say of it."""
    asked, marks, found = exercise.asked, [1.0], []
    for name, most in (("time", asked.time), ("length", asked.length)):
        if most is None:
            continue
        timed = name == "time"
        have = run.profile().time if timed else length(run)
        marks.append(min(1.0, max(0.0, 2.0 - have / most)))
        if have > most:
            line, why = lost(run, timed)
            said = f"it can be quicker: {have:.1f} s" if timed else f"the way can be shorter: {have:.0f} mm"
            told = f"{said} of {most:g}"
            found.append(Finding(SLOW, f"economy of {name}", line, (told, f"{told}; {why}")))
    return min(marks), found


def lost(run: Run, timed: bool) -> tuple[int, str]:
    """What most of the time, or else of the way, goes to beside the cuts, in words, and the line that spends most on it."""
    path, profile = run.toolpath, run.profile()
    rapid, cuts = path.kind == Kind.RAPID, run.removal().volumes > 0 if run.stock is not None else False
    each = profile.seconds - profile.lost if timed else path.lengths
    spent = {"rapids": each * rapid, "moves at feed that take nothing away": each * (path.is_motion & ~rapid & ~cuts)}
    if timed:
        spent |= {"speeding up and braking": profile.lost, "changes of tools": each * (path.kind == Kind.TOOL),
                  "changes of the spindle's speed": each * (path.kind == Kind.SPINDLE)}  # fmt: skip
    what = max(spent, key=lambda name: float(spent[name].sum()))
    much = f"{spent[what].sum():.1f} s" if timed else f"{spent[what].sum():.0f} mm"
    return int(path.line[spent[what].argmax()]), f"{much} go to {what}"


def length(run: Run) -> float:
    """The whole way of the tool, mm."""
    return float(run.toolpath.lengths[run.toolpath.is_motion].sum())
