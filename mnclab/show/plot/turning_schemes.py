"""Roughing schemes of turning side by side, how a thread grows pass by pass, and the zones of a profile.

Z goes to the right, X up as a diameter.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon

from mnclab.comparison.turning_schemes import TurningComparison, TurningTrial
from mnclab.geometry.contours import Contour
from mnclab.machining.turning.profiles import CLOSED, KINDS, Zone, zones
from mnclab.machining.turning.strokes import CLEANUP, FINISH, OUT, PICK_UP, PLUNGE, RAPID, ROUGH, THREAD
from mnclab.path.inserts import holder, insert
from mnclab.path.listing import figure
from mnclab.path.tool import Tool
from mnclab.show import looks
from mnclab.show.plot import colours
from mnclab.show.plot.classes import ramp
from mnclab.show.plot.colours import LineStyle
from mnclab.show.plot.lathe import insert_patches
from mnclab.show.plot.picture import SMALL, VIEWS, Foot, Picture, arrange, write_legend
from mnclab.show.plot.side_by_side import evenly, hatch, hatched, label_outer, panels, views
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown

LOOKS = {
    RAPID: colours.RAPID,
    ROUGH: LineStyle("roughing", looks.BLUE, "-", 1.6, 2.6),
    PICK_UP: LineStyle("pick-up", looks.VIOLET, "-", 2.2, 2.7),
    CLEANUP: LineStyle("clean-up", "#00796b", "-", 2.2, 2.8),
    PLUNGE: LineStyle("plunge", looks.BROWN, "-", 1.6, 2.65),
    FINISH: LineStyle("finishing", "#00796b", (0, (6, 1.2)), 2.0, 2.75),
    THREAD: LineStyle("thread", looks.BLUE, (0, (4, 1, 1, 1)), 1.8, 2.6),
}
WIDE, MANY = (2.8, 1.9), 4  # inches of a view and what stands beside it, at least: of so many ones at most, of more
CHORD = 0.01
INSERT = 0.09  # length of the insert's edges, of the width of what is drawn


@sized()
def plot_schemes(found: TurningComparison | TurningTrial, width: float = 9.0, columns: int | None = None) -> Picture:
    """One view of each trial at one scale: material, strokes by their role, what is left; `width` in inches."""
    trials = found.trials if isinstance(found, TurningComparison) else (found,)
    if not trials:
        raise ValueError("there is nothing to draw: no scheme was compared")
    low, high = _box(trials)
    roles = [role for role in LOOKS if any(s.role == role for trial in trials for s in trial.plan.strokes)]
    marks = [Line2D([], [], **LOOKS[role].style()) for role in roles]
    unreached = any(trial.unreachable.loops for trial in trials)
    legend = marks + hatched(trials, "out of the tool's reach" if unreached else "")
    names, count = [trial.name for trial in trials], columns or evenly(len(trials), width / WIDE[len(trials) > MANY])
    picture, axes = views(names, "roughing schemes", width, count, VIEWS["ZX"], low, high, legend)
    for ax, trial in zip(axes, trials):
        draw(ax, trial)
    return picture


def _box(trials: Sequence[TurningTrial]) -> tuple[np.ndarray, np.ndarray]:
    """The corners (z, r) of what is shown of every trial: material and strokes."""
    every = np.vstack([_places(trial) for trial in trials])
    size = INSERT * float(np.ptp(every[:, 0]))
    stands = [stand for trial in trials for stand in _stand(trial)]
    for tool, tip, reach in stands:
        every = np.vstack([every, tip + insert(tool, size, reach).points, tip + holder(tool, size, reach)])
    low, high = every.min(axis=0), every.max(axis=0)
    margin = 0.05 * float((high - low).max())
    return np.array([low[0] - margin, max(low[1] - 3 * margin, 0.0)]), high + margin


def draw(ax: Axes, trial: TurningTrial) -> None:
    """One trial in its axes, with the tool at the end of its last cut."""
    points = trial.profile.points_within(CHORD)
    left, right = points[-1, 0], points[0, 0]
    blank = [(left, 0), (left, trial.blank), (right, trial.blank), (right, 0)]
    ax.add_patch(Polygon(blank, facecolor=looks.RAW, edgecolor="#b8b09a", linewidth=0.8, zorder=1.0))
    part = np.vstack([points, [(left, 0), (right, 0)]])
    ax.add_patch(Polygon(part, facecolor=looks.METAL, edgecolor=colours.INK, linewidth=1.0, zorder=1.2))
    hatch(ax, trial.rest, trial.unreachable)
    for stroke, way in trial.plan.ways:
        ax.add_line(Line2D(*way.points_within(CHORD).T, **{**LOOKS[stroke.role].style(), "label": f"_{stroke.role}"}))
    size = INSERT * float(np.ptp([z for z, _ in _places(trial)]))
    for tool, tip, reach in _stand(trial):
        for patch in insert_patches(tool, tip, size, reach, 2.0):  # below the strokes
            ax.add_patch(patch)


def _places(trial: TurningTrial) -> list[tuple[float, float]]:
    """Corners of the profile and of the strokes (z, r)."""
    ends = [(float(z), float(r)) for z, r in trial.profile.points]
    return [*ends, trial.plan.start, *((s.z, s.r) for s in trial.plan.strokes)]


def _stand(trial: TurningTrial) -> list[tuple[Tool, tuple[float, float], float]]:
    """The tool of the last cut, its tip at the end, and how long a blade is so that its holder stays outside the blank."""
    cuts = [s for s in trial.plan.strokes if s.role != RAPID]
    return [(trial.tools[s.tool - 1], (s.z, s.r), trial.blank + OUT - s.r) for s in cuts[-1:]]


@sized()
def plot_threads(
    infeeds: Mapping[str, Sequence[float]], depths: Sequence[float], profile: float = 60.0, *, width: float = 9.0,
    columns: int | None = None,
) -> Picture:  # fmt: skip
    """Infeeds of one thread side by side: a mapping from names to the shifts of the passes, mm; `width` in inches.

    Each pass has its own colour and is numbered at its tip; the feed runs to the right."""
    slope = math.tan(math.radians(profile) / 2)
    reach = 1.1 * (depths[-1] * slope + max(abs(s) for shifts in infeeds.values() for s in shifts))
    names, count = list(infeeds), columns or evenly(len(infeeds), width / WIDE[0])
    picture, axes = panels(names, f"infeeds of a thread: {', '.join(names)}", width, count, 0.65 * depths[-1] / reach, [])
    for ax, positions in zip(axes, infeeds.values()):
        _thread(ax, depths, positions, slope, reach)
    label_outer(axes, "along the feed, mm", "depth, mm")
    return picture


def _thread(ax: Axes, depths: Sequence[float], positions: Sequence[float], slope: float, reach: float) -> None:
    """The gap of a thread as passes of these depths and shifts open it, `reach` to both sides; all in mm."""
    x = np.linspace(-reach, reach, 1201)
    gone = np.zeros_like(x)
    first = math.copysign(7, positions[0]) if min(positions) < 0 < max(positions) else -7  # points: the side of the first number
    for k, (depth, place, shade) in enumerate(zip(depths, positions, ramp(len(depths)), strict=True)):
        gap = np.maximum(np.maximum(depth - np.abs(x - place) / slope, 0.0), gone)
        ax.fill_between(x, -gap, -gone, where=gap > gone, color=shade, linewidth=0, interpolate=True, zorder=2)
        ax.plot([place], [-depth], ".", color=colours.INK, markersize=3, zorder=4)
        ax.annotate(str(k + 1), (place, -depth), (first * (-1) ** k, -7), textcoords="offset points", ha="center", fontsize=SMALL,
                    zorder=5, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.3, "alpha": 0.8})  # fmt: skip
        gone = gap
    ax.fill_between(x, -depths[-1] * 1.22, -gone, color=looks.METAL, linewidth=0, zorder=1)
    ax.plot(x, -gone, color=colours.INK, linewidth=1.1, zorder=3)
    ax.set(aspect="equal", xlim=(-reach, reach), ylim=(-1.22 * depths[-1], 0.08 * depths[-1]))


# The zones of a turned profile in one picture: what is to be cut in each, its kind, and the angles that it asks of a tool.

#: Face and hatching of the kinds, told apart in grey print too.
ZONES = {"open": ("#cfe3f5", ""), "semi-open": ("#f6dfae", "////"), "closed": ("#f3c6c0", "xxxx"), "combined": (looks.METAL, "")}


@sized()
def plot_zones(profile: Contour, blank: float, *, ax: Axes | None = None, size: tuple[float, float] = (7.0, 4.5)) -> Picture:
    """The zones of a profile (z, r) under a blank of a radius, mm: numbered, with the steepest rise (main angle) and fall
    (auxiliary angle) in degrees. Z to the right, X up as a diameter.

    >>> from mnclab.geometry.contours import Contour
    >>> plot_zones(Contour([(0, 20), (-40, 20), (-50, 30)], closed=False), 30).alt
    'zones of turning: 1 semi-open: main angle from 45°, auxiliary from 0°'
    """
    if not isinstance(profile, Contour):
        raise Alarm(f"a profile is a Contour of points (z, r), got {shown(profile)}", hint="mnclab.area.Contour(…, closed=False)")
    check_number(blank, "the radius of the blank (mm)", above=0)
    try:
        found = zones(profile, blank)
    except ValueError as error:
        raise Alarm(str(error)) from None
    points = profile.points_within(CHORD)
    said = "; ".join(f"{k} {_told(zone)}" for k, zone in enumerate(found, 1))
    low, high = np.array([0.0, 0.0, points[:, 0].min()]), np.array([blank, 0.0, points[:, 0].max()])
    kinds = [kind for kind in KINDS if any(zone.kind == kind for zone in found)]
    lines = "\n".join(f"{k}  {_told(zone)}" for k, zone in enumerate(found, 1))
    picture = None
    if ax is None:
        view = VIEWS["ZX"]
        picture, (ax,) = arrange([view], low, high, ["part", *kinds], Foot(lines), f"zones of turning: {said}", size)
    left, right = float(points[-1, 0]), float(points[0, 0])
    part = np.vstack([points, [(left, 0), (right, 0)]])
    ax.add_patch(Polygon(part, facecolor=looks.METAL, edgecolor=colours.INK, linewidth=1.2, zorder=2.0))
    for zone in found:
        face, hatch = ZONES[zone.kind]
        look: dict[str, Any] = {"facecolor": face, "edgecolor": "#6b6b6b", "hatch": hatch, "linewidth": 0.6}
        ax.add_patch(Polygon(_area(zone, blank), **look, zorder=1.0 + 0.1 * (zone.kind == CLOSED)))
    ax.plot([left, right], [blank, blank], color=colours.BLANK.colour, linewidth=1.0, zorder=2.1)
    ax.axhline(0.0, **{**colours.CENTRE_LINE.style(), "label": "_centre line"})
    for k, zone in enumerate(found, 1):
        area = _area(zone, blank)
        across = (area[:, 0].min() + area[:, 0].max()) / 2
        order = np.argsort(points[:, 0])
        floor = max(float(np.interp(across, points[order, 0], points[order, 1])), float(area[:, 1].min()))
        middle = np.array([across, (floor + area[:, 1].max()) / 2])
        ax.annotate(
            f"{k}", tuple(middle), ha="center", va="center", fontsize=SMALL + 1, zorder=4,
            bbox={"boxstyle": "circle,pad=0.2", "facecolor": colours.PAPER, "edgecolor": colours.INK},
        )  # fmt: skip
    if picture is None:
        return cast(Picture, ax.get_figure(root=True))
    marks = [Patch(facecolor=looks.METAL, edgecolor=colours.INK, label="part")]
    marks += [Patch(facecolor=ZONES[kind][0], hatch=ZONES[kind][1], edgecolor="#6b6b6b", label=kind) for kind in kinds]
    write_legend(picture, marks)
    return picture


def _told(zone: Zone) -> str:
    return f"{zone.kind}: main angle from {figure(zone.main, 1)}°, auxiliary from {figure(zone.auxiliary, 1)}°"


def _area(zone: Zone, blank: float) -> np.ndarray:
    """What is to be cut in a zone: from its profile up to the blank; of a closed one up to its lower rim."""
    points = zone.profile.points_within(CHORD)
    rim = min(blank, float(min(points[0, 1], points[-1, 1]))) if zone.kind == CLOSED else blank
    above = points[:, 1] <= rim + 1e-9
    if zone.kind == CLOSED and not above.all():
        points = np.column_stack([points[:, 0], np.minimum(points[:, 1], rim)])
    return np.vstack([np.minimum(points, [np.inf, rim]), [(points[-1, 0], rim), (points[0, 0], rim)]])
