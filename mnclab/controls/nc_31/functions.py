"""Words and functions of the NC-31: straight and conditional moves, repetition, feed, spindle; numbers in discretes."""

from __future__ import annotations

from dataclasses import dataclass, field

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.text.program import INCREMENTAL, RAPID_MARK, Program, Word

# The scale of the integers: a program of the NC-31 has no decimal point, it counts in discretes.
# The source gives the scale of F inside a cycle only; the others are adopted so that its example makes sense (diameter
# 105, a groove 0.3 to 1 mm deep with a lead of 2 mm, cut at 99 m/min).

X = 200.0  # discretes in a millimetre of radius: X counts 0.01 mm on the diameter
Z = 100.0  # 0.01 mm
FREE_FEED = 100.0  # F as a frame of its own: 0.01 mm/rev
CYCLE_FEED = 10_000.0  # F inside a cycle: 0.0001 mm/rev
TRAVEL = 100.0  # machine parameters 8, 10, 11: 0.01 mm of true tool travel


# What the NC-31 keeps beside the common state of a machine.

@dataclass
class Memory:
    """Of the NC-31."""

    frames: dict[int, list[int]] = field(default_factory=dict)  # numbers of the frames of each block, once worked out


def memory(m: Machine) -> Memory:
    """What the NC-31 keeps."""
    kept: Memory = m.memory
    return kept


# Words and functions: straight moves, conditional moves G61 to G67, repetition G25, feed, spindle, auxiliary codes.
# The source starts the spindle of its example with S alone, and its feeds are per revolution. So S turns the spindle
# clockwise until the first M3, M4 or M5; from then on these say how it turns (adopted).

FUNCTIONS = FunctionTable()
OUTSIDE = "the source does not describe it; it is taken in its usual meaning"
SPINDLE = {"M3": "Spindle clockwise", "M4": "Spindle counter-clockwise", "M5": "Spindle stop"}
CONDITIONS = ("exact stop check", "Stop key blocked", "synchronised start")  # bits 1, 2, 4 of the second digit
CONDITIONAL = {
    f"G{60 + bits}": "Conditional move: " + ", ".join(c for k, c in enumerate(CONDITIONS) if bits >> k & 1)
    for bits in range(1, 8)
}


def power_on(m: Machine) -> None:
    """A lathe: the plane of X and Z, feeds per revolution."""
    m.change("plane", "ZX")
    m.change("per_rev", True)


def targets(m: Machine, words: Words) -> dict[str, float]:
    """Ends of a move as arguments of a verb, mm; increments count from the start of the move."""
    found = {}
    for k, (address, scale) in enumerate((("X", X), ("", 0.0), ("Z", Z))):
        if address in words:
            value = m.value(words[address]) / scale
            found[address.lower()] = m.programmed[k] + value if words[address].incremental else value
    return found


def move(m: Machine, words: Words, rapid: bool) -> None:
    """A straight line to X, Z at rapid or at the modal feed."""
    ends = targets(m, words)
    if rapid:
        m.rapid(**ends)
    elif ends:  # a conditional move may have M alone: it needs no feed
        m.line(**ends, word=words.words[0])


def refuse_rapid(m: Machine, words: list[Word], code: str) -> None:
    """In a group with a G frame that frame carries the mark ~, not X or Z."""
    for word in words:
        if word.flag & RAPID_MARK:
            m.alarm(f"the mark ~ has no meaning on {word} in a group with {code}", word, f"write it on {code}")


@FUNCTIONS("Z", "Straight move", takes="X", source="3.20.2")
@FUNCTIONS("X", "Straight move", takes="Z", source="3.20.2")
def straight_move(m: Machine, words: Words) -> None:
    """At the modal feed; at rapid when a frame of the move has the mark ~. With @ the value is an increment."""
    move(m, words, any(word.flag & RAPID_MARK for word in words.words))


def notes_of(head: Word, bits: int) -> list[str]:
    """What a conditional move has beside the exact stop."""
    notes = [condition for k, condition in enumerate(CONDITIONS) if k and bits >> k & 1]
    return [*notes, "separate in single-block mode"] if head.flag & INCREMENTAL else notes


@FUNCTIONS(" ".join(CONDITIONAL), CONDITIONAL, takes="X Z M", modal=False, source="3.20.15")
def conditional_move(m: Machine, words: Words) -> None:
    """One straight move at feed, with ~ on the G frame at rapid; M is carried out at its end.

    The exact stop is a column of the path. What has no column is told by the label: a blocked Stop key, a start at the
    zero mark of the spindle, and (@ on the G frame) that in single-block mode the next frame waits for the operator.
    """
    head, bits = words.words[0], int(words.code[1:]) - 60
    if len(words.words) == 1:
        m.alarm(f"{words.code} needs X, Z or M", head, "tie their frames to it with the mark *")
    refuse_rapid(m, [*words.words[1:]], words.code)
    notes = notes_of(head, bits)
    m.exact_here = bool(bits & 1)
    with m.within(label=f"{words.code} {', '.join(notes)}" if notes else words.code):
        move(m, words, bool(head.flag & RAPID_MARK))
    if "M" in words:
        auxiliary(m, Words((words["M"],), "M"))


