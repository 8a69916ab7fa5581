"""Where the axes of a machine stand, over the rows of a path or over time."""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.path.profile import Profile
from mnclab.show.plot import colours
from mnclab.show.plot.picture import LINE, SMALL, Picture, broken, stacked
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.unrolled import angle_steps
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown

UNITS = {"X": "mm", "Y": "mm", "Z": "mm", "A": "°", "B": "°", "C": "°"}
DECIMALS = 6  # what is below is noise of numbers
WIDTH, HIGH, LEFT = 7.0, 0.85, 0.8  # inches: of the figure, of one axis, and of its names
STEPS = 3  # of an axis that turns, at most


@sized()
def plot_axes(axes: Any, profile: Profile | None = None, *, width: float = WIDTH, height: float | None = None) -> Picture:
    """A curve for each axis that moves: X Y Z of the spindle reference, mm, and A B C, degrees, in machine coordinates.

    Over the rows of the path, or over the time of a `profile` of it, s, within a row evenly; `width`, `height` in inches.
    """
    course, at = axes.course()
    course = course.round(DECIMALS)
    over = "row of the path"
    if profile is not None and not (isinstance(profile, Profile) and len(profile.path) == len(axes)):
        message = f"the profile that axes are drawn over is that of their run, got {shown(profile)}"
        raise Alarm(message, hint="run.axes().plot(run.profile())")
    if profile is not None:
        at, over = np.interp(at, np.arange(len(profile.starts)), profile.starts), "time, s"
    if len(at) and at[0] > 0:  # before the first move all axes stand
        at, course = np.append(0.0, at), np.concatenate([course[:1], course])
    moving = [k for k in range(6) if len(course) and np.ptp(course[:, k]) > 0]
    ends = ", ".join(f"{name} from {low:g} to {high:g}" for name, low, high in _spans(course, moving))
    picture = Picture((width, height or HIGH * max(len(moving), 1) + 0.8), f"axes over {over}: {ends or 'none moves'}")
    title = broken("machine coordinates, X Y Z of the spindle reference", width - LEFT - 0.1, SMALL + 1)
    rows = stacked(picture, [1.0] * max(len(moving), 1), 0.15 + LINE * len(title), left=LEFT, ticks=3)
    for row, k in zip(rows, moving):
        name, look = "XYZABC"[k], colours.AXES[k % 3]
        row.plot(at, course[:, k], color=look.colour, linewidth=look.width)
        row.set_ylabel(f"{name}, {UNITS[name]}", fontsize=SMALL + 1)
        low, high = course[:, k].min(), course[:, k].max()
        row.set_ylim(low - 0.08 * (high - low), high + 0.08 * (high - low))
        row.margins(x=0)
        if k > 2:
            row.yaxis.set_major_locator(angle_steps(high - low, STEPS))
    rows[0].set_title("\n".join(title), fontsize=SMALL + 1, loc="left", pad=4)
    last = rows[-1]
    last.set_xlabel(over, fontsize=SMALL + 1)
    if not moving:
        last.text(0.5, 0.5, "no axis moves", transform=last.transAxes, ha="center", va="center", fontsize=SMALL + 1)
    picture.align_ylabels(picture.axes)
    return picture


def _spans(course: Any, moving: list[int]) -> list[tuple[str, float, float]]:
    return [("XYZABC"[k], round(course[:, k].min(), 3), round(course[:, k].max(), 3)) for k in moving]
