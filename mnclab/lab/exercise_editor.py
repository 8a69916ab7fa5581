"""An exercise in a notebook: editor, task, part and grade in one view; and the cell that is graded when it is run."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

from mnclab.lab.editor import opened
from mnclab.lab.forms.live import DRAWING, widgets
from mnclab.learning.answered import SUFFIXES
from mnclab.learning.card import card, grade_card, picture
from mnclab.learning.exercise import Exercise, exercise
from mnclab.learning.grade import Grade
from mnclab.learning.progress import Progress
from mnclab.text.alarm import Alarm


def graded(found: Exercise, text: str) -> Grade:
    """The grade of an answer, with the help that its earlier tries have earned; it is kept in progress.json.

    Where that file cannot be written a warning says so.
    """
    done = Progress()
    grade = found.check(text, done.tried(found.id))
    try:
        done.record(grade)
    except Alarm as alarm:
        warnings.warn(alarm.message, stacklevel=2)
    return grade


def grade_cell(name: str, cell: str) -> Grade:
    """Grade a cell (`%%mnc --exercise mnc-03`)."""
    return graded(exercise(name), cell)


def exercise_editor(found: Exercise, folder: str | Path = ".") -> Any:
    """Editor and grade on the left; task, drawing, path and part on the right; a button that saves and grades (needs ipywidgets).

    The answer is a file in the folder, `mnc-03.mnc`, with the template in it at first. The result has `text`, `grade`, the
    last one, and `check`, the button.
    """
    ipywidgets = widgets("editors")
    program = found.answer == "program"
    path = Path(folder) / f"{found.id}{SUFFIXES[found.control] if program else '.txt'}"
    live = opened(path, found.control, found.setup, begins=found.begins, program=program)
    live.text.layout.height, live.text.layout.width = "22em", "auto"
    button = ipywidgets.Button(description="Grade", button_style="primary", tooltip="save, run, measure the part, give hints")
    button.layout = live.button.layout = {"width": "7em", "flex": "none"}
    told, part = ipywidgets.HTML(), ipywidgets.HTML()
    task, drawing = ipywidgets.HTML(card(found, drawing=False)), ipywidgets.HTML(DRAWING.submit(picture, found).result())
    pages = {"task": task, "drawing": drawing, **({"path": live.picture} if program else {}), "part": part}
    _, buttons = live.children[0].children[0].children
    buttons.children = (live.button, button, live.status, *buttons.children[2:])
    left, sheets = ipywidgets.VBox([live.text, buttons, told]), ipywidgets.Tab()
    named = {"task": told, "grade": button, "part": part, "drawing": drawing, "left": left, "sheets": sheets}
    for name, box in named.items():
        box.add_class(f"mnclab-{name}-box")

    def lay() -> None:
        """What is empty has no page."""
        filled = {name: box for name, box in pages.items() if box.value}
        if len(filled) != len(sheets.children):
            sheets.children, sheets.titles = list(filled.values()), [*filled]

    def check(text: str) -> None:
        live.save(text, over=False)
        grade = DRAWING.submit(graded, found, text).result()
        live.grade, live.graded = grade, text
        told.value = grade_card(grade, differs=False)
        told.remove_class("mnclab-old")  # the picture of the part is yet to come
        part.value = DRAWING.submit(_part_of, grade).result()
        lay()
        if part.value:
            sheets.selected_index = len(sheets.children) - 1
        age()

    def age(_: Any = None) -> None:  # a grade of the text before is dimmed
        for box in (told, part):
            (box.remove_class if live.text.value == live.graded else box.add_class)("mnclab-old")

    lay()
    button.on_click(lambda _: check(live.text.value))
    live.text.observe(age, "value")
    live.children = (ipywidgets.HBox([left, sheets], layout={"flex_flow": "row wrap"}), *live.children[1:])
    live.grade, live.graded, live.check, live.told, live.part, live.sheets = None, "", button, told, part, sheets
    live.sent["!"] = check
    return live


def _part_of(grade: Grade) -> str:
    """Where part and drawing differ, or the part as it is."""
    if grade.difference is None:
        return ""
    whole: Any = grade.run.workpiece() if grade.passed and grade.run is not None else None
    drawn: Any = whole.plot() if whole is not None else grade.difference.plot(size=(6.4, 5.0))
    return str(drawn.html())
