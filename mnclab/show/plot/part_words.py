"""What stands in words beside the picture of a part."""

from __future__ import annotations

from mnclab.workpiece.workpiece import Workpiece


def told(part: Workpiece) -> str:
    """How a part was found, how exact it is, what was removed, and what is to be noted."""
    return "\n".join([f"{part.method}{part.error_told}; {part.removed:.3f} mm³ removed", *part.notes])


def in_words(part: Workpiece) -> str:
    """What a person who cannot see the picture is told."""
    return f"the part: {part.volume:.3f} mm³ left, {part.removed:.3f} mm³ removed"
