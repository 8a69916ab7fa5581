"""Reference points of the machine: G28."""

from __future__ import annotations

from mnclab.controls.g43.language.motion import targets
from mnclab.controls.g43.remarks import ISO, undescribed
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()


@FUNCTIONS("G28", "Return to the reference point", takes="X Y Z", still=True, modal=False, source=ISO)
def reference(m: Machine, words: Words) -> None:
    """The axes written go to their points at rapid, then to machine zero; without axes all go at once."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    if to := targets(m, words):
        m.rapid(**to)
    home = m.to_program((0.0, 0.0, -m.tool.effective_length))
    m.rapid(**{axis: home[k] for k, axis in enumerate(AXES.lower()) if axis in to or not to})
