"""O words of LinuxCNC: subprograms with arguments and a value, conditions and loops; of the dialect linuxcnc alone.

A subprogram that the running file does not have is sought in a file of its name, among `Setup(files=…)` and beside the
running file. It has #1 to #30 and variables with names of its own; #<_most> belongs to all.
"""

from __future__ import annotations

import re

from mnclab.controls.g43.language import programs
from mnclab.controls.g43.language.programs import decide, number
from mnclab.controls.g43.reading.formulas import LINUXCNC
from mnclab.controls.g43.reading.statements import spelled
from mnclab.controls.g43.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.running import interpreter
from mnclab.running.flow import course
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
SOURCE = "LinuxCNC, O codes"
MOST_ARGUMENTS = 30
MOST_TIMES = 1e9
MEANINGS = {
    "ELSE": "where the next branch begins", "name": "the name of the subprogram", "argument": "an argument, from #1 on",
}  # fmt: skip
LOCAL = frozenset(f"#{n}" for n in range(1, MOST_ARGUMENTS + 1))


def dialect(m: Machine, words: Words) -> None:
    """An Alarm where the program is not LinuxCNC's."""
    if m.settings["macros"] != LINUXCNC:
        hint = 'Setup(settings={"dialect": "linuxcnc"}) obeys them; Fanuc and Haas have M98, WHILE and IF'
        m.alarm("O words are those of LinuxCNC", words.words[0] if words.words else None, hint)


@FUNCTIONS("O SUB,", "Subprogram", takes="END", leads_away=True, source=SOURCE)
def definition(m: Machine, words: Words) -> None:
    """The blocks up to the end are passed over, once: a subprogram is obeyed where it is called."""
    dialect(m, words)
    place, word = (m.program, str(words["END"].value).removeprefix("after ")), words["END"]
    if place in memory(m).known:
        hint = "LinuxCNC refuses it: write the subprogram above its first call, or after M2"
        m.alarm(f"the program comes to {place[1]}, which it has called or passed before", word, hint)
    memory(m).known.add(place)
    m.flow.jump(m, str(word.value), m.span_of(word))


@FUNCTIONS("O SKIP,", "End of a branch", takes="END", leads_away=True, source=SOURCE)
@FUNCTIONS("O BREAK,", "Leave a loop", takes="END", leads_away=True, source=SOURCE)
def go_past(m: Machine, words: Words) -> None:
    """The blocks up to the end are passed over."""
    dialect(m, words)
    m.flow.jump(m, str(words["END"].value), m.span_of(words["END"]))


@FUNCTIONS("O ENDSUB,", "End of a subprogram", takes="value", leads_away=True, source=SOURCE)
@FUNCTIONS("O RETURN,", "Return from a subprogram", takes="value", leads_away=True, source=SOURCE)
def back(m: Machine, words: Words) -> None:
    """Back to the block after the call, with a value for #<_value> if one is written."""
    dialect(m, words)
    if not course(m).calls:
        m.alarm("the end of a subprogram that was not called", words.get("value"))
    memory(m).returned = (number(m, words["value"]) or 0.0) if "value" in words else None
    m.flow.leave()


@FUNCTIONS("O CALL,", "Subprogram call", phase="call", takes="name argument*", source=SOURCE)
def call(m: Machine, words: Words) -> None:
    """Runs a subprogram with arguments in #1, #2, …; those that are not written are 0."""
    dialect(m, words)
    word, arguments = words["name"], words.all("argument")
    programs.no_deeper(m, word)
    if len(arguments) > MOST_ARGUMENTS:
        m.alarm(f"a call has at most {MOST_ARGUMENTS} arguments", arguments[MOST_ARGUMENTS])
    values = {f"#{k}": number(m, each) or 0.0 for k, each in enumerate(arguments, 1)}
    name = word.value if isinstance(word.value, str) else f"{number(m, word) or 0.0:.10g}"
    index = place_of(m, name, word)
    memory(m).known.add((index, f"O{name} sub"))
    kept, flow = memory(m), course(m)
    kept.returned = None
    with programs.own_level(m, lambda known: known in LOCAL or programs.is_named(known), values), flow.inside(m, index):
        flow.call(m, f"O{name} sub", m.span_of(word))
    m.variables["#<_value>"] = kept.returned or 0.0
    m.variables["#<_value_returned>"] = float(kept.returned is not None)


