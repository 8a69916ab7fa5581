"""Programs of the TNC 620 in tests: run a text, run the inside of a program, see the moves of the tool axis."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

import mnclab as mnc

Runner = Callable[..., mnc.Run]


@pytest.fixture
def tnc() -> Runner:
    """Run a program; `setup` and single `settings` may be given."""

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
    """The rows of a run in the notation of the manual's sequences: `Z22 FMAX`, `Z15 F250`, `dwell 0.1 s`."""

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


THREADING = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-threading.json"


@pytest.fixture(scope="session")
def printed() -> dict[int, dict[str, str]]:
    """The definitions that chapter 5 prints: number of the cycle -> its Q parameters as they are written, in order."""
    examples = json.loads(THREADING.read_text(encoding="utf-8"))
    found = {int(e["code"].split()[-1]): e["program"] for e in examples if e["code"].startswith("CYCL DEF")}
    return {number: dict(re.findall(r"(Q\d+)=(\S+)", text)) for number, text in found.items()}


@pytest.fixture(scope="session")
def called(printed: dict[int, dict[str, str]]) -> Runner:
    """Run a printed definition, with some Q parameters changed, at X0 Y0 from Z100; `start` is written before it.

    Tool 3 has a radius of 3, or the one given; the definition begins in line 4, its parameters follow one a line.
    """

    def run(
        number: int, start: str = "M3", radius: float = 3, pitch: float = 0, speed: float = 500, unit: str = "MM",
        limits: mnc.Limits | None = None, settings: dict[str, object] | None = None, **changed: object,
    ) -> mnc.Run:  # fmt: skip
        values = printed[number] | {address: str(value) for address, value in changed.items()}
        lines = [f"{address}={value}" for address, value in values.items() if value != "None"]
        tools = {3: mnc.Tool(radius=radius, pitch=pitch)}
        setup = mnc.Setup(tools=tools, limits=limits or mnc.Limits(), settings=settings or {})
        return mnc.run(
            f"0 BEGIN PGM A {unit}\n1 TOOL CALL 3 Z S{speed:g} F333\n2 L X+0 Y+0 Z+100 R0 FMAX {start}\n"
            + "\n".join([f"3 CYCL DEF {number} X", *lines, "4 CYCL CALL", f"99 END PGM A {unit}\n"]),
            "tnc-620",
            setup,
        )

    return run


@pytest.fixture(scope="session")
def rows() -> Callable[[mnc.Run], mnc.Toolpath]:
    """The rows of the cycles of a run that ended well."""

    def of(run: mnc.Run) -> mnc.Toolpath:
        assert run.ok, run.alarms
        path = run.toolpath
        return path[[path.labels[k].startswith("CYCL DEF") for k in path.label]]

    return of
