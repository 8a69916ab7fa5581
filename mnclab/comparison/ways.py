"""What is between the cuts of two programs: rapids that go another way, dwells. Lengths in mm, times in s."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from mnclab.comparison.diff import nearest_of
from mnclab.comparison.found import RATE, Found, from_where, tilts
from mnclab.comparison.motion import Motion
from mnclab.comparison.pairs import Stretch, leaning
from mnclab.geometry.curves import counted
from mnclab.path.listing import figure, point
from mnclab.path.toolpath import Array, Index, Kind, Mask

SECONDS = 0.001
SLOPED = 0.1  # Z of a direction: along a tool that leans more heights say little
LOWER, NEARER, ASIDE, HIGHER = range(4)
OF_WAYS = ("rapid", "nearer", "aside", "lifts")  # their kinds
MOST = 2000  # ways that are looked at one by one
PLACES = 200_000  # of all rapids
SHARES = np.linspace(0.0, 1.0, 33)[:, None, None]  # of a rapid: where it is looked at


def links(one: Motion, other: Motion, i: Index, j: Index, parts: list[Stretch]) -> tuple[Index, Index]:
    """Which ways between cuts (k,), by the rank of the cut behind them, are each other's: both their ends are."""
    wide = len(other.cuts) + 1
    stretch = np.array(parts, dtype=np.int64).reshape(-1, 4)
    before = np.concatenate([i * wide + j, stretch[:, 0] * wide + stretch[:, 2], [len(one.cuts) * wide + len(other.cuts)]])
    behind = np.concatenate([[0], (i + 1) * wide + j + 1, stretch[:, 1] * wide + stretch[:, 3]])
    both = np.sort(np.concatenate([_each_once(before), _each_once(behind)]))
    both = both[1:][both[1:] == both[:-1]]
    return both // wide, both % wide


def _each_once(numbers: Index) -> Index:
    """Numbers in their order; of many integers it is quicker than that of numpy."""
    found = np.sort(numbers)
    return found[np.append(True, found[1:] != found[:-1])]


