"""Which words and codes LinuxCNC takes in one block, and which of them it misses: its rules before a block is obeyed."""

from __future__ import annotations

from mnclab.machine.control import Modal
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word, digits

COMPENSATION = ("G41", "G42", "G41.1", "G42.1")
OFFSETS = ("G10", "G28", "G28.1", "G30", "G30.1", "G52", "G53", "G92", "G92.1", "G92.2", "G92.3", "G43", "G43.1", "G49")
SYSTEMS = tuple(f"G{number}" for number in (*range(54, 60), "59.1", "59.2", "59.3"))
CONTROL = ("G61", "G61.1", "G64", "G98", "G99")

#: Words that stand beside one of these codes alone.
BESIDE = {"D": (*COMPENSATION, "G70", "G71", "G96"), "H": ("G43",)}
#: Codes that need one of these words, and what they name.
NEEDS = {
    "G2": ("RIJK", "how the arc is bent"), "G3": ("RIJK", "how the arc is bent"), "G4": ("P", "the time"),
    "G52": ("XYZABC", "how far the origin moves"),
    "M61": ("Q", "the number of the tool"),
}  # fmt: skip
#: Codes whose axis words are no motion: a second code that moves has none left.
OWN = ("G28", "G30")
STRAIGHT = ("G0", "G1")
MOVING = (*STRAIGHT, "G2", "G3", "G38.2", "G38.3", "G38.4", "G38.5")
MOST_FUNCTIONS = 4


def check(modal: Modal, words: list[Word]) -> None:
    """An Alarm where LinuxCNC refuses a block for the words and codes that stand in it, whatever their numbers."""
    codes = {f"{word.address}{digits(word.value)}": word for word in words if type(word.value) is float and word.address in "GM"}
    functions = [word for word in words if word.address == "M"]
    if len(functions) > MOST_FUNCTIONS:
        refuse(f"a block has at most {MOST_FUNCTIONS} M words on LinuxCNC", functions[MOST_FUNCTIONS])
    addresses = {word.address: word for word in words}
    for address, those in BESIDE.items():
        if address in addresses and not codes.keys() & set(those):
            listed = " or ".join(those[:2])
            refuse(f"{address} stands beside {listed} alone", addresses[address], "write it there (LinuxCNC)")
    for code, (needed, what) in NEEDS.items():
        if code in codes and not addresses.keys() & set(needed):
            refuse(f"{code} {' '.join(needed)} ({what}) is missing", codes[code])
    axis = next((addresses[letter] for letter in "XYZ" if letter in addresses), None)
    motion = next((code for code in MOVING if code in codes), "")
    if axis and "G80" in codes and not motion:
        refuse(f"{axis.rounded} stands beside G80, which moves nothing", axis, "write G0 or G1 (LinuxCNC)")
    if "G53" in codes and not (motion in STRAIGHT or not motion and modal.motion in STRAIGHT and axis and not modal.active):
        refuse("G53 needs G0 or G1 in its block", codes["G53"], "or axis words while one of them is active (LinuxCNC)")
    for code in OWN:
        if axis and motion and code in codes:
            refuse(f"{code} and {motion} both take {axis.rounded}", axis, "write two blocks (LinuxCNC)")
    on = next((code for code in COMPENSATION if code in codes), "")
    beside = next((code for code in (*OFFSETS, *SYSTEMS, *CONTROL) if code in codes), "")
    if on and beside:
        refuse(f"{beside} stands beside {on}, which comes first", codes[beside], "write two blocks (LinuxCNC)")


def refuse(sentence: str, word: Word, hint: str = "") -> None:
    raise Alarm(sentence, word.span, hint=hint)
