"""Programs that call others, and Macro B: assignments, conditions, jumps and loops."""

from __future__ import annotations

import os
import re
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import NamedTuple

from mnclab.controls.g43.language import parameters, variables
from mnclab.controls.g43.reading.formulas import FANUC, LINUXCNC, Formula
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import LONG, Machine
from mnclab.running import interpreter
from mnclab.running.flow import course
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word

# Programs that stand one after another in a file, from one O number to the next, and the numbered blocks of each.

_PROGRAM = re.compile(r"O\d+")


def sections(m: Machine) -> list[tuple[int, str]]:
    """The first block and the label of each program of the running file."""
    known = memory(m).sections
    if m.program not in known:
        labels = m.flow.program.labels
        known[m.program] = sorted((block, name) for name, block in labels.items() if _PROGRAM.fullmatch(name))
    return known[m.program]


def here(m: Machine) -> str:
    """The label of the program that runs; empty without O numbers."""
    found = sections(m)
    place = bisect_right(found, (m.flow.current, "~")) - 1
    return found[place][1] if place >= 0 else ""


def block_label(m: Machine, number: float, word: Word) -> str:
    """The label of a numbered block of the running program: the next one below with this number, or else the first one."""
    own = here(m)
    name = f"{own} N{number:.10g}".strip()
    labels = m.flow.program.labels
    if name not in labels:
        where = f" in {own}" if own else ""
        known = [label.rpartition(" ")[2] for label in labels if label.startswith(f"{own} N".lstrip())]
        hint = f"blocks with numbers: {', '.join(known[:8])}" if known else "no block has a number"
        m.alarm(f"there is no block N{number:.10g}{where}", word, hint)
    found, count = [name], 2
    while (again := f"{name} ({count})") in labels:
        found.append(again)
        count += 1
    if len(found) > 1:
        m.warn(f"N{number:.10g} stands {len(found)} times: the next one below counts, or else the first", word)
    return next((label for label in found if labels[label] > m.flow.current), found[0])


# Macro B: assignments, conditions, jumps and loops; the formulas in blocks of words.
# A block's formulas are worked out before its words are handed out, so that G and M may be formulas, too; a word whose value is
# vacant is left out, as Fanuc has it.

FUNCTIONS = FunctionTable()
MACRO_B = "Macro B"
MACRO_MEANINGS = {
    "target": "the variable that takes a value", "value": "the value", "message": "the comment that is shown",
    "beside": "words stand in the same line",
    "condition": "the condition", "GOTO": "the block to go on at", "END": "where the loop ends", "DO": "where it begins",
}  # fmt: skip
#: Addresses whose numbers count things, and of them those that say where the program goes on and what it does there.
COUNTS, COURSE = "DGHLMNOPST", "GMP"
LENGTHS = (*"XYZIJKRQUVW", ",R", ",C")
INCREMENT = {1.0: 1e-3, 25.4: 1e-4}  # what ROUND rounds lengths to, by the unit in mm
WHOLE = 1e-6  # what computing leaves of a whole number


