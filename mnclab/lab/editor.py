"""A part program to type in: its text, its alarms and its picture, all of them while one types; and a file to save to.

The text box is a plain one wherever widgets are shown. In JupyterLab the Lab extension puts an editor in its place
(`labextension/static/editor.js`): line numbers, colours, faults underlined, words explained, Ctrl+S, a click on a move goes
to its line. For that the alarms carry their places as data.

The front end holds typing back while the kernel is busy, so that nothing need be delayed here; a change that comes back
to the same text draws nothing. Programs are run and figures drawn in the one drawing thread of `lab.forms`:
where that takes long, one types on beside the last good picture, and texts typed over in the meantime are not run.
"""

from __future__ import annotations

import json
import os
from html import escape
from pathlib import Path
from typing import Any
from weakref import WeakValueDictionary

from mnclab.controls.choice import choose, read_text
from mnclab.controls.choice import run as run_text
from mnclab.lab.forms.live import DRAWING, SIZE, live_class, verdict, widgets
from mnclab.machine.setup import Setup
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm
from mnclab.text.file import decode, read, reason, replaced
from mnclab.text.given import fitting, shown

FIRST = 10.0  # s for the first picture, which has none before it
PATIENCE = 0.5  # s; work that takes longer goes on elsewhere, and what was good last stays in sight
PAST = "mnclab-past"  # alarms of a text that was typed over
OPENED: WeakValueDictionary[Path, Any] = WeakValueDictionary()  # a cell that is run again finds what was typed and not saved
MARKED = 100  # faults that are underlined at most


class Document:
    """A file and what was read from it: line ends and code page are kept, a change elsewhere is noticed."""

    def __init__(self, path: Path) -> None:
        self.path, self.encoding, self.ends, self.content, self.text = path, "utf-8", "\n", b"", ""
        self.told: bytes | None = None  # a change elsewhere that was told of
        try:
            os.stat(path)
        except FileNotFoundError:
            return
        except (OSError, ValueError) as error:
            raise Alarm(f"{shown(str(path))} cannot be opened: {reason(error)}") from None
        self.content = read(path, path)
        text, self.encoding = decode(self.content)
        if self.content.startswith(b"\xef\xbb\xbf"):
            self.encoding = "utf-8-sig"  # with its byte order mark
        self.ends = "\r\n" if "\r\n" in text else "\n"
        self.text = text.replace("\r\n", "\n")

    def save(self, text: str, over: bool = True) -> None:
        """Write the text; an Alarm for letters it cannot hold, or a change since it was read; asked again, `over` that one."""
        found = read(self.path, self.path) if self.path.exists() else b""
        if found != self.content and not (over and found == self.told):
            self.told = found
            raise Alarm(f"not saved: {self.path.name} was changed elsewhere. Save again to write over it, "
                        "or run the cell again to read it")  # fmt: skip
        content = self._encoded(text.replace("\n", self.ends))
        with replaced(self.path) as beside:
            beside.write_bytes(content)
        self.content, self.text = content, text

    def _encoded(self, text: str) -> bytes:
        try:
            return text.encode(self.encoding)
        except UnicodeEncodeError as error:
            letter = text[error.start]
            raise Alarm(f"{letter!r} cannot be written in {self.encoding}, the code page of {self.path}") from None


@fitting
def editor(path: str | Path, control: str | None = None, setup: Setup | None = None, *, view: str = "auto") -> Any:
    """Text, alarms and picture of a part program side by side (needs ipywidgets and matplotlib).

    A file that does not exist yet is made when it is saved. The result has `text`, `button` and `status` (boxes),
    `run` (the last run) and `document`.

    >>> mnc.editor("new.mnc", "mnc").text.value
    ''
    """
    if not isinstance(path, str | Path):
        raise Alarm(f"an editor is opened on the path of a file, got {shown(path)}")
    if control is not None:
        choose(control, "", "")
    return opened(Path(path), control, setup, view)


