"""Formats of words: which numbers may carry a sign or a decimal point, and blanks between an address and its number.

A format is written as manuals of such controls write it: `n` digits, `n.n` digits with a point or not, `±n` and
`±n.n` the same with a sign or not.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mnclab.text.alarm import Alarm
from mnclab.text.program import MOST_FAULTS, NUMBER, Program, TooManyFaults
from mnclab.text.words import characters

MEANING = {"n": "digits alone", "n.n": "a number without sign", "±n": "a whole number", "±n.n": "a number"}


def misformed(program: Program, formats: Mapping[str, str]) -> list[Alarm]:
    """An Alarm for each word with a blank inside, or that is not of the format of its address."""
    data = characters(program.text)
    length = program.length.astype(np.int64)
    alarms = []

    def refuse(which: NDArray[np.bool_], what: str, repair: str = "") -> None:
        for i in np.flatnonzero(which & (program.form == NUMBER)):
            address = program.addresses[program.address[i]]
            hint = repair or f"{address} takes {MEANING[formats[address]]}"
            span = program.span(int(program.offset[i]), int(length[i]))
            alarms.append(Alarm(f"{address} has {what}", span, hint=hint))
            if len(alarms) > MOST_FAULTS:
                raise TooManyFaults(span.line)

    def count(found: NDArray[np.bool_]) -> NDArray[np.int64]:
        before = np.concatenate([[0], np.cumsum(found)])
        begin = program.offset.astype(np.int64)
        return np.asarray(before[np.minimum(begin + length, len(data))] - before[begin])

    plain, whole = (
        np.isin(program.address, [k for k, name in enumerate(program.addresses) if formats.get(name, "±n.n") in kinds])
        for kinds in (("n", "n.n"), ("n", "±n"))
    )
    blanks = count((data == ord(" ")) | (data == ord("\t")))
    refuse(blanks > 0, "a blank before its number", "write the number directly after the address")
    refuse(plain & (count((data == ord("+")) | (data == ord("-"))) > 0), "a sign")
    refuse(whole & (count(data == ord(".")) > 0), "a decimal point")
    return alarms
