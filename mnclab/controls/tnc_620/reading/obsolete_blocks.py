"""The sub-blocks of the cycles 1 to 5 and 17: which value stands where, each behind a word of the dialog.

The words are those of the control's language (`DEPTH`, `TIEFE` …): what a number means follows from its place. A word that
is known and belongs to another place is refused, for then one of the two is wrong.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import partial

from mnclab.controls.tnc_620.reading.dialog import dialog
from mnclab.controls.tnc_620.reading.words import FLAGS, Cursor, Fault, Read

_MILLED = ("SETUP", "DEPTH", "PECKG PECKG:F")
#: By cycle, the addresses of the sub-blocks .1, .2, …; `PECKG:F` is the feed behind the infeed.
PLACES: dict[int, tuple[str, ...]] = {
    1: ("SETUP", "DEPTH", "PECKG", "DWELL", "F"), 2: ("SETUP", "DEPTH", "DWELL", "F"), 3: (*_MILLED, "X", "Y", "F"),
    4: (*_MILLED, "X", "Y", "F DR RADIUS"), 5: (*_MILLED, "RADIUS", "F DR"), 17: ("SETUP", "DEPTH", "PITCH"),
}  # fmt: skip
CODES = frozenset(f"CYCL DEF {cycle}" for cycle in PLACES)

#: What an address means, and its words in English and German programs; the first one is written.
NAMES: dict[str, tuple[str, ...]] = {
    "SETUP": ("set-up clearance", "SET UP", "ABST"), "DEPTH": ("depth", "DEPTH", "TIEFE"),
    "PECKG": ("infeed", "PECKG", "ZUSTLG"), "DWELL": ("dwell in seconds", "DWELL", "V.ZEIT"),
    "PITCH": ("pitch of the thread", "PITCH", "STEIG"), "RADIUS": ("radius", "RADIUS"), "F": ("feed rate", "F"),
    "DR": ("sense of rotation", "DR"),
}  # fmt: skip
_MEANT = {word.replace(" ", ""): address for address, (_, *words) in NAMES.items() for word in words}

_AUTO = re.compile(r"F[ \t]*AUTO(?![A-Z])", FLAGS)
_SENSE = re.compile(r"[ \t]*([+-])(?![ \t]*[\dQ.,])", FLAGS)


def values(cursor: Cursor, addresses: str) -> None:
    """The values of one sub-block, in any order where words tell them apart; those behind the first may be missing."""
    left = addresses.split()
    _value(cursor, left)
    while left and not cursor.done:
        _value(cursor, left)
    begin = cursor.blanks()
    if _MEANT.get(again := dialog(cursor), "-") in addresses:
        raise Fault(f"{again} stands twice", begin, len(again))
    cursor.at = begin


def _value(cursor: Cursor, left: list[str]) -> None:
    """One of the values that are `left`: that of a word that is known, else the next one."""
    begin, kinds = cursor.blanks(), [address.rpartition(":")[2] for address in left]
    if "F" in kinds and cursor.match(_AUTO):
        cursor.add(left.pop(kinds.index("F")), "FAUTO", begin)
        return
    word = dialog(cursor)
    kind = _MEANT.get(word, kinds[0])
    if kind not in kinds or (kind in ("F", "DR") and word not in ("", kind)):
        raise Fault(f"{word} stands where the {NAMES[kinds[0]][0]} belongs", begin, max(1, len(word)))
    address = left.pop(kinds.index(kind))
    if kind == "DR":
        sense = cursor.expect(_SENSE, "DR needs + or -")
        turning = 1.0 if sense.group(1) == "+" else -1.0  # no length, as DR is elsewhere
        cursor.builder.word(address, turning, begin, cursor.at - begin)
        return
    value = cursor.needed(f"a number is missing: the {NAMES[kind][0]}", begin, max(1, cursor.at - begin))
    cursor.add(address, value, begin)


#: The readers of all these sub-blocks; axes have letters.
READERS: dict[str, Read] = {
    f"CYCL DEF {cycle}.{part}": Cursor.words if addresses in ("X", "Y") else partial(values, addresses=addresses)
    for cycle, places in PLACES.items()
    for part, addresses in enumerate(places, 1)
}


def written(cycle: int, title: str, words: Mapping[str, str]) -> Iterator[str]:
    """The lines of a definition, of the values that are there as they are written."""
    yield f"CYCL DEF {cycle}.0 {title}"
    for part, addresses in enumerate(PLACES[cycle], 1):
        there = [(address.rpartition(":")[2], words[address]) for address in addresses.split() if address in words]
        if there:
            yield f"CYCL DEF {cycle}.{part} " + " ".join(NAMES.get(kind, ("", kind))[1] + text for kind, text in there)
