"""Programs of the TNC 620 in tests: run a text, run the inside of a program, see the moves of the tool axis."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import mnclab as mnc

Runner = Callable[..., mnc.Run]


@pytest.fixture
def tnc() -> Runner:
    """Run a program; ``setup`` and single ``settings`` may be given."""

    def run(text: str, setup: mnc.Setup | None = None, **settings: object) -> mnc.Run:
        return mnc.run(text, "tnc-620", setup or mnc.Setup(settings=settings))

    return run


@pytest.fixture
def inside(tnc: Runner) -> Runner:
    """Run blocks behind BEGIN PGM and a TOOL CALL of a tool of radius 5 at feed 100; they begin in line 3."""

    def run(blocks: str, setup: mnc.Setup | None = None, **settings: object) -> mnc.Run:
        return tnc(f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n{blocks}\n99 END PGM A MM\n", setup, **settings)

    return run


@pytest.fixture
def drilled() -> Callable[[mnc.Run], list[str]]:
    """The rows of a run in the notation of the manual's sequences: ``Z22 FMAX``, ``Z15 F250``, ``dwell 0.1 s``."""

    def words(run: mnc.Run) -> list[str]:
        found = []
        for move in run.toolpath:
            if move.kind == mnc.Kind.DWELL:
                found.append(f"dwell {move.time:g} s")
            elif move.kind == mnc.Kind.RAPID and tuple(move.start[:2]) == tuple(move.end[:2]):
                found.append(f"Z{round(float(move.end[2]), 4):g} FMAX")
            elif move.kind == mnc.Kind.LINE:
                found.append(f"Z{round(float(move.end[2]), 4):g} F{move.feed:g}")
        return found

    return words