def worth(m: Machine, formula: Formula, address: str = "") -> float | None:
    """The value of a formula, None where it is vacant."""
    dialect = m.settings["macros"]
    unit = INCREMENT[m.variable_unit] if dialect == FANUC and address in LENGTHS else 1.0
    m.flow.spend_again(1 + len(formula.tokens) // LONG)  # what a formula takes beside its block
    try:
        value = formula.worth(m.variables, dialect, unit)
    except Alarm as alarm:
        raise placed(m, alarm) from None
    if value is not None and address and address in COUNTS and abs(value - round(value)) < WHOLE:
        return float(round(value))
    return value


def placed(m: Machine, alarm: Alarm) -> Alarm:
    """An alarm of a formula at its place in the running program."""
    alarm.span = alarm.span and alarm.span._replace(program=m.program)
    return alarm


def computed(m: Machine, words: list[Word]) -> list[Word]:
    """The words of a block with numbers in the place of their formulas."""
    found = []
    for word in words:
        if isinstance(word.value, Formula):
            if word.address in COURSE:
                m.flow.ask(word.value)
            if word.value.text.lstrip("+- ")[:1].isalpha() and m.settings["macros"] == FANUC:
                hint = f"write {word.address}[{word.value.text}]; LinuxCNC takes it as it is: setting dialect"
                m.alarm(f"{word.address}: a function of a value stands in brackets", word, hint)
            value = worth(m, word.value, word.address)
            if value is None:
                continue
            word = word._replace(value=value)
        found.append(word)
    return found


def number(m: Machine, word: Word) -> float | None:
    """The number of a word of a statement."""
    return worth(m, word.value) if isinstance(word.value, Formula) else m.value(word)


@FUNCTIONS("#,", "Assignment", takes="target* value* message beside", source=MACRO_B)
def assign(m: Machine, words: Words) -> None:
    """Variables take values, all of which are worked out before."""
    if "beside" in words and m.settings["macros"] == FANUC:
        hint = "write two blocks; LinuxCNC takes it: setting dialect"
        m.alarm("words and an assignment stand in one block", words["beside"], hint)
    values = [number(m, word) for word in words.all("value")]
    for target, value in zip(words.all("target"), values, strict=True):
        formula = target.value
        assert isinstance(formula, Formula)
        try:
            name = formula.name(m.variables, m.settings["macros"])
        except Alarm as alarm:
            raise placed(m, alarm) from None
        message = words.get("message")
        variables.give(m, target, name, value, str(message.value) if message else "")


@FUNCTIONS("IF,", "Condition", takes="condition GOTO target* value* message", leads_away=True, source=MACRO_B)
def condition(m: Machine, words: Words) -> None:
    """GOTO a block, or THEN an assignment, if the condition holds."""
    holds = decide(m, words["condition"])
    if "GOTO" not in words:
        if holds:
            assign(m, words)
    elif holds or isinstance(words["GOTO"].value, float):  # a block that is missing is a fault even without the jump
        label = target(m, words["GOTO"])
        if holds:
            m.flow.jump(m, label, m.span_of(words["GOTO"]))


@FUNCTIONS("GOTO,", "Jump to a block", takes="GOTO", leads_away=True, source=MACRO_B)
def go_to(m: Machine, words: Words) -> None:
    """The program goes on at the block with this N: the next one below, or else the first one of the program."""
    m.flow.jump(m, target(m, words["GOTO"]), m.span_of(words["GOTO"]))


def target(m: Machine, word: Word) -> str:
    if isinstance(word.value, Formula):
        m.flow.ask(word.value)
    return block_label(m, number(m, word) or 0.0, word)


@FUNCTIONS("WHILE,", "Loop", takes="condition END", leads_away=True, source=MACRO_B)
def repeat(m: Machine, words: Words) -> None:
    """The blocks up to END are obeyed as long as the condition holds."""
    if not decide(m, words["condition"]):
        m.flow.jump(m, str(words["END"].value), m.span_of(words["END"]))


@FUNCTIONS("DO,", "Loop without a condition", takes="END", leads_away=True, source=MACRO_B)
def begin_loop(m: Machine, words: Words) -> None:
    """Without WHILE a loop is left by GOTO alone."""


@FUNCTIONS("END,", "End of a loop", takes="DO", leads_away=True, source=MACRO_B)
def end_loop(m: Machine, words: Words) -> None:
    """Back to the block of DO."""
    m.flow.jump(m, str(words["DO"].value), m.span_of(words["DO"]))


def decide(m: Machine, word: Word) -> bool:
    """Whether a condition holds."""
    formula = word.value
    assert isinstance(formula, Formula)
    try:
        sides = formula.sides(m.variables, m.settings["macros"])
    except Alarm as alarm:
        raise placed(m, alarm) from None
    if sides:
        m.flow.compare(formula, 0.0, sides[0] - sides[1])
    else:
        m.flow.ask(formula)
    return bool(worth(m, formula))


# Programs that call others: M98 and M99, G65 with arguments, G66 after every motion; O, where a program begins.
# The program of a number is sought in the running file, then in those that were called, then among `Setup(files=…)` and beside
# the running file: `O1000.nc`, `1000.nc`, whatever the ending. M98 leaves the variables #1 to #33 to the program that it calls,
# as Fanuc and LinuxCNC have it; a macro has its own.

SOURCE = "Fanuc, LinuxCNC"
MACRO = "Macro B"
MOST = 9999  # calls by one word
DEEPEST = 9  # calls inside each other on LinuxCNC, whose interpreter has ten levels, the main program's included
_TAPE = re.compile(r"(?m)^[ \t]*%")
LOCAL = frozenset(f"#{n}" for n in range(1, 34))
#: The variables of arguments; I, J and K of the second to tenth time have #7 to #33.
ARGUMENTS = dict(zip("ABCIJKDEFHMQRSTUVWXYZ", (*range(1, 10), 11, 13, *range(17, 27)), strict=True))
TAKES = " ".join(["P", "L", *(f"{letter}*" for letter in ARGUMENTS if letter != "M"), "argument*"])
_WRITTEN = {("argument" if letter == "M" else letter): number for letter, number in ARGUMENTS.items()}
MEANINGS = {
    "M99 P": "the block to go on at",
    **{f"{code} P": "the number of a program" for code in ("M98", "G65", "G66")},
    **{f"{code} L": "how often" for code in ("M98", "G65", "G66")},
    **{f"{code} {word}": f"argument #{number}" for code in ("G65", "G66") for word, number in _WRITTEN.items()},
}
#: In whose blocks X, Y and Z are no way.
STANDING = {4.0, 10.0, 52.0, 92.0, 50.0, 51.0, 68.0}


class Macro(NamedTuple):
    """A program that G66 calls after every motion: its number, how often, and its variables."""

    program: int
    times: int
    arguments: dict[str, float]


@FUNCTIONS("O", "Program number", phase="plane", source="ISO 6983")
def program_number(m: Machine, words: Words) -> None:
    """Where a program begins; one that runs into the next one ends there."""
    blocks, word, flow = sections(m), words["O"], course(m)
    place = next((k for k, (block, _) in enumerate(blocks) if block == flow.current), -1)
    if place < 0:
        m.alarm("O, a whole number of up to eight digits, is the first word of its block", word)
    if place == 0:
        return
    before = blocks[place - 1][1]
    ends = "M99" if flow.calls or flow.called else "M2 or M30"
    if len(flow.program[flow.current].words) > 1:
        m.alarm(f"{before} ends in a block with other words, which belong to {word}", word, f"write {ends} before it")
    m.warn(f"{before} ends where {word} begins", word, f"write {ends} before it")
    back(m)
    m.ended = m.ended or not (flow.returning or flow.over)


def without_end(m: Machine) -> None:
    """What LinuxCNC says of a program without an end: rs274 goes all its way, and then calls it a fault."""
    if m.settings["dialect"] != "linuxcnc":
        return
    tape = _TAPE.findall(course(m).programs[0].text)
    if len(tape) < 2:
        missing = "a second %" if tape else "M2, M30 or two lines %"
        m.warn(f"the program ends without {missing}: LinuxCNC stops here with an error", None, "write M2 at the end")


def back(m: Machine) -> None:
    """End the running subprogram, or the called file; nothing in the main program."""
    if course(m).calls:
        m.flow.leave()
    elif m.flow.called:
        m.flow.end_program()


@FUNCTIONS("M98", "Subprogram call", phase="call", takes="P L", modal=False, source=SOURCE)
def call(m: Machine, words: Words) -> None:
    """Runs the program of P, L times; without L, of P with more than four digits the last four are the number."""
    if "P" not in words:
        m.alarm("M98 needs P, the number of a program", first_word(words))
    program, times = whole(m, words["P"], 99_999_999), whole(m, words["L"], MOST) if "L" in words else 1
    if program > MOST and "L" not in words and not known(m, program):
        times, program = divmod(program, 10_000)
    run(m, program, times, "M98", words["P"])


@FUNCTIONS("M99", "End of a subprogram", phase="end", takes="P", modal=False, leads_away=True, source=SOURCE)
def end(m: Machine, words: Words) -> None:
    """Back to the block after the call, or with P to that of this number; in the main program as `main_m99` has it."""
    word, flow = words.words[0], course(m)
    if flow.calls or flow.called:
        memory(m).return_to = words.get("P")
        back(m)
    elif "P" in words:
        m.flow.jump(m, block_label(m, m.value(words["P"]), words["P"]), m.span_of(words["P"]))
    elif m.settings["main_m99"] == "repeat":
        m.flow.jump(m, "%", m.span_of(word))
    else:
        m.warn("M99 in the main program: it would begin again, and ends here", word, "setting main_m99")
        m.ended = True


@FUNCTIONS("G65,", "Macro call", phase="call", takes=TAKES, source=MACRO)
def call_macro(m: Machine, words: Words) -> None:
    """Runs the program of P, L times, with variables #1 to #33 of its own: A is #1, B #2, …; they are vacant afterwards."""
    run_macro(m, macro(m, words, "G65"), "G65", words["P"])


@FUNCTIONS("G66,", "Modal macro call", phase="call", takes=TAKES, source=MACRO)
def call_after_motion(m: Machine, words: Words) -> None:
    """From the next block on, the program of P runs after every block with X, Y or Z, until G67."""
    if m.modal.get("call"):
        m.alarm("G66 inside G66 is not built", words["P"] if "P" in words else None, "write G67 before it")
    memory(m).macro = macro(m, words, "G66")
    m.set_modal("call", "G66 again")


@FUNCTIONS("G66 again,", "Modal macro call, after a motion", group="call", phase="call", listed=False, source=MACRO)
def call_again(m: Machine, words: Words) -> None:
    """Not inside the macro itself."""
    kept = memory(m).macro
    assert isinstance(kept, Macro)
    if m.position_cycle:
        m.alarm("G66 and a drilling cycle are active: their order is not stated", hint="write G80 or G67 before it")
    m.set_modal("call", "")
    run_macro(m, kept, "G66", None)
    m.set_modal("call", "G66 again")


@FUNCTIONS("G67", "Modal macro call off", phase="plane", modal=False, source=MACRO)
def no_macro(m: Machine, words: Words) -> None:
    """Also where none was active."""
    m.set_modal("call", "")


def calls_again(keyword: str, words: list[Word]) -> bool:
    """Whether G66 calls its macro after a block."""
    codes = {word.value for word in words if word.address == "G"}
    return not keyword and not codes & STANDING and any(word.address in ("X", "Y", "Z") for word in words)


def macro(m: Machine, words: Words, code: str) -> Macro:
    """What a call says; its I, J and K begin a new group where one of them does not come after the last in order."""
    if "P" not in words:
        m.alarm(f"{code} needs P, the number of a program")
    program, times = whole(m, words["P"], 99_999_999), whole(m, words["L"], MOST) if "L" in words else 1
    arguments, group, last = dict[str, float](), 0, ""
    for word in sorted(words.words, key=lambda word: word.place):
        letter = "M" if word.address == "argument" else word.address
        if letter in ("P", "L"):
            continue
        index = ARGUMENTS[letter]
        if letter in ("I", "J", "K"):
            group, last = group + (letter <= last), letter
            index += 3 * group
            if index > 33:
                m.alarm("I, J and K stand at most ten times each", word)
        if (value := number(m, word)) is not None:
            arguments[f"#{index}"] = value
    return Macro(program, times, arguments)


def run_macro(m: Machine, called: Macro, code: str, word: Word | None) -> None:
    for _ in range(called.times):
        with own_level(m, is_local, called.arguments):
            run(m, called.program, 1, code, word)
        if m.ended or course(m).target >= 0:
            return


@contextmanager
def own_level(m: Machine, local: Callable[[str], bool], values: Mapping[str, float]) -> Iterator[None]:
    """Inside, variables that are local are others, with some values; afterwards those of before."""
    kept = {name: value for name, value in m.variables.items() if local(name)}
    for name in kept:
        m.variables.forget(name)
    for name, given in values.items():
        m.variables[name] = given
    yield
    for name in [name for name in m.variables if local(name)]:
        m.variables.forget(name)
    for name, value in kept.items():
        m.variables[name] = value


def is_local(name: str) -> bool:
    """Of #1 to #33."""
    return name in LOCAL


def is_named(name: str) -> bool:
    """Of those with names, which belong to one program; #<_most> does not (LinuxCNC, also for M98)."""
    return name[1] == "<" and name[2] != "_"


def run(m: Machine, program: int, times: int, code: str, word: Word | None) -> None:
    """Run a program a number of times; M99 P ends that."""
    no_deeper(m, word)
    for _ in range(times):
        index, label = found(m, program, code, word)
        flow = course(m)
        with own_level(m, is_named, {}):
            if label:
                with flow.inside(m, index):
                    flow.call(m, label, m.span_of(word))
            else:
                flow.call_program(m, index, m.span_of(word))
        if m.ended:
            return
        if (place := memory(m).return_to) is not None:
            memory(m).return_to = None
            flow.jump(m, block_label(m, m.value(place), word or place), m.span_of(word))
            return


def no_deeper(m: Machine, word: Word | None) -> None:
    """LinuxCNC has a limit of its own for calls inside each other; repeats do not count."""
    if m.settings["macros"] == LINUXCNC and parameters.depth(m) >= DEEPEST:
        m.alarm(f"calls stand deeper inside each other than {DEEPEST}, the most on LinuxCNC", word)


def whole(m: Machine, word: Word, most: int) -> int:
    value = number(m, word) or 0.0
    if value != int(value) or not 0 <= value <= most:
        m.alarm(f"{word.address} must be a whole number from 0 to {most}, got {value:.10g}", word)
    return int(value)


def found(m: Machine, program: int, code: str, word: Word | None) -> tuple[int, str]:
    """The file of a program, by its index, and its label there, if it has one."""
    if (place := known(m, program)) is not None:
        return place
    what, label = f"{code} P{program}", f"O{program}"
    name = file_of(m, f"O?0*{program}", label, what, word)
    if name is None:
        there = ", ".join(name for _, name in sections(m)[:8]) or "no program with a number"
        hint = f"this file has {there}; Setup(files=…) and the folder have no file {label}"
        m.alarm(f"{what}: there is no program {label}", word, hint)
    index = interpreter.called(m, name, code, m.span_of(word))
    labels = course(m).programs[index].labels
    other = next((held for held in labels if held[0] == "O"), "")
    if label not in labels and other:
        m.warn(f"{what}: the file {last(name)} holds {other}, and no {label}: it runs from its beginning", word)
    return index, label if label in labels else ""


def known(m: Machine, program: int) -> tuple[int, str] | None:
    """The place of a program in the files that were read."""
    flow, label = course(m), f"O{program}"
    indices = (m.program, *range(len(flow.programs)))
    return next(((index, label) for index in indices if label in flow.programs[index].labels), None)


def file_of(m: Machine, stem: str, called: str, what: str, word: Word | None) -> str | None:
    """The name of the file that a program has of its own, by the pattern of its stem; of several the one with the ending
    of the running file."""
    pattern = re.compile(rf"{stem}(\.\w{{1,8}})?", re.IGNORECASE)
    names, running = [name for name in m.setup.files if pattern.fullmatch(last(name))], m.flow.program
    if not names and running.folder:
        try:
            names = sorted(name for name in os.listdir(running.folder) if pattern.fullmatch(name))
        except OSError as fault:
            raise Alarm(f"the folder of the program cannot be read: {fault.strerror}") from None
    ending = os.path.splitext(running.name)[1].lower()
    if len(names) > 1 and len(chosen := [name for name in names if name.lower().endswith(ending)]) == 1:
        return chosen[0]
    if len(names) > 1:
        m.alarm(f"{what}: {len(names)} files are {called}: {', '.join(names[:8])}", word, "keep one of them there")
    return names[0] if names else None


def last(name: str) -> str:
    """The name of a file without its folders."""
    return re.split(r"[/\\:]", name)[-1]