def opened(
    path: Path, control: str | None, setup: Setup | None, view: str = "auto", begins: str = "", program: bool = True
) -> Any:
    """The same; a new file `begins` as a text, and what is no `program` is not run."""
    ipywidgets = widgets("editors")
    document, whole = Document(path), path.absolute()
    document.text = document.text or begins
    former = OPENED.get(whole)
    known = former.text.value if former is not None and former.document.content == document.content else document.text
    size, said = {"width": "34em", "height": "26em"}, "part program" if program else "answer"
    text = ipywidgets.Textarea(known, description=said, layout=size, continuous_update=True)
    button = ipywidgets.Button(description="Save", tooltip=f"write {path}")
    picture = ipywidgets.HTML(layout={"flex": "1 1 380px", "min_width": "380px"})  # so wide at least, or below
    status, alarms = ipywidgets.HTML(), ipywidgets.HTML()
    kept = ipywidgets.Textarea(layout={"display": "none"})  # what an editor saves: a click would overtake what was typed last
    left = ipywidgets.VBox([text, ipywidgets.HBox([button, status, kept])])
    live: Any = live_class()([ipywidgets.HBox([left, picture], layout={"flex_flow": "row wrap"}), alarms])
    name, at_work = path.name, sentence(f"{path.name}: at work")
    live.title, live.boxes = name, {"text": text}
    named = {"editor": text, "save": button, "kept": kept, "picture": picture, "alarms": alarms, "live": live}
    for place, box in named.items():
        box.add_class(f"mnclab-{place}")

    def check(_: Any = None) -> None:
        source = text.value if text.value.endswith("\n") else text.value + "\n"
        state()
        live.source = source
        future = DRAWING.submit(work, source)
        try:
            future.result(FIRST if live.run is None else PATIENCE)
        except TimeoutError:
            status.value = at_work  # what was good last stays in sight, its alarms dimmed
            alarms.add_class(PAST)
            future.add_done_callback(lambda done: fresh() if live.source == source else None)
        else:
            alarms.remove_class(PAST)

    def fresh() -> None:
        alarms.remove_class(PAST)
        if status.value == at_work:  # and not that it could not be saved
            state()

    def state() -> None:
        stands = "changed" if text.value != document.text else "saved" if document.content else "new"
        status.value = sentence(f"{name}: {stands}")

    def work(source: str) -> None:
        if live.source != source or not program:  # typed over in the meantime
            return
        try:
            run = run_text(read_text(source, name, control, str(document.path.parent)), None, setup)
            moved = bool(run.toolpath.is_motion.any())
            drawn = run.plot(view=view, size=SIZE).html() if moved or live.run is None else ""  # type: ignore[attr-defined]
            told = marked(run)
        except Alarm as alarm:
            if live.source == source:
                alarms.value = alarm._repr_html_()
            return
        if live.source == source:
            live.run, alarms.value = run, told
            picture.value = drawn or picture.value  # what was good last stays in sight, dimmed
            (picture.remove_class if drawn else picture.add_class)(PAST)
            live.renew()

    def keep(change: dict[str, Any]) -> None:
        if change["new"]:  # behind the sign of what to do: an empty program can be saved too
            live.sent[change["new"][0]](change["new"][1:])
            kept.value = ""

    def save(source: str, over: bool = True) -> None:
        try:
            document.save(source, over)
        except Alarm as alarm:
            status.value = sentence(alarm.message, fault=True)
        else:
            status.value = sentence(f"{name}: saved")

    live.text, live.button, live.status, live.picture, live.alarms = text, button, status, picture, alarms
    live.run, live.document, live.source, live.save, live.sent = None, document, "", save, {"=": save}
    OPENED[whole] = live
    check()
    text.observe(check, "value")
    button.on_click(lambda _: save(text.value))
    kept.observe(keep, "value")
    return live


def sentence(text: str, fault: bool = False) -> str:
    """What is said beside the buttons."""
    return f'<span style="display:block;line-height:1.35" role="{"alert" if fault else "status"}">{escape(text)}</span>'


def marked(run: Run) -> str:
    """The alarms of a run and its figures, with the places in its text for what underlines them."""
    here = [alarm for alarm in run.alarms if alarm.span and not alarm.span.program][:MARKED]
    kept = ("line", "column", "length", "severity", "message")
    faults = json.dumps([{name: alarm.as_dict()[name] for name in kept} for alarm in here])
    return f'<div data-control="{run.control.name}" data-faults="{escape(faults)}">{verdict(run)}</div>'
