"""How the rapids of a run go: the one rule for plots, scene, player and report."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from mnclab.path.limits import Limits


def rapids_of(run: Any) -> Limits:
    """The limits of the setup; a rapid goes as the control has it (its setting `rapid_motion`) unless they say how."""
    limits: Limits = run.setup.limits
    return replace(limits, rapid_motion=limits.rapid_motion or str(run.settings.get("rapid_motion", "line")))