def place_of(m: Machine, name: str, word: Word) -> int:
    """The index of the file that has a subprogram."""
    flow, label = course(m), f"O{name} sub"
    for index in (m.program, *range(len(flow.programs))):
        if label in flow.programs[index].labels:
            return index
    file = programs.file_of(m, re.escape(name), f"O{name}", f"O{name} call", word)
    if file is None:
        hint = f"neither this file nor Setup(files=…) nor the folder has O{name} sub"
        m.alarm(f"there is no subprogram O{name}", word, hint)
    index = interpreter.called(m, file, f"O{name} call", m.span_of(word))
    if label not in flow.programs[index].labels:
        m.alarm(
            f"the file {programs.last(file)} has no subprogram O{name}",
            word,
            f"its first line is O<{spelled(name)}> sub",
        )
    return index


@FUNCTIONS("O IF,", "Condition", takes="condition END ELSE", leads_away=True, source=SOURCE)
def condition(m: Machine, words: Words) -> None:
    """The next branch, elseif, else or endif, is gone to if the condition does not hold."""
    dialect(m, words)
    if not decide(m, words["condition"]):
        m.flow.jump(m, str(words["ELSE"].value), m.span_of(words["condition"]))


@FUNCTIONS("O ELSE,", "Branch without a condition", source=SOURCE)
@FUNCTIONS("O ENDIF,", "End of the branches", source=SOURCE)
@FUNCTIONS("O DO,", "Loop whose condition stands at its end", takes="END", source=SOURCE)
@FUNCTIONS("O ENDREPEAT,", "End of a counted loop", takes="DO", source=SOURCE)
def nothing(m: Machine, words: Words) -> None:
    """A place that others go to."""
    dialect(m, words)


@FUNCTIONS("O WHILE,", "Loop", takes="condition END", leads_away=True, source=SOURCE)
def loop(m: Machine, words: Words) -> None:
    """The blocks up to endwhile are obeyed as long as the condition holds."""
    dialect(m, words)
    if not decide(m, words["condition"]):
        m.flow.jump(m, str(words["END"].value), m.span_of(words["condition"]))


@FUNCTIONS("O LOOP,", "End of a loop, with its condition", takes="condition DO", leads_away=True, source=SOURCE)
def loop_again(m: Machine, words: Words) -> None:
    """Back to the block of do as long as the condition holds."""
    dialect(m, words)
    if decide(m, words["condition"]):
        m.flow.jump(m, str(words["DO"].value), m.span_of(words["condition"]))


@FUNCTIONS("O ENDWHILE,", "End of a loop", takes="DO", leads_away=True, source=SOURCE)
@FUNCTIONS("O CONTINUE,", "Next pass of a loop", takes="DO", leads_away=True, source=SOURCE)
def again(m: Machine, words: Words) -> None:
    """Back to the condition."""
    dialect(m, words)
    m.flow.jump(m, str(words["DO"].value), m.span_of(words["DO"]))


@FUNCTIONS("O REPEAT,", "Loop a number of times", takes="condition END", leads_away=True, source=SOURCE)
def repeat(m: Machine, words: Words) -> None:
    """The blocks up to endrepeat are obeyed so many times, to the nearest whole number; not at all for less than one."""
    dialect(m, words)
    flow, span, after = course(m), m.span_of(words["condition"]), str(words["END"].value)
    m.flow.ask(words["condition"].value)
    times = min(max(number(m, words["condition"]) or 0.0, 0.0), MOST_TIMES)
    if round(times) > 0:
        flow.repeat(m, flow.current + 1, flow.index_of(after), round(times), span)
    if flow.target < 0 and not (flow.returning or flow.over or m.ended):
        flow.jump(m, after, span)
