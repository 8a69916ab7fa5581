"""What the words of free elements say: each is an equation of the contour (catalogue: FK).

I before a word counts from the start of the element, or with RX, RY, RPR, RPA, RAN, RCCX, … from an earlier block, whose
number that word gives. Polar data count from FPOL.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from mnclab.controls.tnc_620.free_contours.free_contour import FreeContour, Pair, known, normal_of
from mnclab.controls.tnc_620.free_contours.quadratic_form import Form
from mnclab.controls.tnc_620.language.checks import above_zero, not_negative
from mnclab.controls.tnc_620.language.motion import sense
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import Words
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

if TYPE_CHECKING:
    from mnclab.controls.tnc_620.language.free_contours import Chain

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
