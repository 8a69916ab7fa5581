"""What follows the boxes of a form or a panel: the picture, the alarms, the figures of the run.

JupyterLab calls widgets from another thread than cells, so figures are drawn in **one** thread, `DRAWING`, and without
pyplot; nobody else starts threads. A picture keeps the limits of the one before and shows its path as a ghost; where a
value is refused the last good picture stays, greyed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

from mnclab.lab.forms.faults import at_field
from mnclab.lab.forms.fields import Field
from mnclab.lab.forms.live import PAST, live_class
from mnclab.runs.run import Run
from mnclab.text.alarm import ALARM, Alarm, card_html
from mnclab.text.opening import require

DRAWING = ThreadPoolExecutor(1, thread_name_prefix="drawing")
SIZE = (6.4, 4.4)  # inches, of a picture beside boxes


class Work(NamedTuple):
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
    boxes: Mapping[str, Any], fields: Mapping[str, Field], left: Any, work: Callable[[Any], Work | None],
    field_of: Callable[[Alarm], str] = lambda alarm: "", *also: Any, title: str = "panel", classes: str = "",
    below: Iterable[Any] = (), above: Iterable[Any] = (),
) -> Any:  # fmt: skip
    """What is `left` with the picture and the alarms beside it; `work` is done when a box, or one `also`, changes.

    A fault stands at the field that `field_of` names, one of no field above them all.
    """
    require("matplotlib", "pictures")
    import ipywidgets

    picture, alarms, first = ipywidgets.HTML(), ipywidgets.HTML(), ipywidgets.HTML()
    right = ipywidgets.VBox([picture, alarms, *below])
    column = ipywidgets.VBox([first, left])
    for part, name in ((right, "right"), (column, "left"), (first, "first"), (picture, "drawn"), (alarms, "said")):
        part.add_class(f"mnclab-{name}")
    body = ipywidgets.HBox([column, right])
    body.add_class("mnclab-body")
    live = live_class()([*above, body], f"mnclab-following {classes}")
    live.title, live.boxes, live.fields, live.picture, live.alarms = title, dict(boxes), dict(fields), picture, alarms
    live.good, live.former, live.box = False, None, None

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
                live.shown, live.box = DRAWING.submit(_drawn, done, live.former, live.box).result()
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


def _drawn(done: Work, former: Any, box: Any) -> tuple[str, Any]:
    """A picture as HTML, and what the next one keeps of it."""
    figure = done.draw(under=former, limits=box)
    return figure.html(), figure.box


def greyed(picture: str) -> str:
    """A picture that is not of the values beside it."""
    said = picture.replace('alt="', f'alt="{PAST}; ', 1)
    return f'<figure class="mnclab-past"><div>{said}</div><figcaption>{PAST}</figcaption></figure>'


def of_run(run: Run, draw: Callable[..., Any]) -> Work:
    """The work of a run: its picture, its verdict, the alarm that stopped it, and the path that the next picture shows."""
    stop = None if run.ok else next((alarm for alarm in run.alarms if alarm.severity == ALARM), None)
    return Work(draw, verdict(run), stop, run.toolpath)


def verdict(run: Run) -> str:
    """The alarms of a run, each with its line and caret, and its figures in one line."""
    s = run.summary()
    lengths = f"cutting {s['cutting length']:.3f} mm, rapid {s['rapid length']:.3f} mm"
    figures = f"{lengths}, {s['time at feed']:.1f} s at feed"
    alarms = card_html(run.alarms)
    return f'<div role="status">{"" if alarms else "no alarms; "}{figures}</div>{alarms}'
