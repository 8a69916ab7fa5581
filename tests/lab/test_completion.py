"""Words that may be typed next, and what a word means: from the declarations, without a run. `|` is the cursor."""

import pytest

import mnclab
from mnclab.lab.vocabulary import completions, meaning_at, vocabulary

CONTROLS = list(mnclab.controls)
CYCLE = "CYCL DEF 200 DRILLING ~\n  Q200=+2 ~\n  Q201=-20 ~\n  "


def offered(text, control, files=()):
    """What is typed of a word, and word -> meaning."""
    begun, choices = completions(text.replace("|", ""), text.index("|"), mnclab.controls[control], files)
    return begun, dict(choices)


def meant(text, control):
    """What the word right of the cursor means."""
    return meaning_at(text.replace("|", ""), text.index("|"), mnclab.controls[control])


def test_codes_of_the_control():
    begun, found = offered("N40 G8|", "mnc")
    assert begun == "G8" and found["G83"] == mnclab.controls["mnc"].cycles["G83"].title
    assert set(found) == {code for code in mnclab.help("mnc").entry.functions if code.startswith("G8")} | {"G83", "G84", "G85"}


def test_words_of_a_cycle_come_in_the_order_of_the_manual_without_those_written():
    declared = [p.address for p in mnclab.controls["mnc"].cycles["G83"].parameters()]
    begun, found = offered("N40 G83 X20 K5 |", "mnc")
    assert begun == "" and [*found] == [address for address in declared if address not in "XK"]
    assert found["R"] == "level R, mm (G83)"
    _, found = offered("N40 G83 X20 |K5", "mnc")  # what stands after the cursor is written too
    assert "K" not in found and "X" not in found and "R" in found


def test_a_cycle_of_keywords_goes_on_over_lines():
    declared = [p.address for p in mnclab.controls["tnc-620"].cycles["CYCL DEF 200"].parameters()]
    begun, found = offered(CYCLE + "Q2|", "tnc-620")
    assert begun == "Q2" and [*found] == [f"{a}=" for a in declared if a.startswith("Q2") and a not in ("Q200", "Q201")]
    assert offered(CYCLE.replace("-20 ~", "-20") + "Q2|", "tnc-620")[1] == {}  # a new block: nothing begins so


@pytest.mark.parametrize(
    ("text", "begun", "word"),
    [
        ("CYC|", "CYC", "CYCL DEF 200"),
        ("12 CYCL DEF 2|", "2", "200"),
        ("CYCL |", "", "DEF 200"),
        ("APPR L|", "L", "LT"),
        ("tool |", "", "CALL"),
        ("L X+5 M1|", "M1", "M13"),
        ("L X+5 |", "", "FMAX"),
        ("|", "", "BEGIN PGM"),
    ],
)
def test_keywords_are_completed_word_by_word(text, begun, word):
    found = offered(text, "tnc-620")
    assert found[0] == begun and word in found[1]


def test_files_and_labels_of_calls():
    near = ["SUB.H", "a.h", "sub2.h"]
    assert offered("CALL PGM S|", "tnc-620", near) == ("S", {"SUB.H": "file", "sub2.h": "file"})
    assert offered('SEL CONTOUR "|', "tnc-620", near)[1].keys() == set(near)
    text = 'CALL LBL |\nLBL 5\n12 LBL "RIM"\nLBL 0\nCALL LBL 7\n'
    assert offered(text, "tnc-620") == ("", {"5": "label", '"RIM"': "label"})


@pytest.mark.parametrize("text", ["N40 // G8|", "G1 X+|", "G1 X-|", "N40 G99999|", "N40 G83 Ö|"])
def test_nothing_where_nothing_can_stand(text):
    assert offered(text, "mnc")[1] == {}


@pytest.mark.parametrize(
    ("control", "text", "found"),
    [
        ("mnc", "N40 |G83 X20 K5", ("G83", "G83", "Deep-hole drilling")),
        ("mnc", "N40 G83 X20 |K5", ("K", "G83", "depth of one peck, mm")),
        ("mnc", "N40 G83 X20 K5\n|X40", ("X", "G83", "hole position along X, mm")),  # still on
        ("mnc", "G04 |P2", ("P", "G4", "seconds")),
        ("mnc", "G92 X0\nG1 X5\n|X7", ("X", "G1", "coordinate X")),  # G92 holds for its block alone
        ("mnc", "|N40 G83", ("N", "", "number of the block")),
        ("mnc", "G1 X5 // |G83", None),
        ("tnc-620", "5 |L X+10", ("L", "L", "Straight line")),
        ("tnc-620", "C X+1 |C+20", ("C", "", "angle of the rotary axis C")),
        ("tnc-620", "TOOL CALL 5 |Z S200", ("Z", "TOOL CALL", "tool axis")),
        ("tnc-620", CYCLE + "|Q202=5", ("Q202", "CYCL DEF 200", "infeed depth, mm")),
        ("tnc-620", "L X+|Q7", ("Q", "", "variable of the program")),
        ("nc-31", "G77*~\nX2440*\n|Z-2990*", ("Z", "G77", "end of the passes, 0.01 mm")),
        ("g43", "G54.1 |P3 G81", ("P", "G54.1", "number of the work offset")),
        ("g43", "G81 Z-3 (a |G83 here)", None),
        ("jnc-t01", "G02 X20 |I10", ("I", "G2", "centre along X from the start")),
    ],
)
def test_a_word_means_what_its_code_says(control, text, found):
    assert meant(text, control) == found


@pytest.mark.parametrize("control", CONTROLS)
def test_every_parameter_of_every_cycle_is_told(control):
    """As its declaration says; a word that is written again has all its meanings."""
    known = vocabulary(mnclab.controls[control])
    for code, cycle in mnclab.controls[control].cycles.items():
        for p in cycle.parameters():
            assert p.meaning in known.codes[code].words[p.address]


@pytest.mark.parametrize("control", CONTROLS)
def test_no_text_is_a_fault(control):
    """Wherever the cursor stands in half a program, or in no program at all."""
    one = mnclab.controls[control]
    samples = [CYCLE, "N1 G83 X1\nG", '"', "(((", "~\n~\n", "%\x00\n\t/ 5 ", "Q", "\n", ""]
    for text in samples:
        for at in range(len(text) + 1):
            begun, _ = completions(text, at, one)
            assert text[:at].endswith(begun)
            meaning_at(text, at, one)
