"""Whether two programs make the same motion, or the same part: the verdict, and all that differs by kinds.

Two moves are the same that end within the tolerance of each other, arcs at their quarters too, with feeds and speeds within half
a percent, which rounding in inches needs. Rapids are compared from cut to cut. What a machine makes of it is not compared: how it
rounds corners (G64, cycle 32), how long it takes. Lengths are in mm, feeds in mm/min.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Collection
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mnclab.comparison.diff import names_of
from mnclab.comparison.differences import differences, in_order
from mnclab.comparison.found import NONE, Found
from mnclab.comparison.motion import motion_of
from mnclab.comparison.parts import around, collided, not_comparable, one_blank, part_apart
from mnclab.comparison.ways import Around
from mnclab.path.corners import Corner
from mnclab.path.listing import MM, Unit, figure, point, words
from mnclab.path.toolpath import Kind
from mnclab.text.alarm import ALARM, Alarm, several
from mnclab.text.given import check_number, choice, shown
from mnclab.text.tables import Listing, Pictured, html_table, save_as, text_table, write_csv, write_picture

#: What may differ, the worst first -> what it means.
KINDS = {
    "stops": "a program stops before its end, so that nothing is proven",
    "collision": "only one of them collides",
    "rapid": "the second goes lower at rapid",
    "nearer": "the second comes nearer at rapid than the first ever does",
    "aside": "the second goes elsewhere at rapid, no higher: something may stand there (fixtures of the setup tell)",
    "geometry": "other cuts",
    "depth": "the same cuts at another depth",
    "side": "radius compensation on another side",
    "tool": "another tool",
    "spindle": "another speed or sense of the spindle",
    "feed": "another feed",
    "dwell": "another dwell, or a stop",
    "coolant": "another coolant",
    "order": "the same cuts in another order",
    "chords": "lines within the tolerance of an arc",
    "lifts": "another way between cuts, nowhere lower or nearer",
    "leftovers": "something else is on at the end",
    "restart": "the spindle is started again behind a tool change, or held through it: not every machine holds it",
    "centre": "one says the way of the tool's centre, the other compensates its radius: the same with this tool alone",
    "number": "another tool number, of a tool with the same measures",
}
#: What one of a kind is called where they are counted.
NOUNS = dict(zip(KINDS, (
    "stop", "collision", "lower rapid", "nearer rapid", "rapid detour", "other cut", "other depth", "other side", "other tool",
    "other spindle speed", "other feed", "other dwell", "other coolant state", "moved cut", "arc in lines", "other lift",
    "leftover", "spindle restart", "centre path", "other tool number",
), strict=True))  # fmt: skip
MAY_BE_ALLOWED = ("lifts", "chords", "order")
BESIDE = ("leftovers", "restart", "centre", "number")  # told, but no motion
#: With one of these the part is not the same, even where the sweep of the tool says so: a tool breaks, a clamp is hit.
UNSAFE = ("stops", "collision", "rapid", "nearer", "side", "spindle", "feed")
SAME_MOTION, SAME_PART, DIFFERENT = "same motion", "same part", "different"


class Difference(NamedTuple):
    """One difference: its kind, and of both programs the line, its file, the block, the place (mm) and what is done there.

    `rows` are those of the paths, -1 where there is none; `amount` in `unit`, nan where there is no number; `moves` in a row
    are alike; `values` are what each has. `harmless` ones were allowed.
    """

    kind: str
    lines: tuple[int, int]
    files: tuple[str, str]
    blocks: tuple[str, str]
    places: tuple[tuple[float, ...], tuple[float, ...]]
    doing: tuple[str, str]
    amount: float
    unit: str
    values: tuple[str, str]
    moves: int
    rows: tuple[int, int]
    harmless: bool

    @property
    def told(self) -> str:
        """By how much, in words."""
        amount = f"{figure(self.amount, 4)} {self.unit}" if self.unit and 0 < self.amount < float("inf") else ""
        if any(self.values):
            said = f"{self.values[0]} against {self.values[1]}" + (f" ({amount})" if amount else "")
        else:
            said = f"{amount} apart" if amount else ""
        return f"{said} over {self.moves} moves".strip() if self.moves > 1 else said

    @property
    def sentence(self) -> str:
        """Where it is, in both programs, and what it is."""
        here, there = (
            f"line {number} of {file}, `{block}`{f', {doing}' if doing else ''}" if number else f"nothing in {file}"
            for number, file, block, doing in zip(self.lines, self.files, self.blocks, self.doing)
        )
        return f"{self.kind}: {KINDS[self.kind]}{f', {self.told}' if self.told else ''}: {there}; against {here}"

    def as_dict(self) -> dict[str, Any]:
        """The same for JSON."""
        return {**self._asdict(), "amount": self.amount if abs(self.amount) < float("inf") else None, "told": self.told}


@dataclass(frozen=True, eq=False, repr=False)
class Proof(Pictured, Listing):
    """What `mnclab.prove` found: `verdict` is "same motion", "same part" or "different"; a table of the differences.

    `paths` and `names` are those of the two programs, `part` says why their parts are not the same or were not compared, `blank`
    whose blank was taken where only one has any. Its truth is whether the motion is not the same, as that of `mnclab.diff`:
    `if mnclab.prove(a, b): print("look")`.
    """

    NUMBERS, CODE, MOST = (1, 3), (2, 4), 30

    verdict: str
    differences: tuple[Difference, ...]
    names: tuple[str, str]
    tolerance: float
    paths: tuple[Any, Any]
    part: str = ""
    blank: str = ""

    def __bool__(self) -> bool:
        """Whether the motion is not the same."""
        return self.verdict != SAME_MOTION

    def __len__(self) -> int:
        return len(self.differences)

    @property
    def harmless(self) -> bool:
        """Whether the motion is the same, or the part is and no more differs than what may be allowed."""
        return self.verdict == SAME_MOTION or (self.verdict == SAME_PART and {*self.counts} <= {*MAY_BE_ALLOWED, *BESIDE})

    @property
    def first(self) -> Difference | None:
        """The first place where they differ, in the order of the motion: of what could hurt, else of lifts, else of what was
        allowed, else of what is no motion. Where a unit was mistaken lifts are as wrong as all."""
        found, late = self.differences, () if self.scale else ("lifts",)
        return min(found, key=lambda each: (each.kind in BESIDE, each.harmless, each.kind in late), default=None)

    @property
    def zeros(self) -> str:
        """Where the two zero points are from which places count, the first that each program selects; empty if they are one."""
        one, other = (path.origin for path in self.paths)
        if np.abs(one - other).max() <= self.tolerance:
            return ""
        return f"places count from the first zero point of each, in machine coordinates {point(one)} and {point(other)}"

    @property
    def scale(self) -> str:
        """A unit that was mistaken, in words; empty where none was."""
        one, other = (float(path.lengths[path.kind != Kind.RAPID].sum()) for path in self.paths)
        small, large = sorted((one, other))
        return "all is 25.4 times as large in one of them: inches for mm" if 0 < 24.5 * small < large < 26.3 * small else ""

    @property
    def counts(self) -> dict[str, int]:
        """How many differences of each kind there are, the worst kind first."""
        many = Counter(each.kind for each in self.differences)
        return {kind: many[kind] for kind in KINDS if kind in many}

    @property
    def sentence(self) -> str:
        """The verdict with its reasons, and the first place where they differ."""
        counts = ", ".join(several(many, NOUNS[kind]) for kind, many in self.counts.items())
        if not any(path.is_motion.any() for path in self.paths) and not counts:
            return "not proven: there is no motion in either"
        if self.verdict == SAME_MOTION:
            more = f"beside it: {counts}" if counts else ""
            left = "; ".join(each.sentence for each in self.differences if each.kind in BESIDE)
            return "; ".join(filter(None, [f"the same motion within {self.tolerance:g} mm", more, left, self.blank, self.zeros]))
        assert self.first is not None
        if "stops" in self.counts:
            verdict = "not proven"
        else:
            verdict = "the same part, made another way" if self.verdict == SAME_PART else "different"
        reasons = f"{verdict} ({counts})", self.scale, self.part, self.blank, f"first {self.first.sentence}", self.zeros
        return "; ".join(filter(None, reasons))

    @property
    def above(self) -> str:
        return f"{self.names[0]} and {self.names[1]}: {self.sentence}"

    def __repr__(self) -> str:
        head, rows, numbers = self.table()
        more = f"… {len(rows) - self.MOST} more" if len(rows) > self.MOST else ""
        return "\n".join(filter(None, [self.above, text_table(head, rows[: self.MOST], numbers) if rows else "", more]))

    @property
    def unit(self) -> Unit:
        """In what it is drawn: the unit of both paths, mm where they have two."""
        one, other = self.paths
        return one.unit if one.unit == other.unit else MM

    @property
    def head(self) -> tuple[str, ...]:
        one, other = self.names
        return "kind", f"line of {one}", "block", f"line of {other}", "its block", "difference", "harmless"

    def texts(self) -> list[tuple[str, ...]]:
        """The differences, in the order of the motion."""
        return [
            (each.kind, str(each.lines[0] or "–"), each.blocks[0], str(each.lines[1] or "–"), each.blocks[1], each.told,
             "yes" if each.harmless else "no") for each in self.differences
        ]  # fmt: skip

    def as_dict(self) -> dict[str, Any]:
        """All of it for JSON."""
        found = {name: getattr(self, name) for name in ("verdict", "sentence", "names", "tolerance", "counts", "part", "blank")}
        return found | {"differences": [each.as_dict() for each in self.differences]}

    def plot(self, **options: Any) -> Any:
        """Both paths about the first difference, with both places marked; `number` of another one, `view`, `size`."""
        from mnclab.show.plot.side_by_side import plot_proof

        return plot_proof(self, **options)

    def save(self, path: str | Path, **options: Any) -> Path:
        """Write all of it (.html, .json), the table (.csv) or the picture (.svg, .pdf, .png, with the options of `plot`)."""
        writers = dict.fromkeys((".svg", ".pdf", ".png"), write_picture)
        writers |= {".html": _write_page, ".json": _write_json, ".csv": write_csv}  # type: ignore[dict-item]
        return save_as(self, path, writers, "cannot write a proof as {}", **options)

    def _repr_html_(self) -> str:
        above, end, shown = Listing._repr_html_(self).partition("</p>")
        two = html_table(("first difference", *self.names), _two(self.first)) if self.first else ""
        return re.sub("`([^`]*)`", r"<code>\1</code>", above) + end + two + shown


def _two(first: Difference) -> list[tuple[str, str, str]]:
    """A difference as rows of what each program has."""
    places = (point(each) if each else "–" for each in first.places)
    rows = [("line", *(str(each or "–") for each in first.lines)), ("block", *first.blocks), ("place, mm", *places)]
    return [*rows, ("does", *first.doing), *([("has", *first.values)] if any(first.values) else [])]  # type: ignore[list-item]


def _write_json(proof: Proof, path: Path) -> None:
    path.write_text(json.dumps(proof.as_dict(), allow_nan=False), "utf-8")


def _write_page(proof: Proof, path: Path) -> None:
    """A page that needs nothing else, with the picture of the first difference."""
    picture = proof.plot()._repr_mimebundle_()["text/html"] if proof.first is not None else ""
    title = escape(f"{proof.names[0]} and {proof.names[1]}: {proof.verdict}")
    style = "body{font-family:sans-serif;margin:2em;max-width:75em}table,img{margin:1em 0}td,th{padding:2px 8px;text-align:left}"
    page = f"<!doctype html><html lang=en><meta charset=utf-8><title>{title}</title><style>{style}</style>"
    path.write_text(f"{page}<h1>{title}</h1>{proof._repr_html_()}{picture}</html>\n", "utf-8")


def proof(one: Any, other: Any, tolerance: float = 0.001, allow: Collection[str] = ()) -> Proof:
    """The proof of two runs; see `mnclab.prove`."""
    check_number(tolerance, "the tolerance (mm)", at_least=1e-6, at_most=1.0)
    if isinstance(allow, str):
        allow = (allow,)
    if not isinstance(allow, Collection):
        raise Alarm(f"allow must be a list of kinds, got {shown(allow)}", hint=f"allow={MAY_BE_ALLOWED}")
    allowed = tuple(choice(each, "what is allowed", MAY_BE_ALLOWED) for each in allow)
    runs, tools = (one, other), list[Any]()
    motions = motion_of(one, tools), motion_of(other, tools)
    stock = one_blank(runs)
    found = differences(*motions, tolerance, around(runs, stock))
    names, part, shared = names_of(one, other), "", ""
    told: tuple[Difference, ...] = ()
    if any(map(_broken, runs)):
        found = _stopped(runs, found)
        told, runs = _contours(runs, found, names, allowed, tolerance) or (told, runs)
    elif found and (why := not_comparable(runs, motions)):
        part = f"the parts were not compared: {why}" if {each.kind for each in found} - {*allowed, *BESIDE} else ""
    elif found:
        found = in_order([*found, *collided(runs, stock)], *motions)
        part = part_apart(runs, motions, tolerance, found, stock)
        shared = f"the blank of {names[one.stock is None]} was taken for both" if stock is not None else ""
    serious = {each.kind for each in found} - {*allowed, *BESIDE}
    still = not any(motion.path.is_motion.any() for motion in motions)  # which proves nothing
    verdict = DIFFERENT if part or still or serious & {*UNSAFE} else SAME_PART if serious else SAME_MOTION
    told = told or tuple(_told(each, runs, names, allowed) for each in found)
    return Proof(verdict, told, names, float(tolerance), (runs[0].toolpath, runs[1].toolpath), part, shared)


def _contours(
    runs: tuple[Any, Any], found: list[Found], names: tuple[str, str], allowed: Collection[str], tolerance: float
) -> tuple[tuple[Difference, ...], tuple[Any, Any]] | None:
    """Where compensation stops a program what differs in the contours, and both runs with tools of no radius, which have them."""
    if any(each.kind == "geometry" for each in found) or not any(run.programmed.side.any() for run in runs):
        return None
    thin = [{number: replace(tool, radius=0.0) for number, tool in (run.setup.tools or {}).items()} for run in runs]
    bare: Any = tuple(run.again(replace(run.setup, tools=tools)) for run, tools in zip(runs, thin))
    if any(map(_broken, bare)):
        return None
    of_tools = list[Any]()
    one, other = (motion_of(run, of_tools) for run in bare)
    why = [each for each in differences(one, other, tolerance, Around()) if each.kind in ("geometry", "depth")]
    if not why:
        return None
    a, b = (
        int(np.searchsorted(thin.toolpath.step, run.toolpath.step[row])) if row >= 0 else row
        for thin, run, row in zip(bare, runs, found[-1].rows)
    )
    stops = _told(found[-1], runs, names, allowed)._replace(rows=(a, b))
    return (*(_told(each, bare, names, allowed) for each in why), stops), bare


def _stopped(runs: tuple[Any, Any], found: list[Found]) -> list[Found]:
    """Where the programs stop, and what differs before."""
    rows, said = list[int](), list[str]()
    known = [each for each in found if each.kind != "leftovers" and NONE not in each.values]
    for k, (run, other) in enumerate(zip(runs, runs[::-1])):
        if _broken(run):
            alarm = next((each for each in run.alarms if each.severity == ALARM), None)
            rows, said = [*rows, len(run.toolpath) - 1], [*said, f"stops{f': {alarm.message}' if alarm else ''}"]
            known = [each for each in known if each.rows[k] < rows[k]]
        else:  # where it goes on, as far as that is known
            alone = [each.rows[k] for each in found if each.values[1 - k] == NONE]
            rows, said = [*rows, min(alone, default=_beside(run, other))], [*said, "goes on"]
    return [*known, Found("stops", (rows[0], rows[1]), float("nan"), "", (said[0], said[1]))]


def _beside(run: Any, other: Any) -> int:
    """The row of a run that ends nearest to where the other one stopped."""
    ends, last = run.toolpath.end, other.toolpath.end[-1:]
    return int(np.linalg.norm(ends - last, axis=1).argmin()) if len(ends) and len(last) else len(ends) - 1


def _broken(run: Any) -> bool:
    """Whether a run stopped before its end, or something in it was refused."""
    return bool(run.reach) or not run.ok


def _told(found: Found, runs: tuple[Any, Any], names: tuple[str, str], allowed: Collection[str]) -> Difference:
    """A difference with the lines, blocks and places of its rows."""
    halts = (run.halt if found.kind == "stops" else None for run in runs)
    one, other = (_spot(run, row, halt, name) for run, row, halt, name in zip(runs, found.rows, halts, names))
    both: Any = zip(one, other)  # lines, files, blocks, places, and what is done
    kind, rows, *more = found
    return Difference._make((kind, *both, *more, rows, kind in allowed))


def _spot(run: Any, row: int, halt: Any, name: str) -> tuple[int, str, str, tuple[float, ...], str]:
    """Of a row, or where the program stopped: the line, its file, the block, the place and what is done there."""
    if row < 0 and halt is None:
        return 0, name, "", (), ""
    path = run.toolpath
    line, which = (halt.line, halt.program) if halt else (int(path.line[row]), int(path.program[row]))
    place = tuple(path.end[row].tolist()) if row >= 0 else ()
    program, move = run.programs[which], None if halt else path[row]
    if move is not None and move.side:  # what the block says, not the way of the centre that follows from it
        said = run.programmed[slice(*np.searchsorted(run.programmed.step, (move.step, move.step + 1)))]
        move = said[said.is_motion][-1] if said.is_motion.any() else move
    doing = "" if move is None else _doing(move, path.lathe)
    return line, program.name if which else name, program.line_text(line).strip(), place, doing


def _doing(move: Any, lathe: bool) -> str:
    """What a row does, in words."""
    said = words(move).replace(point(move.end), point(move.end, lathe=lathe))
    side = {1: ", tool left of it", -1: ", tool right of it"}.get(move.side, "") if move.kind != Kind.RAPID else ""
    joint = f", then {move.joint}" if isinstance(move.joint, Corner) else ""
    return f"{Kind(move.kind).name.lower()} {'to ' if move.kind <= Kind.PROBE else ''}{said}{side}{joint}".strip()
