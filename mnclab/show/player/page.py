"""One HTML text with everything inside, shown in a frame of its own."""

from __future__ import annotations

import base64
import hashlib
import re
import zlib
from collections.abc import Sequence
from functools import cached_property
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from mnclab.path.profile import Profile
from mnclab.show.looks import player_css
from mnclab.show.player.machine import turns
from mnclab.show.player.payload import payload
from mnclab.show.probed import felt
from mnclab.text.alarm import Alarm, several
from mnclab.text.file import printable, replaced
from mnclab.text.given import check_number, choice, fitting_class
from mnclab.text.opening import opened
from mnclab.workpiece.collision import Collision
from mnclab.workpiece.cutting import Cutting

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture

SCRIPTS = (
    "data", "shapes", "camera", "strokes", "curves", "touches", "picture", "curve", "listing", "state", "points", "measure",
    "conditions", "stops", "shades", "player",
)  # fmt: skip
#: What is only in the pages that cut, by whether the machine is a lathe.
CUTTING = {
    False: (
        "swept", "leaning", "heights", "walls", "carving", "space", "bodies", "patch", "relief", "shaded", "surface",
        "shown_part",
    ),
    True: ("space", "bodies", "columns", "turned", "section", "rims"),
}  # fmt: skip
#: What is only in the pages of machines whose rotary axes swing the tip.
TURNING = ("chain",)
ROOM = "max(480px, 100vh - 210px)"  # below a cell of three lines in JupyterLab, down to its buttons
THEMES = ("auto", "light", "dark")
HIDE = 'document.querySelectorAll(".mnclab-player-still").forEach(each => { each.hidden = true; });'


def _digest(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def _read(name: str) -> str:
    return files("mnclab.show.player").joinpath(name).read_text("utf-8")


def _colours() -> str:
    """The colours of programs, as the editor has them; none where its wing was left out."""
    try:
        module = opened("mnclab.lab", "languages")().replace("export {", "return {")
        return f"const {{LANGUAGES, tokenOf}} = (() => {{{module}}})();"
    except Alarm:
        return "const LANGUAGES = [];"


def _short(script: str) -> str:
    """A script without its indents and its comments, which would be in every page."""
    return re.sub(r"(?m)^ *//.*\n|^ +|  // .*$", "", script)


@fitting_class
class Player:
    """A run to be played; shows itself in a notebook, `save` writes it as a page of its own.

    `page` is the whole page as text; it asks no network for anything. The frame in a notebook is sandboxed: its
    scripts see nothing but the page.
    """

    def __init__(
        self, run: Any, profile: Profile, cutting: Cutting | None = None, collisions: Sequence[Collision] = (),
        *, height: int | None = None, theme: str = "auto", speed: float = 1.0,
    ) -> None:  # fmt: skip
        for name, number in (("speed", speed), ("height", 1 if height is None else height)):
            check_number(number, name, above=0)
        self.run, self.profile, self.cutting, self.collisions = run, profile, cutting, collisions
        self.height = ROOM if height is None else f"{int(height):d}px"
        self.theme, self.speed = choice(theme, "theme", THEMES), speed

    @property
    def name(self) -> str:
        return printable(self.run.program.title)

    @cached_property
    def page(self) -> str:
        """The page: markup, style, data and scripts in one text."""
        probed = felt(self.run)
        shown = self.cutting or (probed is not None and probed.part is not None and not self.run.toolpath.lathe)
        names = [*(CUTTING[self.run.toolpath.lathe] if shown else ()), *(TURNING if turns(self.run.toolpath) else ()), *SCRIPTS]
        scripts = "\n".join(map(_short, (_colours(), *(_read(f"{name}.js") for name in names))))
        script, begin = f'"use strict";\n{scripts}\n', f"\n{_short(_read('begin.js'))}\n"
        style = f"\n{player_css()}\n{_read('page.css')}\n"
        parts = {
            "title": escape(f"{self.name} on {self.run.control.title}"),
            "theme": self.theme,
            "speed": f"{self.speed:g}",
            "scripthash": _digest(script),
            "beginhash": _digest(begin),
            "stylehash": _digest(style),
            "style": style,
            "data": payload(self.run, self.profile, self.cutting, self.collisions, probed),
            "script": base64.b64encode(zlib.compress(script.encode(), 9)).decode(),
            "begin": begin,
            "still": self.still,
        }
        return printable(re.sub("@([a-z]+)@", lambda place: parts[place[1]], _read("page.html")))

    @cached_property
    def picture(self) -> Picture | None:
        """The path as a figure, for where no scripts run; None where a figure of it is refused or matplotlib is not there."""
        try:
            from mnclab.show.plot.path import plot_run

            return cast("Picture", plot_run(self.run))
        except Alarm:
            return None

    @cached_property
    def still(self) -> str:
        """The same in the page."""
        if self.picture is None:
            return ""
        data = base64.b64encode(self.picture.png()).decode()
        return f'<img alt="{escape(self.picture.alt)}" src="data:image/png;base64,{data}">'

    def save(self, path: str | Path) -> Path:
        """Write the page to a file and return its path; an Alarm if it cannot be written."""
        with replaced(path) as beside:
            self.write(beside)
        return Path(path)

    def write(self, path: Path) -> None:
        path.write_text(self.page, "utf-8", newline="\n")

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """The page, and for where no script runs a picture of the path: it is seen until a script hides it."""
        if self.picture is None:
            return {"text/html": self._repr_html_(), "text/plain": repr(self)}
        still = self.picture._repr_mimebundle_()
        picture = f'<div class="mnclab-player-still">{still["text/html"]}</div><script>{HIDE}</script>'
        return {"text/html": picture + self._repr_html_(), "image/png": still["image/png"], "text/plain": repr(self)}

    def _repr_html_(self) -> str:
        name = escape(f"player of {self.name}", quote=True)
        return (
            f"<script>{_short(_read('notebook.js'))}</script>"
            f'<iframe class="mnclab-player" title="{name}" sandbox="allow-scripts" loading="eager" '
            f'style="width: 100%; height: {self.height}; border: 0; border-radius: 6px" '
            f'srcdoc="{escape(self.page, quote=True)}"></iframe>'
        )

    def __repr__(self) -> str:
        moves = several(int(self.run.toolpath.is_motion.sum()), "move")
        return f"<Player of {self.name}: {moves}, {self.profile.time:.1f} s; save it as .html>"


def player(
    run: Any, profile: Profile | None = None, cutting: Cutting | None = None, collisions: Sequence[Collision] = (),
    **options: Any,
) -> Player:  # fmt: skip
    """The player of a run under a feed-rate profile (that of its own setup if none is given).

    With a `cutting` the page cuts the blank as it plays; `collisions` are marked in the text and over time.
    `height` in pixels of the frame in a notebook (else what a screen has room for), `theme` "auto", "light" or "dark",
    `speed` 1 for real time.
    """
    return Player(run, profile or run.profile(), cutting, collisions, **options)
