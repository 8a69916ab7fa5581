"""Cutting data, tool by tool: cutting speed, feed per tooth, depth and width of cut, chip thickness, removal rate.

    vc = π D n / 1000 m/min        fz = vf / (n z) mm        hm = fz ae / (R φ) mm        Pc = Q kc / 60e6 kW

hm is the mean thickness of the chip over the engaged angle φ of a mill whose edges stand along its axis: that of ISO 3002-3,
h = fz sin κ cos θ with κ = 90°, averaged; for a small width of cut about fz √(ae / D). Of a drill h = fz sin(σ / 2) with the
point angle σ. On a lathe vc is that at the tip. Q, ap and ae of a row are the greatest that occur on it, hm is that of the
place where Q is the greatest: air is in none of them. What is called most is the most of all rows, or it says "at least"
(`mnclab.workpiece.ahead`). What ap and ae are of a ball and of a round corner says `mnclab.workpiece.milling.engaged`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from mnclab.path.feeds import spindle_speed
from mnclab.path.limits import Limits
from mnclab.path.listing import Unit, figure
from mnclab.path.tool import POINTED, Tool
from mnclab.path.toolpath import Array, Index, Kind, Toolpath
from mnclab.text.tables import Rows
from mnclab.workpiece.ahead import CHIP, DEPTH, WIDTH
from mnclab.workpiece.removal import AT_LEAST, Removal

Pair = tuple[float, float]
DRILLS, UNJUDGED = ("drill", "reamer", "countersink"), ("probe", "tap", "thread mill", "thread")
MORE = 1 + 1e-9


class ToolCut(NamedTuple):
    """How one tool cuts, from the least to the greatest value that occurs; None where it is not known.

    `speed` n rev/min, `surface` vc m/min, `feed` vf mm/min, `per_rev` and `per_tooth` mm, `depth` ap, `width` ae and `chip`
    hm mm, `rate` mm³/min (mean, greatest), `power` kW at the greatest rate. `beyond` says what is above its limit, `open`
    names the fields whose greatest may be more than is known, `seen` how many of how many rows depth, width and chip are of.
    """

    tool: int
    name: str
    speed: Pair
    surface: Pair
    feed: Pair
    per_rev: Pair
    per_tooth: Pair | None = None
    depth: Pair | None = None
    width: Pair | None = None
    chip: Pair | None = None
    rate: Pair | None = None
    power: float | None = None
    beyond: tuple[str, ...] = ()
    open: tuple[str, ...] = ()
    seen: tuple[int, int] = (0, 0)


class CuttingData(Rows[ToolCut]):
    """The cutting data of a run, one `ToolCut` a tool; it prints as a table, in the unit of the program."""

    NOTHING = "nothing is cut"

    def __init__(self, cuts: Sequence[ToolCut], unit: Unit, notes: Sequence[str] = ()) -> None:
        super().__init__(cuts, unit)
        self.notes = tuple(notes)

    def table(self) -> tuple[tuple[str, ...], list[tuple[str, ...]], range]:
        """Heads, rows of texts, and which columns are numbers; columns in which nothing stands are left out."""
        inch, length = self.unit.length != 1, self.unit.length
        short, surface, rate = ("in", "ft/min", "in³/min") if inch else ("mm", "m/min", "cm³/min")
        per = 3 + 2 * inch
        head = (
            "tool", "n\nrev/min", f"vc\n{surface}", f"vf\n{short}/min", f"f\n{short}/rev", f"fz\n{short}", f"ap\n{short}",
            f"ae\n{short}", f"hm\n{short}", f"Q mean\n{rate}", f"Q most\n{rate}", "Pc\nkW", "above\nits limit",
        )  # fmt: skip
        feet, volume = (0.3048, length**3) if inch else (1.0, 1000.0)
        rows = []
        for cut in self:
            mean, most = cut.rate or (None, None)
            rows.append((
                f"T{cut.tool} {cut.name}".rstrip(),
                said(cut.speed, 1.0, 0), said(cut.surface, feet, 1), said(cut.feed, length, 1),
                *(said(getattr(cut, name), length, digits, name in cut.open) for name, digits in (
                    ("per_rev", per), ("per_tooth", per), ("depth", 2 + inch), ("width", 2 + inch), ("chip", per))),
                *("" if each is None else AT_LEAST * open_ + figure(each / unit, 2) for each, unit, open_ in (
                    (mean, volume, False), (most, volume, "rate" in cut.open), (cut.power, 1.0, "rate" in cut.open))),
                "; ".join(cut.beyond),
            ))  # fmt: skip
        kept = [k for k in range(len(head)) if not k or any(row[k] for row in rows)]
        numbers = range(1, len(kept) - (len(head) - 1 in kept))
        return tuple(head[k] for k in kept), [tuple(row[k] for k in kept) for row in rows], numbers

    @property
    def head(self) -> tuple[str, ...]:
        return self.table()[0]

    def rows(self) -> list[tuple[str, ...]]:
        """The table's rows of texts."""
        return self.table()[1]

    texts = rows


