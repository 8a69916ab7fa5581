"""Parameters that came later than their cycle: programs from before them do what the first manuals of the cycles say.

Drilling without Q211 does not dwell; pecking without Q208 leaves at rapid; hole circles without Q365 go on lines; slots
without Q338 finish in one infeed; pockets and slots without Q385 finish at the milling feed.
"""

from __future__ import annotations

import pytest

HOLE = "Q200=2 Q201=-20 Q206=150 Q202=6 Q203=0 Q204=20"
POCKET = "Q215=0 Q368=.2 Q207=400 Q351=1 Q201=-6 Q202=3 Q369=.1 Q206=150 Q338=0 Q200=2 Q203=0 Q204=50 Q366=1"
SLOT = "Q200=2 Q201=-4 Q207=300 Q202=2 Q215=0 Q203=0 Q204=50 Q216=60 Q217=40"
CASES = {
    "200": ("200 BOHREN " + HOLE + " Q210=0", "Q211=0"),
    "205": ("205 TIEFBOHREN " + HOLE + " Q212=0 Q205=0 Q258=.2 Q259=.2 Q257=0 Q256=.2 Q211=0 Q379=0 Q253=750", "Q208=FMAX"),
    "210": ("210 NUT " + SLOT + " Q218=50 Q219=12 Q224=0", "Q338=0"),
    "211": ("211 NUT " + SLOT + " Q244=60 Q219=12 Q245=0 Q248=90", "Q338=0"),
    "251": ("251 TASCHE Q218=40 Q219=30 Q220=6 Q224=0 Q367=0 Q370=1 " + POCKET, "Q385=400"),
    "252": ("252 TASCHE Q223=30 Q370=1 " + POCKET, "Q385=400"),
    "253": ("253 NUT Q218=50 Q219=14 Q374=0 Q367=0 " + POCKET, "Q385=400"),
    "254": ("254 NUT Q219=14 Q375=80 Q367=0 Q216=0 Q217=0 Q376=0 Q248=90 Q378=0 Q377=1 " + POCKET, "Q385=400"),
}
CIRCLE = "CYCL DEF 220 KREIS Q216=0 Q217=0 Q244=60 Q245=0 Q246=360 Q247=90 Q241=4 Q200=2 Q203=0 Q204=20 Q301=1"


def listing(tnc, cycle: str, after: str = "CYCL CALL M3") -> str:
    run = tnc(f"TOOL CALL 1 Z S1000\nL X+5 Y+5 Z+50 FMAX M3\nCYCL DEF {cycle}\n{after}\n")
    assert run.ok, run.alarms
    return str(run.toolpath)


@pytest.mark.parametrize("code", CASES)
def test_a_program_from_before_a_parameter(tnc, code: str) -> None:
    cycle, later = CASES[code]
    assert listing(tnc, cycle) == listing(tnc, f"{cycle} {later}")
    other = {"Q208=FMAX": "Q208=500", "Q211=0": "Q211=1", "Q338=0": "Q338=2", "Q385=400": "Q385=300"}[later]
    assert listing(tnc, cycle) != listing(tnc, f"{cycle} {other}")


def test_a_hole_circle_from_before_its_way_goes_on_lines(tnc) -> None:
    drill = " ".join(CASES["200"])
    assert listing(tnc, drill, CIRCLE) == listing(tnc, drill, f"{CIRCLE} Q365=0") != listing(tnc, drill, f"{CIRCLE} Q365=1")


def test_without_both_feeds_nothing_can_be_finished(tnc) -> None:
    text = CASES["252"][0].replace("Q207=400", "Q207=0").replace("Q215=0", "Q215=2")
    (alarm,) = tnc(f"TOOL CALL 1 Z S1000\nL Z+50 FMAX M3\nCYCL DEF {text}\nCYCL CALL\n").alarms
    assert alarm.message == "CYCL DEF 252 Q207 (feed rate for milling) must be greater than 0 to mill with, got 0"
