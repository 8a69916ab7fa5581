"""Everything that chapters 1 to 7, 11, 12 and 16 of the manual name: obeyed, refused by name, or read as something else is.

The entries (how they were listed: tests/authorities/README.md) have a kind. A concept is text without a code; each other
one is a function or a cycle of the control, or it is refused by its name, or `READ_AS` says where it went.
"""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import Any

import pytest
from tools.together import together

import mnclab as mnc

CONTROL = mnc.controls["tnc-620"]
CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"


def records(name: str) -> list[dict]:
    return json.loads((CATALOGUE / f"{name}.json").read_text(encoding="utf-8"))


ENTRIES = [entry for entry in records("codes-tnc-620") if entry["kind"] != "concept"]
FUNCTIONS, CYCLES = CONTROL.functions, CONTROL.cycles
REFUSED = {code for code in CONTROL.refused if len(code) > 1}  # beside the letters of axes, of which C is a statement too
WORDS = {address.rstrip("*") for function in FUNCTIONS.values() for address in function.takes}
PARAMETERS = {p.address: p for cycle in CYCLES.values() for p in cycle.parameters()}
NAMED = {
    "function": FUNCTIONS, "cycle": CYCLES, "refused": REFUSED, "word": WORDS, "parameter": PARAMETERS,
    "setting": {setting.name for setting in CONTROL.settings}, "setup": {f.name for f in dataclasses.fields(mnc.Setup)},
}  # fmt: skip
FORMS = "LT LN CT LCT PLT PLN PCT PLCT".split()

#: Entry -> what it is here, the names of it there; the entry names several things at once, or a thing by another name.
READ_AS: dict[str, tuple[str, list[str]]] = {
    # statements in several forms, each with its own name
    "BLK FORM": ("function", ["BLK FORM 0.1", "BLK FORM 0.2"]),
    "APPR": ("function", [f"APPR {form}" for form in FORMS]),
    "DEP": ("function", [f"DEP {form}" for form in ("LT", "LN", "CT", "LCT", "PLCT")]),
    "FK": ("function", ["FPOL", "FL", "FLT", "FC", "FCT", "FSELECT"]),
    "FN": ("function", [f"FN {n}" for n in (*range(20),)]),
    "Q formula": ("function", ["Q"]),
    "M0 M1": ("function", ["M0", "M1"]),
    "CYCL CALL family": ("function", ["CYCL CALL", "CYCL CALL PAT", "CYCL CALL POS", "M99", "M89"]),
    "contour formula": ("function", ["QC"]),
    "FUNCTION": ("refused", ["FUNCTION PARAXMODE", "FUNCTION PARAXCOMP", "FUNCTION MODE"]),
    # cycles: the entry describes the format, or a second use of the same one
    "CYCL DEF": ("cycle", ["CYCL DEF 200"]),
    "CYCL DEF (formats)": ("cycle", ["CYCL DEF 7", "CYCL DEF 200"]),
    "CYCL DEF 7 (datum table)": ("cycle", ["CYCL DEF 7"]),
    "GLOBAL DEF": ("cycle", [f"GLOBAL DEF {n}" for n in (100, 105, 110, 111, 120, 125)]),
    "TCH PROBE": ("cycle", ["TCH PROBE 419"]),
    "result parameters": ("cycle", [f"TCH PROBE {n}" for n in range(420, 428)]),
    "Q366": ("parameter", ["Q366"]),
    "Q439": ("parameter", ["Q439"]),
    "engraving characters": ("cycle", ["CYCL DEF 225"]),
    "engraving system variables": ("cycle", ["CYCL DEF 225"]),
    # words
    "coordinates": ("word", ["X", "Y", "Z", "A", "B", "C", "PR", "PA"]),
    "R0 RL RR": ("word", ["R0", "RL", "RR"]),
    "F": ("word", ["F", "FMAX", "FAUTO", "FU", "FZ"]),
    "Q parameters": ("function", ["Q", "QS"]),
    **{f"PATTERN DEF {form}": ("word", [form]) for form in ("POS", "ROW", "PAT", "FRAME", "CIRC", "PITCHCIRC")},
    # tables, files and machine parameters
    "tool table columns": ("setup", ["tools"]),
    "point table": ("function", ["SEL PATTERN"]),
    "FADE": ("function", ["SEL PATTERN"]),
    "datum table": ("function", ["SEL TABLE"]),
    "CfgThreadSpindle": ("setting", ["thread_wait"]),
    "displayDepthErr, suppressPlungeErr": ("setting", ["depth_error", "plunge_error"]),
}
#: What has no counterpart, and why.
WITHOUT = {
    "PREDEF": "the value of a parameter: every one that allows it has the mark predef",
    "CfgDisplayCoordSys, presetToAlignAxis": "how the status display shows a shift, and an axis of presets by hand",
}


def place(code: str) -> str:
    """What a code is: function, cycle, refused, or empty."""
    return next((name for name in ("function", "cycle", "refused") if code in NAMED[name]), "")


def each(entries: list[dict]) -> Any:
    return together("entry", entries, lambda entry: entry["file"], lambda entry: entry["code"])


