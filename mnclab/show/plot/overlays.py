"""What is drawn over the path of a run, unless it is not wanted."""

from __future__ import annotations

from typing import Any

from mnclab.show.plot.centres import centres_of
from mnclab.show.plot.fixtures import fixtures_of
from mnclab.show.plot.holes import holes_of
from mnclab.show.plot.original import original_of
from mnclab.show.plot.overlay import Overlay
from mnclab.show.plot.polar import polar_of
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown


def overlays_of(run: Any, centres: bool | None, original: bool, holes: bool, fixtures: bool) -> list[Overlay]:
    """Centres of arcs, the contour as written, holes and fixtures of a run."""
    for name, given in {"centres": centres, "original": original, "holes": holes, "fixtures": fixtures}.items():
        if not isinstance(given, bool | None):
            raise Alarm(f"{name} must be True or False, got {shown(given)}")
    found: list[Overlay | None] = [fixtures_of(run) if fixtures else None, original_of(run) if original else None]
    found += [holes_of(run) if holes else None, polar_of(run), centres_of(run, centres)]
    return [each for each in found if each is not None]
