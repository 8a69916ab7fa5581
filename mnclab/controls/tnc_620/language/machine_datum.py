"""Positions that count from the machine (M91, M92), and rotary axes within one turn (M94)."""

from __future__ import annotations

import math
from typing import Any

from mnclab.controls.tnc_620.state import Place, memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import tool_axis
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
TITLES = {"M91": "Machine coordinates", "M92": "Coordinates from a position of the machine tool builder"}


@FUNCTIONS("M91 M92", TITLES, group="machine datum", phase="start", modal=False, source="11.9")
def machine_datum(m: Machine, words: Words) -> None:
    """Positions of the block count from the machine datum or from the position of the settings, without tool length."""
    word, program = words.words[0], m.flow.program
    if program.keywords[program.keyword[m.flow.current]] != "L":
        m.alarm(f"{words.code} stands in a straight line L alone", word)
    if m.side:
        m.alarm(f"{words.code} cannot stand under radius compensation", word, "write R0 in the block before")
    x, y, z = (m.settings[f"m92_{axis}"] if words.code == "M92" else 0.0 for axis in "xyz")
    memory(m).machine_datum = word, (x, y, z)
    m.at_block_end(lambda: setattr(memory(m), "machine_datum", None))


def above_tip(m: Machine) -> Place:
    """From the tip to where X, Y and Z of the machine stand: the length of the tool, less what U, V and W carry."""
    u, v, w = memory(m).secondary
    above = [0.0 - u, 0.0 - v, 0.0 - w]
    above[tool_axis(m)] += m.tool.effective_length
    return above[0], above[1], above[2]


def machine_target(m: Machine, active: tuple[Word, Place], written: dict[int, Word]) -> dict[str, Any]:
    """The point of the program that the words of these axes mean under M91 or M92 (`active`)."""
    (word, datum), target, above = active, list(m.tip), above_tip(m)
    for axis, coordinate in written.items():
        value = m.value(coordinate)
        target[axis] = target[axis] + value if coordinate.incremental else datum[axis] + value - above[axis]
    if m.side:
        m.alarm(f"{word} cannot begin radius compensation", word, "write RL or RR in the block after")
    point = m.to_program(target)
    return {"xyz"[axis]: point[axis] for axis in (written if m.shift is not None else range(3))}


@FUNCTIONS("M94", "Rotary axes within one turn", takes="M94:A M94:B M94:C", phase="start", modal=False, source="11.9")
def within_one_turn(m: Machine, words: Words) -> None:
    """The named rotary axes, or all, show an angle from 0 to less than 360 degrees; nothing moves."""
    named = [word for word in words.words if word.address.startswith("M94:")]
    for word in named:
        if word.value is not None:
            m.alarm(f"M94 names an axis without a number, got {word.address[4:]}{m.value(word):g}", word)
    axes = "".join(word.address[4:] for word in named) or "ABC"
    m.change("rotary", tuple(a % math.tau if axis in axes else a for axis, a in zip("ABC", m.rotary, strict=True)))
