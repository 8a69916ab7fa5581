"""The parameters of a cycle in groups that fold: what it makes, how deep it goes, how fast, and how it is done.

The group follows from the unit of a parameter and from the words of its meaning; a cycle says nothing of it, so that one
that is added tomorrow has groups, too.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from mnclab.machine.cycle import Parameter

FEW = 8  # parameters that need no groups
SHAPE, DEPTH, FEED, STRATEGY, RESULT = (
    "Shape and place", "Depths and heights", "Feeds, speed, dwell", "Strategy", "Tolerances and results",
)  # fmt: skip
#: What a meaning says -> its group; the first that fits counts, and of what fits none the unit decides.
WORDS = (
    (RESULT, r"toleranc|limit|permissible|greatest size|least size|monitored|log\b|protocol|result|new (system|coordinate)"
             r"|datum (table|along)|preset|measured values|in table|taken over|Q parameter|beyond"),
    (FEED, r"\b(feed|feeds|dwell|speed)\b(?! reference)"),
    (DEPTH, r"depth|infeed|surface|clearance|height|level|bottom|peck|floor|retract|distance back|chip|tool axis|probe axis"
            r"|stop distance|thickness|way back|depth of cut|per pass"),
    (STRATEGY, r"strateg|operation|scope|climb|overlap|machining direction|direction of machining|kind of|sense"),
    (SHAPE, r"position|corner|angle|slot|axis|direction along|factor along|number of"),
)  # fmt: skip
BY_UNIT = {
    "choice": STRATEGY, "mark": STRATEGY, "ratio": STRATEGY, "%": STRATEGY, "count": STRATEGY, "": STRATEGY,
    "mm/min": FEED, "s": FEED, "ms": FEED, "rev/min": FEED, "0.0001 mm/rev": FEED,
}  # fmt: skip


def group_of(parameter: Parameter) -> str:
    """The group that a parameter belongs to."""
    found = (group for group, words in WORDS if re.search(words, parameter.meaning))
    return next(found, BY_UNIT.get(parameter.unit, SHAPE))


def groups(parameters: Sequence[Parameter]) -> dict[str, list[Parameter]]:
    """Parameters by the name of their group, in the order of the manual; a few of them stand in one without a name."""
    if len(parameters) <= FEW:
        return {"": list(parameters)}
    found: dict[str, list[Parameter]] = {name: [] for name in (SHAPE, DEPTH, FEED, STRATEGY, RESULT)}
    for parameter in parameters:
        found[group_of(parameter)].append(parameter)
    return {name: those for name, those in found.items() if those}
