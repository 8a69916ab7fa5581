"""What goes out of the control, to its PLC or to a log: here nobody listens, and the program goes on."""

from __future__ import annotations

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
TITLES = {
    "FN 19": "Values to the PLC", "FN 20": "Waiting for the PLC", "FN 29": "Values to the PLC", "FN 37": "Exporting parameters",
    "FN 38": "Sending to a log",
}  # fmt: skip
HAPPENS = {
    "FN 19": "there is no PLC that could take the values", "FN 20": "there is no PLC, and the program goes on at once",
    "FN 29": "there is no PLC that could take the values", "FN 37": "the parameters of a cycle are not exported",
    "FN 38": "there is nobody to send to",
}  # fmt: skip


@FUNCTIONS(", ".join(TITLES), TITLES, source="Klartext, not described")
def outwards(m: Machine, words: Words) -> None:
    """Nothing moves and nothing waits; a warning says so."""
    m.warn(f"{words.code} has no effect: {HAPPENS[words.code]}")