@FUNCTIONS("G25", "Repetition of frames", takes="P*", modal=False, source="3.20.15, example")
def repeat(m: Machine, words: Words) -> None:
    """Carries out the frames of a range once more, or as often as a second P says, then goes on after its group.

    The first P holds both numbers: first * 1000 + last.
    """
    head, given = words.words[0], words.all("P")
    if head.flag & (RAPID_MARK | INCREMENTAL):
        m.alarm("the marks ~ and @ have no meaning on G25", head)
    if not given:
        m.alarm("G25 P (frame range) is missing", head, "tie its frame to G25 with the mark *")
    if len(given) > 2:
        m.alarm(f"G25 takes P twice, range and count: {given[2]} is one too many", given[2])
    count = int(m.value(given[1])) if len(given) == 2 else 1
    if count < 1:
        m.alarm(f"G25 P (number of repetitions) must be at least 1, got {count}", given[1])
    first, last = frame_range(m, given[0])
    m.flow.repeat(m, first, last + 1, count, given[0].span)


def frame_range(m: Machine, word: Word) -> tuple[int, int]:
    """First and last block of a range of frames; it must be there, be whole, and lie beside the G25 that asks."""
    value, program = int(m.value(word)), m.flow.program
    first, last = divmod(value, 1000)
    if value < 0:
        m.alarm(f"G25 P (frame range) must be first frame * 1000 + last frame, got {value}", word)
    if first > last:
        m.alarm(f"G25 P (frame range) must not run backwards, got {first} to {last}", word)
    for number in (first, last):
        if str(number) not in program.labels:
            hint = "the last three digits are the last frame, those before them the first"
            m.alarm(f"G25 P (frame range) names frame {number}, which does not exist", word, hint)
    begin, end = program.labels[str(first)], program.labels[str(last)]
    if begin <= m.flow.current <= end:
        m.alarm(f"G25 P (frame range) {first} to {last} contains this G25 itself", word)
    for number, block, place in ((first, begin, 0), (last, end, -1)):
        frames = frames_of(m, program)[block]
        if frames[place] != number:
            m.alarm(f"G25 P (frame range) {first} to {last} cuts the group {frames[0]} to {frames[-1]} in two", word)
    return begin, end


def frames_of(m: Machine, program: Program) -> dict[int, list[int]]:
    """Numbers of the frames of each block, worked out once in a run."""
    frames = memory(m).frames
    for number, block in () if frames else program.labels.items():
        frames.setdefault(block, []).append(int(number))
    return frames


@FUNCTIONS("P", "Parameter of a command", source="3.20.3")
def parameter(m: Machine, words: Words) -> None:
    """Only inside a group: P1, P2, P3 of a cycle are its first, second and third P frame."""
    word = words.words[0]
    m.alarm(f"{word} stands alone: P belongs to a group that begins with G", word, "the frame before it has no mark *")


@FUNCTIONS("F", "Feed, modal", source="3.20.15, example")
def feed(m: Machine, words: Words) -> None:
    """In 0.01 mm/rev as a frame of its own; inside the group of a cycle in 0.0001 mm/rev and for that cycle alone."""
    value = m.value(words["F"])
    if value <= 0:
        m.alarm(f"F (feed, 0.01 mm/rev) must be greater than 0, got {value:g}", words["F"])
    m.change("feed", value / FREE_FEED)


@FUNCTIONS("S", "Spindle speed", source="3.20.15, example")
def spindle_speed(m: Machine, words: Words) -> None:
    """In rev/min. Turns the spindle clockwise as long as no M3, M4 or M5 was written."""
    value = m.value(words["S"])
    if value < 0:
        m.alarm(f"S (spindle speed, rev/min) must be at least 0, got {value:g}", words["S"])
    m.spindle(speed=value, turning=None if "spindle" in m.modal else 1)


@FUNCTIONS("M3 M4 M5", SPINDLE, group="spindle", source="outside")
def spindle(m: Machine, words: Words) -> None:
    """From here on M3, M4 and M5 say how the spindle turns, S only how fast."""
    m.set_modal("spindle", words.code)
    m.spindle(turning={"M3": 1, "M4": -1, "M5": 0}[words.code])


@FUNCTIONS("M0", "Program stop", modal=False, source="outside")
def program_stop(m: Machine, words: Words) -> None:
    """Waits for the operator."""
    m.stop()


@FUNCTIONS("M8 M9", {"M8": "Coolant on", "M9": "Coolant off"}, group="coolant", source="outside")
def coolant(m: Machine, words: Words) -> None:
    """Not in the source."""
    m.warn(f"{words.code}: {OUTSIDE}", words["M"])
    m.set_modal("coolant", words.code)
    m.coolant()


@FUNCTIONS("M", "Auxiliary function", source="3.20.15")
def auxiliary(m: Machine, words: Words) -> None:
    """A frame of its own, or the end of a conditional move. The source describes no code; a few usual ones work."""
    code = f"M{m.value(words['M']):g}"
    function = FUNCTIONS.get(code)
    if function is None:
        known = ", ".join(c for c in FUNCTIONS if c[0] == "M" and c != "M")
        m.alarm(f"{code} is not described in the source of this control", words["M"], f"known: {known}")
    function.obey(m, Words(words.words, code))
