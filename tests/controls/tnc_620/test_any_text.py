"""No text raises anything but alarms, and a run of it ends."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import mnclab as mnc

pytestmark = pytest.mark.deep

PROGRAM = """\
0 BEGIN PGM PART MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-20
2 BLK FORM 0.2 X+100 Y+100 Z+0
3 TOOL CALL 1 Z S1000 F250 DL+0.1 DR-0.1
4 L X+10 Y-2.5 R0 FMAX M3
5 FN 2: Q1 = +Q2 - -5
6 APPR LT X+0 Y+20 LEN10 RL F200
7 L Y+40
8 RND R2
9 L X+60
10 CC X+60 Y+0
11 C X+60 Y-40 DR-
12 CR X+0 Y-40 R+40 DR+
13 DEP LT LEN15 F500
14 CYCL DEF 200 DRILLING ~
 Q200=2 ;SET-UP CLEARANCE ~
 Q201=-15 ;DEPTH ~
 Q206=FAUTO ;FEED ~
 Q202=5 ;INFEED ~
 Q210=0 ~
 Q203=+0 ~
 Q204=20 ~
 Q211=0.25
15 CYCL DEF 7.0 DATUM SHIFT
16 CYCL DEF 7.1 X+60
17 LBL "A"
18 CYCL DEF 10.0 ROTATION
19 CYCL DEF 10.1 IROT+45
20 CALL LBL 2
21 CALL LBL "A" REP 6/6
22 Q5 = 3 * (SIN 30 + Q1) ^ 2
23 L X+Q5 M99
23 QS1 = "A" || SUBSTR ( SRC_QS1 BEG0 LEN1 ) || TOCHAR ( DAT+Q1 DECIMALS2 )
23 Q6 = TONUMB ( SRC_QS1 )
23 FN 8: Q7 = +Q1 LEN -4
23 FN 11: IF +Q1 GT +3 GOTO LBL "A"
23 FN 18: SYSREAD Q8 = ID20 NR1
23 CALL PGM OTHER
23 CYCL DEF 12.0 PGM CALL
23 CYCL DEF 12.1 PGM TNC:\\X\\OTHER.H
24 CYCL DEF 14.0 CONTOUR
25 CYCL DEF 14.1 CONTOUR LABEL1/2
26 M30
27 LBL 2
28 L IX+5 R0 F100
29 CYCL CALL M3
30 LBL 0
31 END PGM PART MM
"""

SCRAPS = st.sampled_from([
    "X", "+", "-", ".", ",", "9", "0", " ", "\t", "\n", "\r", ";", "~", "/", "\\", '"', "=", "(", ")", "^", "*", "%", "#", "Q1",
    "RL", "R0", "FMAX", "DR-", "LBL 0\n", "CALL LBL 2\n", "CYCL DEF 7.1 ", "Q201=", "99999999", "\ufeff", "\0", "\u0425",
    "\u0661", "\u017f", "DEP LT LEN5\n", "RND R1\n", "TOOL CALL ", "END PGM A MM\n", "1e9", "INCH", "M2\n", "L ", "C ", "CC ",
])  # fmt: skip
PIECES = [
    "X", "+", "-", ".", ",", "9", "0", " ", "\n", "\r", ";", "~", "/", '"', "=", "(", "#", "Q1", "Q201=", "RL", "RR", "R0",
    "FMAX", "FU0.1", "FZ.1 ", "FAUTO", "M91 ", "M103 F20", "M118 X1", "M99", "M110", "M6", "M13 ", "LBL 1\n", "TOOL DEF 5 L+1",
    "\ufeff", "CYCL DEF 200", "CYCL CALL\n", "BLK FORM 0.2 ", "1e9", "999999", "INCH", " DR2+1", "-Q5", "QS1", "CC X+1 Y+1\n",
    "DR-", "C X+1 ",
]  # fmt: skip


#: Mutated repeats may be long.
SHORT = {"most_blocks": 3000}


@settings(max_examples=300, deadline=None)
@given(edits=st.lists(st.tuples(st.integers(0, len(PROGRAM)), st.integers(0, 12), SCRAPS), min_size=1, max_size=5))
@example(edits=[(0, 0, "")])
def test_mutated_programs(edits: list[tuple[int, int, str]]) -> None:
    text = PROGRAM
    for at, cut, scrap in edits:
        text = text[:at] + scrap + text[at + cut :]
    run = mnc.run(text, "tnc-620", mnc.Setup(files={"OTHER": "\n".join(text.splitlines()[:9])}, settings=SHORT))
    assert all(alarm.span is None or alarm.span.column >= 1 for alarm in run.alarms)
    str(run.toolpath), repr(run), list(run.program)


FOLDER = Path(__file__).parents[3]
PROGRAMS = [
    *(file.read_text(encoding="utf-8") for file in sorted(FOLDER.glob("data/programs/tnc-620/*.h"))),
    *(
        entry["program"] + "\n"
        for entry in json.loads((FOLDER / "tests/authorities/catalogue/programs-tnc-620.json").read_text("utf-8"))
    ),
]


def mutated(programs: list[str], seed: int) -> str:
    """One of the programs with some characters, words or lines changed, doubled, swapped or cut."""
    rng = random.Random(seed)
    text = rng.choice(["", "TOOL CALL 1 Z S1000 F100 M3\nL Z+20 FMAX M3\n"]) + rng.choice(programs)
    for _ in range(rng.randint(1, 6)):
        at = rng.randrange(len(text) + 1)
        way = rng.randrange(6)
        if way == 0:
            text = text[:at] + rng.choice(PIECES) + text[at + rng.randint(0, 3) :]
        elif way == 1:
            text = text[:at] + chr(rng.choice([rng.randrange(128), rng.randrange(0xD800)])) + text[at + 1 :]
        elif way == 2:
            text = text[:at] + text[at + rng.randint(1, 12) :]
        elif way == 3:
            lines = text.split("\n")
            lines.insert(rng.randrange(len(lines)), rng.choice(lines))
            text = "\n".join(lines)
        elif way == 4:
            other = rng.choice(programs).split("\n")
            begin = rng.randrange(len(other))
            text = text[:at] + "\n" + "\n".join(other[begin : begin + rng.randint(1, 9)]) + "\n" + text[at:]
        else:
            words = text.split(" ")
            i, j = rng.randrange(len(words)), rng.randrange(len(words))
            words[i], words[j] = words[j], words[i]
            text = " ".join(words)
    return text + "\n"


@pytest.mark.parametrize("hundreds", range(4))
def test_mutated_samples_and_examples_of_the_manual(hundreds: int) -> None:
    """A sample; 50,000 seeds were run once."""
    for seed in range(100 * hundreds, 100 * hundreds + 100):
        run = mnc.run(mutated(PROGRAMS, seed), "tnc-620", mnc.Setup(settings=SHORT))
        assert all(alarm.span is None or alarm.span.column >= 1 for alarm in run.alarms)
        str(run.toolpath), repr(run)


@settings(max_examples=200, deadline=None)
@given(st.text(max_size=200))
def test_any_characters(text: str) -> None:
    mnc.run(text + "\n", "tnc-620")


@pytest.mark.parametrize(
    "text",
    [
        "9" * 100_000, "L X" + "9" * 10_000, "Q1 = " + "(" * 5000, "Q1 = " + "2^" * 5000 + "2", "Q1 = " + "-" * 5000 + "2",
        "L " * 10_000, ";" * 1000 + "\n" + "~\n" * 1000, "LBL " + "9" * 5000, "CYCL DEF " + "9" * 5000, "Q" + "9" * 5000 + "=1",
        "CALL LBL 1 REP " + "9" * 5000, "FN " + "9" * 5000, "M" + "9" * 5000, "\x0b\x0c\x1c\x85\u2028L X1",
    ],
)  # fmt: skip
def test_long_and_odd_texts(text: str) -> None:
    mnc.run(text + "\n", "tnc-620")
    mnc.run("1 TOOL CALL 1 Z F100\n2 " + text + "\n", "tnc-620")
