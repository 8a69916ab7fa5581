"""An exercise in a notebook: task, editor, part and grade in one view; and the cell that is graded when it is run."""

from __future__ import annotations

import warnings
from html import escape
from pathlib import Path
from typing import Any

from mnclab.lab.editor import editor
from mnclab.lab.forms.live import DRAWING
from mnclab.learning.answered import SUFFIXES
from mnclab.learning.card import card, grade_card, picture
from mnclab.learning.exercise import Exercise, exercise
from mnclab.learning.grade import Grade
from mnclab.learning.progress import Progress
from mnclab.text.alarm import Alarm
from mnclab.text.opening import require

TASK = {"max_height": "10em", "overflow": "auto"}  # it scrolls, so that the editor stays in sight
BESIDE = {"flex": "1 1 520px", "min_width": "420px"}


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
    """Task and editor on the left; drawing, path and part on the right; a button that grades (needs ipywidgets).

    The answer is a file in the folder, `mnc-03.mnc`, with the template in it at first. The result has `text`, `grade`, the
    last one, and `check`, the button.
    """
    require("ipywidgets", "editors")
    import ipywidgets

    program = found.answer == "program"
    path = Path(folder) / f"{found.id}{SUFFIXES[found.control] if program else '.txt'}"
    live = editor(path, found.control if program else None, found.setup)
    if not live.document.text and found.template:
        live.text.value = found.template
    live.text.layout.height = "16em"
    button = ipywidgets.Button(description="Grade", button_style="primary", tooltip="run it, measure the part, give hints")
    told, part = ipywidgets.HTML(), ipywidgets.HTML()
    drawing = ipywidgets.HTML(DRAWING.submit(picture, found).result())
    pages = {"drawing": drawing, **({"path": live.picture} if program else {}), "part": part}
    sheets = ipywidgets.Tab([*pages.values()], titles=[*pages], layout=BESIDE)
    for name, box in {"task": told, "grade": button, "part": part}.items():
        box.add_class(f"mnclab-{name}-box")

    def check(_: Any = None) -> None:
        grade = DRAWING.submit(graded, found, live.text.value).result()
        live.grade = grade
        told.value = grade_card(grade, differs=False)
        part.value = DRAWING.submit(_part_of, grade).result()
        if part.value:
            sheets.selected_index = len(pages) - 1

    button.on_click(check)
    style, _, buttons = live.children[0].children[0].children
    task = ipywidgets.HTML(card(found, drawing=False), layout=TASK)
    buttons.children = (live.button, button, live.status, *buttons.children[2:])
    left = ipywidgets.VBox([style, task, live.text, buttons, told], layout={"width": "36em"})
    below = live.children[1:] if program else ()  # what is no program has no alarms of one
    live.children = (ipywidgets.HBox([left, sheets], layout={"flex_flow": "row wrap"}), *below)
    live.grade, live.check, live.told, live.part, live.sheets = None, button, told, part, sheets
    return live


def _part_of(grade: Grade) -> str:
    """Where part and drawing differ, or the part as it is."""
    if grade.difference is None:
        return ""
    if grade.passed:
        whole: Any = grade.run.workpiece().plot() if grade.run is not None else None
        return str(whole.html()) if whole is not None else ""
    drawn: Any = grade.difference.plot(size=(6.4, 5.0))
    return f"{drawn.html()}<p>{escape(grade.verdict)}</p>"
