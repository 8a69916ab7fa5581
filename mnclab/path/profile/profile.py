"""When the tool is where, and how fast: the feed-rate profile of a path."""

from __future__ import annotations

from functools import cached_property
from operator import attrgetter
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.path.limits import Limits
from mnclab.path.listing import point
from mnclab.path.machines import limits_of
from mnclab.path.places import Bends
from mnclab.path.profile.lookahead import running_sum
from mnclab.path.profile.timing import PlannedRows, plan
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.text.alarm import Alarm
from mnclab.text.given import LostOptions, PathOptions, ProfileOptions, choice, fitting_class, shown
from mnclab.text.tables import Columned, Pictured, Rounded, fixed, html_table, shapes

if TYPE_CHECKING:
    from matplotlib.figure import Figure


# A plan as pieces of constant jerk (or constant acceleration), in the order of time.

class Pieces(NamedTuple):
    """`t`, `s`, `v` (m + 1,) at the nodes; `a` at the start of each piece, `j` and `row` of the plan (m,)."""

    t: Array
    s: Array
    v: Array
    a: Array
    j: Array
    row: Index

    def __repr__(self) -> str:
        return shapes(self)


def pieces(plan: PlannedRows) -> Pieces:
    """All pieces that take time."""
    left_out = plan.rapids.rows if plan.rapids is not None else np.empty(0, dtype=np.int64)
    tables = [_trapezoids(plan) if plan.groups is None else plan.groups.items(plan.seconds, left_out)]
    if plan.rapids is not None:
        tables.append(_rapids(plan))
    columns = [*zip(*tables)]
    if len(tables) > 1 or plan.groups is not None:
        sorted_ = np.argsort(np.concatenate(columns[0]), kind="stable")
        tables.clear()  # a column after the other is let go
        columns = [(np.concatenate(columns.pop(0))[sorted_],) for _ in range(len(columns))]
    row, dt, ds, v, a, j = (column for (column,) in columns)
    if plan.row is not None:
        row = plan.row[row]
    join = np.zeros(len(row), dtype=bool)  # pieces that only go on at the speed of the one before
    join[1:] = (row[1:] == row[:-1]) & (a[1:] == 0) & (a[:-1] == 0) & (j[1:] == 0) & (j[:-1] == 0)
    join[1:] &= np.abs(v[1:] - v[:-1]) <= 1e-12 * v[1:]
    if join.any():
        first = np.flatnonzero(~join)
        dt, ds = np.add.reduceat(dt, first), np.add.reduceat(ds, first)
        row, v, a, j = row[first], v[first], a[first], j[first]
    return Pieces(running_sum(dt), running_sum(ds), np.append(v, 0.0), a, j, row)


Table = tuple[NDArray[Any], ...]  # row, seconds, length, speed and acceleration at the start, jerk; those of a row in order


def _trapezoids(plan: PlannedRows) -> Table:
    """Up, along and down in every row, and the events."""
    n = len(plan.seconds)
    v0, v1, top = plan.v[:-1], plan.v[1:], plan.top
    moving = plan.rows.length > 0
    if plan.rapids is not None:
        moving[plan.rapids.rows] = False
    ds = np.empty((n, 3))
    ds[:, 0] = (top - v0) * (top + v0) / (2 * plan.rows.a)
    ds[:, 2] = (top - v1) * (top + v1) / (2 * plan.rows.a)
    ds[:, 1] = np.maximum(plan.rows.length - ds[:, 0] - ds[:, 2], 0.0)
    ds[~moving] = 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        dt = np.stack([2 * ds[:, 0] / (v0 + top), ds[:, 1] / top, 2 * ds[:, 2] / (v1 + top)], axis=1)
    dt[ds <= 0] = 0.0
    up = plan.rows.a.copy()
    if plan.ramps is not None:
        one = plan.ramps
        length, total = plan.rows.length[one], v0[one] + v1[one]
        dt[one], ds[one] = 0.0, 0.0
        dt[one, 0], ds[one, 0] = 2 * length / total, length
        up[one] = (v1[one] - v0[one]) * total / (2 * length)
    events = plan.rows.length == 0
    dt[events, 1] = plan.seconds[events]
    kept = np.flatnonzero(dt > 0)
    row, part, dt, ds = kept // 3, (kept % 3).astype(np.int8), dt.ravel()[kept], ds.ravel()[kept]
    v, a, first = top[row], -plan.rows.a[row], part == 0
    v[first], a[first], a[part == 1] = v0[row[first]], up[row[first]], 0.0
    v[events[row]] = 0.0
    return row, dt, ds, v, a, np.zeros(len(row))


