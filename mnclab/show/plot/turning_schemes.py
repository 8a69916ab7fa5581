"""Roughing schemes of turning side by side, and how a thread grows pass by pass. Z to the right, X up as a diameter."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon

from mnclab.comparison.turning_schemes import TurningComparison, TurningTrial
from mnclab.machining.turning.strokes import CLEANUP, FINISH, OUT, PICK_UP, PLUNGE, RAPID, ROUGH, THREAD
from mnclab.path.inserts import holder, insert
from mnclab.path.tool import Tool
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Line
from mnclab.show.plot.insert import insert_patches
from mnclab.show.plot.picture import SMALL, Picture, write_legend
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strategy import hatch, hatched
from mnclab.show.plot.trials import side_by_side

LOOKS = {
    RAPID: colours.RAPID,
    ROUGH: Line("roughing", "#1259a8", "-", 1.6, 2.6),
    PICK_UP: Line("pick-up", "#7b1fa2", "-", 2.2, 2.7),
    CLEANUP: Line("clean-up", "#00796b", "-", 2.2, 2.8),
    PLUNGE: Line("plunge", "#8a5a00", "-", 1.6, 2.65),
    FINISH: Line("finishing", "#00796b", (0, (6, 1.2)), 2.0, 2.75),
    THREAD: Line("thread", "#1259a8", (0, (4, 1, 1, 1)), 1.8, 2.6),
}
MATERIAL = "#f4f1e8"
GAP, TOP, BOTTOM = 0.5, 0.3, 0.46  # inches
CHORD = 0.01
INSERT = 0.09  # length of the insert's edges, of the width of what is drawn


@sized()
def plot_schemes(found: TurningComparison | TurningTrial, width: float = 9.0, columns: int | None = None) -> Picture:
    """One view of each trial at one scale: material, strokes by their role, what is left; `width` in inches."""
    trials = found.trials if isinstance(found, TurningComparison) else (found,)
    if not trials:
        raise ValueError("there is nothing to draw: no scheme was compared")
    low, high = _box(trials)
    count = columns or min(len(trials), 3 if len(trials) > 4 or len(trials) == 3 else 2)
    names = [trial.name for trial in trials]
    room = {"width": width, "top": TOP, "gap": GAP, "bottom": BOTTOM}
    picture, axes = side_by_side(names, "ZX", low, high, what="roughing schemes", columns=count, **room)
    for ax, trial in zip(axes, trials):
        draw(ax, trial)
    roles = [role for role in LOOKS if any(s.role == role for trial in trials for s in trial.plan.strokes)]
    marks = [Line2D([], [], **LOOKS[role].style()) for role in roles]
    unreached = any(trial.unreachable.loops for trial in trials)
    write_legend(picture, marks + hatched(trials, "out of the tool's reach" if unreached else ""))
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
    ax.add_patch(Polygon(blank, facecolor=MATERIAL, edgecolor="#b8b09a", linewidth=0.8, zorder=1.0))
    part = np.vstack([points, [(left, 0), (right, 0)]])
    ax.add_patch(Polygon(part, facecolor="#d9d5c8", edgecolor=colours.INK, linewidth=1.0, zorder=1.2))
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


def plot_thread(
    depths: Sequence[float], positions: Sequence[float], profile: float = 60.0, ax: Axes | None = None, title: str = "",
    reach: float = 0.0,
) -> Picture:  # fmt: skip
    """The gap of a thread as passes open it: each pass in its own shade, numbered at its tip; depths and shifts in mm.

    `reach` is how far the picture goes to both sides at least. The feed runs to the right.
    """
    slope = math.tan(math.radians(profile) / 2)
    reach = max(reach, 1.1 * (depths[-1] * slope + max(map(abs, positions))))
    if ax is None:
        wide, tall = 2 * reach, depths[-1] * 1.3
        size = (4.2, 4.2 * tall / wide + 0.9)
        picture = Picture(size, alt=f"thread in {len(depths)} passes")
        ax = picture.add_axes((0.16, 0.52 / size[1], 0.8, 1 - 0.86 / size[1]))
    else:
        picture = cast(Picture, ax.get_figure(root=True))
    x = np.linspace(-reach, reach, 1201)
    gone = np.zeros_like(x)
    for k, (depth, place) in enumerate(zip(depths, positions, strict=True)):
        gap = np.maximum(np.maximum(depth - np.abs(x - place) / slope, 0.0), gone)
        shade = ("#1259a8", "#9fc3e6")[k % 2]
        ax.fill_between(x, -gap, -gone, where=gap > gone, color=shade, linewidth=0, interpolate=True, zorder=2)
        ax.plot([place], [-depth], ".", color=colours.INK, markersize=3, zorder=4)
        ax.annotate(str(k + 1), (place, -depth), ((-7, 7)[k % 2], -7), textcoords="offset points", ha="center", fontsize=SMALL,
                    zorder=5, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.3, "alpha": 0.8})  # fmt: skip
        gone = gap
    ax.fill_between(x, -depths[-1] * 1.22, -gone, color="#d9d5c8", linewidth=0, zorder=1)
    ax.plot(x, -gone, color=colours.INK, linewidth=1.1, zorder=3)
    ax.set(aspect="equal", xlim=(-reach, reach), ylim=(-1.22 * depths[-1], 0.08 * depths[-1]))
    ax.set_xlabel("along the feed, mm", fontsize=SMALL + 1)
    ax.set_ylabel("depth, mm", fontsize=SMALL + 1)
    ax.tick_params(labelsize=SMALL)
    ax.set_title(title, fontsize=SMALL + 1, loc="left", pad=4)
    return picture


def plot_threads(infeeds: dict[str, Sequence[float]], depths: Sequence[float], profile: float = 60.0) -> Picture:
    """Infeeds of one thread side by side: a mapping from names to the shifts of the passes, mm."""
    slope = math.tan(math.radians(profile) / 2)
    reach = 1.1 * (depths[-1] * slope + max(abs(s) for shifts in infeeds.values() for s in shifts))
    width, count = 9.0, len(infeeds)
    box = width / count - 0.74
    height = box * 1.3 * depths[-1] / (2 * reach)
    picture = Picture((width, height + 0.9), alt="infeeds of a thread: " + ", ".join(infeeds))
    for k, (name, positions) in enumerate(infeeds.items()):
        left = k * width / count + 0.6
        ax = picture.add_axes((left / width, 0.52 / (height + 0.9), box / width, height / (height + 0.9)))
        plot_thread(depths, positions, profile, ax, name, reach)
        if k:
            ax.set_ylabel("")
    return picture
