"""Sections through a part as drawings have them: hatched, named by a letter at both ends of the line; what holds it."""

from __future__ import annotations

from collections.abc import Sequence
from string import ascii_uppercase
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch, Polygon
from matplotlib.path import Path
from matplotlib.patheffects import withStroke

from mnclab.geometry.contours import Contour
from mnclab.path.listing import MM, Unit
from mnclab.path.toolpath import Array
from mnclab.show.plot import colours
from mnclab.show.plot.overlay import fits, grown
from mnclab.show.plot.picture import SMALL, VIEWS, View
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice, shown
from mnclab.workpiece.blank import Blank, blank
from mnclab.workpiece.part import Part
from mnclab.workpiece.workpiece import Workpiece

ACROSS = {"XY": 2, "XZ": 1, "YZ": 0}  # the coordinate that a plane fixes
CHORD = 0.02  # mm
FACE: dict[str, Any] = {"facecolor": "#f3efe2", "edgecolor": colours.INK, "linewidth": 1.1}
HATCH: dict[str, Any] = {"facecolor": "none", "edgecolor": "#55524a", "linewidth": 0.0, "hatch": "////"}
CUT: dict[str, Any] = {"color": colours.INK, "linewidth": 0.8, "linestyle": (0, (10, 3, 1.5, 3))}
HALO = [withStroke(linewidth=1.8, foreground=colours.PAPER)]
CARD: dict[str, Any] = {"boxstyle": "round,pad=0.12", "facecolor": colours.PAPER, "edgecolor": "none"}  # behind a text
FIXTURE: dict[str, Any] = {  # dashed as drawings have what is beside the part
    "facecolor": "#c9ccd180", "edgecolor": "#55524a", "linewidth": 0.8, "linestyle": (0, (9, 2, 1.5, 2, 1.5, 2)),
}  # fmt: skip
HEAD = 0.16  # inches, of a title
OUT, ARROW = 0.035, 0.05  # of the part's greatest side: how far the line of a cut goes beyond it, arrows


class Section(NamedTuple):
    """A plane, where it lies (mm), its letter, and what it cuts."""

    plane: str
    at: float
    letter: str
    contours: list[Contour]
    unit: Unit = MM

    @property
    def view(self) -> View:
        return VIEWS[self.plane]._replace(head=HEAD, unit=self.unit)

    @property
    def title(self) -> str:
        value = f"{self.at / self.unit.length:.6g}".replace("-", "\N{MINUS SIGN}")
        return f"{self.letter}\N{EN DASH}{self.letter}   {'XYZ'[ACROSS[self.plane]]} = {value} {self.unit.short}"


def sections_of(workpiece: Workpiece, planes: str | Sequence[str], at: float | Sequence[float] | None) -> list[Section]:
    """The sections that are asked for: a plane or several, each with its place, or all in the middle of the blank."""
    several = [planes] if isinstance(planes, str) else planes
    if not isinstance(several, Sequence):
        raise Alarm(f"section must be a plane or several of {', '.join(ACROSS)}, got {shown(planes)}")
    for plane in several:
        choice(plane, "section", ACROSS)
    middle = workpiece.cutting.stock.bounds.mean(axis=0)
    places = [float(middle[ACROSS[plane]]) for plane in several] if at is None else at
    places = list(places) if isinstance(places, Sequence | np.ndarray) else [places] * len(several)
    for place in places:
        check_number(place, "where a section is (mm)")
    if len(places) != len(several):
        raise Alarm(f"each section needs a place, got {len(places)} for {len(several)}", hint='section=["XZ", "YZ"], at=[10, 30]')
    return [
        Section(plane, float(place), letter, workpiece.cut(plane, float(place)), workpiece.cutting.path.unit)
        for plane, place, letter in zip(several, places, ascii_uppercase)
    ]


def draw_cut(ax: Axes, contours: Sequence[Contour], label: str = "") -> None:
    """The faces that a plane cuts, hatched."""
    shape = outline_of(contours)
    hatch = PathPatch(shape, **HATCH, zorder=1.6)
    hatch.set_hatch_linewidth(0.6)
    ax.add_patch(PathPatch(shape, **FACE, zorder=1.5, label=label))
    ax.add_patch(hatch)