def _rapids(plan: PlannedRows) -> Table:
    """Rapids whose axes go by themselves, seen along the straight line from start to end."""
    rapids = plan.rapids
    assert rapids is not None
    breaks = rapids.breaks()
    dt = np.diff(breaks, axis=1)
    which, order = np.nonzero(dt > 0)
    direction = rapids.travel / rapids.length[:, None]
    begin, end = breaks[which, order], breaks[which, order + 1]
    middle = rapids.state(which, (begin + end) / 2)  # within the phases, whatever the rounding of their ends
    a, j = (np.einsum("ij,ij->i", column, direction[which]) for column in middle[2:])
    places = (rapids.state(which, t)[0] - rapids.start[which] for t in (begin, end))
    at = [np.einsum("ij,ij->i", place, direction[which]) for place in places]
    half = (end - begin) / 2
    a -= j * half
    v = (at[1] - at[0]) / (2 * half) - a * half - j * (2 * half) ** 2 / 6
    return rapids.rows[which], 2 * half, at[1] - at[0], v, a, j


#: What time goes to. "cutting" is what the programmed feed alone would take, "rapid" the axes' greatest speed;
#: "acceleration" is all that speeding up, braking, corners and other limits of the machine add.
CAUSES = ("cutting", "rapid", "probing", "acceleration", "dwell", "tool change", "spindle", "stop")
CAUSE = {
    Kind.LINE: "cutting", Kind.ARC: "cutting", Kind.RAPID: "rapid", Kind.PROBE: "probing", Kind.DWELL: "dwell",
    Kind.TOOL: "tool change", Kind.SPINDLE: "spindle", Kind.COOLANT: "stop", Kind.STOP: "stop",
}  # fmt: skip


class Instant(NamedTuple):
    """The tool at a time, or at many (k,): vectors are (3,) or (k, 3); mm and s.

    `s` is the length of path behind it, `move` the row of the path and `line` its source line. `velocity` and
    `acceleration` are those of the axes; `v`, `a` and `j` those along the path.
    """

    t: Any
    s: Any
    v: Any
    a: Any
    j: Any
    position: Array
    velocity: Array
    acceleration: Array
    move: Any
    line: Any

    def __repr__(self) -> str:
        if np.ndim(self.t):
            return shapes(self)
        return f"<Instant at {self.t:.3f} s: {point(self.position)}, {self.v:.3f} mm/s, line {self.line}>"


