"""A fault found in a pass: it knows the step of its row, and the machine knows which block that was."""

from __future__ import annotations


class PathFault(Exception):
    """What does not fit, at the `step` of the row concerned."""

    def __init__(self, message: str, step: int, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.step, self.hint = message, step, hint
