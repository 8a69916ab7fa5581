"""What benchmarks of one run have in common: a peer, and the table of ratios at the end."""

import shutil
import subprocess
from typing import NamedTuple

import pytest


class Ratio(NamedTuple):
    """A row of the table: what was done, how often as fast as the peer it is, and what is to be held."""

    work: str
    ours: float
    peer: str
    theirs: float
    ratio: float
    held: str


TABLE: list[Ratio] = []


@pytest.fixture
def told():
    """Says a row: work, seconds, peer, its seconds, what is to be held; `times` where ours is a time in theirs, no rate."""

    def say(work, ours, peer, theirs, held, times=False):
        ratio, sign = (ours / theirs, "≤") if times else (theirs / ours, "≥")
        TABLE.append(Ratio(work, ours, peer, theirs, ratio, f"{sign} {held}"))

    return say


@pytest.fixture
def rs274(tmp_path):
    """Runs a program on rs274, to nowhere; a test that asks for it is skipped where there is none."""
    if not shutil.which("rs274"):
        pytest.skip("rs274 is not installed")
    (tmp_path / "tool.tbl").write_text(f"T1 P1 D{6 / 25.4:.6f} Z0 ;end mill of 6 mm\n")

    def interpret(name, text):
        path = tmp_path / f"{name}.ngc"
        path.write_text(text)
        command = ["rs274", "-g", "-t", str(tmp_path / "tool.tbl"), str(path), "/dev/null"]
        return lambda: subprocess.run(command, check=True, capture_output=True, cwd=tmp_path)

    return interpret


def pytest_terminal_summary(terminalreporter):
    if TABLE:
        terminalreporter.section("ratios of one run, processor seconds")
        terminalreporter.line(f"{'work':44s}{'s':>8s}  {'peer':24s}{'s':>8s}{'ratio':>9s}   to hold")
    for row in TABLE:
        terminalreporter.line(f"{row.work:44s}{row.ours:8.3f}  {row.peer:24s}{row.theirs:8.3f}{row.ratio:9.2f}   {row.held}")
