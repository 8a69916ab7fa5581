"""A cycle of the TNC 620 in a program of its own.

A transformation shows a figure before and after it, a contour cycle machines a contour that stands below the program.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from mnclab.controls.tnc_620.contours.area import ContourData, ContourGeometry
from mnclab.controls.tnc_620.contours.area_cycles import RoughOut, SideFinishing
from mnclab.controls.tnc_620.contours.train import ContourTrain, TrainData
from mnclab.controls.tnc_620.reading import sub_blocks
from mnclab.machine.cycle import Cycle
from mnclab.machine.probe import Setter
from mnclab.machine.tool_setting import SETS
from mnclab.machine.touching import FEELS, PROBES
from mnclab.machine.trial import TrialWords, at_setter, first_value, number, written_first

HOLES = ("CYCL DEF 200 DRILLING", *"Q200=2 Q201=-15 Q206=120 Q202=5 Q210=0 Q203=0 Q204=20 Q211=0".split())
#: Cycles that machine an area or say which.
AREA = tuple(f"CYCL DEF {n}" for n in (14, 20, 21, 22, 23, 24))
CALL = "CYCL CALL"
WHERE_IT_STANDS = ("TCH PROBE 3", "TCH PROBE 4", "TCH PROBE 451", "TCH PROBE 452")  # the touches of these begin there
TOOLS = {SETS: 7, PROBES: 6, FEELS: 6}  # by what a cycle does
SETUP = at_setter(Setter(x=10, y=5, z=-40), tt_calibrated=True)


def klartext(value: float | str) -> str:
    """A number with its sign, a text in quotes."""
    return f'"{value}"' if isinstance(value, str) else ("" if value < 0 else "+") + number(value)


def as_sub_blocks(cycle: type[Cycle], words: Sequence[tuple[str, Any]]) -> list[str]:
    """The lines of a cycle that has no Q parameters."""
    if cycle.code not in sub_blocks.CODES:
        plain: tuple[str, ...] = sub_blocks.UNSIGNED if cycle.code.startswith("TCH PROBE") else ()
        texts = {a: value if isinstance(value, str) else (number if a in plain else klartext)(value) for a, value in words}
        head = f" Q{texts.get('Q', '')} {texts.get('axis', '')}" if cycle.code == "TCH PROBE 0" else ""
        return list(sub_blocks.lines_of(cycle.code, cycle.title.upper() + head, texts))
    plain = ("DWELL", "F", "PECKG:F")
    texts = {address: number(value) if address in plain else klartext(value) for address, value in words}
    if "DR" in texts:
        texts["DR"] = texts["DR"][0]  # the sign alone
    return list(sub_blocks.lines_of_obsolete(int(cycle.code.split()[-1]), cycle.title.upper(), texts))


def definition(cycle: type[Cycle], words: TrialWords) -> list[str]:
    """The lines that define a cycle."""
    if cycle.code in sub_blocks.CODES or cycle.code in sub_blocks.LINES:
        return as_sub_blocks(cycle, words)
    return [" ~\n".join([f"{cycle.code} {cycle.title.upper()}", *(f"  {a}={klartext(v)}" for a, v in words)])]


def first_words(cycle: type[Cycle]) -> TrialWords:
    """The words that a cycle has to begin with."""
    return [(p.address, first_value(p)) for p in cycle.parameters() if p.required or written_first(p)]


def begun(cycle: type[Cycle]) -> list[str]:
    """A cycle with these words."""
    return definition(cycle, first_words(cycle))


def trial_program(cycle: type[Cycle], words: TrialWords) -> str | None:
    """A program around a cycle; None where nothing could be seen of it."""
    mine = definition(cycle, words)
    if cycle.code in MOVED:
        return program([*SHOWN, *mine, *SHOWN], FIGURE)
    if cycle.code in LINES:
        run = begun(ContourTrain) if cycle is TrainData else []  # which shows its data
        return program([*definition(ContourGeometry, [("LBL", "1")]), *mine, *run, CALL], LINES[cycle.code])
    if cycle.code in AREA:
        return program([*around(cycle, mine), CALL], CONTOURS)
    if cycle.code == "CYCL DEF 12":
        return program([*mine, "L X+20 Y+10 R0 FMAX M99", "L X+60 Y+30 R0 FMAX M99"])
    older = cycle.code in sub_blocks.CODES or cycle.code.startswith("TCH PROBE") and cycle.code in sub_blocks.LINES
    if not older and (not words or not all(address.startswith("Q") for address, _ in words)):
        return None
    return plain_program(cycle, mine, words)


def around(cycle: type[Cycle], mine: list[str]) -> Iterator[str]:
    """The cycles of a contour with one of them as it is written; those that only say something have roughing to show it."""
    for each in (ContourGeometry, ContourData):
        yield from mine if cycle is each else begun(each)
    if cycle is SideFinishing:  # which asks what roughed, here the same tool before
        yield "TOOL CALL 1 Z S1000 F500"
    yield from mine if cycle.runs == "call" else begun(RoughOut)


def program(blocks: Sequence[str], below: Sequence[str] = ()) -> str:
    """Blocks of an end mill, and labels below them."""
    start = ["BEGIN PGM TRIAL MM", "TOOL CALL 1 Z S1000 F500", "L X+0 Y+0 Z+50 R0 FMAX M3"]
    return "\n".join([*start, *blocks, "L Z+50 R0 FMAX M2", *below, "END PGM TRIAL MM", ""])


def plain_program(cycle: type[Cycle], mine: Sequence[str], words: TrialWords) -> str:
    """A cycle called by M99, an obsolete one at its set-up clearance."""
    written = [address for address, _ in words]
    call = ["L X+20 Y+10 R0 FMAX M99"] if cycle.runs == "call" else []
    height = next((abs(value) for address, value in words if address == "SETUP"), 50)
    mills = "PECKG:F" in written or ("Q207" in written and "Q239" not in written)
    tool = TOOLS.get(cycle.does) or (1 if mills else 2)  # an end mill; for holes and their threads the drill
    speed, turning = ("", "") if tool == TOOLS[PROBES] else (" S1000", " M3")  # a probe stands still
    start = ["BEGIN PGM TRIAL MM", f"TOOL CALL {tool} Z{speed}", f"L X+0 Y+0 Z{klartext(height)} R0 FMAX{turning}"]
    if cycle.does == FEELS or cycle.code in WHERE_IT_STANDS:
        start[2:] = ["L X+20 Y+10 Z+20 R0 FMAX"]
    before = HOLES if cycle.code in ("CYCL DEF 220", "CYCL DEF 221") else ()  # which run the cycle before them
    return "\n".join([*start, *before, *mine, *call, "END PGM TRIAL MM", ""])


# Figures and contours of trial programs: what a transformation moves and what a contour cycle machines. Lengths in mm.

#: Cycles that place what comes after them: a figure is cut before and after.
MOVED = tuple(f"CYCL DEF {n}" for n in (7, 8, 10, 11, 19, 26))
SHOWN = ("CALL LBL 1",)
#: No symmetry, so that a mirror image and a rotation can be told apart.
FIGURE = """LBL 1
L X+10 Y+5 R0 FMAX
L Z-2 F200
L X+50
L Y+15
L X+20
L Y+30
L X+10
L Y+5
L Z+50 FMAX
LBL 0""".splitlines()

#: A pocket, an island in it, and a second pocket that overlaps the first.
CONTOURS = """LBL 1
L X+0 Y+30 RR
L Y+60
RND R10
L X+90
RND R10
L Y+0
RND R10
L X+0
RND R10
L Y+30
LBL 0
LBL 2
L X+20 Y+30 RL
CC X+30 Y+30
C X+20 Y+30 DR-
LBL 0
LBL 3
L X+105 Y+30 RR
CC X+90 Y+30
C X+105 Y+30 DR-
LBL 0""".splitlines()


def line(*blocks: str) -> list[str]:
    """The label of one contour."""
    return ["LBL 1", *blocks, "LBL 0"]


TRAIN = ("L X+10 Y+0 RL", "L Y+25", "RND R8", "L X+40", "L X+55 Y+10", "CR X+85 Y+10 R20 DR-", "L Y+40")
WITHOUT_SIDE = ("L X+10 Y+0 R0", *TRAIN[1:])
IN_SPACE = ("L X+10 Y+0 Z+0 RL", "L Y+25 Z-2", "L X+40 Z-6", "L X+55 Y+10 Z-6", "CR X+85 Y+10 R20 DR-", "L Y+40 Z+0")
CENTRE_LINE = ("L X+0 Y+0", "L X+40", "RND R20", "L Y+45")
ON_CYLINDER = ("L X+0 Y+0 RL", "L X+50", "RND R20", "L Y+45", "L X+90 Y+65")
#: By cycle, the one contour that it machines.
LINES = {
    "CYCL DEF 25": line(*TRAIN), "CYCL DEF 270": line(*WITHOUT_SIDE), "CYCL DEF 276": line(*IN_SPACE),
    "CYCL DEF 275": line(*CENTRE_LINE),
    **{f"CYCL DEF {n}": line(*ON_CYLINDER) for n in (27, 28, 29, 39)},
}  # fmt: skip
#: The program that cycle 12 runs to begin with, by its name.
FILES = {
    "ABC.H": "BEGIN PGM ABC MM\nL Z+2 R0 FMAX\nL Z-5 F200\nL IX+15\nL IY+10\nL IX-15\nL IY-10\nL Z+50 FMAX\nEND PGM ABC MM\n"
}
