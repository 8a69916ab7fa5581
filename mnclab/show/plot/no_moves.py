"""What is said in the place of a picture where nothing moved: that, and the alarm that stopped the program."""

from __future__ import annotations

import textwrap

from mnclab.show.plot import colours
from mnclab.show.plot.picture import LINE, SMALL, Foot, Picture
from mnclab.text.alarm import Alarm

WIDE, LETTERS = 4.6, 70  # inches, and how many letters they hold


def no_moves(stop: Alarm | None) -> Picture:
    """A strip with words: axes around nothing would show a scale that means nothing."""
    said = textwrap.wrap(Foot.of(stop).text, LETTERS)[:6] if stop else []
    place = f"; stopped in line {stop.span.line}" if stop and stop.span else ""
    picture = Picture((WIDE, 0.4 + LINE * len(said)), f"tool path: no moves{place}")
    high = picture.get_figheight()
    picture.text(0.1 / WIDE, 1 - 0.1 / high, "no moves", fontsize=SMALL + 2, color=colours.INK, va="top")
    for k, line in enumerate(said):
        down = 0.34 + LINE * k
        picture.text(0.1 / WIDE, 1 - down / high, line, fontsize=SMALL, color=colours.ALARM.colour, va="top", parse_math=False)
    return picture
