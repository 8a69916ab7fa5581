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
    """A section of the manual, with `example` where only a program there shows it; or none, where the manual has none."""
    for table in (mnclab.controls["tnc-620"].functions, mnclab.controls["tnc-620"].cycles):
        for code, entry in table.items():
            assert re.fullmatch(r"\d{1,2}\.\d{1,2}(, example)?|Klartext, not described", entry.source), code


def test_words_of_a_free_contour_are_explained():
    text = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z F100\n2 L X+0 Y+30 R0\n3 FC DR- R30 CCX+30 CCY+30\n4 END PGM A MM\n"
    run = mnclab.run(text, "tnc-620")
    says = [word.says.split(" of ")[0] for word in run.explain(line=4).meanings]
    assert says == ["Free arc", "sense", "radius", "centre along X", "centre along Y"]


def test_the_sense_of_an_arc_is_told():
    text = "TOOL CALL 1 Z F100 S900 M3\nCC X+0 Y+0\nL X+9 Y+0 FMAX\nC X+0 Y+9 DR+\nC X+9 Y+0 DR-\n"
    run = mnclab.run(text, "tnc-620")
    told = [run.explain(line=line).meanings[3] for line in (4, 5)]
    assert [word.word for word in told] == ["DR+", "DR-"]
    assert [word.says.split(" of C")[0] for word in told] == [
        "sense of rotation (counter-clockwise)", "sense of rotation (clockwise)"
    ]  # fmt: skip


def test_a_repetition_tells_its_frames_and_how_often():
    run = mnclab.run("N0 S500\nN1 F20\nN2 M3\nN3 X@-200\nN4 Z-300\nN5 G25*\nN6 P3004*\nN7 P2\n", "nc-31")
    says = {word.word: word.says for word in run.explain(line=6).meanings}
    assert says["P3004"].startswith("frames 3 to 4 of G25") and says["P2"].startswith("2 times of G25")


def test_a_unit_stands_apart_and_an_increment_is_no_coordinate():
    run = mnclab.run("N0 S500\nN1 F20\nN2 M3\nN3 X5000*\nN4 Z@-300\n", "nc-31")
    says = {word.word: word.says for word in run.explain(line=4).meanings}
    assert says["Z@-300"] == "increment along the axis (0.01 mm) of X (Straight move)"
    assert says["X5000"] == "Straight move: diameter, 0.01 mm"
