"""GLOBAL DEF and PREDEF: values said once, taken by the cycles that name them, and what is refused."""

from __future__ import annotations

from typing import Any

import pytest

import mnclab as mnc
from mnclab.controls.tnc_620.trial import klartext
from mnclab.machine import trial

GLOBAL_100 = "GLOBAL DEF 100 GENERAL\nQ200=3 ;A\nQ204=40 ;B\nQ253=750 ;C\nQ208=1000 ;D\n"
GLOBAL_105 = "GLOBAL DEF 105 DRILLING\nQ256=0.2\nQ210=0.3\nQ211=0.4\n"
CYCLE = "CYCL DEF 200 D\nQ200={Q200}\nQ201=-15\nQ206=250\nQ202=10\nQ210={Q210}\nQ203=0\nQ204={Q204}\nQ211={Q211}\n"


def cycle(**words: str) -> str:
    return CYCLE.format(**{"Q200": "2", "Q210": "0", "Q204": "20", "Q211": "0"} | words)


def test_predef_takes_the_values_of_global_def(inside, drilled) -> None:
    """Set-up plane 3, dwells 0.3 s above and 0.4 s at the bottom, cycle end 40."""
    everything = cycle(Q200="PREDEF", Q210="PREDEF", Q204="PREDEF", Q211="PREDEF")
    run = inside(f"2 {GLOBAL_100}3 {GLOBAL_105}4 {everything}5 CYCL CALL M3")
    assert run.alarms == () and drilled(run) == [
        "Z3 FMAX", "Z-10 F250", "dwell 0.4 s", "Z3 FMAX", "dwell 0.3 s", "Z-7 FMAX", "Z-15 F250", "dwell 0.4 s", "Z40 FMAX",
    ]  # fmt: skip
    assert run.variables["Q200"] == 3 and run.variables["Q204"] == 40


def test_a_number_in_the_cycle_does_not_follow_global_def(inside, drilled) -> None:
    run = inside(f"2 {GLOBAL_100}3 {cycle(Q204='PREDEF')}4 CYCL CALL M3")
    assert drilled(run) == ["Z2 FMAX", "Z-10 F250", "Z2 FMAX", "Z-8 FMAX", "Z-15 F250", "Z40 FMAX"]


def test_global_def_is_read_where_the_cycle_is_defined(inside, drilled) -> None:
    """A later GLOBAL DEF does not change a cycle defined before it, as FAUTO does not follow a later TOOL CALL."""
    later = GLOBAL_100.replace("Q200=3", "Q200=9")
    run = inside(f"2 {GLOBAL_100}3 {cycle(Q200='PREDEF')}4 {later}5 CYCL CALL M3\n6 {cycle(Q200='PREDEF')}7 CYCL CALL")
    assert [word for word in drilled(run) if word in ("Z3 FMAX", "Z9 FMAX")] == ["Z3 FMAX"] * 2 + ["Z9 FMAX"] * 2


def test_global_def_writes_no_q_parameter(tnc) -> None:
    run = tnc(f"1 Q200 = 7\n2 {GLOBAL_100}")
    assert run.ok and run.variables == {"Q200": 7} and len(run.toolpath) == 0


def test_in_inches(tnc, drilled) -> None:
    """Q200 = 0.5 in = 12.7 mm; the parameter of the cycle is 0.5 again; 250 tenths of an inch are 635 mm."""
    globals_ = GLOBAL_100.replace("Q200=3", "Q200=0.5").replace("Q204=40", "Q204=2")
    definition = cycle(Q200="PREDEF", Q204="PREDEF").replace("-15", "-1").replace("Q202=10", "Q202=0")
    run = tnc(f"0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z S1000 F20\n2 {globals_}3 {definition}4 CYCL CALL M3\n")
    assert drilled(run) == ["Z12.7 FMAX", "Z-25.4 F635", "Z50.8 FMAX"] and run.variables["Q200"] == 0.5


@pytest.mark.parametrize("address", ["Q345", "Q352"])
def test_two_names_of_the_positioning_height(address: str, inside) -> None:
    """The text of the manual says Q352, its example Q345."""
    assert inside(f"2 GLOBAL DEF 125 POSITIONARE\n{address}=+1").ok


VALUES = {
    100: {"Q200": 3, "Q204": 40, "Q253": 750, "Q208": 900}, 105: {"Q256": 0.3, "Q210": 0.5, "Q211": 0.7},
    110: {"Q370": 1.2, "Q351": -1, "Q366": 1}, 111: {"Q2": 1.3, "Q6": 4, "Q7": 60, "Q9": -1},
    120: {"Q320": 5, "Q260": 80, "Q301": 1}, 125: {"Q345": 1},
}  # fmt: skip
EVERYTHING = "".join(
    f"GLOBAL DEF {n}\n" + "".join(f"{q}={v}\n" for q, v in values.items()) for n, values in VALUES.items()
)
CYCLES = mnc.controls["tnc-620"].cycles
LINKS = [
    (code, parameter)
    for code, cycle in CYCLES.items()
    for source in CYCLES.values()
    if code in getattr(source, "serves", ()) and cycle.runs == "call"
    for parameter in cycle.parameters()
    if parameter.address in {p.address for p in source.parameters()}
]


def test_every_value_is_kept(tnc) -> None:
    run = tnc(EVERYTHING)
    assert run.ok and {q: run.history[f"default {q}"][-1] for values in VALUES.values() for q in values} == {
        q: v for values in VALUES.values() for q, v in values.items()
    }


@pytest.mark.parametrize(("code", "parameter"), LINKS, ids=lambda case: getattr(case, "address", case))
def test_every_cycle_takes_the_values_made_for_it(code: str, parameter: Any, tnc) -> None:
    """Drilling the clearances and dwells, milling the overlap, …: the Q parameter has the value of GLOBAL DEF."""
    values = {p.address: klartext(trial.first_value(p)) for p in CYCLES[code].parameters()}
    values[parameter.address] = "PREDEF"
    run = tnc(f"{EVERYTHING}{code} X\n" + "".join(f"{q}={v}\n" for q, v in values.items()))
    assert run.ok, run.alarms
    assert run.variables[parameter.address] == next(
        v[parameter.address] for v in VALUES.values() if parameter.address in v
    )


def test_every_kind_has_its_help() -> None:
    for number in (100, 105, 110, 111, 120, 125):
        assert f"GLOBAL DEF {number}  " in str(mnc.help(f"GLOBAL DEF {number}", "tnc-620"))
