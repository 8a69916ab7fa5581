"""The numbers of blocks of ISO mills, and what names them: GOTO of the same program, P of M99 in the one that called."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator

from mnclab.controls.word_address.numbers import numbered
from mnclab.text.alarm import Alarm
from mnclab.text.dialect import Numbered, Numbers, Reference, code_of, one_number, unknown
from mnclab.text.program import Program

_GOTO = re.compile(r"(?<![A-Z])GOTO[ \t]*+(?:(\d++)(?![.\d])|(?=(\S)))", re.IGNORECASE)
_M99 = re.compile(r"(?<![A-Z])M[ \t]*+0*+99(?![\d.])", re.IGNORECASE)
_P = re.compile(r"(?<![A-Z])P[ \t]*+(?:(\d++)(?![\d.])|(?=(\S)))", re.IGNORECASE)
_PROGRAM = re.compile(r"[ \t\ufeff]*+(?:O|:)[ \t]*+\d", re.IGNORECASE)


def numbers(program: Program) -> Numbers:
    """The numbers, and every word that jumps to one; an Alarm where a jump computes its target or has none."""
    blocks = numbered(program)
    return Numbers(blocks, list(_references(program, blocks)))


def _references(program: Program, blocks: list[Numbered]) -> Iterator[Reference]:
    code, starts = code_of(program.text), program.line_starts.tolist()
    begun = [at for at in starts if _PROGRAM.match(code, at)]  # the programs of O numbers
    places: dict[tuple[int, int], list[int]] = {}  # program, number -> the blocks that have it
    for index, block in enumerate(blocks):
        places.setdefault((bisect_right(begun, block.offset), int(block.old)), []).append(index)
    for jump in _GOTO.finditer(code):
        own = bisect_right(begun, jump.start())
        found = places.get((own, _target(program, jump, "GOTO")), [])
        below = [k for k in found if blocks[k].offset > jump.start()]
        yield _reference(program, jump, "GOTO", (below or found)[:1])
    for begin, end in zip(starts, [*starts[1:], len(code)], strict=True):
        back = _P.search(code, begin, end) if _M99.search(code, begin, end) else None
        if back is None:
            continue
        number, own = _target(program, back, "M99 P"), bisect_right(begun, begin)
        callers = [own] if own <= 1 else [k for k in range(len(begun) + 1) if k != own]
        yield _reference(program, back, "M99 P", [index for k in callers for index in places.get((k, number), [])])


def _target(program: Program, jump: re.Match[str], what: str) -> int:
    if jump[1] is None:
        span = program.span(jump.start(), len(jump[0].rstrip()))
        raise Alarm(f"{what} computes the block that it goes to, so its number cannot follow", span, source=program)
    return int(jump[1])


def _reference(program: Program, jump: re.Match[str], what: str, found: list[int]) -> Reference:
    """A reference to the only block that is meant."""
    span = program.span(jump.start(1), len(jump[1]))
    if not found:
        raise unknown(what, jump[1]).changed(span=span, source=program)
    if len(found) > 1:
        raise Alarm(f"{what} {jump[1]} may name {len(found)} blocks: give them different numbers first", span, source=program)
    return Reference(jump.start(1), len(jump[1]), ((found[0], 0),), one_number)