def said(pair: Pair | None, unit: float, digits: int, open_: bool = False) -> str:
    """A range as a person writes it, `600–800`, or the one number that it is; `600 to at least 800` if it may be more."""
    if pair is None:
        return ""
    low, high = (figure(value / unit, digits) for value in pair)
    if open_:
        return AT_LEAST + low if low == high else f"{low} to {AT_LEAST}{high}"
    return low if low == high else f"{low}–{high}"


def cutting_data(
    path: Toolpath, tools: Mapping[int, Tool], numbers: Index, limits: Limits, removal: Removal | None = None,
    *, most: Mapping[str, Mapping[int, float]] | None = None, kc: float | None = None, reach: str = "",
    unknown: str = "Without a blank", material: bool = True,
) -> CuttingData:  # fmt: skip
    """The data of each tool of a path; `numbers` (n,) are the tools of its rows.

    With a `removal` only what takes material away counts, and depth, width, chip and rate are known. `most` holds the greatest
    "vc" m/min and "fz" mm by the number of a tool, `kc` N/mm² the specific cutting force, for the power. `reach` is
    how far a run went that stopped before its end, `unknown` why there is no removal. Without `material` nothing is worked out
    of what the rows meet.
    """
    kinds = np.isin(path.kind, (Kind.LINE, Kind.ARC)) & (path.lengths > 0)
    found: list[ToolCut] = []
    for number in dict.fromkeys(numbers[kinds].tolist()):
        tool, rows = tools.get(number, Tool()), np.flatnonzero(kinds & (numbers == number))
        if number and tool.kind not in UNJUDGED:
            found += _cut(path, number, tool, rows, limits, removal, most or {}, kc, material)
    known = [f"Known only {reach}."] if reach else []
    known += [] if material else ["ap, ae, hm and Q were not asked for."]
    return CuttingData(found, path.unit, [*known, *_notes(found, path, removal, limits, unknown, material)])


