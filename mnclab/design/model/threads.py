"""Metric threads as a drawing names them: "M8" with its coarse pitch (ISO 261), "M8x1" with its own."""

from __future__ import annotations

import re
from typing import Any

from mnclab.text.alarm import Alarm
from mnclab.text.given import shown

#: Coarse pitches by nominal diameter, mm.
COARSE = {
    1.6: 0.35, 2.0: 0.4, 2.5: 0.45, 3.0: 0.5, 4.0: 0.7, 5.0: 0.8, 6.0: 1.0, 8.0: 1.25, 10.0: 1.5, 12.0: 1.75, 14.0: 2.0,
    16.0: 2.0, 18.0: 2.5, 20.0: 2.5, 22.0: 2.5, 24.0: 3.0, 27.0: 3.0, 30.0: 3.5, 33.0: 3.5, 36.0: 4.0, 39.0: 4.0,
    42.0: 4.5, 45.0: 4.5, 48.0: 5.0, 52.0: 5.0, 56.0: 5.5, 60.0: 5.5, 64.0: 6.0,
}  # fmt: skip
WRITTEN = re.compile(r"[Mm]\s?(\d+(?:\.\d+)?)(?:\s?[xX×]\s?(\d+(?:\.\d+)?))?")


def metric(written: Any) -> tuple[float, float]:
    """Nominal diameter and pitch of a designation, mm."""
    found = WRITTEN.fullmatch(written.strip()) if isinstance(written, str) and len(written) < 40 else None
    if not found:
        raise Alarm(f"a thread is M and its diameter, with x and the pitch if it is fine, got {shown(written)}", hint="M8, M8x1")
    wide = float(found[1])
    if found[2]:
        pitch = float(found[2])
    elif wide in COARSE:
        pitch = COARSE[wide]
    else:
        raise Alarm(f"M{wide:g} has no coarse pitch, name its pitch", hint=f"M{wide:g}x1")
    if not 0 < pitch < wide:
        raise Alarm(f"the pitch of a thread is between 0 and its diameter, {wide:g}, got {pitch:g}")
    return wide, pitch


def core_of(written: Any, pitches: float = 1.0) -> float:
    """The hole that a thread is cut in: the nominal diameter less the pitch, or less so many pitches, mm."""
    wide, pitch = metric(written)
    return wide - pitches * pitch
