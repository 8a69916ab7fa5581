"""What a notebook gets: `%load_ext mnclab`, and then `%%mnc` cells, completion of words (Tab), their meaning (Shift+Tab).

`import mnclab` does the same in a running IPython: who does not know of the extension types `mnc.help("` and presses Tab.
IPython is imported here alone (and where a live box shows itself); what is done at a key is imported when the first key is
pressed.
"""

from __future__ import annotations

import re
from typing import Any

from mnclab.text.alarm import first_of
from mnclab.text.opening import require

MATCHER = "mnclab words"
LONGEST = 60  # letters of a meaning beside a word
#: Signs of what is offered: JupyterLab shows the first letter of a "type" as an icon, and a letter would look like an address.
KINDS = {"code": "◆", "word": "◇", "name": "▤"}
NAMES = ("file", "folder", "program", "label", "setup", "tools")


def kind_of(word: str, meaning: str) -> str:
    """What an offered word is: a code, a word of one (whose meaning names it), or the name of something."""
    if meaning in NAMES:
        return "name"
    return "word" if word.endswith("=") or re.search(r" \([A-Z][A-Z0-9. ]*\)$", meaning) else "code"


def load_ipython_extension(shell: Any) -> None:
    """Make %%mnc, completion and the meaning of words known to the running IPython."""
    require("IPython", "cells of programs (%%mnc)")
    from IPython.display import display

    def mnc(line: str, cell: str) -> None:
        """Obey the cell as a part program; see `mnclab.lab.cell`."""
        from mnclab.lab.cell import chosen_of, run_cell

        if (asked := chosen_of(line)).exercise:
            from mnclab.lab.exercise_editor import grade_cell

            grade = grade_cell(asked.exercise, cell)
            shell.push({asked.name: grade.run, "grade": grade})
            display(grade)
            return
        name, run, chosen = run_cell(line, cell, shell.user_ns)
        shell.push({name: run})
        if chosen.quiet:
            shown, more = first_of(run.alarms)
            for alarm in (*shown, *filter(None, [more])):
                display(alarm)
            return
        display(run)
        if run.toolpath.is_motion.any() and not chosen.card:  # an early fault leaves nothing to draw: the card says it all
            display(run.plot(colour=chosen.colour))

    shell.register_magic_function(mnc, "cell", "mnc")
    complete_words(shell)
    # Once pyplot is imported IPython draws every Figure itself: None keeps the PNG that a Picture has given already.
    shell.display_formatter.formatters["image/png"].for_type_by_name("mnclab.show.plot.picture", "Picture", lambda _: None)
    if hasattr(shell, "kernel"):
        explain_words(shell.kernel, shell)


def complete_words(shell: Any) -> None:
    """Add what completes words to the completer, once."""
    try:
        from IPython.core.completer import CompletionContext, SimpleCompletion, context_matcher
    except ImportError:  # before IPython 8.6
        return
    matchers = shell.Completer.custom_matchers
    if any(getattr(each, "matcher_identifier", "") == MATCHER for each in matchers):
        return

    @context_matcher(identifier=MATCHER)
    def match(context: CompletionContext) -> dict[str, Any]:
        from mnclab.lab.cell import suggestions

        lines = context.full_text.split("\n")[: context.cursor_line]
        at = sum(len(line) + 1 for line in lines) + context.cursor_position
        fragment, choices = suggestions(context.full_text, at, shell.user_ns) or (context.token, [])
        found = [SimpleCompletion(word, type=f"{KINDS[kind_of(word, meaning)]} {meaning[:LONGEST]}") for word, meaning in choices]
        return {"completions": found, "matched_fragment": fragment, "ordered": True, "suppress": bool(found)}

    matchers.append(match)


def explain_words(kernel: Any, shell: Any) -> None:
    """Let the kernel answer the question for a word of a program; all others as before."""
    if kernel is None or getattr(kernel.do_inspect, "of_mnclab", False):
        return
    usual = kernel.do_inspect

    def do_inspect(code: str, cursor_pos: int, *rest: Any, **more: Any) -> Any:
        from mnclab.lab.cell import explanation

        found = explanation(code, cursor_pos, shell.user_ns)
        if not found:
            return usual(code, cursor_pos, *rest, **more)
        return {"status": "ok", "found": True, "data": found, "metadata": {}}

    do_inspect.of_mnclab = True  # type: ignore[attr-defined]
    kernel.do_inspect = do_inspect
