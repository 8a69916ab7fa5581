"""The zones of a turned profile in one picture: what is to be cut in each, its kind, and the angles that it asks of a tool."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch, Polygon

from mnclab.geometry.contours import Contour
from mnclab.machining.turning.zones import CLOSED, KINDS, Zone, zones
from mnclab.path.listing import figure
from mnclab.show.plot import colours
from mnclab.show.plot.picture import SMALL, VIEWS, Foot, Picture, arrange, write_legend
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown

PART, CHORD = "#d9d5c8", 0.01
#: Face and hatching of the kinds, told apart in grey print too.
LOOKS = {"open": ("#cfe3f5", ""), "semi-open": ("#f6dfae", "////"), "closed": ("#f3c6c0", "xxxx"), "combined": (PART, "")}


@sized()
def plot_zones(profile: Contour, blank: float, ax: Axes | None = None, *, size: tuple[float, float] = (7.0, 4.5)) -> Picture:
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
    ax.add_patch(Polygon(part, facecolor=PART, edgecolor=colours.INK, linewidth=1.2, zorder=2.0))
    for zone in found:
        face, hatch = LOOKS[zone.kind]
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
    marks = [Patch(facecolor=PART, edgecolor=colours.INK, label="part")]
    marks += [Patch(facecolor=LOOKS[kind][0], hatch=LOOKS[kind][1], edgecolor="#6b6b6b", label=kind) for kind in kinds]
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
