"""Lines of a DIN/ISO program into blocks: `N10 G00 X+5 *`.

A block ends with `*` or with its line; `/` before or after the number marks one that may be passed over, `;` begins a
comment, `*` behind the number a structure block. A definition goes on over lines that begin with a parameter
(`Q200=2`) and have no number, and any block over lines that end in `~`. In a formula `*` multiplies: it ends a block
where the line ends behind it, or the next block begins.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from mnclab.controls.tnc_620.reading.lines import bounds
from mnclab.controls.tnc_620.reading.words import FLAGS
from mnclab.text.program import ProgramBuilder

_HEAD = re.compile(r"[ \t]*(/?)[ \t]*(N[ \t]*\d+)?[ \t]*(/?)[ \t]*", FLAGS)
_PIECE = re.compile(r'(?:[^"*]++|"[^"]*+(?:"|$)|\*(?![ \t]*+(?:$|/?[ \t]*+N[ \t]*+\d|%)))*+', FLAGS)
_PARAMETER = re.compile(r"Q[LRS]?[ \t]*\d+[ \t]*=", FLAGS)
_DEFINES = re.compile(r"(?:G[ \t]*[1-9]\d{2,3}|CYCL[ \t]+DEF|GLOBAL[ \t]+DEF|TCH[ \t]+PROBE)(?!\d)", FLAGS)
_PATTERN = re.compile(r"PATTERN[ \t]+DEF(?![A-Z])", FLAGS)


@dataclass
class Raw:
    """A block as it stands in the text: where it begins, its mark, and from where to where its words are."""

    start: int
    skip: bool = False
    parts: list[tuple[int, int]] = field(default_factory=list)


def blocks(builder: ProgramBuilder) -> Iterator[Raw]:
    """The blocks of the text of a builder, in order."""
    text, last, joined = builder.text, None, False
    for line in range(len(builder.line_starts)):
        at, stop, comment, tilde = bounds(builder, line)
        if at == stop and comment >= 0 and last is None:
            yield Raw(comment)
        while at < stop:
            head, piece = _HEAD.match(text, at, stop), None
            assert head is not None
            piece = _PIECE.match(text, head.end(), stop)
            assert piece is not None
            words = head.end(), piece.end()
            if last is not None and (joined or (not head.group(2) and _goes_on(text, last, *words))):
                last.parts.append((at, piece.end()) if joined else words)
            else:
                if last is not None:
                    yield last
                start = at + len(head.group()) - len(head.group().lstrip(" \t"))
                last = Raw(start, bool(head.group(1) or head.group(3)), [words])
            at, joined = piece.end() + 1, False
            if piece.end() < stop:  # behind it stands the * that ends the block
                yield last
                last = None
        joined = last is not None and (tilde or (joined and comment >= 0))
    if last is not None:
        yield last


def _goes_on(text: str, last: Raw, at: int, stop: int) -> bool:
    """Whether an unnumbered line belongs to the definition before it."""
    begin, end = last.parts[0]
    if _PATTERN.match(text, begin, end):
        return True
    return _PARAMETER.match(text, at, stop) is not None and _DEFINES.search(text, begin, end) is not None
