"""What features are called that a program makes: by the cycle and the line, threads by their designation."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np

from mnclab.design.model.threads import COARSE
from mnclab.design.recognition.outlines import number
from mnclab.workpiece.cutting import Cutting

CYCLE = re.compile(r"(CYCL DEF \d+|[A-Z]{1,3}\d+)\b")


def names(cutting: Cutting, rows: Sequence[int]) -> Iterator[str]:
    """The cycle, if it is one, and the line of each of some rows, numbered where one made several features."""
    path, said = cutting.path, list[str]()
    for row in rows:
        line, program = int(path.line[row]), int(path.program[row])
        place = f"line {line}" if program == 0 else cutting.name(line, program)
        cycle = CYCLE.match(path.labels[path.label[row]])
        said.append(f"{cycle[1]}, {place}" if cycle else place)
    times, count = Counter(said), Counter[str]()
    for name in said:
        count[name] += 1
        yield f"{name} ({count[name]})" if times[name] > 1 else name


def lines(cutting: Cutting, rows: Sequence[int]) -> str:
    """The first lines of some rows, in words."""
    those = np.zeros(len(cutting), dtype=bool)
    those[list(rows)] = True
    return cutting.lines(those)


def designation(diameter: float, pitch: float) -> str:
    """M8 where the pitch is the coarse one, or is not known and there is a coarse one; else M8x1; nothing if no thread is."""
    wide, pitch = number(round(diameter, 6)), round(pitch, 6)
    if not 0 < pitch < wide:
        return f"M{wide:g}" if wide in COARSE and not pitch else ""
    return f"M{wide:g}" if COARSE.get(wide) == pitch else f"M{wide:g}x{pitch:g}"
