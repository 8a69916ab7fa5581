"""A cycle of the TNC 620 in a program of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mnclab.machine.cycle import Cycle
from mnclab.machine.trial import number


def klartext(value: float | str) -> str:
    """A number with its sign, a text in quotes."""
    return f'"{value}"' if isinstance(value, str) else ("" if value < 0 else "+") + number(value)


def trial_program(cycle: type[Cycle], words: Sequence[tuple[str, Any]]) -> str | None:
    """Cycles of Q parameters, called by M99; the old ones stand in blocks of their own kind, and have no trial."""
    if not words or not all(address.startswith("Q") for address, _ in words):
        return None  # the old cycles stand in blocks of their own kind
    lines = [f"{cycle.code} {cycle.title.upper()}", *(f"  {address}={klartext(value)}" for address, value in words)]
    call = ["L X+20 Y+10 R0 FMAX M99"] if cycle.runs == "call" else []
    written = [address for address, _ in words]
    tool = 1 if "Q207" in written and "Q239" not in written else 2  # an end mill; for holes and their threads the drill
    start = ["BEGIN PGM TRIAL MM", f"TOOL CALL {tool} Z S1000", "L X+0 Y+0 Z+50 R0 FMAX M3"]
    if cycle.code in ("CYCL DEF 220", "CYCL DEF 221"):  # which run the cycle before them
        start += ["CYCL DEF 200 DRILLING", *"Q200=2 Q201=-15 Q206=120 Q202=5 Q210=0 Q203=0 Q204=20 Q211=0".split()]
    return "\n".join([*start, " ~\n".join(lines), *call, "END PGM TRIAL MM", ""])
