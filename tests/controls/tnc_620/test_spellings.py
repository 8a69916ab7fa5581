"""One program in many spellings: 200 seeded programs, each written plainly and as oddly as the catalogue allows (NC block)."""

from __future__ import annotations

import json
import random
from pathlib import Path

import numpy as np
import pytest

import mnclab as mnc

pytestmark = pytest.mark.deep

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"
DRILL = ("Q200=2", "Q201=-{}", "Q206=FAUTO", "Q202=5", "Q210=0", "Q203=+0", "Q204=20", "Q211=0.25")
NAMES = ("", "GAURIRE", "DALTUIRE FRONTALĂ", "Bohren", "孔", "ГОРЯЧО", "DEPL. DECALARE OR.")
COMMENTS = (";DISTANTA DE SIGURANTA", "; adâncime", ";", '; "', ";Q200=7", ";L X+5")


def number(rng: random.Random) -> float:
    return rng.choice([rng.randint(-50, 50), round(rng.uniform(-50, 50), 3), rng.randint(0, 9) / 10])


def words(rng: random.Random, axes: str) -> list[str]:
    return [f"{rng.choice(['', 'I'])}{axis}{number(rng):+g}" for axis in axes if rng.random() < 0.6] or ["IX+1"]


def block(rng: random.Random) -> list[str]:
    """The lines of one block, plainly: the first is numbered, those that go on with it are not."""
    kind = rng.randrange(9)
    if kind < 4:
        feed = rng.choice(["", "", "FMAX", "FAUTO", f"F{rng.randint(1, 999)}", "FU0.5"])
        return [
            " ".join(["L", *words(rng, "XYZ"), rng.choice(["", "R0"]), feed, rng.choice(["", "M8", "M9", "M9 M3"])])
        ]
    if kind == 4:
        return [f"CC X{number(rng):+g} Y{number(rng):+g}"]
    if kind == 5:
        return ["CYCL DEF 200 {name}", *(line.format(rng.randint(1, 30)) for line in DRILL)]
    if kind == 6:
        return ["CYCL DEF 7.0 {name}", f"#CYCL DEF 7.1 X{number(rng):+g}", f"#CYCL DEF 7.2 IY{number(rng):+g}"]
    if kind == 7:
        return [f"Q{rng.randint(1, 9)} = {number(rng):+g}"]
    return [
        rng.choice(["CYCL CALL M3", "TOOL CALL 2 Z S2000 F333 DL+0.5", "FN 1: Q1 = +2 + -3.5", "L X+Q30 Y-Q30 M13"])
    ]


def program(rng: random.Random) -> list[list[str]]:
    head = [
        ["BEGIN PGM A MM"],
        ["TOOL CALL 1 Z S1000 F100"],
        ["Q30 = 1.5"],
        ["L X+0 Y+0 Z+50 FMAX M3"],
        block_of_drilling(),
    ]
    return [*head, *(block(rng) for _ in range(rng.randint(1, 25))), ["END PGM A MM"]]


def block_of_drilling() -> list[str]:
    return ["CYCL DEF 200 {name}", *(line.format(10) for line in DRILL)]


def plainly(blocks: list[list[str]]) -> str:
    out: list[str] = []
    for lines in blocks:
        for k, line in enumerate(lines):
            new = k == 0 or line.startswith("#")
            out.append(f"{len(out)} " * new + line.removeprefix("#").replace("{name}", "DRILLING"))
    return "\n".join(out) + "\n"


def oddly(blocks: list[list[str]], rng: random.Random) -> str:
    """The same blocks in another spelling."""
    numbered, lower = rng.random() < 0.7, rng.random() < 0.5
    tilde = not numbered or rng.random() < 0.4  # else an assignment below a definition would be a parameter of it
    end, blank = rng.choice(["\n", "\r\n", "\r"]), rng.choice([" ", "  ", "\t", " \t "])
    out, count = [], rng.randint(0, 9)
    for lines in blocks:
        for k, line in enumerate(lines):
            text = odd_words(line.removeprefix("#"), rng, blank, lower)
            new = k == 0 or line.startswith("#")
            head = f"{count}{blank}" if numbered and new else rng.choice(["", " ", "\t"])
            count += rng.randint(0, 3) if new else 0
            on = tilde and k + 1 < len(lines) and not lines[k + 1].startswith("#")
            comment = "" if "{name}" in line and on else rng.choice(["", "", *COMMENTS])
            out.append(
                head + text.replace("{name}", rng.choice(NAMES)) + (blank + comment if comment else "") + " ~" * on
            )
        if rng.random() < 0.2 and lines[0][:3] not in ("END", "BEG"):
            out.append(rng.choice(["* - structure", "; a remark", f"{count} ; numbered", "", "   "]))
    return rng.choice(["", "\ufeff"]) + end.join(out) + rng.choice(["", end])


def odd_words(line: str, rng: random.Random, blank: str, lower: bool) -> str:
    name = "{name}" in line
    line = line.replace(" {name}", "")
    if rng.random() < 0.5:
        line = line.replace("+", "") if "FN" not in line else line
    if rng.random() < 0.5:
        line = line.replace(".", ",") if "CYCL DEF 7." not in line and "CC" != line[:2] else line
    if rng.random() < 0.3:
        line = line.replace("R0", "RO")
    line = line.replace(" ", blank)
    return (line.lower() if lower else line) + (blank + "{name}" if name else "")


COLUMNS = ("kind", "end", "centre", "sweep", "feed", "per_rev", "spindle", "tool", "radius", "time")


@pytest.mark.parametrize("tens", range(20))
def test_a_program_and_its_odd_spelling_give_one_path(tens: int) -> None:
    for seed in range(10 * tens, 10 * tens + 10):
        rng = random.Random(seed)
        blocks = program(rng)
        one, other = mnc.run(plainly(blocks), "tnc-620"), mnc.run(text := oddly(blocks, rng), "tnc-620")
        assert one.ok and other.ok, (text, other.alarms)
        for name in COLUMNS:
            a, b = getattr(one.toolpath, name), getattr(other.toolpath, name)
            assert np.array_equal(a, b, equal_nan=a.dtype.kind == "f"), (name, text)
        assert one.variables == other.variables and len(one.toolpath) >= 4


def test_every_example_program_of_the_manual_is_read() -> None:
    """Faults of the text only where the print shows several programs, a table, or dots for what is left out."""
    entries = json.loads((CATALOGUE / "programs-tnc-620.json").read_text(encoding="utf-8"))
    read = 0
    for entry in entries:
        text = entry["program"]
        if "..." in text or text.count("BEGIN PGM") > 1 or "POSITION 7" in text or not any(
            line.strip()[:1].isdigit() for line in text.splitlines()
        ) or text.startswith("TAB1.PNT"):  # fmt: skip
            continue
        program = mnc.read(text + "\n", "tnc-620")
        assert [a for a in program.alarms if a.severity == "alarm"] == [], text
        assert len(program) and all(b.keyword or b.words or b.comment or not b.span.length > 9 for b in program), text
        read += 1
    assert read > 200
