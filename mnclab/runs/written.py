"""Where a program has certain codes, found in its columns."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from mnclab.path.toolpath import Mask
from mnclab.text.program import NUMBER, Program

WITH_NUMBERS = "GM"  # addresses that make codes with their numbers


def blocks_with(program: Program, codes: Collection[str]) -> Mask:
    """The blocks (b,) with one of some codes, as their keyword ("CYCL CALL") or as a word ("M99")."""
    found = np.isin(program.keyword, [k for k, keyword in enumerate(program.keywords) if keyword in codes])
    for k, address in enumerate(program.addresses):
        values = [float(code[1:]) for code in codes if code[0] == address and address in WITH_NUMBERS and code[1:].isdigit()]
        if values:
            words = (program.address == k) & (program.form == NUMBER) & np.isin(program.value, values)
            found[np.searchsorted(program.first, np.flatnonzero(words), "right") - 1] = True
    return found