def _notes(
    found: Sequence[ToolCut], path: Toolpath, removal: Removal | None, limits: Limits, unknown: str, material: bool
) -> Iterator[str]:  # fmt: skip
    """How the numbers are to be read."""
    if not found:
        return
    if path.lathe:
        yield "vc is that at the diameter of the tip."
    if any(cut.chip for cut in found):
        yield "hm is the mean chip thickness over the engaged angle (ISO 3002-3, κ = 90°; of a drill at its point angle)."
    if removal is None and material:
        yield f"{unknown} ap, ae, hm and Q are not known, and moves in the air count."
    elif material:
        met, chip = _met(found), ", hm goes with its most Q" * any(cut.chip for cut in found)
        most = f"; {met} {'are' if ' ' in met else 'is'} the most of a row{chip}" * bool(met)
        yield f"Q most is that at a place in the material, plunges too{most}."
    if any(cut.open for cut in found):
        tilted = removal is not None and removal.workpiece.cutting.tilted is not None
        others = "in threads, or under tilted tools" if tilted else "or in threads"
        yield f"At least: there may be more in rows that are too many to look at, {others}, which are not looked at."
    if few := [cut for cut in found if cut.depth and cut.seen[0] < cut.seen[1]]:
        told = ", ".join(f"{cut.seen[0]} of {cut.seen[1]} of T{cut.tool}" for cut in few)
        yield f"The least of {_met(few, chip=True)} is that of the rows that were looked at: {told}."
    if bent := ", ".join(f"T{cut.tool}" for cut in found if cut.width and cut.per_tooth and not cut.chip):
        yield f"hm of {bent} is empty: the chip thins along a round edge; its ae is the width of cut at the top of the material."
    if not any(cut.beyond for cut in found):
        speeds = dict(zip("XYZ", (figure(float(v) * 60 / path.unit.length, 1) for v in limits.axes("rapid"))))
        speeds = {axis: speed for axis, speed in speeds.items() if axis != "Y" or not path.lathe}
        alike = len(set(speeds.values())) == 1
        fastest = f"each axis {speeds['X']}" if alike else ", ".join(f"{axis} {speed}" for axis, speed in speeds.items())
        spindle = f"{figure(limits.spindle, 0)} rev/min, " if math.isfinite(limits.spindle) else ""
        whose = "default limits (none were given)" if limits == Limits() else "limits of the machine"
        yield f"All within the {whose}, {spindle}{fastest} {path.unit.short}/min."


def _met(found: Sequence[ToolCut], chip: bool = False) -> str:
    """What of the material is known of some of the tools: "ap and ae"."""
    names = {"ap": "depth", "ae": "width"} | ({"hm": "chip"} if chip else {})
    known = [short for short, name in names.items() if any(getattr(cut, name) for cut in found)]
    return " and ".join(filter(None, [", ".join(known[:-1]), *known[-1:]]))


def _cut(
    path: Toolpath, number: int, tool: Tool, rows: Index, limits: Limits, removal: Removal | None,
    most: Mapping[str, Mapping[int, float]], kc: float | None, material: bool,
) -> Iterator[ToolCut]:  # fmt: skip
    if removal is not None:
        rows = rows[removal.volumes[rows] > 0]
    drilled, met = tool.kind in DRILLS, rows
    if not path.lathe and not drilled:
        along = np.abs(((path.end - path.start)[rows] * path.axis[rows]).sum(axis=1))
        sideways = rows[path.lengths[rows] > 2 * along]  # a plunge has another feed, and no chip thickness
        rows = sideways if len(sideways) else rows
    speed, feed = _speeds(path, rows, limits)
    told = (speed > 0).all(axis=1) & np.isfinite(feed).all(axis=1)
    rows, speed, feed = rows[told], speed[told], feed[told]
    if not len(rows):
        return
    radii: Any = tool.effective_radius
    if path.lathe and not drilled:
        radii = np.abs(np.stack([path.start[rows, 0], path.end[rows, 0]], axis=1) - path.spindle_x[rows][:, None])
    surface, per_rev = 2 * np.pi * radii * speed / 1000, feed / speed
    per_tooth = per_rev / tool.teeth if tool.teeth and not path.lathe else None
    cut = ToolCut(number, tool.name, _pair(speed), _pair(surface), _pair(feed), _pair(per_rev))
    if per_tooth is not None:
        cut = cut._replace(per_tooth=_pair(per_tooth))
        if tool.kind == "drill":
            point = math.radians(tool.angle or POINTED[tool.kind])
            cut = cut._replace(chip=_pair(per_tooth * math.sin(point / 2)))
    if removal is not None and material:
        cut = _with_material(_with_rate(cut, met, removal, kc), path, tool, rows, per_tooth, removal)
    _, feed = _speeds(path, met, limits)
    share = np.abs(path.end - path.start)[met] / path.lengths[met][:, None]
    share[path.kind[met] == Kind.ARC] = 1.0  # somewhere along it each axis of its plane goes as fast
    fastest = np.where(np.isfinite(feed), feed, 0.0).max(axis=1)[:, None] * share
    axes = [(float(fastest[:, k].max()), float(limit) * 60) for k, limit in enumerate(limits.axes("rapid"))]
    yield cut._replace(beyond=tuple(_beyond(cut, axes, limits, most)))


