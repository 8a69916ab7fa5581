"""Sheets as matplotlib figures in true size: one millimetre is one millimetre of the paper, arcs are true curves."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.font_manager import FontProperties
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from mnclab.design.drawing.ink import CAPITAL, FACE, Arrow, Label, Stroke, corners_of
from mnclab.design.drawing.view import Kind, Point
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats

MM = 72 / 25.4  # points to a millimetre
INCH = 25.4
INK, PAPER = "black", "white"


def curve(contours: Iterable[Contour]) -> Path:
    """Contours as one path of matplotlib, whose arcs are curves of the third degree, of at most an eighth of a turn each."""
    points: list[Any] = []
    codes: list[Any] = []
    for contour in contours:
        points.append(tuple(contour.points[0].tolist()))
        codes.append(Path.MOVETO)
        here = contour.points[0]
        for end, sweep, centre in contour.walk:
            if sweep == 0:
                points.append(end)
                codes.append(Path.LINETO)
            else:
                count = math.ceil(abs(sweep) / (math.pi / 4) - 1e-9)
                step = sweep / count
                pull = 4 / 3 * math.tan(step / 4)
                arm = np.array(here) - centre
                for _ in range(count):
                    c, s = math.cos(step), math.sin(step)
                    after = np.array([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]])
                    points += [
                        centre + arm + pull * np.array([-arm[1], arm[0]]),
                        centre + after - pull * np.array([-after[1], after[0]]),
                        centre + after,
                    ]
                    codes += [Path.CURVE4] * 3
                    arm = after
            here = np.array(end)
        if contour.closed:
            points.append(points[-1])
            codes.append(Path.CLOSEPOLY)
    return Path(np.array(points, dtype=float).reshape(-1, 2), np.array(codes, dtype=np.uint8))


def draw_strokes(ax: Axes, strokes: Sequence[Stroke], at: Point = (0.0, 0.0)) -> None:
    """Strokes moved to a place on the paper."""
    move = Affine2D().translate(*at) + ax.transData
    for stroke in strokes:
        dashes = stroke.kind.dashes if stroke.dashes is None else stroke.dashes
        width = stroke.kind.width * MM
        style: Any = (0, [each * MM / width for each in dashes]) if dashes else "-"
        ends: Any = "butt" if dashes else "round"
        path = PathPatch(
            curve([stroke.contour]), fill=False, edgecolor=INK, linewidth=width, linestyle=style, capstyle=ends,
            joinstyle="round", transform=move, zorder=2 + stroke.kind.width, gid=stroke.layer,
        )  # fmt: skip
        ax.add_patch(path)


def draw_thin(ax: Axes, segments: Floats, layer: str, at: Point = (0.0, 0.0), zorder: float = 2.45) -> None:
    """Thin straight lines `(n, 2, 2)`."""
    if len(segments):
        width = Kind.THIN.width * MM
        lines = LineCollection(list(segments + at), colors=INK, linewidths=width, zorder=zorder, gid=layer)
        ax.add_collection(lines, autolim=False)


def draw_arrows(ax: Axes, arrows: Sequence[Arrow], at: Point = (0.0, 0.0)) -> None:
    """Filled arrowheads."""
    if arrows:
        heads = [Polygon(arrow.corners + at, closed=True) for arrow in arrows]
        filled = PatchCollection(heads, facecolor=INK, edgecolor="none", zorder=3, gid="DIMENSIONS")
        ax.add_collection(filled, autolim=False)


def draw_clear(ax: Axes, labels: Sequence[Label], at: Point = (0.0, 0.0)) -> None:
    """Centre lines and other thin lines of the part stop beside texts, as ISO 128 has it."""
    if labels:
        boxes = corners_of(np.array([label.box(0.2) for label in labels])) + at
        empty = PatchCollection([Polygon(box) for box in boxes], facecolor=PAPER, edgecolor="none", zorder=2.4, gid="PAPER")
        ax.add_collection(empty, autolim=False)


def draw_label(ax: Axes, label: Label, at: Point = (0.0, 0.0)) -> None:
    """A line of text; signs that the face lacks are strokes."""
    c, s = math.cos(label.angle), math.sin(label.angle)
    for piece in label.block.pieces:
        x = label.at[0] + at[0] + piece.x * c - piece.y * s
        y = label.at[1] + at[1] + piece.x * s + piece.y * c
        if piece.strokes:
            move = Affine2D().scale(piece.height).rotate(label.angle).translate(x, y) + ax.transData
            width = piece.height / 10 * MM
            ax.add_patch(PathPatch(curve(piece.strokes), fill=False, edgecolor=INK, linewidth=width, transform=move, zorder=4))
            continue
        ax.text(
            x, y, piece.text, fontproperties=FontProperties(family=FACE, size=piece.height / CAPITAL * MM), color=INK, ha="left",
            va="baseline", rotation=math.degrees(label.angle), rotation_mode="anchor", parse_math=False, zorder=4,
        )  # fmt: skip


def thin(contour: Contour) -> Stroke:
    """A thin line among the dimensions."""
    return Stroke(contour, Kind.THIN, "DIMENSIONS")
