"""Seeds of random tasks: a few of them with the fast tests, all others with the deep ones."""

from __future__ import annotations

from typing import Any

import pytest


def seeds(few: int, *, deep: int) -> list[Any]:
    """The seeds from 0 up to `deep` as parameters: the first `few` are fast tests, those after them deep ones."""
    return [*range(few), *(pytest.param(seed, marks=pytest.mark.deep) for seed in range(few, deep))]