def of_links(one: Motion, other: Motion, i: Index, j: Index, tolerance: float, around: Around) -> list[Found]:
    """Rapids between cuts that do not go the same way: lower than those of the first program, elsewhere, or not."""
    a, b = Ways(one, tolerance), Ways(other, tolerance)
    many = a.count[i], b.count[j]
    odd = many[0] != many[1]
    which, rank = counted(np.where(odd, 0, many[0]))
    at, to = (side.begin[k[which]] + rank for side, k in ((a, i), (b, j)))
    leans = np.bincount(which, leaning(one, a.rapids[at], other, b.rapids[to]) > tolerance, len(i)) > 0
    odd[which[np.linalg.norm(a.end[at] - b.end[to], axis=1) > tolerance]] = True
    some = np.flatnonzero((many[0] > 0) & (many[1] > 0) & (one.turns | other.turns))  # where they go in other steps how they end
    lasts = (side.rapids[side.begin[k[some]] + side.count[k[some]] - 1] for side, k in ((a, i), (b, j)))
    leans[some] |= leaning(one, next(lasts), other, next(lasts)) > tolerance
    odd |= leans
    found = _beyond(a, b, i, j, tolerance)
    i, j, leans = i[odd], j[odd], leans[odd]
    if not len(i):
        return found
    heights = np.stack([a.low[i], b.low[j], a.last[i], b.last[j]], axis=1)
    upright = np.isinf(a.low[i]) & (a.count[i] > 0)  # only up and down
    down = _gap(a.last[i], b.last[j])
    down[b.in_own_hole(j, down > tolerance, tolerance)] = 0.0
    lower = np.maximum(_gap(np.where(upright, a.high[i], a.low[i]), b.low[j]), down)
    beside = np.abs(a.box[i] - b.box[j]).max(axis=1)
    off = np.maximum(beside, np.abs(_gap(heights[:, ::2], heights[:, 1::2])).max(axis=1))
    kind = np.where((lower > tolerance) & (not a.lathe), LOWER, HIGHER)
    told: dict[int, tuple[float, tuple[str, str]]] = {}
    deepest: dict[int, int] = {}
    bent = (beside > tolerance) | (a.turns[i] > 1) | (b.turns[j] > 1)
    goes = (kind == HIGHER) & (a.lathe | (bent & np.isfinite(b.low[j])) | np.isfinite(b.dip[j]))
    least = a.least(around) if goes.any() else np.empty(0)
    for k in np.flatnonzero(goes)[:MOST].tolist():
        here, there = int(i[k]), int(j[k])
        sunk, place = (0.0, 0) if a.lathe else b.below(there, a, here, tolerance)
        if sunk > tolerance:
            kind[k], lower[k], deepest[k] = LOWER, sunk, place
        else:
            kind[k], told[k] = _elsewhere(a, here, b, there, tolerance, around, least)
    rest = np.flatnonzero(goes)[MOST:]
    kind[rest] = np.where((b.dip[j[rest]] < a.low[i[rest]] - tolerance) & (not a.lathe), LOWER, ASIDE)
    stays = a.lathe & (j == len(other.cuts)) & (b.count[j] == 0)  # at the part
    kind[(leans | stays) & (kind == HIGHER)] = ASIDE
    new = (np.diff(i) != 1) | (np.diff(j) != 1) | (kind[1:] != kind[:-1]) | (heights[1:] != heights[:-1]).any(axis=1)
    first = np.flatnonzero(np.append(True, new))
    for k, moves in zip(first.tolist(), np.diff(np.append(first, len(i))).tolist()):
        amount, said = float(lower[k] if kind[k] == LOWER and lower[k] > 0 else off[k]), (a.said(i[k]), b.said(j[k]))
        amount, said = told[k] if k in told and (kind[k] != HIGHER or a.lathe) else (amount, said)
        until = a.until(i[k], b, j[k], tolerance)
        if kind[k] == ASIDE or k in deepest or said[0] == said[1] or (a.lathe and kind[k] != NEARER):
            said = a.route(i[k], until), b.route(j[k], until)
        if leans[k] and kind[k] == ASIDE:
            leaning_moves = [int(w.rapids[w.begin[n] + min(until, int(w.count[n]) - 1)]) for w, n in ((a, i[k]), (b, j[k]))]
            said = tilts(one, leaning_moves[0], other, leaning_moves[1])
        ranks = [until, deepest.get(k, until)]
        if kind[k] == LOWER and k not in deepest and b.motion.turns:  # what goes so low, not what turns the tool before it
            z = heights[k, 2:] if lower[k] == down[k] else heights[k, :2]
            ranks = [ways.reaching(link[k], until, height + tolerance) for ways, link, height in zip((a, b), (i, j), z)]
        rows = from_where(one, other, (a.row(i[k], ranks[0]), b.row(j[k], ranks[1])), tolerance)
        found.append(Found(OF_WAYS[kind[k]], rows, amount if np.isfinite(amount) else np.nan, "mm", said, moves))
    return found


def _elsewhere(
    a: Ways, i: int, b: Ways, j: int, tolerance: float, around: Around, least: Array
) -> tuple[int, tuple[float, tuple[str, str]]]:  # fmt: skip
    """What the way before cut j of b is beside that before cut i of a, by how much, and in words where it comes nearer.

    What stands on the machine is known of what the setup names alone. Where that is nothing, b must be higher than a was. `least`
    is how near any rapid of a comes to it.
    """
    places, aside = b.off(j, a, i, tolerance)
    if not len(places):
        return HIGHER, (0.0, ("", ""))
    far = around.far(places, b.radius(j))
    if (near := np.flatnonzero(far < least - tolerance)).size:
        body = int(near[(least - far)[near].argmax()])
        before, now = (f"{figure(float(each[body]), 3)} mm from {around.names[body]}" for each in (least, far))
        return NEARER, (float((least - far)[body]), (before, now))
    higher = around.fixtures or (not a.lathe and places[:, 2].min() > a.over(i) + tolerance)
    return HIGHER if higher else ASIDE, (aside, ("", ""))


