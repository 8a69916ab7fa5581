"""One HTML text with everything inside, shown in a frame of its own."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Sequence
from functools import cached_property
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from mnclab.path.profile import Profile
from mnclab.show.looks import player_css
from mnclab.show.player.payload import payload
from mnclab.show.probed import felt
from mnclab.text.alarm import Alarm, several
from mnclab.text.file import printable, replaced
from mnclab.text.given import check_number, choice, fitting_class
from mnclab.workpiece.collision import Collision
from mnclab.workpiece.cutting import Cutting

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture

SCRIPTS = (
    "data", "shapes", "camera", "strokes", "curves", "touches", "picture", "curve", "listing", "state", "points", "measure",
    "player",
)  # fmt: skip
#: What is only in the pages that cut, by whether the machine is a lathe.
CUTTING = {
    False: ("swept", "heights", "carving", "relief", "shaded", "surface", "shown_part"),
    True: ("section", "rims"),
}
ROOM = "clamp(480px, 100vh - 210px, 640px)"  # below a cell of three lines in JupyterLab, down to its buttons
THEMES = ("auto", "light", "dark")
#: Tells the frames of a notebook whether its theme is dark (JupyterLab, VS Code), when they ask and when it changes.
#: Where the scripts of outputs do not run, a page follows the system's choice.
FOLLOW = """
if (!window.mnclabPlayers) {
  window.mnclabPlayers = true;
  const dark = () => document.body.dataset.jpThemeLight === "false" || document.body.classList.contains("vscode-dark");
  const known = () => "jpThemeLight" in document.body.dataset || document.body.className.includes("vscode-");
  const tell = frame => known() && frame.postMessage({mnclab: dark() ? "dark" : "light"}, "*");
  addEventListener("message", event => event.data && event.data.mnclab === "theme?" && tell(event.source));
  new MutationObserver(() => document.querySelectorAll("iframe.mnclab-player").forEach(each => tell(each.contentWindow)))
    .observe(document.body, {attributes: true, attributeFilter: ["class", "data-jp-theme-light"]});
}
"""
HIDE = 'document.querySelectorAll(".mnclab-player-still").forEach(each => { each.hidden = true; });'
#: What a browser lets the page do: run its own script in its own style, and ask nobody for anything.
POLICY = (
    "default-src 'none'; script-src 'sha256-{script}'; style-src 'sha256-{style}'; img-src data:; "
    "base-uri 'none'; form-action 'none'"
)


def _digest(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def _short(script: str) -> str:
    """A script without its indents and its lines of comment, which would be in every page."""
    return re.sub(r"(?m)^ *//.*\n|^ +", "", script)


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
        here = files("mnclab.show.player")
        text = {name: here.joinpath(name).read_text("utf-8") for name in ("page.html", "page.css")}
        probed = felt(self.run)
        shown = self.cutting or (probed is not None and probed.part is not None and not self.run.toolpath.lathe)
        names = [*(CUTTING[self.run.toolpath.lathe] if shown else ()), *SCRIPTS]
        scripts = "\n".join(_short(here.joinpath(f"{name}.js").read_text("utf-8")) for name in names)
        script, style = f'\n"use strict";\n{scripts}\n', f"\n{player_css()}\n{text['page.css']}\n"
        parts = {
            "title": escape(f"{self.name} on {self.run.control.title}"),
            "theme": self.theme,
            "speed": f"{self.speed:g}",
            "policy": POLICY.format(script=_digest(script), style=_digest(style)),
            "style": style,
            "data": payload(self.run, self.profile, self.cutting, self.collisions, probed),
            "script": script,
            "still": self.still,
        }
        return printable(re.sub("@([a-z]+)@", lambda place: parts[place[1]], text["page.html"]))

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
            f"<script>{FOLLOW}</script>"
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
