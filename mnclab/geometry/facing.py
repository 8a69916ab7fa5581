"""Places where a contour faces itself."""

from __future__ import annotations


def facing() -> None:
    """To be done."""