@dataclass(frozen=True, eq=False)
class Around:
    """What stands on the machine beside the tool, by its `names`: the `bounds` (k, 2, 3) of blank and fixtures in the frame of
    the path. `fixtures` is whether the setup names any: without, nobody knows of clamps."""

    names: tuple[str, ...] = ()
    bounds: Array = field(default_factory=lambda: np.empty((0, 2, 3)))
    fixtures: bool = False
    lathe: bool = False

    def far(self, places: Array, radius: Array | float) -> Array:
        """How far (k,) a tool whose tip is at places (m, 3) is from each of them, at the nearest."""
        low, high = self.bounds[:, None, 0], self.bounds[:, None, 1]
        out = np.maximum(np.maximum(low - places, places - high), 0.0)  # (k, m, 3)
        if self.lathe:
            wide = np.abs(self.bounds[:, :, :2]).max(axis=(1, 2))
            return np.hypot(np.maximum(np.abs(places[:, 0]) - wide[:, None], 0.0), out[:, :, 2]).min(axis=1, initial=np.inf)
        beside = np.maximum(np.hypot(out[:, :, 0], out[:, :, 1]) - np.abs(radius), 0.0)
        return np.hypot(beside, np.maximum(places[:, 2] - high[:, :, 2], 0.0)).min(axis=1, initial=np.inf)


def _gap(a: Array, b: Array) -> Array:
    """How much lower b is than a, inf where a has none."""
    with np.errstate(invalid="ignore"):
        return np.where(a == b, 0.0, a - b)


def _beyond(a: Ways, b: Ways, i: Index, j: Index, tolerance: float) -> list[Found]:
    """Of ways that are nobody's counterpart: whether those of b go sideways or dip lower than all of a goes sideways."""
    deep = np.minimum(b.low, b.dip)
    rest = [np.setdiff1d(np.flatnonzero(np.isfinite(low)), k) for low, k in ((a.low, i), (deep, j))]
    if not len(rest[1]):
        return []
    deepest = int(rest[1][deep[rest[1]].argmin()])
    highest = int(rest[0][a.low[rest[0]].argmin()] if len(rest[0]) else a.low.argmin())
    lower = float(_gap(a.low[highest], deep[deepest]))
    if not lower > tolerance:
        return []
    rows = a.row(highest, a.lowest(highest)), b.row(deepest, b.lowest(deepest))
    amount = lower if np.isfinite(lower) else np.nan
    return [Found("rapid", rows, amount, "mm", (a.said(highest), b.said(deepest)))]


def _along(motion: Motion) -> Array:
    """The direction (m, 3) along which moves go up and down: Z, but for those that keep a tilted tool that of the tool."""
    found = np.tile([0.0, 0.0, 1.0], (len(motion), 1))
    if motion.turns and (tool := motion.tool_along) is not None:
        keeps = (np.abs(np.diff(tool, axis=0, prepend=tool[:1])).max(axis=1) < 1e-9) & (tool[:, 2] > SLOPED)
        found[keeps] = tool[keeps]
    return found


