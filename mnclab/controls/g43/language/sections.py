"""Programs that stand one after another in a file, from one O number to the next, and the numbered blocks of each."""

from __future__ import annotations

import re
from bisect import bisect_right

from mnclab.controls.g43.state import memory
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

_PROGRAM = re.compile(r"O\d+")


def sections(m: Machine) -> list[tuple[int, str]]:
    """The first block and the label of each program of the running file."""
    known = memory(m).sections
    if m.program not in known:
        labels = m.flow.program.labels
        known[m.program] = sorted((block, name) for name, block in labels.items() if _PROGRAM.fullmatch(name))
    return known[m.program]


def here(m: Machine) -> str:
    """The label of the program that runs; empty without O numbers."""
    found = sections(m)
    place = bisect_right(found, (m.flow.current, "~")) - 1
    return found[place][1] if place >= 0 else ""


def block_label(m: Machine, number: float, word: Word) -> str:
    """The label of a numbered block of the running program: the next one below with this number, or else the first one."""
    own = here(m)
    name = f"{own} N{number:.10g}".strip()
    labels = m.flow.program.labels
    if name not in labels:
        where = f" in {own}" if own else ""
        known = [label.rpartition(" ")[2] for label in labels if label.startswith(f"{own} N".lstrip())]
        hint = f"blocks with numbers: {', '.join(known[:8])}" if known else "no block has a number"
        m.alarm(f"there is no block N{number:.10g}{where}", word, hint)
    found, count = [name], 2
    while (again := f"{name} ({count})") in labels:
        found.append(again)
        count += 1
    if len(found) > 1:
        m.warn(f"N{number:.10g} stands {len(found)} times: the next one below counts, or else the first", word)
    return next((label for label in found if labels[label] > m.flow.current), found[0])
