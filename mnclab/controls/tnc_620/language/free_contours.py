"""Free contour programming: FPOL, FL, FLT, FC, FCT, FSELECT (catalogue: FK).

Each block tells what is known of an element; `free_contours.free_contour` finds the contours that fit. The blocks
wait in `machine.pending` until something follows that is no free element: then everything must be settled. RND, CHF,
FPOL, FSELECT and assignments may stand between.

FSELECT counts the readings in the order of that module. The manual does not document its order; with this one the numbers
of its example give its contour. Without FSELECT later data may decide; what is left in the end is decided by the contour
that closes, stays inside the blank and does not cross itself, if there is one alone, with a warning.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, NoReturn

import numpy as np

from mnclab.controls.tnc_620.free_contours import free_contour
from mnclab.controls.tnc_620.free_contours.free_contour import Element, FreeContour, FreePiece, Pair, known, normal_of
from mnclab.controls.tnc_620.free_contours.quadratics import Exhausted, Form
from mnclab.controls.tnc_620.free_contours.readings import Contradiction, TooManyReadings
from mnclab.controls.tnc_620.language.auxiliary import feed
from mnclab.controls.tnc_620.language.motion import SIDED, TOLERANCE, refuse_rapid, sense, side
from mnclab.controls.tnc_620.language.program import body
from mnclab.controls.tnc_620.language.tools import refuse_other
from mnclab.controls.tnc_620.language.values import above_zero, counted, first, not_negative, refuse_on_cylinder
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.flow import ReadUnder, as_of, reading
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()

BOTH = f"X Y PR PA LEN AN P1X P1Y P2X P2Y PDX PDY D CLSD RX RY RPR RPA RAN {SIDED}"
LINE = f"{BOTH} PAR DP"
ARC = f"{BOTH} P3X P3Y R DR CCA CCX CCY CCPR CCPA RCCX RCCY RCCPR RCCPA"
LINES = {"FL": "Free line", "FLT": "Free tangential line"}
MOST_COMPARED = 2000  # elements in all solutions, when those that do not cross themselves are sought


class Earlier(NamedTuple):
    """What later blocks may refer to: the end of an element, the normal where it begins, and n·p of that line."""

    end: Pair
    normal: Pair
    level: Form


class ContourBlock(NamedTuple):
    """A block that waits: its number and code, when it was read, its feed, and the joint after it."""

    number: str
    code: str
    moment: ReadUnder
    feed: float
    joints: list[Any]


class Chain:
    """Free elements in a row, told and not yet moved."""

    def __init__(self, m: Machine) -> None:
        x, y, self.z = m.programmed
        if math.isnan(x) or math.isnan(y):
            m.alarm("a free contour needs a point to begin from", hint="write L X… Y… before it")
        self.start = (x, y)
        self.contour = FreeContour(self.start, _heading(m))
        self.blocks: list[ContourBlock] = []
        self.chosen = False
        self.closed = False

    def mark(self, joint: Any) -> bool:
        if self.blocks[-1].joints:
            return False
        self.blocks[-1].joints.append(joint)
        return True

    def add(self, m: Machine, words: Words, f: float) -> None:
        tangent, arc = words.code in ("FLT", "FCT"), words.code in ("FC", "FCT")
        if tangent and not self.blocks and self.contour.arriving is None:
            m.alarm(f"{words.code} needs a path element in the working plane directly before it")
        number = str(m.flow.program[m.flow.current].number)
        k = self.contour.arc(tangent, words.code) if arc else self.contour.line(tangent, words.code)
        self.blocks.append(ContourBlock(number, words.code, reading(m), f, []))
        describe(self, m, words, k)
        self.follow(m)

    def follow(self, m: Machine, thoroughly: bool = False) -> None:
        """See what fits; an alarm at the datum that does not."""
        try:
            self.contour.follow(thoroughly)
        except Contradiction as error:
            self.refuse(m, error)
        except (TooManyReadings, Exhausted) as error:
            if isinstance(error, Exhausted):
                self.refuse_open(m)
            m.alarm("the free contour has too many solutions to follow", hint="write FSELECT after earlier blocks")

    def refuse(self, m: Machine, error: Contradiction) -> NoReturn:
        label, block = error.label, self.blocks[-1]
        if isinstance(label, Word):
            missed = "" if math.isnan(error.gap) else f", it is missed by {error.gap:.4f} mm"
            m.alarm(f"{block.code} {label} contradicts what is known of the contour{missed}", label)
        m.alarm(f"{block.code} has no solution: the element cannot be joined to what is known of the contour")

    def earlier(self, m: Machine, word: Word) -> Earlier:
        """The element of a block number, told in this contour or an earlier one."""
        number = f"{m.value(word):g}"
        for k in reversed(range(len(self.blocks) - 1)):
            if self.blocks[k].number == number:
                return Earlier(self.contour.end(k), self.contour.normal(k), self.contour.level(k))
        found = memory(m).free_elements
        if number not in found:
            m.alarm(f"{word} must name an earlier block of a free contour, block {number} is none", word)
        return found[number]

    def close(self, m: Machine, word: Word, k: int) -> None:
        """CLSD+ at the first element of a closed contour, CLSD- at its last."""
        if word.value == "+":
            if memory(m).free_start is not None:
                m.alarm("CLSD+ begins a closed contour inside another one", word, hint="end that with CLSD- first")
            memory(m).free_start = self.contour.elements[k].start
        elif word.value != "-":
            m.alarm(f"CLSD must be CLSD+ or CLSD-, got {word}", word)
        elif (start := memory(m).free_start) is None:
            m.alarm("CLSD- ends a closed contour that no CLSD+ began", word)
        else:
            self.contour.same(self.contour.end(k), start, word)
            memory(m).free_start, self.closed = None, True

    def make(self, m: Machine) -> None:
        self.follow(m, thoroughly=True)
        self.refuse_open(m)
        contour = self.contour
        solutions = [contour.pieces(reading) for reading in contour.readings]
        which = 0 if len(solutions) == 1 else self.likely(m, solutions)
        values = contour.readings[which].values
        self.keep(m, values)
        for block, piece in zip(self.blocks, solutions[which], strict=True):
            with as_of(m, block.moment):
                x, y = (round(v, 10) for v in piece.end)  # what was programmed comes out as programmed
                if piece.centre is None:
                    m.line(x, y, f=block.feed)
                else:
                    centre = {0: round(piece.centre[0], 10), 1: round(piece.centre[1], 10)}
                    m.arc(x, y, sense=piece.sense, centre=centre, f=block.feed, tolerance=TOLERANCE)
                for joint in block.joints:
                    m.mark_joint(joint)

    def keep(self, m: Machine, values: np.ndarray[Any, Any]) -> None:
        """What later contours may refer to, in numbers."""
        kept = memory(m)
        for k, block in enumerate(self.blocks):
            element = self.contour.elements[k]
            normal = element.normal
            if normal is None:
                assert element.centre is not None
                normal = (element.centre - element.start).times(1 / element.radius.at(values))
            n, end, start = (_fixed(pair, values) for pair in (normal, element.end, element.start))
            kept.free_elements[block.number] = Earlier(end, n, n.dot(start))
        if kept.free_start is not None:
            kept.free_start = _fixed(kept.free_start, values)

    def refuse_open(self, m: Machine) -> None:
        """The alarm of a contour of which too little is known; nothing if no reading leaves anything open."""
        contour = self.contour
        reading = next((reading for reading in contour.readings if contour.open_unknowns(reading)), None)
        if reading is None:
            return
        open_ = set(contour.open_unknowns(reading))
        parts = [_open_parts(element, open_) for element in contour.elements]
        k = next((k for k, names in enumerate(parts) if names), len(parts) - 1)
        *others, last = parts[k] or ["end point"]
        unknown = f"{', '.join(others)} and {last}" if others else last
        block, missing = self.blocks[k], contour.missing(reading)
        need = "too much of it is open" if missing is None else "no solution was found"
        if missing:
            need = f"{missing} more {'datum is' if missing == 1 else 'data are'} needed"
        what = f"{block.code}: the free contour is not determined, {need}; not known here: {unknown}"
        m.alarm(what, m.flow.span_of_step(block.moment.step))

    def likely(self, m: Machine, solutions: list[list[FreePiece]]) -> int:
        """The one solution that closes, stays inside the blank and does not cross itself; an alarm if it is not alone."""
        blank = body(m)
        left = [k for k, pieces in enumerate(solutions) if free_contour.is_closed(pieces, self.start)]
        left = left or list(range(len(solutions)))
        if blank is not None:
            low, high = blank.bounds[:, :2].tolist()
            left = [k for k in left if free_contour.is_within(solutions[k], low, high)] or left
        if len(left) * len(self.blocks) <= MOST_COMPARED:
            left = [k for k in left if not free_contour.crosses_itself(solutions[k])] or left
        block, count = self.blocks[-1], len(solutions)
        span = m.flow.span_of_step(block.moment.step)
        if len(left) > 1:
            hint = f"choose one with FSELECT 1 to FSELECT {count}"
            m.alarm(f"{block.code}: the free contour has {count} solutions here", span, hint)
        what = f"{block.code}: of {count} solutions the one is taken that fits the blank and closes best"
        m.warn(what, span, f"FSELECT {left[0] + 1} says so")
        return left[0]


def _open_parts(element: Element, unknowns: set[int]) -> list[str]:
    """What of an element is not known."""
    named = (
        ("direction", element.normal and element.normal.x), ("place", element.offset),
        ("centre", element.centre and element.centre.x), ("radius", element.radius),
        ("end point", element.end.x), ("end point", element.end.y),
    )  # fmt: skip
    return list(dict.fromkeys(name for name, form in named if form is not None and form.variables & unknowns))


def _fixed(pair: Pair, values: np.ndarray[Any, Any]) -> Pair:
    """A point whose unknowns are settled, as numbers."""
    return known(pair.x.at(values), pair.y.at(values))


def _heading(m: Machine) -> float | None:
    """The direction (rad, in program coordinates) in which the last move arrived; None where there is none in the plane."""
    travel = m.heading()
    if travel is None:
        return None
    ahead = m.to_program(t + d for t, d in zip(m.tip, travel, strict=True))
    x, y, z = (a - b for a, b in zip(ahead, m.to_program(m.tip), strict=True))
    return math.atan2(y, x) if abs(z) < 1e-9 and math.hypot(x, y) > 1e-9 else None


@FUNCTIONS("FC FCT", {"FC": "Free arc", "FCT": "Free tangential arc"}, takes=ARC, collects=True, source="8.13, example")
@FUNCTIONS("FL FLT", LINES, takes=LINE, collects=True, source="8.13, example")
def free_element(m: Machine, words: Words) -> None:
    """A line or an arc told by what is known of it; FLT and FCT join the element before tangentially."""
    refuse_on_cylinder(m, words)
    refuse_other(m, words.code)
    own = feed(m, words)
    if words.code in ("FC", "FCT"):
        refuse_rapid(m, words)
    side(m, words, begins=words.code in ("FL", "FLT"))
    f = m.feed_of(own)
    if not isinstance(m.pending, Chain):
        m.pending = Chain(m)
    m.pending.add(m, words, f)


@FUNCTIONS("FPOL", "Pole of free contours", takes="X Y", collects=True, source="8.13, example")
def free_pole(m: Machine, words: Words) -> None:
    """The pole of polar data of free elements, until the next one; no motion."""
    refuse_other(m, "FPOL")
    for axis in "XY":
        if axis not in words:
            m.alarm(f"FPOL needs {axis}, the coordinate of the pole", first(words))
        if words[axis].incremental and m.pending:
            m.alarm(f"FPOL {axis} (pole) must be absolute inside a free contour", words[axis])
    x, y = (counted(m, words[axis], at) for axis, at in zip("XY", m.programmed, strict=False))
    memory(m).free_pole = (x, y)
    m.log("free pole", (x, y))


@FUNCTIONS("FSELECT", "Choice of a free contour", takes="number", collects=True, source="8.13, example")
def select(m: Machine, words: Words) -> None:
    """Go on with one of the solutions of the free elements so far."""
    if not isinstance(m.pending, Chain):
        m.alarm("FSELECT must follow a block of a free contour", first(words))
    if "number" not in words:
        m.alarm("FSELECT needs the number of a solution")
    word, contour = words["number"], m.pending.contour
    number, count = m.value(word), len(contour.readings)
    if number != int(number) or not 1 <= number <= count:
        m.alarm(f"FSELECT must be the number of a solution, 1 to {count} here, got {number:g}", word)
    contour.readings = [contour.readings[int(number) - 1]]


# What the words of free elements say: each is an equation of the contour (catalogue: FK).
# I before a word counts from the start of the element, or with RX, RY, RPR, RPA, RAN, RCCX, … from an earlier block, whose
# number that word gives. Polar data count from FPOL.

MEANINGS = {"LEN": "length", "R": "radius", "CCA": "central angle", "D": "distance", "DP": "distance of parallels"}

COUNTED = ("X", "Y", "PR", "PA", "AN", "CCX", "CCY", "CCPR", "CCPA")
#: What stands in the words of free contours, for explanations; an address with R before it is the block that it counts from.
WORDS = {
    "AN": "angle of the line, or of the tangent where the arc begins", "CCX": "centre along X", "CCY": "centre along Y",
    "CCPR": "polar radius of the centre", "CCPA": "polar angle of the centre", "PAR": "block of the parallel line",
    "PDX": "point beside the element, X", "PDY": "point beside the element, Y", "CLSD": "beginning or end of a closed contour",
    "D": "distance from the point beside the element", "DP": MEANINGS["DP"],
    **{f"P{n}{axis}": f"point {n} on the element, {axis}" for n in (1, 2, 3) for axis in "XY"},
    **{f"R{address}": f"block that {address} counts from" for address in COUNTED},
}  # fmt: skip


def describe(chain: Chain, m: Machine, words: Words, k: int) -> None:
    contour = chain.contour
    place(chain, m, words, contour.end(k), "", k)
    angle(chain, m, words, k)
    if "LEN" in words:
        contour.length(k, positive(m, words, "LEN"), words["LEN"])
    for name in ("P1", "P2", "P3"):
        if point := pair(chain, m, words, name + "X", name + "Y", k):
            contour.through(k, point, words[name + "X"])
    beside(chain, m, words, k)
    if words.code in ("FC", "FCT"):
        of_arc(chain, m, words, k)
    elif "PAR" in words:
        other = chain.earlier(m, words["PAR"])
        distance = abs(m.value(words["DP"])) if "DP" in words else None
        contour.parallel(k, other.normal, other.level, distance, words["PAR"])
    elif "DP" in words:
        m.alarm("DP (distance of parallels) needs PAR, the block of the parallel line", words["DP"])
    if "CLSD" in words:
        chain.close(m, words["CLSD"], k)


def of_arc(chain: Chain, m: Machine, words: Words, k: int) -> None:
    contour, sign = chain.contour, 0
    if "DR" in words:
        sign = sense(m, words)
        contour.sense(k, sign, words["DR"])
    if "R" in words:
        contour.radius(k, positive(m, words, "R"), sign, words["R"])
    centre = contour.elements[k].centre
    assert centre is not None
    place(chain, m, words, centre, "CC", k)
    if "CCA" in words:
        if not sign:
            m.alarm(f"{words.code} CCA (central angle) needs the sense of rotation", words["CCA"], "write DR+ or DR-")
        value = positive(m, words, "CCA")
        if value > 360:
            m.alarm(f"{words.code} CCA (central angle) must be at most 360, got {value:g}", words["CCA"])
        contour.central_angle(k, math.radians(value), sign, words["CCA"])


def positive(m: Machine, words: Words, address: str) -> float:
    return above_zero(m, absolute(m, words, address), f"{words.code} {address} ({MEANINGS[address]})")


def absolute(m: Machine, words: Words, address: str) -> Word:
    """A word that cannot be incremental."""
    word = words[address]
    if word.incremental:
        m.alarm(f"{words.code} {address} cannot be incremental", word)
    return word


def place(chain: Chain, m: Machine, words: Words, point: Pair, kind: str, k: int) -> None:
    """Coordinates of the end point, or (`kind` CC) of the centre: X Y PR PA, counted from a block with R…."""
    contour = chain.contour
    for i, axis in enumerate("XY"):
        begin = reference(chain, m, words, kind + axis, k)
        if (word := words.get(kind + axis)) is not None:
            away = point[i] - begin[i] if word.incremental else point[i]
            contour.equal(away - m.value(word), word)
    polar(chain, m, words, point, kind, k)


def reference(chain: Chain, m: Machine, words: Words, address: str, k: int) -> Pair:
    """What an incremental word counts from: the end of the block that R… names, or the start of the element."""
    if "R" + address not in words:
        return chain.contour.elements[k].start
    word = words["R" + address]
    if address not in words or not words[address].incremental:
        m.alarm(f"{word} needs I{address}, which counts from that block", word)
    return chain.earlier(m, word).end


def polar(chain: Chain, m: Machine, words: Words, point: Pair, kind: str, k: int) -> None:
    """PR PA or CCPR CCPA from the pole of FPOL."""
    far, turn = words.get(kind + "PR"), words.get(kind + "PA")
    begins = {name: reference(chain, m, words, kind + name, k) for name in ("PR", "PA")}
    first = far or turn
    if first is None:
        return
    pole = memory(m).free_pole
    if pole is None:
        m.alarm(f"{words.code} {first.address} needs a pole", first, hint="write FPOL X… Y… before it")
    contour, away = chain.contour, point - known(*pole)
    spot = 2 * k + (2 if kind == "" else 1)
    distance: Form | None = None
    if far is not None:
        if far.incremental:
            distance = radius_of(contour, begins["PR"] - known(*pole), spot, far) + m.value(far)
        else:
            distance = Form(not_negative(m, far, f"{words.code} {far.address} (polar radius)"))
    if turn is None:
        assert distance is not None
        contour.equal(away.dot(away) - distance * distance, far)
        contour.positive(distance + 1e-5, far)
        return
    bearing = math.radians(m.value(turn))
    if turn.incremental:
        from_ = begins["PA"] - known(*pole)
        arm = contour.unknown_pair(spot, 0)
        contour.same(arm.times(radius_of(contour, from_, spot, turn)), from_, turn)
        direction = arm.turned(bearing)
    else:
        direction = known(math.cos(bearing), math.sin(bearing))
    if distance is None:
        distance = contour.unknown(spot)
        contour.positive(distance + 1e-5, turn)
    contour.same(away, direction.times(distance), turn if far is None else far)


def radius_of(contour: FreeContour, away: Pair, spot: float, word: Word) -> Form:
    """The distance of a point from the pole, as an unknown."""
    distance = contour.unknown(spot)
    contour.equal(away.dot(away) - distance * distance, word)
    contour.positive(distance, word)
    return distance


def angle(chain: Chain, m: Machine, words: Words, k: int) -> None:
    """AN: the direction of a line, or where an arc begins; IAN counts from the direction before, or from that of RAN."""
    if "RAN" in words and ("AN" not in words or not words["AN"].incremental):
        m.alarm(f"{words['RAN']} needs IAN, which counts from that block", words["RAN"])
    if "AN" not in words:
        return
    word, contour = words["AN"], chain.contour
    value = math.radians(m.value(word))
    if not word.incremental:
        contour.direction(k, normal_of(value), word)
        return
    if "RAN" in words:
        before: Pair | None = chain.earlier(m, words["RAN"]).normal
    else:
        before = contour.normal(k - 1, at_end=True) if k else contour.arriving
    if before is None:
        m.alarm(f"{words.code} IAN needs a path element in the working plane directly before it", word)
    contour.direction(k, before.turned(value), word)


def pair(chain: Chain, m: Machine, words: Words, x: str, y: str, k: int) -> Pair | None:
    """A point of two coordinates; I counts from the start of the element."""
    if x not in words and y not in words:
        return None
    for one, other in ((x, y), (y, x)):
        if other not in words:
            m.alarm(f"{words.code} {one} needs {other} beside it", words[one])
    start = chain.contour.elements[k].start
    return Pair(counted_from(m, words[x], start.x), counted_from(m, words[y], start.y))


def counted_from(m: Machine, word: Word, start: Form) -> Form:
    value = m.value(word)
    return start + value if word.incremental else Form(value)


def beside(chain: Chain, m: Machine, words: Words, k: int) -> None:
    """PDX PDY D: the element passes a point at a distance."""
    point = pair(chain, m, words, "PDX", "PDY", k)
    if point is None:
        if "D" in words:
            m.alarm(f"{words.code} D (distance) needs PDX and PDY, the point beside the element", words["D"])
        return
    if "D" not in words:
        m.alarm(f"{words.code} PDX PDY need D, the distance of the element from that point", words["PDX"])
    value = not_negative(m, absolute(m, words, "D"), f"{words.code} D (distance)")
    chain.contour.beside(k, point, value, words["D"])
