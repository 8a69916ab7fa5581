"""Blocks of motion in a DIN/ISO program: the path function that is written or modal, the pole, speed and feed beside it.

A block may hold what conversational programs write in several: `S1000` becomes a TOOL CALL, `I+10 J+5` a CC, the rest a
block of motion. G00 with F: the feed counts for the blocks after it, so it stands in a block of its own before.

G26 R after the first contour point makes an approach of the block before it, and G27 R a departure of the one behind it.
How these arcs lie the manuals do not tell exactly: read is a line that touches an arc with the radius R, which touches
the contour at its point (APPR LCT, DEP LCT), the only way whose one number is R and which ends at both points.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from mnclab.controls.tnc_620.reading.din_words import MIXED, PATHS, Given, Modes, put, unmixed
from mnclab.controls.tnc_620.reading.words import Cursor, Fault
from mnclab.text.program import NO_MEANING

SIDES = {40: "R0", 41: "RL", 42: "RR"}
POLE = {"I": "X", "J": "Y", "K": "Z"}
AXES = frozenset("XYZUVWABC")
TURNS = {2: "-", 12: "-", 3: "+", 13: "+", 5: "", 15: ""}
PLANES = {17: "Z", 18: "Y", 19: "X"}  # and their tool axes
RAPID, POLAR = (0, 10), (10, 11, 12, 13, 15, 16)
KEYWORDS = {0: "L", 1: "L", 6: "CT", 7: "L", 10: "LP", 11: "LP", 12: "CP", 13: "CP", 15: "CP", 16: "CTP"}
PARAXIAL = "G43 and G44, radius compensation of single axes, are not built yet"


class Departure(NamedTuple):
    """G27 with its radius, which the next block needs: the two become one, that begins where G27 does."""

    start: int
    skip: bool
    head: Given
    radius: Given

    def fault(self, more: str = "") -> Fault:
        """The fault where the next block is another one."""
        return Fault(f"G27 needs a straight line with G40 after it{more}", self.head.at, self.head.length)


class Motion:
    """One block of words; `write` makes the blocks of the language."""

    def __init__(self, cursor: Cursor, start: int, skip: bool, modes: Modes, axis: str, leaves: Departure | None) -> None:
        self.cursor, self.start, self.skip, self.modes, self.leaves = cursor, start, skip, modes, leaves
        self.axis = axis  # of the tool, as the last T block has it
        self.codes: list[Given] = []
        self.begun = False

    def write(self, words: Sequence[Given]) -> None:
        """The blocks of the language, in the order in which they count."""
        self.codes = [word for word in words if word.letter == "G"]
        given = [word for word in words if word.letter != "G"]
        path, side = self.one_of(PATHS, "path function"), self.one_of(SIDES, "radius compensation")
        if paraxial := next((code for code in self.codes if code.code in (43, 44)), None):
            raise Fault(PARAXIAL, paraxial.at, paraxial.length)
        self.check_plane()
        auxiliary = [word for word in given if word.letter[0] == "M"]
        pole = [word for word in given if word.letter in POLE]
        speed = [word for word in given if word.letter == "S"]
        rest = [word for word in given if word.letter[0] != "M" and word not in pole and word not in speed]
        if speed:
            self.begin("TOOL CALL", speed)
            for word in speed:
                put(self.cursor, "S", word)
        if pole:
            unmixed(self.cursor.builder, pole)
            self.begin("CC", pole)
            for word in pole:
                put(self.cursor, POLE[word.letter], word)
        if rest or path or side:
            self.motion(path, side, rest, auxiliary)
        elif auxiliary or not self.begun:
            self.begin("", auxiliary)
            self.put_all(auxiliary)

    def begin(self, keyword: str, words: Sequence[Given], plain: bool = False) -> None:
        """A block of the language; the first one begins where the text block does, others at their first word."""
        start = self.start
        if self.begun:
            builder = self.cursor.builder
            start = max(builder.blocks[-1][0] + 1, min(word.at for word in words))
        self.begun = True
        self.cursor.builder.block(start, keyword, self.skip, plain)

    def put_all(self, words: Sequence[Given]) -> None:
        for word in words:
            put(self.cursor, word.letter, word)

    def one_of(self, group: object, name: str) -> Given | None:
        found = [code for code in self.codes if code.code in group]  # type: ignore[operator]
        if len(found) > 1:
            what = f"G{found[0].code:02} and G{found[1].code:02} stand in one block: one {name} is allowed"
            raise Fault(what, found[1].at, found[1].length)
        return found[0] if found else None

    def check_plane(self) -> None:
        """G17 to G20 stand in T and G30; elsewhere they may only repeat the plane of the last T block."""
        for word in self.codes:
            if word.code in (17, 18, 19, 20) and PLANES.get(word.code) != self.axis:
                hint = "the plane is chosen in the T block: T5 G17 S1000"
                raise word.fault(self.cursor.builder, f"is not the plane of the tool axis {self.axis}", hint)

    def motion(self, path: Given | None, side: Given | None, rest: list[Given], auxiliary: list[Given]) -> None:
        """L, C, CR, CT, LP, CP, CTP with their words."""
        builder = self.cursor.builder
        code = path.code if path else self.modes.path
        first = next((word for word in rest if word.letter in AXES or word.letter in "RH"), None)
        unmixed(builder, (word for word in rest if word.letter in AXES or (word.letter in "RH" and code in POLAR)))
        if first is None:
            if path and path.code not in (*RAPID, 1, 7, 11):
                raise path.fault(builder, "needs the end of its path")
            code = 1 if code not in RAPID else 0
        if code == MIXED:
            assert first is not None
            why = "has no certain path function: the ways that lead to this block bring different ones"
            raise first.fault(builder, why, "write G00, G01 … in this block")
        if code is None:
            assert first is not None
            raise first.fault(builder, "needs a path function before it", "for example G00 or G01")
        if code not in POLAR and code not in (2, 3, 5) and first is not None:
            self.refuse_polar(rest)
        if self.leaves:
            self.depart(self.leaves, code, path, side, rest, auxiliary)
            return
        if code in RAPID:
            feed = [word for word in rest if word.letter[0] == "F" and word.letter != "FMAX"]
            rest = [word for word in rest if word.letter[0] != "F"]
            if feed:
                self.begin("L", feed)
                self.put_all(feed)
            if not (path or side or rest):
                if auxiliary or not self.begun:
                    self.begin("", auxiliary)
                    self.put_all(auxiliary)
                return
        words = [*([path] if path else []), *([side] if side else []), *rest, *auxiliary]
        if code == 7 and sum(word.letter in AXES for word in rest) > 1:
            assert path is not None or first is not None
            raise (path or first).fault(builder, "moves one axis alone")  # type: ignore[union-attr]
        keyword = KEYWORDS.get(code) or ("CR" if any(word.letter == "R" for word in rest) else "C")
        self.begin(keyword, words, keyword == "L" and not auxiliary and code not in RAPID and _is_plain(rest, side))
        if side:
            put(self.cursor, SIDES[side.code], side, None)
        renamed = {"R": "PR", "H": "PA"} if code in POLAR else {}
        for word in rest:
            if word.letter == "R" and code not in POLAR:
                word = word._replace(incremental=0)
            put(self.cursor, renamed.get(word.letter, word.letter), word)
        if code in TURNS:
            self.put_sense(code, path, rest)
        if code in RAPID:
            put(self.cursor, "FMAX", path or words[0], None)
        self.put_all(auxiliary)

    def refuse_polar(self, rest: Sequence[Given]) -> None:
        """R and H beside a path function that takes none."""
        if polar := next((word for word in rest if word.letter in ("R", "H")), None):
            hint = "straight lines to polar points are G10 and G11, arcs G12, G13, G15 and G16"
            raise polar.fault(self.cursor.builder, NO_MEANING, hint)

    def put_sense(self, code: int, path: Given | None, rest: Sequence[Given]) -> None:
        """DR of an arc: that of its function, with G05 and G15 the last one."""
        head, sense = path or rest[0], TURNS[code]
        if not sense:
            if self.modes.sense in (0, MIXED):
                why = "none was programmed" if not self.modes.sense else "the ways that lead to this block bring both"
                what = f"G{code:02} needs the sense of rotation of an arc before it: {why}"
                raise Fault(what, head.at, head.length, "write G02 or G03, or G12 or G13")
            sense = "+" if self.modes.sense > 0 else "-"
        if not path and not any(word.letter in "XYRH" for word in rest):
            raise head.fault(self.cursor.builder, f"alone is no end of an arc (G{code:02} is active)", "write G00 or G01")
        put(self.cursor, "DR", head, sense)

    def depart(
        self, leaves: Departure, code: int, path: Given | None, side: Given | None, rest: Sequence[Given],
        auxiliary: Sequence[Given],
    ) -> None:  # fmt: skip
        """The block behind G27: DEP LCT to its end; the compensation ends there."""
        if code not in (0, 1) or side is None or side.code != 40 or self.begun:
            raise leaves.fault(", to the end of the departure")
        if self.skip != leaves.skip:
            raise leaves.fault(": both or none are marked with /")
        self.start = leaves.start
        self.begin("DEP LCT", [leaves.radius])
        put(self.cursor, "R", leaves.radius._replace(incremental=0))
        self.put_all(rest)
        if code == 0:
            put(self.cursor, "G00", path or rest[0], None)
        self.put_all(auxiliary)


def _is_plain(rest: Sequence[Given], side: Given | None) -> bool:
    """Whether a straight line can be obeyed together with others like it."""
    letters = [word.letter for word in rest]
    plain = all(word.letter in "XYZF" and type(word.value) is float and not word.incremental for word in rest)
    return bool(rest) and plain and len(set(letters)) == len(letters) and (side is None or side.code == 40)


def approach(cursor: Cursor, head: Given, radius: Given) -> None:
    """G26 R: the straight line before it, which begins the compensation, becomes an approach."""
    builder = cursor.builder
    names, keywords = list(builder.addresses), list(builder.keywords)
    offset, keyword, skip, _, first = builder.blocks[-1] if builder.blocks else (0, 0, False, False, 0)
    given = {names[word[0]] for word in builder.block_words} if builder.blocks else set()
    if keywords[keyword] != "L" or not given & {"RL", "RR"}:
        what = "G26 needs a straight line with G41 or G42 directly before it, to the first contour point"
        raise Fault(what, head.at, head.length)
    key = builder.keywords.setdefault("APPR LCT", len(builder.keywords))
    builder.blocks[-1] = (offset, key, skip, False, first)
    put(cursor, "R", radius._replace(incremental=0))
