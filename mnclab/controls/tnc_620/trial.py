"""A cycle of the TNC 620 in a program of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mnclab.controls.tnc_620.reading import obsolete_blocks
from mnclab.machine.cycle import Cycle
from mnclab.machine.trial import number


def klartext(value: float | str) -> str:
    """A number with its sign, a text in quotes."""
    return f'"{value}"' if isinstance(value, str) else ("" if value < 0 else "+") + number(value)


def as_sub_blocks(cycle: type[Cycle], words: Sequence[tuple[str, Any]]) -> list[str]:
    """The lines of an obsolete cycle, which has no Q parameters."""
    plain = ("DWELL", "F", "PECKG:F")
    texts = {address: number(value) if address in plain else klartext(value) for address, value in words}
    if "DR" in texts:
        texts["DR"] = texts["DR"][0]  # the sign alone
    return list(obsolete_blocks.written(int(cycle.code.split()[-1]), cycle.title.upper(), texts))


def trial_program(cycle: type[Cycle], words: Sequence[tuple[str, Any]]) -> str | None:
    """A cycle called by M99, an obsolete one at its set-up clearance; others that stand in sub-blocks have no trial."""
    obsolete = cycle.code in obsolete_blocks.CODES
    if not obsolete and (not words or not all(address.startswith("Q") for address, _ in words)):
        return None
    written = [address for address, _ in words]
    lines = as_sub_blocks(cycle, words) if obsolete else []
    if not obsolete:
        lines = [" ~\n".join([f"{cycle.code} {cycle.title.upper()}", *(f"  {a}={klartext(v)}" for a, v in words)])]
    call = ["L X+20 Y+10 R0 FMAX M99"] if cycle.runs == "call" else []
    height = next((abs(value) for address, value in words if address == "SETUP"), 50)
    mills = "PECKG:F" in written or ("Q207" in written and "Q239" not in written)
    tool = 1 if mills else 2  # an end mill; for holes and their threads the drill
    start = ["BEGIN PGM TRIAL MM", f"TOOL CALL {tool} Z S1000", f"L X+0 Y+0 Z{klartext(height)} R0 FMAX M3"]
    if cycle.code in ("CYCL DEF 220", "CYCL DEF 221"):  # which run the cycle before them
        start += ["CYCL DEF 200 DRILLING", *"Q200=2 Q201=-15 Q206=120 Q202=5 Q210=0 Q203=0 Q204=20 Q211=0".split()]
    return "\n".join([*start, *lines, *call, "END PGM TRIAL MM", ""])
