"""Zones of turning: what a profile asks of the tool, and how a combined one is parted (NC-31, 3.20.1 and 3.20.2).

    open       r never grows with the feed: no wall ends a pass               any tool
    semi-open  r only grows: a shoulder ends every pass                       the main angle must reach the shoulder
    closed     r falls and grows again, walls on both sides                   both angles are restricted
    combined   two or three of these

The figures of the source are missing; the test by growth is the reading adopted, as it gives the stated restrictions. Water
poured over the profile stands in the closed zones; what stays dry grows up to the greatest radius (semi-open) and does
not grow behind it (open). Profiles are those of `profiles`: (z, r), mm, from the face to the chuck.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour, joined
from mnclab.machining.turning.profiles import SAME, between, checked, entry_way, exit_way

OPEN, SEMI_OPEN, CLOSED, COMBINED = "open", "semi-open", "closed", "combined"
KINDS = (OPEN, SEMI_OPEN, CLOSED, COMBINED)


class Zone(NamedTuple):
    """One section: its kind and its profile; in dry sections lines stand for the closed zones within them.

    `main` and `auxiliary` are the angles in degrees that the tool needs at least: the steepest growth and fall.
    """

    kind: str
    profile: Contour

    @property
    def main(self) -> float:
        return _steepest(self.profile, 1.0)

    @property
    def auxiliary(self) -> float:
        return _steepest(self.profile, -1.0)


def zone_of(profile: Contour, blank: float = math.inf) -> str:
    """The kind of a whole profile under a blank of a radius: one of `KINDS`."""
    found = zones(profile, blank)
    return COMBINED if len(found) > 1 else found[0].kind


def zones(profile: Contour, blank: float = math.inf) -> tuple[Zone, ...]:
    """The sections of a profile: dry ones from the face to the chuck, then the closed ones, outer before inner.

    Sections that the `blank` radius leaves nothing to cut of are left out. A closed zone with a rib inside is parted at
    the height of the rib. Raises ValueError where the blank lies nowhere above the profile.
    """
    contour = checked(profile)
    rim, pools = _poured(contour)
    r = rim.points[:, 1]
    top = int(np.flatnonzero(r >= r.max() - SAME)[0])
    upto = float(rim.lengths[:top].sum())
    found = [Zone(SEMI_OPEN, joined([between(rim, 0.0, upto)]))] if top else []
    rest = between(rim, upto, rim.length)
    if rest is not None:
        right, left = rest.points[0, 0], rest.points[-1, 0]
        bridged = sum(float(np.ptp(pool.points[:, 0])) for pool in pools if left <= pool.points[0, 0] <= right + SAME)
        if right - left - bridged > SAME:
            found.append(Zone(OPEN, rest))
    found += [Zone(CLOSED, simple) for pool in pools for simple in _simple(pool)]
    kept = tuple(zone for zone in found if zone.profile.points[:, 1].min() < blank - SAME)
    if not kept:
        raise ValueError(f"a blank of radius {blank:g} leaves nothing to cut above the profile")
    return kept


def filled(profile: Contour) -> Contour:
    """The profile with its closed zones filled up to their rims."""
    return _poured(checked(profile))[0]


def _poured(contour: Contour) -> tuple[Contour, list[Contour]]:
    """A checked profile with straight lines over its pools, and the pools."""
    r = contour.points[:, 1]
    water = np.minimum(np.maximum.accumulate(r), np.maximum.accumulate(r[::-1])[::-1])
    wet = np.flatnonzero(r < water - SAME)
    upto = np.concatenate([[0.0], np.cumsum(contour.lengths)])
    dry: list[Contour | None] = []
    pools: list[Contour] = []
    at = 0.0
    for run in np.split(wet, np.flatnonzero(np.diff(wet) > 1) + 1) if len(wet) else []:
        first, last, level = int(run[0]) - 1, int(run[-1]) + 1, float(water[run[0]])
        around = between(contour, float(upto[first]), float(upto[last]))
        assert around is not None
        head, tail = entry_way(around, level) or 0.0, exit_way(around, level)
        pool = between(around, head, tail)
        assert pool is not None
        dry.append(between(contour, at, float(upto[first]) + head))
        dry.append(Contour(pool.points[[0, -1]], closed=False))
        pools.append(pool)
        at = float(upto[first]) + tail
    dry.append(between(contour, at, contour.length))
    return joined(dry), pools


def _simple(pool: Contour) -> list[Contour]:
    """A pool as pools that fall once and grow once: what stands above the highest rib, and what lies on its sides."""
    r = pool.points[:, 1]
    ribs = [r[i] for i in range(1, len(r) - 1) if _is_rib(r, i)]
    if not ribs:
        return [pool]
    rib = float(max(ribs))
    head, tail = entry_way(pool, rib), exit_way(pool, rib)
    assert head is not None
    inner = between(pool, head, tail)
    assert inner is not None
    above = joined([between(pool, 0.0, head), between(pool, tail, pool.length)])
    return [above, *(simple for each in _poured(inner)[1] for simple in _simple(each))]


def _is_rib(r: np.ndarray, i: int) -> bool:
    """Whether the profile has grown before a point and falls behind it."""
    before, behind = (part[np.abs(part - r[i]) > SAME] for part in (r[:i], r[i + 1 :]))
    return bool(len(before) and len(behind) and before[-1] < r[i] and behind[0] < r[i])


def _steepest(profile: Contour, side: float) -> float:
    """The steepest angle, degrees, in which a profile grows (side 1) or falls (side -1)."""
    slopes = np.vstack(profile.tangents())
    return float(np.degrees(np.arctan2(side * slopes[:, 1], -slopes[:, 0])).max(initial=0.0)) + 0.0
