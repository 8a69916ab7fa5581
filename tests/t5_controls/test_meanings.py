"""Every word that a function takes can be explained, and every function names a place where a reader can look it up."""

import re

import pytest

import mnclab

TAKEN = [
    (name, code, address.rstrip("*"))
    for name, control in mnclab.controls.items()
    for code, function in control.functions.items()
    for address in function.takes
]
AXES = "XYZ"  # the words that run.explain names itself: coordinates and increments


@pytest.mark.parametrize("control", mnclab.controls)
def test_a_word_of_a_function_has_a_meaning(control):
    meanings = mnclab.controls[control].meanings
    taken = [(code, address) for name, code, address in TAKEN if name == control]
    nameless = [
        f"{code} {address}"
        for code, address in taken
        if address not in AXES and not (meanings.get(f"{code} {address}") or meanings.get(address))
    ]
    assert taken and not nameless


@pytest.mark.parametrize("control", mnclab.controls)
def test_a_meaning_belongs_to_a_word(control):
    taken = {(code, address) for name, code, address in TAKEN if name == control}
    words = {address for _, address in taken} | {f"{code} {address}" for code, address in taken}
    assert set(mnclab.controls[control].meanings) - words == set()


def test_a_function_of_the_tnc_620_names_its_section():
    """A section of the manual, with ``example`` where only a program there shows it; or none, where the manual has none."""
    for table in (mnclab.controls["tnc-620"].functions, mnclab.controls["tnc-620"].cycles):
        for code, entry in table.items():
            assert re.fullmatch(r"\d{1,2}\.\d{1,2}(, example)?|Klartext, not described", entry.source), code


def test_words_of_a_free_contour_are_explained():
    text = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z F100\n2 L X+0 Y+30 R0\n3 FC DR- R30 CCX+30 CCY+30\n4 END PGM A MM\n"
    run = mnclab.run(text, "tnc-620")
    says = [word.says.split(" of ")[0] for word in run.explain(line=4).meanings]
    assert says == ["Free arc", "sense", "radius", "centre along X", "centre along Y"]
