"""The box that a form, a panel or an editor is, and what follows what is typed: the picture, the alarms, the figures of a run.

JupyterLab takes a widget; where there is none (an exported or printed notebook, a page on the web) the last picture and
the values stand in its place. `_repr_mimebundle_` is asked once, when the box is shown; so a second output, which the
style of the widget hides, holds the picture and is replaced after each change.

JupyterLab calls widgets from another thread than cells, so figures are drawn in **one** thread, `DRAWING`, and without
pyplot; nobody else starts threads, and where none can be started (Python in a browser) the work is done at once. A
picture keeps the limits of the one before and shows its path as a ghost; where a value is refused the last good picture
stays, greyed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import suppress
from functools import cache, cached_property
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

from mnclab.lab.forms.fields import Field, at_field
from mnclab.machine.trial import number
from mnclab.runs.run import Run
from mnclab.text.alarm import ALARM, Alarm, card_html
from mnclab.text.opening import require

PAST = "last good picture"
IMAGE = re.compile('<img [^>]*base64,([^"]*)"[^>]*>')


def widgets(what: str) -> Any:
    """ipywidgets, whose boxes have pictures beside them; an Alarm that says `what` needs it where it is missing."""
    require("ipywidgets", what)
    require("matplotlib", "pictures")
    import ipywidgets

    return ipywidgets


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


# What follows the boxes.

class OneThread(Executor):
    """Works done one after the other in a thread of their own, or at once where no thread can be started."""

    @cached_property
    def _thread(self) -> ThreadPoolExecutor | None:
        thread = ThreadPoolExecutor(1, thread_name_prefix="drawing")
        try:
            thread.submit(int)  # the first work starts it
        except RuntimeError:
            return None
        return thread

    def submit(self, work: Callable[..., Any], /, *given: Any, **options: Any) -> Future[Any]:
        if self._thread is not None:
            return self._thread.submit(work, *given, **options)
        done: Future[Any] = Future()
        try:
            done.set_result(work(*given, **options))
        except Exception as error:
            done.set_exception(error)
        return done


DRAWING = OneThread()
SIZE = (6.4, 4.4)  # inches, of a picture beside boxes


class NewPicture(NamedTuple):
    """What a change makes: what draws the picture, what is said below it, and the alarm that stopped it.

    `draw` takes `under` and `limits`, what the picture before was made of and its `box`; `made` is that for the next one.
    A picture that `shows` the fault itself takes the place of the last good one.
    """

    draw: Callable[..., Any]
    said: str
    stop: Alarm | None = None
    made: Any = None
    shows: bool = False
    after: Callable[[], None] | None = None  # what can wait until the picture is seen


def following(
    boxes: Mapping[str, Any], fields: Mapping[str, Field], left: Any | None, work: Callable[[Any], NewPicture | None],
    field_of: Callable[[Alarm], str] = lambda alarm: "", *also: Any, title: str = "panel", classes: str = "",
    below: Iterable[Any] = (), above: Iterable[Any] = (), over: Iterable[Any] = (),
) -> Any:  # fmt: skip
    """What is `left`, the rows of the fields if None, with the picture and the alarms beside it.

    `work` is done when a box, or one `also`, changes. What is `over` the picture lies in front of it. A fault stands at the
    field that `field_of` names, one of no field above them all.
    """
    ipywidgets = widgets("forms")
    picture, alarms, first = ipywidgets.HTML(), ipywidgets.HTML(), ipywidgets.HTML()
    view = ipywidgets.VBox([picture, *over])
    right = ipywidgets.VBox([view, alarms, *below])
    column = ipywidgets.VBox([first, left or ipywidgets.VBox([field.row for field in fields.values()])])
    parts = {"right": right, "left": column, "first": first, "view": view, "drawn": picture, "said": alarms}
    for name, part in parts.items():
        part.add_class(f"mnclab-{name}")
    body = ipywidgets.HBox([column, right])
    body.add_class("mnclab-body")
    live = live_class()([*above, body], f"mnclab-following {classes}")
    live.title, live.boxes, live.fields, live.picture, live.alarms = title, dict(boxes), dict(fields), picture, alarms
    live.good, live.former, live.box, live.figure = False, None, None, None

    def tell(stop: Alarm | None) -> None:
        name = field_of(stop) if stop else ""
        for each, field in live.fields.items():
            field.tell(at_field(stop, field.parameter) if stop and each == name else "")
        first.value = stop.html() if stop and name not in live.fields else ""

    def changed(_: Any = None) -> None:
        done, stop = None, None
        try:
            done = work(live)
            stop = done.stop if done else None
            if done and (stop is None or not live.good or done.shows):
                live.shown, live.figure = DRAWING.submit(_drawn, done, live.former, live.box).result()
                live.box = live.figure.box
                if stop is None:
                    live.good, live.former = True, done.made
        except Alarm as alarm:
            stop = alarm
        tell(stop)
        past = stop is not None and live.good and not (done and done.shows)
        picture.value = greyed(live.shown) if past else live.shown
        alarms.value = done.said if done else stop.html() if stop else ""
        if done and done.after:
            done.after()
        live.renew()

    changed()
    for box in (*boxes.values(), *also):
        box.observe(changed, "value")
    return live


def _drawn(done: NewPicture, former: Any, box: Any) -> tuple[str, Any]:
    """A picture as HTML, and the figure."""
    figure = done.draw(under=former, limits=box)
    return figure.html(), figure


def greyed(picture: str) -> str:
    """A picture that is not of the values beside it."""
    said = picture.replace('alt="', f'alt="{PAST}; ', 1)
    return f'<figure class="mnclab-past"><div>{said}</div><figcaption>{PAST}</figcaption></figure>'


def of_run(run: Run, draw: Callable[..., Any]) -> NewPicture:
    """The work of a run: its picture, its verdict, the alarm that stopped it, and the path that the next picture shows."""
    stop = None if run.ok else next((alarm for alarm in run.alarms if alarm.severity == ALARM), None)
    return NewPicture(draw, verdict(run), stop, run.toolpath)


def verdict(run: Run) -> str:
    """The alarms of a run, each with its line and caret, and its figures in one line."""
    s = run.summary()
    lengths = f"cutting {s['cutting length']:.3f} mm, rapid {s['rapid length']:.3f} mm"
    figures = f"{lengths}, {s['time at feed']:.1f} s at feed"
    alarms = card_html(run.alarms)
    return f'<div role="status">{"" if alarms else "no alarms; "}{figures}</div>{alarms}'
