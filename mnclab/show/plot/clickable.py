"""Moves of a picture that name their line: an invisible drawing over the picture, a stroke for each line of the program.

Where the pointer is over a stroke, or clicked on it, the moves of its line light up in every view and the line stands below;
style sheets alone do that, so that it works wherever HTML is shown, without any script. What has scripts (the Lab extension)
finds the line in `data-line`. A picture of more than `MOST` moves has none: it is no easy target, and costs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from html import escape
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show.plot.strokes import Strokes
from mnclab.text.alarm import quoted

MOST, MANY = 3000, 8000  # moves; points in all views
COARSE = 6  # units between the points of an arc
FINE = 200  # units to an inch: half a pixel on the screen
LETTER = 13.3  # units, the width of one of the line that is named
STYLE = (
    ".mnclab-moves{position:absolute;left:0;top:0;width:100%;height:100%;pointer-events:none}"
    ".mnclab-moves g{outline:none}.mnclab-moves path{fill:none;stroke:#f5a300;stroke-opacity:0;stroke-width:14;"
    "stroke-linecap:round;stroke-linejoin:round;pointer-events:stroke;cursor:pointer}"
    ".mnclab-moves text{visibility:hidden;font:600 22px monospace;fill:#1a1a1a;stroke:#fff;stroke-width:10px;"
    "paint-order:stroke;pointer-events:none}"
    ".mnclab-moves .here path,.mnclab-moves g:focus path,.mnclab-moves g:hover path{stroke-opacity:.6}"
    ".mnclab-moves g:focus text,.mnclab-moves g:hover text{visibility:visible}"
    ".mnclab-moves:hover g:focus:not(:hover) text{visibility:hidden}"
    "@media print{.mnclab-moves{display:none}}"
)

Told = Callable[[int, int], str]  # what is said of a line: its number, and which program
Seen = Sequence[tuple[Axes, Any, Toolpath, Strokes]]  # axes, their view, the path and the strokes that are drawn there


def told_by(run: Any) -> Told:
    """`line 5: N50 G1 X40`, before it the name of a program that was called."""

    def told(line: int, program: int) -> str:
        of = run.programs[program]
        return f"{f'{of.title} ' if program else ''}line {line}: {quoted(of.line_text(line).strip(), width=60)[0]}"

    return told


def over(figure: Any, seen: Seen, told: Told | None) -> str:
    """The drawing over a figure that was just drawn, as SVG; empty where there is nothing to click on."""
    strokes: dict[tuple[int, int], list[str]] = {}
    cut: set[tuple[int, int]] = set()
    count = 0
    for ax, view, path, drawn in seen:
        if int(path.is_motion.sum()) > MOST:
            return ""
        for key, points, cuts in _rows(figure, ax, view, path, drawn):
            if (count := count + len(points)) > MANY:
                return ""
            begin, *rest = points
            known = strokes.setdefault(key, [])
            if not (known and known[-1].endswith(f" {begin}")):
                known.append(f"M{begin} {begin}")  # a dot, if nothing follows
            known[-1] += "".join(f" {each}" for each in rest)
            if cuts:
                cut.add(key)
    if not strokes:
        return ""
    wide, high = (round(FINE * side) for side in figure.get_size_inches())
    most = int((wide - 24) / LETTER)
    parts = []
    for program, line in sorted(strokes, key=lambda key: (key in cut, key)):  # cuts lie over rapids
        said = told(line, program) if told else f"line {line}"
        said = escape(said if len(said) <= most else said[: most - 1] + "…")
        place = f'data-line="{line}"' + (f' data-program="{program}"' if program else "")
        inside = f'<path d="{"".join(strokes[program, line])}"/><text x="12" y="{high - 10}">{said}</text>'
        parts.append(f'<g tabindex="-1" {place}>{inside}</g>')
    box = f'viewBox="0 0 {wide} {high}" preserveAspectRatio="none"'
    return f'<svg class="mnclab-moves" {box} aria-hidden="true"><style>{STYLE}</style>{"".join(parts)}</svg>'


def _rows(figure: Any, ax: Axes, view: Any, path: Toolpath, drawn: Strokes) -> Any:
    """For each move within the axes: (program, line), whole points `x y` from the upper left corner, whether it cuts."""
    scale, high = FINE / figure.dpi, round(FINE * figure.get_figheight())
    at = ax.transData.transform(drawn.xyz[:, [view.right, view.up]]) * scale
    points = np.rint(at).astype(int) * (1, -1) + (0, high)
    (left, bottom), (right, top) = (ax.bbox.get_points() * scale).tolist()
    off = ((points < (left - 2, high - top - 2)) | (points > (right + 2, high - bottom + 2))).any(axis=1)
    begins = np.flatnonzero(np.diff(drawn.row, prepend=-2))
    first, last, row = np.maximum(begins - 1, 0), np.append(begins[1:], len(points)), drawn.row[begins]
    before = np.append(0, off.cumsum())
    seen = (row >= 0) & (before[last] == before[first])  # what is cut off at the border has no place to point at
    first, last, row = first[seen], last[seen], row[seen]
    texts = [f"{x} {y}" for x, y in points.tolist()]
    keys = zip(path.program[row].tolist(), path.line[row].tolist(), strict=True)
    for key, cuts, begin, end in zip(keys, path.kind[row] != Kind.RAPID, first.tolist(), last.tolist(), strict=True):
        way = texts[begin:end]
        if len(way) > 2:
            ways = np.abs(np.diff(points[begin:end], axis=0)).max(axis=1).cumsum() // COARSE
            way = [each for each, far in zip(way, np.r_[True, np.diff(ways, prepend=0)[:-1] > 0, True], strict=True) if far]
        yield key, way, cuts