@each(ENTRIES)
def test_an_entry_is_obeyed_or_refused_by_name(entry: dict) -> None:
    code = entry["code"]
    kind, names = READ_AS.get(code, (place(code), [code]))
    assert (kind and all(name in NAMED[kind] for name in names)) or code in WITHOUT
    if kind in ("function", "cycle"):
        assert all(mnc.help(name, "tnc-620") is not None and name not in REFUSED for name in names)


def test_what_is_listed_here_needs_it() -> None:
    codes = {entry["code"] for entry in ENTRIES}
    assert (READ_AS.keys() | WITHOUT.keys()) <= codes
    assert not [code for code in (*READ_AS, *WITHOUT) if place(code)]
    assert any(parameter.predef for parameter in PARAMETERS.values())


ABSENT = [name for entry in ENTRIES for name in READ_AS.get(entry["code"], ("", [entry["code"]]))[1] if name in REFUSED]


@pytest.mark.parametrize("name", ABSENT)
def test_what_is_not_built_is_refused_at_its_place(name: str) -> None:
    block = {"CYCL DEF 256": "CYCL DEF 256 X ~\n  Q218=60"}.get(name, name)
    begin, column = ("3 L X+1 R0 FMAX ", 17) if name.startswith("M") else ("3 ", 1)
    run = mnc.run(f"1 TOOL CALL 1 Z F100\n2 L X+0\n{begin}{block}\n", "tnc-620")
    assert [(a.severity, a.span[:2]) for a in run.alarms] == [("alarm", (3, column))]
    assert run.alarms[0].message.startswith(f"{name} is refused: ") and "not built yet" in run.alarms[0].message


STANDING = {"M5": "the spindle stands when a program starts", "M9": "the coolant is off when a program starts"}


@each([e for e in ENTRIES if e["code"] in FUNCTIONS])
def test_a_function_stays_and_is_on_as_the_manual_says(entry: dict) -> None:
    function = FUNCTIONS[entry["code"]]
    assert function.title and function.doc and function.source
    assert function.modal == entry.get("modal", function.modal)
    assert function.power_on == (entry.get("power_on", False) or entry["code"] in STANDING)


def test_every_example_with_a_check_is_a_test() -> None:
    """All of them are in the files that the tests beside this one read, if what they show is built."""
    for entry in records("codes-tnc-620"):
        found = [e for e in records(f"tnc620-{entry['file']}") if e["code"] == entry["code"] and e["check"]]
        if len(found) != entry["checked"]:
            assert place(entry["code"]) == "refused" or READ_AS.get(entry["code"], ("",))[0] == "refused"


# --- PGM COTRANS (11.10) -------------------------------------------------------------------------------------------------

COTRANS = next(e for e in records("tnc620-transformations") if e["code"].startswith("PGM COTRANS"))
CHECK = COTRANS["check"]


def test_the_example_of_transformations() -> None:
    """Eight contours round (65, 65), each 45 degrees further, their roundings among the points that must be passed."""
    run = mnc.run(COTRANS["program"] + "\n", "tnc-620", mnc.Setup(tools={1: mnc.Tool()}))
    assert run.ok, run.alarms
    path = run.toolpath.motion
    firsts = [k for k in range(len(path)) if path.line[k] == 25]
    assert len(firsts) == CHECK["runs"] == len(CHECK["contours"])
    for first, angle in zip(firsts, CHECK["angles"], strict=True):
        lines = [k for k in range(first, len(path)) if 25 <= path.line[k] <= 33 and k < first + 12]
        one = path[lines]
        points = {tuple(point) for point in one.end[:, :2].round(3).tolist()}
        arcs = [k for k in range(len(one)) if one.kind[k] == mnc.Kind.ARC]
        wanted = CHECK["contours"][str(angle)]
        assert len(arcs) == CHECK["rnd_arcs_per_run"]
        assert all((one.sweep[k] < 0) == (CHECK["rnd_direction_RL_contour"] == "clockwise") for k in arcs)
        for k, name in zip(arcs, ("arc1", "arc2"), strict=True):
            assert one.start[k, :2].tolist() == pytest.approx(wanted[f"{name}_start"], abs=6e-4)
            assert one.centre[k, :2].tolist() == pytest.approx(wanted[f"{name}_center"], abs=6e-4)
            assert one.end[k, :2].tolist() == pytest.approx(wanted[f"{name}_end"], abs=6e-4)
        for name in ("start_end", "p1", "p2", "p3"):
            assert any(abs(x - wanted[name][0]) + abs(y - wanted[name][1]) < 2e-3 for x, y in points), name
        assert set(one.feed) == {CHECK["feed_contour"]} and set(one.end[:, 2]) == {CHECK["z_depth"]}
    back = path[path.feed == CHECK["feed_back"]]
    assert back.end[:, :2].tolist() == [pytest.approx(CHECK["datum"])] * CHECK["runs"]
    xyz, _ = path[path.feed < 1e5].points(1e-4)
    for k, extent in enumerate((CHECK["extent_x"], CHECK["extent_y"])):
        assert [xyz[:, k].min(), xyz[:, k].max()] == pytest.approx(extent, abs=2e-3)
    assert (
        not [name for name, _ in run.frames if name not in run.frames.slots]
        and CHECK["chain_at_end"] == "no transformation active"
    )
