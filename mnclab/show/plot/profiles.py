"""Feed-rate profiles of several machines, limits or programs in one figure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from mnclab.path.listing import MM, Unit
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Kind
from mnclab.show.plot.picture import SMALL, Picture, calm, write_legend
from mnclab.show.plot.profile import curve
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice, fitting, shown

WIDTH, HIGH = 7.0, 1.75  # inches: of the figure, and of one profile at most
MOST = 8
LOOKS = ("#12304f", "#c26a12")  # dark and pale in turn
RAPID = "#e9c9c5"


@sized()
@fitting
def plot_profiles(
    profile: Any, *others: Any, names: Sequence[str] = (), over: str = "time", width: float = WIDTH
) -> Picture:
    """The feed of several profiles, or runs, under one another: `plot_profiles(run.profile("small-mill"), run)`.

    They may be a list, too. All begin at 0 and have the same scales; bands stand for rapids. `names` are what they are called
    (default: program and machine), each with its time; `over` "time" (s) or "path"; `width` of the figure in inches. Lengths
    are in inches where all programs are, else in mm.
    """
    over = choice(over, "over", ("time", "path"))
    found = [_profile(each) for each in (*(profile if isinstance(profile, list | tuple) else [profile]), *others)]
    if not 0 < len(found) <= MOST:
        hint = 'plot_profiles(run.profile("small-mill"), run.profile("fast-mill"))'
        raise Alarm(f"a picture has 1 to {MOST} profiles, got {len(found)}", hint=hint)
    named = isinstance(names, tuple | list) and all(isinstance(name, str) for name in names)
    if not named or names and len(names) != len(found):
        raise Alarm(f"there must be a name for each of {len(found)} profiles, got {shown(names)}")
    called = [f"{name}: {each.time:.2f} s" for name, each in zip(names or _names(found), found)]
    height = min(HIGH, 0.5 * width) * len(found) + 0.75
    picture = Picture((width, height), f"feed over {over}: {'; '.join(called)}")
    left, low, above = 0.72 / width, 0.48 / height, 0.27 / height
    grid = picture.add_gridspec(len(found), 1, left=left, right=1 - 0.15 / width, bottom=low, top=1 - above, hspace=0.12)
    rows: list[Axes] = []
    for k in range(len(found)):
        rows.append(picture.add_subplot(grid[k, 0], sharex=rows[0] if rows else None, sharey=rows[0] if rows else None))
    units = {each.path.unit for each in found}
    unit = units.pop() if len(units) == 1 else MM
    drawn = [_draw(ax, each, over, LOOKS[k % 2], unit) for k, (ax, each) in enumerate(zip(rows, found))]
    top = 1.3 * max(most for _, most in drawn) or 1.0
    rows[0].set(xlim=(0, max(*(end for end, _ in drawn), 1e-9)), ylim=(0, top))
    for ax, name in zip(rows, called):
        calm(ax)
        ax.yaxis.set_major_locator(MaxNLocator(nbins=4, steps=[1, 2, 5, 10]))
        ax.tick_params(labelbottom=ax is rows[-1])
        ax.text(0.005, 0.96, name, transform=ax.transAxes, va="top", fontsize=SMALL, parse_math=False,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5, "alpha": 0.85})  # fmt: skip
    rows[-1].set_xlabel("time, s" if over == "time" else f"path, {unit.short}", fontsize=SMALL + 1)
    said = f"feed, {unit.short}/min"
    picture.text(0.16 / width, (low + 1 - above) / 2, said, rotation=90, va="center", ha="center", fontsize=SMALL + 1)
    write_legend(picture, [Line2D([], [], color=LOOKS[0], label="feed"), Patch(facecolor=RAPID, label="rapid")])
    return picture


def _draw(ax: Axes, profile: Profile, over: str, shade: str, unit: Unit) -> tuple[float, float]:
    """The feed of one profile and its rapids as bands; returns where it ends and its greatest feed."""
    drawn = curve(profile, over).counted(unit.length)
    x, v = (drawn.t if over == "time" else drawn.s), drawn.v * 60
    if not len(x):
        return 0.0, 0.0
    rapid = profile.path.kind[profile.move[drawn.piece]] == Kind.RAPID
    feed = np.where(rapid, np.nan, v)
    ax.fill_between(x, 0, 1, where=rapid, transform=ax.get_xaxis_transform(), color=RAPID, linewidth=0.6, zorder=1)
    ax.fill_between(x, feed, color=shade, alpha=0.18, linewidth=0, zorder=2)
    ax.plot(x, feed, color=shade, linewidth=1.3, zorder=3)
    return float(x[-1]), float(np.nanmax(feed, initial=0.0))


def _profile(given: Any) -> Profile:
    found = given if isinstance(given, Profile) else given.profile() if hasattr(given, "toolpath") else None
    if found is None:
        raise Alarm(f"a profile is that of a run, got {shown(given)}", hint='run.profile("small-mill")')
    return found


def _names(profiles: Sequence[Profile]) -> list[str]:
    """What each is called; those that are called alike by their number."""
    called = [each.name or "path" for each in profiles]
    return [f"{name} ({k})" if called.count(name) > 1 else name for k, name in enumerate(called, 1)]
