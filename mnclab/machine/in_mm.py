"""Sentences about lengths in a program in inches: a cycle, a pass and a probe know theirs in mm, and say so."""

from __future__ import annotations

import re

KNOWN = re.compile(r"(?<![\d.])[\d.]++ mm\b|\b(?:lines?|rows?|passes|turns|teeth|strokes|T|tool) \d+")  # mm, or no lengths
LOOSE = re.compile(r"(?<![\w.])-?\d++(?:\.\d++)?+(?![\w.]*[A-Za-z])(?! *(?:degrees|°|%))")  # a number that is no part of a name
PLACES = re.compile(r"\b[XYZR]-?\d")
LENGTHS = re.compile(
    r"radi(us|i)\b|diameter|\bwid|\blong|length|deep|depth|thick|narrow|\broom\b|pitch|distance|\bway\b|apart|height|\blevel\b"
    r"|clearance|reach|infeed|stepover|allowance|\bball\b|\bside\b|beside|\bwall|\boff by\b|\bdeviation|\bstock of\b|DEPTH"
)


def in_mm(sentence: str, unit: float, length: bool = False, said: str = "") -> str:
    """A sentence whose lengths are in mm names that where a length of 1 of the program is another number of mm.

    `length`: its numbers are known to be lengths; else it must speak of one. `said`: what follows in the brackets.
    """
    if unit == 1:
        return sentence
    told = KNOWN.sub("", sentence)
    of_length = length or LENGTHS.search(told)
    return f"{sentence} (lengths in mm{said})" if PLACES.search(told) or (of_length and LOOSE.search(told)) else sentence
