"""Numbers by their names that print as people read them, and keep all their digits."""

from __future__ import annotations

from typing import Any

DECIMALS = 3  # as the display of a control


class Rounded(dict[Any, float]):
    """A dict of numbers; it prints them with at most three decimals.

    >>> Rounded(cutting=2.911161243192578)
    {'cutting': 2.911}
    """

    def __repr__(self) -> str:
        return repr({key: round(value, DECIMALS) for key, value in self.items()})
