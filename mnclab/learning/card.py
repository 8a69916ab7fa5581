"""What a notebook or a page shows of an exercise and of a grade: HTML, with the drawing, and where part and drawing differ."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

from mnclab.learning.exercise import Exercise
from mnclab.machine.setup import place
from mnclab.path.listing import figure
from mnclab.text.alarm import Alarm
from mnclab.text.tables import html_table
from mnclab.workpiece.blank import Revolved, blank

if TYPE_CHECKING:
    from mnclab.learning.grade import Grade

#: Before a line of a listing; it is not copied with it.
NUMBER = '<span style="user-select:none;color:#888">{:>3}  </span>'
DRAWING = 0.75  # of the size of its sheet, so that task and drawing stand on one screen
SHORT = 80  # letters of a line, up to which lines of a task are a list or a program, which stays as it is written


def card(exercise: Exercise, drawing: bool = True) -> str:
    """Task, drawing, blank, tools and what is asked for; without `drawing` only the words."""
    head = f"<strong>{escape(exercise.id)}: {escape(exercise.title)}</strong>"
    under = f"level {exercise.level}, lesson {escape(exercise.lesson)}: {escape(exercise.does)}"
    task = "".join(map(_paragraph, exercise.task.strip("\n").split("\n\n")))
    rows = "\n".join(f"{NUMBER.format(k)}{escape(row)}" for k, row in enumerate(exercise.program.rstrip().split("\n"), 1))
    given = f"<pre>{rows}</pre>" if exercise.program else ""
    if given:  # what is asked of it stands beside it, where there is room
        given = f'<div style="display:flex;flex-wrap:wrap;gap:0 1.5em">{given}{questions(exercise)}</div>'
    asked = "".join(f"<li>{escape(each)}</li>" for each in wanted(exercise))
    why = f"<p><em>{escape(exercise.why)}</em></p>" if exercise.why else ""
    return (
        f'<div class="mnclab-exercise" style="line-height:1.35">{head}<br>{under}{task}'
        f"{picture(exercise) if drawing else ''}{given}"
        f"{machine(exercise)}{tools(exercise)}{f'<ul>{asked}</ul>' if asked else ''}{why}</div>"
    )


def _paragraph(text: str) -> str:
    lines = text.strip("\n").split("\n")
    as_written = len(lines) > 1 and (max(map(len, lines)) <= SHORT or any("  " in line.strip() for line in lines))
    return f'<pre style="white-space:pre-wrap">{escape(text)}</pre>' if as_written else f"<p>{escape(text)}</p>"


def picture(exercise: Exercise) -> str:
    """The drawing as an image; nothing where there is none."""
    if exercise.design is None:
        return ""
    try:
        drawn: Any = exercise.drawing()
        width = round(100 * DRAWING * drawn.get_figwidth())
        return f'<div style="width:{width}px;max-width:100%">{drawn.html(2 * DRAWING)}</div>'
    except Alarm as alarm:
        return str(alarm._repr_html_())


def machine(exercise: Exercise) -> str:
    """The blank, as the drawing counts, what holds it, and where the machine stands; nothing where that is to be found."""
    setup = exercise.setup
    if exercise.kind == "set up" or setup.stock is None:
        return ""
    told = [f"Blank {_body(getattr(exercise.design, 'blank', None) or blank(setup.stock))}"]
    told += [f"held by {_body(blank(each))}" for each in setup.fixtures if blank(each) is not None]
    stands = place(setup.start).replace(" Y0", "" if hasattr(exercise.design, "profile") else " Y0")  # a lathe has no Y
    told += [f"the machine stands at {stands}"] if any(setup.start) else []
    where = " (in coordinates of the machine)" if setup.fixtures and any(map(any, setup.datums.values())) else ""
    return f"<p>{escape('; '.join(told) + where)}</p>"


def _body(body: Any) -> str:
    """A box or a bar in a few words: how thick it is, and from where to where it goes."""
    low, high = body.bounds
    along = [f"{axis}{figure(a)} to {figure(b)}" for axis, a, b in zip("XYZ", low.tolist(), high.tolist())]
    if not isinstance(body, Revolved):
        return ", ".join(along)
    bore = f", bore {figure(2 * body.bore)}" if body.bore else ""
    return f"⌀{figure(2 * max(radius for radius, _ in body.profile))}{bore}, {along[body.along]}"


def tools(exercise: Exercise) -> str:
    """The tools of the machine as a table."""
    names = ("radius", "length", "corner", "angle", "width", "teeth", "cutting_length", "pitch")
    table = {} if exercise.kind == "set up" else exercise.setup.tools or {}  # which the answer fills
    used = [name for name in names if any(getattr(tool, name, None) for tool in table.values())]
    rows = [(f"T{number}", tool.name or tool.kind, *(_said(getattr(tool, name, None)) for name in used))
            for number, tool in table.items()]  # fmt: skip
    return html_table(("tool", "", *(name.replace("_", " ") for name in used)), rows) if rows else ""


def _said(value: Any) -> str:
    return f"{value:g}" if isinstance(value, int | float) and value else ""


def questions(exercise: Exercise) -> str:
    """What is to be predicted, numbered."""
    rows = "".join(f"<li>{escape(each.text)}</li>" for each in exercise.questions)
    return f'<ol style="flex:1 1 10em;margin-bottom:1em;padding-left:1.6em">{rows}</ol>' if rows else ""


#: What a card says of a strategy, and in which unit; the feed is worked out.
UNITS = {"engagement": "°", "time": " s", "lifts": ""}


def wanted(exercise: Exercise) -> list[str]:
    """What is asked for, in sentences."""
    asked, found = exercise.asked, []
    if exercise.answer == "strategy":
        from mnclab.machining.milling.strategies import STRATEGIES

        found.append(f"strategies: {', '.join(STRATEGIES)}")
    found += [f"use {', '.join(asked.must)}"] if asked.must else []
    found += [f"do not use {', '.join(asked.must_not)}"] if asked.must_not else []
    found += [f"at most {asked.blocks} blocks"] if asked.blocks else []
    found += [f"no more than {asked.time:g} s"] if asked.time else []
    found += [f"a way of no more than {asked.length:g} mm"] if asked.length else []
    shown = {name: most for name, most in asked.strategy.items() if name in UNITS}
    found += [f"{name} at most {most:g}{UNITS[name]}" for name, most in shown.items()]
    return found


def grade_card(grade: Grade, differs: bool = True) -> str:
    """The mark and the hints, and where part and drawing differ, as a picture."""
    colour = "#1a7f37" if grade.passed else "#9a3412"
    head = f'<strong style="color:{colour}">{escape(grade.exercise)}: {grade.verdict}, {grade.score:.0%}</strong>'
    hints = "".join(f"<li>{escape(str(hint))}</li>" for hint in grade.hints)
    points = escape(", ".join(f"{name} {mark}" for name, mark in grade.rows()))
    where = ""
    if differs and grade.difference is not None and not grade.passed:
        drawn: Any = grade.difference.plot()
        where = drawn.html()
    hints = f"<ol>{hints}</ol>" if hints else ""
    return f'<div class="mnclab-grade" style="line-height:1.35">{head} ({points}){hints}{where}</div>'


PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>
body{{font:15px/1.45 sans-serif;max-width:60em;margin:1.5em auto;padding:0 1em}} table{{border-collapse:collapse}}
td,th{{padding:.2em .6em;border-bottom:1px solid #ddd;text-align:left}}
img{{max-width:100%}} pre{{background:#f6f6f4;padding:.6em}}
</style></head><body>{body}</body></html>
"""


def page(title: str, body: str) -> str:
    """A page by itself."""
    return PAGE.format(title=escape(title), body=body)

