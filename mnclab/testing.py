"""For the tests of who writes a post processor: `mnclab.testing.assert_same_motion("part.nc", "part.h")`.

A step of a CI that needs no machine and no network::

    def test_the_post_says_what_it_should():
        assert_same_motion("tests/part.nc", my_post("tests/part.cam"), setup="tests/machine.toml")
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import mnclab


def assert_same_motion(a: Any, b: Any, tolerance: float = 0.001, *, allow: Collection[str] = (), setup: Any = None) -> None:
    """Fail with the first difference, its lines, blocks and places, unless two programs make the same motion.

    See `mnclab.prove` for the arguments: `a` is the program that is trusted, `b` the one that is tested, `tolerance` in mm.
    """
    found = mnclab.prove(a, b, tolerance=tolerance, allow=allow, setup=setup)
    if found:
        raise AssertionError(f"not the same motion within {tolerance:g} mm\n{found}")
