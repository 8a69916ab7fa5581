"""The box that a form, a panel or an editor is: a widget in a notebook that runs, a still picture in one that does not.

JupyterLab takes the widget; where there is none (an exported or printed notebook, a page on the web) the last picture and
the values stand in its place. `_repr_mimebundle_` is asked once, when the box is shown; so a second output, which the
style of the widget hides, holds the picture and is replaced after each change.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

from mnclab.machine.trial import number

PAST = "last good picture"
IMAGE = re.compile('<img [^>]*base64,([^"]*)"[^>]*>')


@cache
def live_class() -> type:
    """The class of live boxes; ipywidgets is imported when the first is made."""
    import ipywidgets
    from IPython.display import display

    class Live(ipywidgets.VBox):
        """Boxes and what follows them; `still()` is what stands in their place where no widget can."""

        def __init__(self, children: Sequence[Any], classes: str = "") -> None:
            super().__init__([*children, ipywidgets.HTML(style())])
            self.title, self.shown, self.run = "panel", "", None
            self.place: Any = None  # of the still picture in the notebook
            self.picture, self.alarms = ipywidgets.HTML(), ipywidgets.HTML()
            self.boxes: dict[str, Any] = {}
            for name in classes.split():
                self.add_class(name)

        def still(self) -> dict[str, str]:
            """The last picture and the values, as a page shows them, as a picture alone, and in words."""
            values = {box.description or name: value_of(box) for name, box in self.boxes.items()}
            words = "; ".join(f"{name}: {value}" for name, value in values.items())
            rows = "".join(f"<tr>{cell(name)}{cell(value)}</tr>" for name, value in values.items())
            found = IMAGE.search(self.picture.value)  # without what can be clicked
            image, data = (found[0], found[1]) if found else ("", "")
            past = f"<p>{PAST}</p>" if PAST in image else ""
            page = f"<p><strong>{escape(self.title)}</strong></p>{image}{past}{self.alarms.value}<table>{rows}</table>"
            still = {"text/html": f'<div class="mnclab-still">{page}</div>', "text/plain": f"<{self.title}; {words}>"}
            return still | ({"image/png": data} if data else {})

        def renew(self) -> None:
            """Bring the still picture of the notebook up to date."""
            if self.place is not None:
                self.place.update(self.still(), raw=True)

        def _repr_mimebundle_(self, **options: Any) -> dict[str, Any]:
            return super()._repr_mimebundle_(**options) | self.still()

        def _ipython_display_(self) -> None:
            widget = super()._repr_mimebundle_() | {"text/plain": ""}
            display(widget, raw=True)
            self.place = display(self.still(), raw=True, display_id=True)

    return Live


def cell(text: str) -> str:
    """A cell of a table, its text on the left."""
    return f'<td style="text-align: left; white-space: pre-wrap">{escape(text)}</td>'


def style() -> str:
    """The style sheet of forms and panels, as an element of a page."""
    return f"<style>{Path(__file__).with_name('form.css').read_text('utf-8')}</style>"


def value_of(box: Any) -> str:
    """The value of a box as people read it: that of a choice in words, numbers as programs have them."""
    if getattr(box, "disabled", False):
        return "left out"
    labels: Mapping[Any, str] = {value: label for label, value in getattr(box, "options", ())} if hasattr(box, "options") else {}
    with suppress(TypeError):
        if box.value in labels:
            return labels[box.value]
    return number(box.value) if isinstance(box.value, int | float) else str(box.value)
