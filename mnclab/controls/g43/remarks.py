"""What stands in no chapter of the manual that there is: it is taken in its ISO meaning.

The table of functions says so of each; by the setting `undescribed` a run says it too, once for each code.
"""

from __future__ import annotations

from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import Words
from mnclab.machine.machine import Machine

ISO = "ISO meaning"


def undescribed(m: Machine, words: Words) -> None:
    """Say once for each code that its chapter is not there, if the setting wants it."""
    if not silent(m, words.code):
        memory(m).undescribed.add(words.code)
        sentence = f"{words.code}: not described in the manual; it is taken in its ISO meaning"
        motion.remark(m, "undescribed", sentence, first_word(words))


def remark(m: Machine, words: Words) -> None:
    """What stands in the example, or changes nothing, needs no remark; nor do M functions."""
    if words.code[0] == "G" and words.code not in ("G17", "G40", "G90"):
        undescribed(m, words)


def silent(m: Machine, *codes: str) -> bool:
    """Whether there is nothing to say of these codes, or no more."""
    return m.settings["undescribed"] == "accept" or memory(m).undescribed.issuperset(codes)
