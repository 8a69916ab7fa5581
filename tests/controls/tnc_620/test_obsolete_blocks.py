"""How the sub-blocks of the cycles 1 to 5 and 17 are spelled: the place of a number counts, its words do not."""

from __future__ import annotations

import pytest

import mnclab as mnc

HEAD = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F250\nL X+0 Y+0 Z+2 R0 FMAX M3\n"
PLAIN = "1.0 PECKING/1.1 SET UP 2/1.2 DEPTH -20/1.3 PECKG 5/1.4 DWELL 0.5/1.5 F200"
SPELLINGS = [
    "1.0 TIEFBOHREN/1.1 ABST 2/1.2 TIEFE -20/1.3 ZUSTLG 5/1.4 V.ZEIT 0.5/1.5 F200",
    "1.0 TIEFBOHREN/1.1 ABST -2.0/1.2 TIEFE -20.0/1.3 ZUSTLG -5.0/1.4 V.ZEIT 0,5/1.5 F 200",
    "1.0/1.1 2/1.2 -20/1.3 +5/1.4 .5/1.5 200",
    "1.0 PECKING/1.1 SETUP2/1.2 DEPTH-20/1.3 PECKG5/1.4 DWELL0.5/1.5 F200",
    "1.0 PECKING/1.1 set up = 2/1.2 depth = -20/1.3 pckg = 5/1.4 v. zeit .5/1.5 f200",
    "1.0 PERCAGE/1.1 DIST. 2/1.2 PROF. -20/1.3 PASSE 5/1.4 TEMP. 0.5/1.5 F200",
    "1.0 PECKING/1.1 SET UP Q1/1.2 DEPTH -Q2/1.3 PECKG Q3/1.4 DWELL Q4/1.5 FQ5",
]


def listing(definition: str) -> str:
    blocks = "".join(f"CYCL DEF {line}\n" for line in definition.split("/"))
    run = mnc.run(f"{HEAD}Q1 = 2\nQ2 = 20\nQ3 = 5\nQ4 = 0.5\nQ5 = 200\n{blocks}CYCL CALL\nEND PGM A MM\n", "tnc-620")
    assert run.ok and not run.alarms, run.alarms
    return str(run.toolpath)


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_one_meaning(spelling: str) -> None:
    assert listing(spelling) == listing(PLAIN)


POCKET = "4.0 P/4.1 SET UP 2/4.2 DEPTH -20/4.3 PECKG 5 F80/4.4 X 80/4.5 Y 40/4.6 F250 DR- RADIUS 0"


@pytest.mark.parametrize(
    "spelling",
    [
        "4.0 TASCHENFRAESEN/4.1 ABST 2/4.2 TIEFE -20/4.3 ZUSTLG 5 F80/4.4 X+80/4.5 Y+40/4.6 F250 DR-",
        "4.0 P/4.1 ABST-2/4.2 TIEFE-20/4.3 ZUSTLG-5F80/4.4 Y40/4.5 X80/4.6 FAUTO DR- RADIUS0",
        "4.0 P/4.1 SET UP2/4.2 DEPTH-20/4.3 PECKG5 F80/4.4 X80/4.5 Y40/4.6 F AUTO DR-RADIUS=0",
        "4.0 P/4.1 SET UP 2/4.2 DEPTH -20/4.3 F80 PECKG 5/4.4 X80/4.5 Y40/4.6 RADIUS 0 DR- F250",
    ],
)
def test_one_pocket(spelling: str) -> None:
    assert listing(spelling) == listing(POCKET)


@pytest.mark.parametrize(
    ("line", "column", "message"),
    [
        ("1.1 TIEFE -20", 14, "TIEFE stands where the set-up clearance belongs"),
        ("1.2 ABST 2", 14, "ABST stands where the depth belongs"),
        ("1.3 V.ZEIT 1", 14, "V.ZEIT stands where the infeed belongs"),
        ("1.5 FU0.2", 14, "FU stands where the feed rate belongs"),
        ("1.5 VORSCHUB 2", 14, "VORSCHUB stands where the feed rate belongs"),
        ("1.4 DWELL", 14, "a number is missing: the dwell in seconds"),
        ("1.4 V.ZEIT.5", 20, ".5 may be 0.5 or 5"),
        ("1.4 DWELL 1 2", 22, "'2' needs an address before it"),
        ("1.5 F100 M8", 19, "M8 has no meaning in this block"),
    ],
)
def test_a_wrong_value_is_refused_where_it_stands(line: str, column: int, message: str) -> None:
    """No number goes to another meaning than its word says."""
    alarms = mnc.run(f"{HEAD}CYCL DEF 1.0 P\nCYCL DEF {line}\n", "tnc-620").alarms
    assert alarms[0].span[:2] == (5, column) and alarms[0].message == message


def test_a_pattern_has_no_place_for_them() -> None:
    blocks = "".join(f"CYCL DEF {line}\n" for line in PLAIN.split("/"))
    run = mnc.run(f"{HEAD}{blocks}PATTERN DEF POS1 (X+1 Y+2 Z+0)\nCYCL CALL PAT FMAX\n", "tnc-620")
    message = "CYCL CALL PAT: CYCL DEF 1 begins where the tool stands, at no surface"
    assert [(a.message, a.span[:2]) for a in run.alarms] == [(message, (11, 1))]