def _speeds(path: Toolpath, rows: Index, limits: Limits) -> tuple[Array, Array]:
    """Spindle speed, rev/min, and feed, mm/min, at the start and the end of rows (k, 2)."""
    x = np.stack([path.start[rows, 0], path.end[rows, 0]], axis=1) - path.spindle_x[rows][:, None]
    most = np.minimum(path.speed_limit[rows], limits.spindle)[:, None]
    constant = spindle_speed(path.surface[rows][:, None], x, most)
    speed = np.where(np.isnan(path.surface[rows])[:, None], np.abs(path.spindle[rows])[:, None], constant)
    speed = np.where(path.spindle[rows][:, None] == 0, 0.0, speed)
    per_rev, time = path.per_rev[rows][:, None], path.time[rows][:, None]
    feed = np.where(np.isnan(per_rev), path.feed[rows][:, None], per_rev * speed)
    with np.errstate(divide="ignore", invalid="ignore"):
        return speed, np.where(np.isnan(time), feed, 60 * path.lengths[rows][:, None] / time)


def _with_rate(cut: ToolCut, rows: Index, removal: Removal, kc: float | None) -> ToolCut:
    """How fast all rows that meet material take it away, plunges too."""
    seconds, greatest = float(removal.seconds[rows].sum()), float(removal.greatest[rows].max())
    mean = 60 * float(removal.volumes[rows].sum()) / seconds if seconds else 0.0
    open_ = () if removal.proves(rows) else ("rate",)
    return cut._replace(rate=(mean, greatest), power=None if kc is None else greatest * kc / 60e6, open=open_)


def _with_material(cut: ToolCut, path: Toolpath, tool: Tool, rows: Index, per_tooth: Array | None, removal: Removal) -> ToolCut:
    """What is known of the material that the rows meet."""
    looks = removal.looks.get(cut.tool)
    if looks is None or tool.kind in DRILLS or (path.lathe and tool.kind not in ("turning", "boring")):
        return cut
    among, feed = np.isin(looks.rows, rows), np.ones(len(looks.rows))
    if per_tooth is not None:
        feed[among] = per_tooth.max(axis=1)[np.isin(rows, looks.rows)]
    asked: list[tuple[str, int, Any]] = [("depth", DEPTH, 1.0), ("width", WIDTH, 1.0), ("chip", CHIP, feed)]
    told: dict[str, Any] = {}
    for name, what, scale in asked if per_tooth is not None else asked[:2]:
        proved, met = looks.proves(what, among, scale), among & (looks.values[what] > 0)
        if met.any():
            told[name] = _pair((looks.values[what] * scale)[met])
            told["open"] = told.get("open", cut.open) if proved else (*told.get("open", cut.open), name)
    return cut._replace(**told, seen=(int((among & looks.seen).sum()), int(among.sum())))


def _beyond(
    cut: ToolCut, axes: Sequence[tuple[float, float]], limits: Limits, most: Mapping[str, Mapping[int, float]]
) -> Iterator[str]:  # fmt: skip
    """What is above its limit; of each axis what it goes at most and what it bears, mm/min."""
    judged = [("n", cut.speed, limits.spindle)]
    judged += [("vf", (0.0, fastest), limit) for fastest, limit in axes if fastest > limit * MORE]
    for name, pair in (("vc", cut.surface), ("fz", cut.per_tooth)):
        if pair is not None and cut.tool in most.get(name, {}):
            judged.append((name, pair, most[name][cut.tool]))
    for name, (_, high), limit in judged:
        if high > limit * MORE:
            yield f"{name} above {figure(limit, 3)}"


def _pair(values: Array) -> Pair:
    return float(np.min(values)), float(np.max(values))
