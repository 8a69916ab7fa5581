"""What follows the boxes of a form or a panel: the picture, the alarms, the figures of the run.

JupyterLab calls widgets from another thread than cells, so figures are drawn in **one** thread, `DRAWING`, and without
pyplot; nobody else starts threads.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from html import escape
from typing import Any

from mnclab.controls.choice import run as run_text
from mnclab.machine.setup import Setup
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm, card_html

DRAWING = ThreadPoolExecutor(1, thread_name_prefix="drawing")
SIZE = (6.4, 4.4)  # inches, of a picture beside boxes

Work = tuple[Callable[[], Any], str]  # what draws the picture, and what is said below it


def following(
    boxes: dict[str, Any], rows: Any, work: Callable[[Any], Work | None], *also: Any, beside: bool = False
) -> Any:
    """Rows of boxes, with a picture and alarms below or beside them; `work` is done when a box, or one `also`, changes."""
    import ipywidgets

    picture, alarms = ipywidgets.HTML(), ipywidgets.HTML()
    live: Any = ipywidgets.VBox([rows, picture, alarms])
    if beside:
        right = ipywidgets.VBox([picture, alarms], layout={"flex": "1 1 460px"})  # at least so wide, or it goes below
        live = ipywidgets.VBox([ipywidgets.HBox([rows, right], layout={"flex_flow": "row wrap"})])
    live.boxes, live.picture, live.alarms, live.run = boxes, picture, alarms, None

    def changed(_: Any = None) -> None:
        try:
            done = work(live)
        except Alarm as alarm:
            alarms.value = alarm._repr_html_()
            return
        if done is not None:
            draw, said = done
            picture.value = DRAWING.submit(lambda: draw().html()).result()
            alarms.value = said

    changed()
    for box in (*boxes.values(), *also):
        box.observe(changed, "value")
    return live


def following_program(
    boxes: dict[str, Any], rows: list[Any], text: Callable[[], str | None], control: str | None,
    setup: Callable[[], Setup | None], view: str, ticks: Mapping[str, Any] | None = None,
) -> Any:  # fmt: skip
    """Boxes with the picture of a program beside them; those of a form have `ticks`, and the program below."""
    import ipywidgets

    program = ipywidgets.HTML()

    def work(live: Any) -> Work | None:
        source = text()
        if source is None:
            what = f"a program around this cycle of {escape(str(control))} is not built"
            live.picture.value = f"<p>no picture yet: {what}</p>"
            return None
        program.value = f"<pre>{escape(source)}</pre>"
        live.run = run = run_text(source, control, setup())
        return lambda: run.plot(view=view, size=SIZE), verdict(run)

    left = ipywidgets.VBox(rows if ticks is None else [*rows, program])
    return following(boxes, left, work, *(ticks or {}).values(), beside=True)


def verdict(run: Run) -> str:
    """The alarms of a run, each with its line and caret, and its figures in one line."""
    s = run.summary()
    lengths = f"cutting {s['cutting length']:.3f} mm, rapid {s['rapid length']:.3f} mm"
    figures = f"{lengths}, {s['time at feed']:.1f} s at feed"
    alarms = card_html(run.alarms)
    return f'<div role="status">{"" if alarms else "no alarms; "}{figures}</div>{alarms}'
