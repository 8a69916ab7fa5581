"""A field: a box, the tick of a word that may be left out, and the fault that stands below them."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import Any

from mnclab.lab.forms.groups import groups

ROWS = 17  # of fields and heads that the first screen of a small laptop has room for
LINE = 46  # letters of a name that stand in one line of a form


class Field:
    """One row of a form or a panel: what is typed into, with its fault below."""

    def __init__(self, box: Any, *beside: Any, tick: Any = None, number: int = 0, parameter: Any = None) -> None:
        import ipywidgets

        self.box, self.tick, self.facts = box, tick, box.tooltip
        self.parts = (*([] if tick is None else [tick]), box, *beside)
        self.row, self.parameter = ipywidgets.HBox(self.parts), parameter
        self.fault: Any = None
        self.head: Any = None  # of its group
        self.row.add_class("mnclab-row")
        self.row.add_class(f"mnclab-p{number}")

    def tell(self, sentence: str) -> None:
        """Say what is wrong with the value, or with no sentence that nothing is; what was folded is opened for it."""
        import ipywidgets

        told = f'<div role="alert" class="mnclab-fault">{escape(sentence)}</div>' if sentence else ""
        if self.fault is None and not sentence:
            return
        if self.fault is None:
            self.fault = ipywidgets.HTML()
        self.fault.value = told
        wanted = (*self.parts, self.fault) if sentence else self.parts
        if self.row.children != wanted:  # the box stays where it is, and keeps the cursor
            self.row.children = wanted
        (self.row.add_class if sentence else self.row.remove_class)("mnclab-wrong")
        self.box.tooltip = "; ".join(filter(None, [sentence, self.facts or ""])) or None
        if sentence and self.head is not None:
            self.head.value = True


def fold(name: str, opened: bool) -> Any:
    """The head of what folds: a button, whose state the style sheet shows and obeys."""
    import ipywidgets

    head = ipywidgets.ToggleButton(opened, description=name, tooltip=f"show or hide {name}")
    head.add_class("mnclab-fold")
    return head


def folded(name: str, body: Any, opened: bool) -> list[Any]:
    """A head and what it shows and hides."""
    body.add_class("mnclab-folded")
    return [fold(name, opened), body]


def grouped(parameters: Iterable[Any], fields: dict[str, Field]) -> list[Any]:
    """The rows of a form in groups; as many groups are open from the first on as have room on a small screen."""
    import ipywidgets

    found = groups(list(parameters))
    if list(found) == [""]:
        return [fields[p.name].row for p in found[""]]
    parts: list[Any] = []
    free = float(ROWS - len(found))
    for place, (name, those) in enumerate(found.items()):
        high = sum(1 if len(fields[p.name].box.description) <= LINE else 1.5 for p in those)
        opened = place == 0 or high <= free
        free -= high if opened else free
        body = ipywidgets.VBox([fields[p.name].row for p in those])
        parts += folded(f"{name} ({len(those)})", body, opened)
        for p in those:
            fields[p.name].head = parts[-2]
    for place, head in enumerate(parts[::2]):  # heads stay in sight where the fields are scrolled
        head.add_class(f"mnclab-above{place}")
        head.add_class(f"mnclab-below{len(found) - 1 - place}")
    return parts
