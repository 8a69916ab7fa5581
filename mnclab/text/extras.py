"""Packages that mnclab can do without: who needs one says so, and an alarm names the extra that brings it."""

from __future__ import annotations

from importlib import import_module

from mnclab.text.alarm import Alarm


def require(package: str, what: str, extra: str = "lab", instead: str = "") -> None:
    """An Alarm where a package is not installed, or not whole: `what` needs it."""
    try:
        import_module(package)
    except ImportError:
        hint = f'pip install "mnclab[{extra}]" brings it' + (f"; {instead}" if instead else "")
        raise Alarm(f"{what} need {package}, which is not installed here", hint=hint) from None
