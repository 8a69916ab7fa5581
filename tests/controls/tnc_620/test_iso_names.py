"""The DIN/ISO names of cycles: those of the manual's headings, known to help and to the alarm about a G word."""

import json
from pathlib import Path

import pytest
from tools.together import together

import mnclab

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"
NAMES = json.loads((CATALOGUE / "iso-names-tnc-620.json").read_text("utf-8"))
CONTROL = mnclab.controls["tnc-620"]


def test_they_are_those_of_the_headings():
    wanted = {f"G{int(name[1:])}": row["code"] for row in NAMES for name in row["iso"]}
    assert dict(CONTROL.names) == wanted


@together("name", [name for name, code in CONTROL.names.items() if code in CONTROL.cycles], lambda name: name[:2])
def test_help_finds_a_cycle_by_its_name(name):
    shown = mnclab.help(name, "tnc-620")
    assert str(shown) == str(mnclab.help(CONTROL.names[name], "tnc-620"))
    assert name in str(shown).splitlines()[-1] and f"<code>{name}</code>" in shown._repr_html_()


@pytest.mark.parametrize(
    ("block", "hint"),
    [
        ("G83 X1", "G words belong to DIN/ISO programs; write L, C, CR or CYCL DEF"),
        ("G203 Q200=2", "G words belong to DIN/ISO programs; G203 is CYCL DEF 203"),
        ("g04", "G words belong to DIN/ISO programs; G04 is CYCL DEF 9"),
    ],
)
def test_a_stray_g_word_is_told_its_cycle(block, hint):
    (alarm,) = mnclab.read(f"1 {block}\n", "tnc-620").alarms
    assert (alarm.span.line, alarm.span.column, alarm.hint) == (1, 3, hint)
