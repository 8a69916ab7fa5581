"""The time of day, which a run has only where the setting `clock` gives it one."""

from __future__ import annotations

from datetime import UTC, datetime

from mnclab.machine.machine import Machine


def time_of_day(m: Machine) -> datetime | None:
    """The time in UTC; None where nothing says it. An Alarm if the setting is no time."""
    clock = float(m.settings["clock"])
    try:
        return datetime.fromtimestamp(clock, UTC) if clock else None
    except (ValueError, OverflowError, OSError):
        m.alarm(f"setting clock: {clock:g} seconds from 1970 are no time that can be written")
