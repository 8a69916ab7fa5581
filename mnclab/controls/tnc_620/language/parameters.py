"""Q parameters: formulas and the functions FN 0 to FN 5 (catalogue: Q parameters, FN, Q formula)."""

from __future__ import annotations

from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()

TITLES = {
    "FN 0": "Assignment", "FN 1": "Addition", "FN 2": "Subtraction", "FN 3": "Multiplication", "FN 4": "Division",
    "FN 5": "Square root", "Q": "Formula",
}  # fmt: skip


@FUNCTIONS(", ".join(TITLES), TITLES, takes="target value", collects=True, source="FN")
def assign(m: Machine, words: Words) -> None:
    """A Q parameter takes the value of its formula, with the variables as they stand."""
    m.variables[str(words["target"].value)] = m.value(words["value"])