def draw_section(ax: Axes, workpiece: Workpiece, section: Section) -> None:
    """The material that a plane cuts, hatched, and the blank around it."""
    view = section.view
    if section.contours:
        draw_cut(ax, section.contours)
    for line in workpiece.cutting.stock.outline(view.right, view.up):
        ax.add_line(Line2D(line[:, 0], line[:, 1], **{**colours.BLANK.style(), "linestyle": (0, (6, 2))}))
    draw_fixtures(ax, workpiece, view, section.at)
    ax.annotate(
        section.title, (0.5, 1.0), (0, -2), xycoords="axes fraction",
        textcoords="offset points", ha="center", va="top", fontsize=SMALL + 1, bbox=CARD, zorder=5,
    )  # fmt: skip


def held(workpiece: Workpiece) -> list[Blank]:
    """The fixtures whose outline is known."""
    return [each for each in workpiece.cutting.fixtures if not isinstance(each, Part)]


def draw_fixtures(ax: Axes, workpiece: Workpiece, view: View, at: float | None = None) -> None:
    """The outlines of fixtures; of a section of those that its plane meets."""
    across = 3 - view.right - view.up
    for each in held(workpiece):
        low, high = each.bounds[:, across].tolist()
        if at is None or low <= at <= high:
            for line in each.outline(view.right, view.up):
                ax.add_patch(Polygon(line, **FIXTURE, zorder=1.8))


def outline_of(contours: Sequence[Contour]) -> Path:
    """Closed contours as one shape with its holes."""
    rings = [each.points_within(CHORD) for each in contours]
    rings = [ring if (ring[0] == ring[-1]).all() else np.concatenate([ring, ring[:1]]) for ring in rings]
    codes = [np.r_[Path.MOVETO, np.full(len(ring) - 2, Path.LINETO), Path.CLOSEPOLY] for ring in rings]
    return Path(np.concatenate(rings), np.concatenate(codes).astype(np.uint8))


def mark_section(ax: Axes, section: Section, low: Array, high: Array) -> None:
    """The line of a cut in the view from above, its arrows where one looks, its letter at both ends."""
    fixed = ACROSS[section.plane]
    if fixed == 2:
        return
    size = float((high - low)[:2].max())
    along, looks = 1 - fixed, size * ARROW * (1 if fixed == 1 else -1)
    ends = np.full((2, 2), section.at)
    ends[:, along] = low[along] - OUT * size, high[along] + OUT * size
    ax.add_line(Line2D(ends[:, 0], ends[:, 1], **CUT, zorder=3.0, path_effects=HALO))
    for end in ends:
        tail = end.copy()
        tail[fixed] -= looks
        arrow = {"arrowstyle": "-|>", "color": colours.INK, "linewidth": 1.2, "mutation_scale": 9, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", tuple(end), tuple(tail), arrowprops=arrow, zorder=3.1)
        ax.annotate(
            section.letter, tuple(tail), (0, -6 if fixed == 1 else 0), textcoords="offset points", fontsize=SMALL + 1,
            ha="center" if fixed == 1 else "left", va="center", weight="bold", bbox=CARD, zorder=3.2,
        )  # fmt: skip


NAME = "fixture"
LOOK: dict[str, Any] = {**FIXTURE, "hatch": "\\\\\\", "linestyle": "-", "edgecolor": "#77736a"}


class Fixtures(NamedTuple):
    """Bodies in the coordinates of the path."""

    bodies: list[Blank]

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        for each in self.bodies:
            if fits(low, high, each.bounds):  # else it is cut off at the border
                low, high = grown(low, high, each.bounds)
        return low, high

    def names(self, views: Sequence[View]) -> list[str]:
        return [NAME]

    def draw(self, ax: Axes, view: View) -> list[Any]:
        for each in self.bodies:
            for outline in each.outline(view.right, view.up):
                ax.add_patch(Polygon(outline, **LOOK, zorder=1.2))
        return [Patch(**LOOK, label=NAME)]

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        return None


def fixtures_of(run: Any) -> Fixtures | None:
    """The fixtures of a mill whose outline is known; of a lathe the picture of the part has them."""
    if run.toolpath.lathe:
        return None
    found = [blank(each) for each in run.setup.fixtures if not isinstance(each, Part)]
    bodies = [each.moved(-np.asarray(run.toolpath.origin)) for each in found if each is not None]
    return Fixtures(bodies) if bodies else None