class Ways:
    """The rapids between cuts, by the rank of the cut behind (n + 1,): their `count`, the lowest height at which they go sideways
    (`low`) and to which they go down only to rise or go on from there (`dip`), the highest of all (`high`) and the `last`, where
    the program ends that of its end, and the `box` (n + 1, 4) that they keep in X and Y. Of a tool that is tilted up and down are
    along it."""

    def __init__(self, motion: Motion, tolerance: float) -> None:
        self.motion, self.lathe = motion, motion.path.lathe
        self.rapids = np.flatnonzero(motion.kind == Kind.RAPID)
        self.end = end = motion.end[self.rapids]
        link, n = motion.link[self.rapids], len(motion.cuts) + 1
        self.count = np.bincount(link, minlength=n)
        self.begin = np.cumsum(self.count) - self.count
        start = motion.start[self.rapids]
        if len(self.rapids) and self.rapids[0] == 0:  # from where the machine stands
            start[0] = end[0]
        self.along = along = _along(motion)
        way = end - start
        way -= np.einsum("ij,ij->i", way, along[self.rapids])[:, None] * along[self.rapids]
        self.aside = aside = np.linalg.norm(way, axis=1) > tolerance
        self.heights = np.minimum(start[:, 2], end[:, 2])
        self.start, self.turns = start, np.bincount(link[aside], minlength=n)
        self.low, self.high = np.full(n, np.inf), np.full(n, -np.inf)
        np.minimum.at(self.low, link[aside], self.heights[aside])
        np.maximum.at(self.high, link, np.maximum(start[:, 2], end[:, 2]))
        self.last = np.full(n, np.inf)
        self.last[link] = end[:, 2]
        self.last[-1] = motion.end[-1, 2] if len(motion) else np.inf
        self.dips = ~aside & (end[:, 2] < start[:, 2] - tolerance) & np.append(link[1:] == link[:-1], False)[: len(link)]
        self.dip = np.full(n, np.inf)
        np.minimum.at(self.dip, link[self.dips], end[self.dips, 2])
        self.box = np.zeros((n, 4))
        some = np.flatnonzero(self.count)
        if len(some):
            low, high = (ufunc.reduceat(end[:, :2], self.begin[some]) for ufunc in (np.minimum, np.maximum))
            self.box[some] = np.hstack([low, high])

    def in_own_hole(self, links: Index, deep: Mask, tolerance: float) -> Index:
        """Which of the rapids before cuts that are `deep` end straight down in a hole that the same tool has cut as deep: pecks
        go on there; as places in `links`."""
        last = self.begin[links] + self.count[links] - 1
        some = np.flatnonzero(deep & (self.count[links] > 0))
        some = some[~self.aside[last[some]]]
        if not len(some):
            return some
        cuts, tool = self.motion.end[self.motion.cuts], self.motion.tool
        places = np.round(np.vstack([self.end[last[some]], cuts])[:, :2] / (2 * tolerance))
        place = np.unique(places, axis=0, return_inverse=True)[1].reshape(-1)
        of, order = place[: len(some)], np.argsort(place[len(some) :], kind="stable")
        known, found = place[len(some) :][order], list[int]()
        for k, begin, stop in zip(some.tolist(), np.searchsorted(known, of), np.searchsorted(known, of, "right")):
            here = order[begin:stop]  # cuts that end at this place
            here = here[(here < links[k]) & (tool[self.motion.cuts[here]] == tool[self.rapids[last[k]]])]
            found += [k] * bool((cuts[here, 2] <= self.end[last[k], 2] + tolerance).any())
        return np.array(found, dtype=np.int64)

    def of(self, link: int) -> slice:
        """The rapids before a cut, by their ranks."""
        return slice(self.begin[link], self.begin[link] + self.count[link])

    def over(self, link: int) -> float:
        """The highest at which they go sideways; where they do not, how high they are."""
        here = self.of(link)
        return float(self.heights[here][self.aside[here]].max()) if self.turns[link] else float(self.high[link])

    def radius(self, link: int) -> float:
        """That of the tool."""
        return float(self.motion.radius[self.rapids[self.begin[link]]])

    def off(self, link: int, other: Ways, there: int, tolerance: float) -> tuple[Array, float]:
        """Places (m, 3) of the ways sideways before a cut (on a lathe of all) that those before a cut of the other do not go
        over, and how far they are beside."""
        here, near = self.of(link), other.of(there)
        some = np.arange(here.start, here.stop)[(self.aside | self.dips)[here] | self.lathe]
        seen = np.array([1.0, 0.0, 1.0] if self.lathe else [1.0, 1.0, 0.0])
        places = (self.start[some] + SHARES * (self.end[some] - self.start[some])).reshape(-1, 3)
        if not other.count[there]:
            return places, float("nan")
        close = nearest_of(places * seen, other.start[near] * seen, other.end[near] * seen)
        beside = np.linalg.norm(places * seen - close, axis=1)
        return places[beside > tolerance], float(beside.max(initial=0.0))

    def reaching(self, link: int, rank: int, height: float) -> int:
        """The first of the rapids before a cut from one of them on that ends as low, by its rank, else that one."""
        return rank + int(np.append(self.end[self.of(link)][rank:, 2] <= height, False).argmax())

    def below(self, link: int, other: Ways, there: int, tolerance: float) -> tuple[float, int]:
        """How much lower than those before a cut of the other the ways before a cut are at a place, seen from above, and which of
        them is, by its rank; where the other does not go lower than all of its own."""
        here, near = self.of(link), other.of(there)
        some = np.arange(here.start, here.stop)[(self.aside | self.dips)[here]]
        start, way = other.start[near], other.end[near] - other.start[near]
        long = np.einsum("ij,ij->i", way[:, :2], way[:, :2])
        found, own = (-np.inf, 0), min(other.low[there], other.last[there])
        for k in np.array_split(some, max(len(SHARES) * len(some) * len(way) // PLACES, 1)):
            places = (self.start[k] + SHARES * (self.end[k] - self.start[k])).reshape(-1, 1, 3)
            share = np.einsum("mki,ki->mk", (places - start)[:, :, :2], way[:, :2]) / np.maximum(long, 1e-12)
            share = np.where(long > tolerance**2, share.clip(0.0, 1.0), way[:, 2] < 0)  # of one straight down its end
            close = start + share[:, :, None] * way
            off = np.linalg.norm((places - close)[:, :, :2], axis=2)
            floor = np.where(off <= tolerance, close[:, :, 2], np.inf).min(axis=1, initial=np.inf)
            lower = (np.where(np.isfinite(floor), floor, own) - places[:, 0, 2]).reshape(-1, len(k)).max(axis=0)
            if lower.max(initial=-np.inf) > found[0]:
                found = float(lower.max()), int(k[lower.argmax()]) - here.start
        return found

    def least(self, around: Around) -> Array:
        """How near (k,) any rapid comes to what stands on the machine."""
        shares = np.linspace(0.0, 1.0, min(max(PLACES // max(len(self.rapids), 1), 2), len(SHARES)))[:, None, None]
        places = (self.start + shares * (self.end - self.start)).reshape(-1, 3)
        return around.far(places, np.tile(self.motion.radius[self.rapids], len(shares)))

    def lowest(self, link: int) -> int:
        """Which of the rapids before a cut goes sideways or dips the lowest, by its rank."""
        here = self.of(link)
        return int(np.where((self.aside | self.dips)[here], self.heights[here], np.inf).argmin()) if self.count[link] else 0

    def said(self, link: int) -> str:
        """What they do, in words."""
        if not self.count[link]:
            return "no rapid"
        heights = {"sideways at": float(self.low[link]), "down to": float(self.dip[link])}
        said = [f"{name} Z{figure(z, 3)}" for name, z in heights.items() if np.isfinite(z)]
        return ", ".join([*said, f"rapid ends at Z{figure(float(self.last[link]), 3)}"])

    def route(self, link: int, rank: int) -> str:
        """Where they go from one of them on."""
        ends = self.end[self.of(link)][rank:]
        said = ", ".join(point(end, lathe=self.lathe) for end in ends[:3]) + ", …" * (len(ends) > 3)
        return f"by {said}" if said else "straight to the cut"

    def until(self, link: int, other: Ways, there: int, tolerance: float) -> int:
        """How many of the rapids before a cut are those before another cut of the other."""
        many = min(self.count[link], other.count[there])
        here, near = (ways.begin[k] + np.arange(many) for ways, k in ((self, link), (other, there)))
        off = np.linalg.norm(self.end[here] - other.end[near], axis=1)
        leans = leaning(self.motion, self.rapids[here], other.motion, other.rapids[near])
        return int(np.append(np.maximum(off, leans) > tolerance, True).argmax())

    def row(self, link: int, rank: int = 0) -> int:
        """The row of the rapids before a cut by their rank, that of the cut where there are no more."""
        cuts = self.motion.cuts[min(link, len(self.motion.cuts) - 1) :]
        moves = np.append(self.rapids[self.of(link)][rank:], cuts[:1])
        return int(self.motion.row[moves[0]]) if len(moves) else -1


def of_dwells(one: Motion, other: Motion, i: Index, j: Index, parts: list[Stretch]) -> list[Found]:
    """Dwells and stops of the program between cuts, at the end of a cut and elsewhere; `parts` are stretches that are one way."""
    found = []
    for at_cut in (True, False):
        sides = []
        for motion, links, k in ((one, i, 0), (other, j, 2)):
            here = np.append(False, motion.kind != Kind.RAPID) == at_cut
            link = np.searchsorted(motion.cuts, np.arange(len(motion) + 1))[here]
            times = np.bincount(link, motion.dwell[here], len(motion.cuts) + 1)
            row = np.append(-1, motion.row[motion.cuts])  # of the cut before, unless there is a dwell
            np.maximum.at(row, link, motion.pause[here])
            inner = [slice(part[k] + 1, part[k + 1]) for part in parts]
            time = np.append(times[links], [times[each].sum() for each in inner])
            sides.append((time, np.append(row[links], [row[each].max(initial=-1) for each in inner])))
        (a, p), (b, q) = sides
        with np.errstate(invalid="ignore"):
            wrong = np.flatnonzero(~((np.abs(a - b) <= SECONDS + RATE * np.abs(a)) | (a == b)))
        for k in wrong.tolist():
            rows = int(p[k]), int(q[k])
            found.append(Found("dwell", rows, float(abs(a[k] - b[k])), "s", (_waits(a[k]), _waits(b[k]))))
    return found


def _waits(time: float) -> str:
    return "a stop" if np.isinf(time) else f"{figure(float(time), 3)} s" if time else "no dwell"