@fitting_class
class Profile(Pictured, Columned):
    """A path under limits, as pieces of constant jerk, or of constant acceleration without a jerk limit.

    Columns: `t` s, `s` mm, `v` mm/s at the nodes (m + 1,); `a` mm/s² at the start and `j` mm/s³ of each piece
    (m,), and `move` (m,), the row of the path it belongs to. For every row (n,): `seconds` and `starts` (n + 1,),
    when it begins. Where rapids go axis by axis, s, v, a, j are those of the tool's projection on the straight line.

    60 mm at 60 mm/s, under 60 mm/s², take 60 / 60 + 60 / 60 s:

    >>> path = mnc.run("S800 M3\\nG1 X60 F3600\\n", "mnc").toolpath
    >>> mnc.Profile(path, mnc.Limits(acceleration=60)).time
    2.0
    """

    def __init__(
        self, path: Toolpath, limits: Limits | str | None = None, *, override: float = 1.0, rapid_motion: str = "line",
        waits: Mask | None = None, source: Any = None, name: str = "", reach: str = "",
    ) -> None:  # fmt: skip
        if not isinstance(path, Toolpath):
            raise Alarm(f"a profile is that of a toolpath, got {shown(path)}", hint="Profile(run.toolpath)")
        self.path, self.limits, self.override = path, limits_of(limits) or Limits(), override
        self.source = source  # the Program, for pictures that show its lines
        self.name = name  # what a picture of several calls it
        self.reach = reach  # "up to line 12, where the run stopped" of a path that ends before its program
        self._more: dict[str, Any] = {"rapid_motion": rapid_motion, "waits": waits, "source": source, "reach": reach}
        self.plan: PlannedRows = plan(path, self.limits, override, rapid_motion, waits)
        self.seconds: Array = fixed(self._of_rows(self.plan.seconds))

    def again(self, limits: Limits | str | None = None, override: float | None = None) -> Profile:
        """The same path planned under other limits, or with another feed override."""
        chosen = self.override if override is None else override
        return Profile(self.path, self.limits if limits is None else limits, override=chosen, **self._more)

    def _of_rows(self, values: Array) -> Array:
        """Sums (n,) for the rows of the path from values for planned rows."""
        row = self.plan.row
        return values if row is None else np.asarray(np.bincount(row, values, len(self.path)), np.float64)

    @cached_property
    def starts(self) -> Array:
        """When each row begins (n + 1,), s; the last is the end."""
        return fixed(running_sum(self.seconds))

    @property
    def time(self) -> float:
        """Seconds from the first row to the end of the last."""
        return float(self.starts[-1])

    @cached_property
    def pieces(self) -> Pieces:
        return Pieces._make(fixed(each) for each in pieces(self.plan))

    t = property(attrgetter("pieces.t"))
    s = property(attrgetter("pieces.s"))
    v = property(attrgetter("pieces.v"))
    a = property(attrgetter("pieces.a"))
    j = property(attrgetter("pieces.j"))
    move = property(attrgetter("pieces.row"))

    def columns(self) -> dict[str, NDArray[Any]]:
        """The columns (m,) at the start of each piece and its row, for pandas, polars or pyarrow."""
        return {name: getattr(self, name)[: len(self)] for name in ("t", "s", "v", "a", "j", "move")}

    def __len__(self) -> int:
        return len(self.pieces.row)

    def at(self, t: ArrayLike) -> Instant:
        """The tool at `t` seconds (a number or an array (k,)); before the start and after the end it stands."""
        try:
            times = np.atleast_1d(np.asarray(t, dtype=np.float64)).ravel()
        except (TypeError, ValueError, OverflowError):
            raise Alarm(f"t must be seconds, a number or an array, got {shown(t)}") from None
        p = self.pieces
        if not len(p.row):
            nothing = np.zeros((len(times), 3)) + (self.path.end[-1] if len(self.path) else 0.0)
            zero, row = np.zeros(len(times)), np.full(len(times), len(self.path) - 1)
            found = Instant(times, zero, zero, zero, zero, nothing, 0 * nothing, 0 * nothing, row, 0 * row)
        else:
            i = np.clip(np.searchsorted(p.t, times, "right") - 1, 0, len(p.row) - 1)
            dt = np.clip(times, p.t[0], p.t[-1]) - p.t[i]
            s = p.s[i] + dt * (p.v[i] + dt * (p.a[i] / 2 + dt * p.j[i] / 6))
            v = np.maximum(p.v[i] + dt * (p.a[i] + dt * p.j[i] / 2), 0.0)
            a, j, row = p.a[i] + dt * p.j[i], p.j[i], p.row[i]
            outside = (times < p.t[0]) | (times > p.t[-1])
            v, a, j = (np.where(outside, 0.0, each) for each in (v, a, j))
            first = np.searchsorted(p.row, row)  # the piece that the row begins with
            within = np.clip(s - p.s[first], 0.0, self.path.lengths[row])
            place, velocity, rate = self._axes(row, within, v, a, p.t[i] + dt)
            found = Instant(times, s, v, a, j, place, velocity, rate, row, self.path.line[row])
        if np.ndim(t):
            return found
        return Instant(*(each[0] if each.ndim == 2 else each[0].item() for each in found))

    def _axes(self, row: Index, within: Array, v: Array, a: Array, t: Array) -> tuple[Array, Array, Array]:
        """Place, velocity and acceleration (k, 3) of the axes, `within` mm after the start of the row."""
        path = self.path
        length = path.lengths[row]
        moving = length > 0
        start, end = path.start[row], path.end[row]
        share = np.divide(within, length, out=np.ones(len(row)), where=moving)[:, None]
        tangent = np.where(moving[:, None], (end - start) / np.where(moving, length, 1.0)[:, None], 0.0)
        place, rate = start + share * (end - start), tangent * a[:, None]
        arcs = np.flatnonzero((path.kind[row] == Kind.ARC) & moving)
        if len(arcs):
            bends = Bends(path, row[arcs], length[arcs])
            along = share[arcs, 0]
            place[arcs], tangent[arcs] = bends.place(along), bends.tangent(along)
            rate[arcs] = tangent[arcs] * a[arcs, None] + bends.curvature(along) * v[arcs, None] ** 2
        velocity = tangent * v[:, None]
        rapids = self.plan.rapids
        if rapids is not None and (own := np.flatnonzero(np.isin(row, self._rapid_rows))).size:
            which = np.searchsorted(self._rapid_rows, row[own])
            since = np.clip(t[own] - self.starts[row[own]], 0.0, rapids.seconds[which])
            place[own], velocity[own], rate[own], _ = rapids.state(which, since)
        return place, velocity, rate

    @cached_property
    def _rapid_rows(self) -> Index:
        rapids = self.plan.rapids
        assert rapids is not None
        return rapids.rows if self.plan.row is None else self.plan.row[rapids.rows]

    @cached_property
    def lost(self) -> Array:
        """Seconds of each row (n,) beyond what its programmed feed (rapids: the axes' greatest speed) would take."""
        p = self.plan
        with np.errstate(divide="ignore", invalid="ignore"):
            speed = np.where(np.isfinite(p.rows.feed), p.rows.feed, np.sqrt(p.rows.cap))
            ideal = np.where(p.rows.length > 0, p.rows.length / speed, p.seconds)
        if p.rapids is not None:
            ideal[p.rapids.rows] = p.rapids.ideal
        return self._of_rows(np.maximum(p.seconds - ideal, 0.0))

    def time_by(self, key: str) -> dict[Any, float]:
        """Seconds by "line", "tool", "kind" or "cause" (`CAUSES`); the values sum to `time`. A line of a program that
        was called is a pair (program, line). An Alarm for another key."""
        path, key = self.path, choice(key, "key", ("line", "tool", "kind", "cause"))
        if key == "cause":
            return self._causes()
        if key == "kind":
            found = np.bincount(path.kind, self.seconds, max(Kind) + 1)
            return Rounded({kind.name.lower(): float(found[kind]) for kind in Kind if (path.kind == kind).any()})
        if key == "tool":
            tools, where = np.unique(path.tool, return_inverse=True)
            return Rounded(zip(tools.tolist(), np.bincount(where, self.seconds, len(tools)).tolist()))
        place = path.program.astype(np.int64) << 32 | path.line
        places, where = np.unique(place, return_inverse=True)
        total = np.bincount(where, self.seconds, len(places)).tolist()
        names = zip((places >> 32).tolist(), (places & 0xFFFFFFFF).tolist())
        return Rounded({(line if program == 0 else (program, line)): time for (program, line), time in zip(names, total)})

    def _causes(self) -> dict[Any, float]:
        of_kind = np.bincount(self.path.kind, self.seconds - self.lost, max(Kind) + 1)
        found = dict.fromkeys(CAUSES, 0.0) | {"acceleration": float(self.lost.sum())}
        for kind, cause in CAUSE.items():
            found[cause] += float(of_kind[kind])
        return Rounded({cause: seconds for cause, seconds in found.items() if seconds > 0})

    def __repr__(self) -> str:
        causes = ", ".join(f"{cause} {seconds:.3f}" for cause, seconds in self.time_by("cause").items())
        return f"<Profile: {f'{self.time:.3f} s {self.reach}'.rstrip()}{': ' if causes else ''}{causes}>"

    def _repr_html_(self) -> str:
        causes = self.time_by("cause")
        rows = [(cause, f"{took:.3f} s", f"{100 * took / self.time:.1f} %") for cause, took in causes.items()]
        return html_table(("time", f"{self.time:.3f} s", self.reach), rows, numbers=(1, 2))

    def plot(self, **options: Unpack[ProfileOptions]) -> Figure:
        """Programmed and reached feed, acceleration and jerk over time, stops, limits, and which of them governs where.

        `over="path"` shows them over the path length, `axes=True` adds X, Y and Z; see `mnclab.show.plot.profile.plot_profile`.
        """
        from mnclab.show.plot.profile import plot_profile

        return plot_profile(self, **options)

    def plot_reached(self, **options: Unpack[PathOptions]) -> Figure:
        """The path coloured by the feed that is reached; options as in `mnclab.show.plot.path.plot_path`."""
        from mnclab.show.plot.profile import plot_reached

        return plot_reached(self, **options)

    def plot_lost(self, **options: Unpack[LostOptions]) -> Figure:
        """The time of each line beside its text, and how much of it the machine adds; `most` lines."""
        from mnclab.show.plot.profile import plot_lost

        return plot_lost(self, **options)
