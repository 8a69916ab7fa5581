"""What a teacher says of a program that its control obeys without a word: warnings, none of which stops a run.

Each rule stands in a file of its own and says only what is certain: a rule that must guess is silent. The setting `lint`
switches them off together, `stopped_spindle` the one of the spindle alone. An arc without a radius, which is found word by
word, is remarked where its control obeys it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from mnclab.runs.lint import beyond_machine, forgotten, motion
from mnclab.text.alarm import Alarm

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine
    from mnclab.runs.run import Run


def remarked(run: Run, m: Machine) -> list[Alarm]:
    """The alarms of a run and these warnings; what was told of blocks that it did not come to is not told twice."""
    found = [*remarks(run, m)]
    said = {alarm.message for alarm in found}
    return [*(alarm for alarm in run.alarms if alarm.message not in said), *found]


def remarks(run: Run, m: Machine) -> Iterator[Alarm]:
    """The warnings about a run, one for each cause."""
    if run.settings["lint"] == "off" or not len(run.steps.block):
        return
    yield from forgotten.still_spindle(m, run.toolpath)
    for remarks_of in (
        motion.rapids_in_blank, forgotten.above_blank, forgotten.left_on, forgotten.unused, motion.remarks,
        forgotten.feed_of_another_unit, beyond_machine.remarks,
    ):  # fmt: skip
        yield from remarks_of(run)
