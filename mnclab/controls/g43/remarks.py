"""What stands in no chapter of the manual that there is: it is taken in its ISO meaning, and said once for each code."""

from __future__ import annotations

from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import Words
from mnclab.machine.machine import Machine

ISO = "ISO 6983, not described"


def undescribed(m: Machine, words: Words) -> None:
    """Say once for each code that its chapter is not there."""
    told = memory(m).undescribed
    if words.code not in told:
        told.add(words.code)
        sentence = f"{words.code}: not described in the manual; it is taken in its ISO meaning"
        motion.remark(m, "undescribed", sentence, first_word(words))


def remark(m: Machine, words: Words) -> None:
    """What stands in the example, or changes nothing, needs no remark; nor do M functions."""
    if words.code[0] == "G" and words.code not in ("G17", "G40", "G90"):
        undescribed(m, words)
