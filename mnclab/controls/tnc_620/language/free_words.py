"""What the words of free elements say: each is an equation of the contour (catalogue: FK).

I before a word counts from the start of the element, or with RX, RY, RPR, RPA, RAN, RCCX, … from an earlier block, whose
number that word gives. Polar data count from FPOL.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.free_contour import FreeContour, Pair, known, normal_of
from mnclab.geometry.quadratic_form import Form
from mnclab.machine.control import Words
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

if TYPE_CHECKING:
    from mnclab.controls.tnc_620.language.free_contours import Chain

MEANINGS = {"LEN": "length", "R": "radius", "CCA": "central angle", "D": "distance", "DP": "distance of parallels"}

#: What stands in the words of free contours, for explanations; an address with R before it is the block that it counts from.
KNOWN = {
    "AN": "angle of the line, or of the tangent where the arc begins", "CCX": "centre along X", "CCY": "centre along Y",
    "CCPR": "polar radius of the centre", "CCPA": "polar angle of the centre", "PAR": "block of the parallel line",
    "PDX": "point beside the element, X", "PDY": "point beside the element, Y", "CLSD": "beginning or end of a closed contour",
    **{f"P{n}{axis}": f"point {n} on the element, {axis}" for n in (1, 2, 3) for axis in "XY"},
}  # fmt: skip
COUNTED = ("X", "Y", "PR", "PA", "AN", "CCX", "CCY", "CCPR", "CCPA")
WORDS = (
    KNOWN
    | {f"R{address}": f"block that {address} counts from" for address in COUNTED}
    | {"D": "distance from the point beside the element", "DP": MEANINGS["DP"]}
)


def describe(chain: Chain, m: Machine, words: Words, k: int) -> None:
    """Every word of the block of element k."""
    contour, arc = chain.contour, words.code in ("FC", "FCT")
    place(chain, m, words, contour.end(k), "", k)
    angle(chain, m, words, k)
    if "LEN" in words:
        contour.length(k, positive(m, words, "LEN"), words["LEN"])
    for name in ("P1", "P2", "P3"):
        if point := pair(chain, m, words, name + "X", name + "Y", k):
            contour.through(k, point, words[name + "X"])
    beside(chain, m, words, k)
    if arc:
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
    """Sense, radius, centre and central angle."""
    contour, sign = chain.contour, 0
    if "DR" in words:
        word = words["DR"]
        if word.value not in ("+", "-"):
            m.alarm(f"{words.code} DR (sense of rotation) must be DR+ or DR-, got {word}", word)
        sign = 1 if word.value == "+" else -1
        contour.sense(k, sign, word)
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
    """A number above zero that cannot be incremental."""
    word = words[address]
    value = absolute(m, words, word)
    if value <= 0:
        m.alarm(f"{words.code} {address} ({MEANINGS[address]}) must be greater than 0, got {value:g}", word)
    return value


def absolute(m: Machine, words: Words, word: Word) -> float:
    """The number of a word that cannot be incremental."""
    if word.incremental:
        m.alarm(f"{words.code} {word.address} cannot be incremental", word)
    return m.value(word)


def place(chain: Chain, m: Machine, words: Words, point: Pair, kind: str, k: int) -> None:
    """Coordinates of the end point, or (`kind` CC) of the centre: X Y PR PA, counted from a block with R…."""
    contour = chain.contour
    for axis in "XY":
        begin = reference(chain, m, words, kind + axis, k)
        if kind + axis in words:
            word = words[kind + axis]
            of, from_ = (point.x, begin.x) if axis == "X" else (point.y, begin.y)
            value = m.value(word)
            contour.equal(of - from_ - value if word.incremental else of - value, word)
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
        value = m.value(far)
        if far.incremental:
            distance = radius_of(contour, begins["PR"] - known(*pole), spot, far) + value
        elif value < 0:
            m.alarm(f"{words.code} {far.address} (polar radius) must be at least 0, got {value:g}", far)
        else:
            distance = Form(value)
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
    given = [words[address] for address in (x, y) if address in words]
    if not given:
        return None
    if len(given) == 1:
        m.alarm(f"{words.code} {given[0].address} needs {y if given[0].address == x else x} beside it", given[0])
    start = chain.contour.elements[k].start
    first, second = (m.value(word) for word in given)
    return Pair(
        start.x + first if given[0].incremental else Form(first),
        start.y + second if given[1].incremental else Form(second),
    )


def beside(chain: Chain, m: Machine, words: Words, k: int) -> None:
    """PDX PDY D: the element passes a point at a distance."""
    point = pair(chain, m, words, "PDX", "PDY", k)
    if point is None:
        if "D" in words:
            m.alarm(f"{words.code} D (distance) needs PDX and PDY, the point beside the element", words["D"])
        return
    if "D" not in words:
        m.alarm(f"{words.code} PDX PDY need D, the distance of the element from that point", words["PDX"])
    value = absolute(m, words, words["D"])
    if value < 0:
        m.alarm(f"{words.code} D (distance) must be at least 0, got {value:g}", words["D"])
    chain.contour.beside(k, point, value, words["D"])
