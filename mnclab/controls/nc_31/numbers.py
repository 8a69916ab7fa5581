"""The numbers of NC-31 frames: those without one count on from the frame before, and P of G25 names the first and last of
a range."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from mnclab.text.alarm import Alarm
from mnclab.text.dialect import Numbered, Numbers, Reference, unknown
from mnclab.text.program import Program

_FRAME = re.compile(r"[ \t\ufeff]*+(?:N[ \t]*+(\d++)[ \t]*+)?(?=[^;\s])", re.IGNORECASE)
_RANGE = re.compile(r"[PР][ \t]*+(\d++)", re.IGNORECASE)
FIRST, STEP, LAST = 1, 1, 999


def numbers(program: Program) -> Numbers:
    """The numbers of the frames that have one, how many follow each without, and the ranges of G25."""
    blocks: list[Numbered] = []
    places: dict[int, tuple[int, int]] = {}  # number -> the numbered frame that it counts from, and how far
    before, number, counted = 0, -1, 0
    for begin in program.line_starts.tolist():
        frame = _FRAME.match(program.text, begin)
        if frame is None:
            continue
        if frame[1]:
            blocks.append(Numbered(frame.start(1), len(frame[1]), frame[1]))
            number, counted = int(frame[1]), 0
        else:
            number, counted = number + 1, counted + 1
            if blocks:
                blocks[-1] = blocks[-1]._replace(counted=counted)
            else:
                before += 1
        places[number] = (len(blocks) - 1, counted if blocks else number)
    return Numbers(blocks, list(_ranges(program, places)), FIRST, STEP, before)


def _ranges(program: Program, places: dict[int, tuple[int, int]]) -> Iterator[Reference]:
    for block in program:
        words = block.words
        if not (words and words[0].address == "G" and words[0].value == 25.0):
            continue
        given = next((word for word in words if word.address == "P"), None)
        if given is None:
            continue
        at = int(program.line_starts[given.span.line - 1]) + given.span.column - 1
        match = _RANGE.match(program.text, at)
        if match is None:
            continue
        first, last = divmod(int(match[1]), 1000)
        for named in (first, last):
            if named not in places:
                raise unknown("G25 P", named).changed(span=given.span, source=program)
        yield Reference(match.start(1), len(match[1]), (places[first], places[last]), written)


def written(values: Sequence[int]) -> str:
    """First and last frame in one number; an Alarm where it has no room for them."""
    first, last = values
    if max(values) > LAST:
        raise Alarm(f"G25 P would name frame {max(values)}, and names frames up to {LAST}", hint="choose a smaller step")
    return str(1000 * first + last)
