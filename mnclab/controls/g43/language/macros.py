"""Macro B: assignments, conditions, jumps and loops; the formulas in blocks of words.

A block's formulas are worked out before its words are handed out, so that G and M may be formulas, too; a word whose value is
vacant is left out, as Fanuc has it.
"""

from __future__ import annotations

from mnclab.controls.g43.language import sections, variables
from mnclab.controls.g43.reading.formulas import FANUC, Formula
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import LONG, Machine
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
SOURCE = "Macro B"
MEANINGS = {
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


@FUNCTIONS("#,", "Assignment", takes="target* value* message beside", source=SOURCE)
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


@FUNCTIONS("IF,", "Condition", takes="condition GOTO target* value* message", leads_away=True, source=SOURCE)
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


@FUNCTIONS("GOTO,", "Jump to a block", takes="GOTO", leads_away=True, source=SOURCE)
def go_to(m: Machine, words: Words) -> None:
    """The program goes on at the block with this N: the next one below, or else the first one of the program."""
    m.flow.jump(m, target(m, words["GOTO"]), m.span_of(words["GOTO"]))


def target(m: Machine, word: Word) -> str:
    if isinstance(word.value, Formula):
        m.flow.ask(word.value)
    return sections.block_label(m, number(m, word) or 0.0, word)


@FUNCTIONS("WHILE,", "Loop", takes="condition END", leads_away=True, source=SOURCE)
def repeat(m: Machine, words: Words) -> None:
    """The blocks up to END are obeyed as long as the condition holds."""
    if not decide(m, words["condition"]):
        m.flow.jump(m, str(words["END"].value), m.span_of(words["END"]))


@FUNCTIONS("DO,", "Loop without a condition", takes="END", leads_away=True, source=SOURCE)
def begin_loop(m: Machine, words: Words) -> None:
    """Without WHILE a loop is left by GOTO alone."""


@FUNCTIONS("END,", "End of a loop", takes="DO", leads_away=True, source=SOURCE)
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
