"""Part programs have colours: in cells that begin with %%mnc, and in files."""

import shutil
from pathlib import Path

import pytest

import mnclab

SAMPLES = Path(__file__).parents[2] / "data" / "programs"
MIME_OF_FILE = "window.jupyterapp?.shell.currentWidget?.content?.model?.mimeType"

LINES = """() => [...document.querySelectorAll('.jp-CodeMirrorEditor .cm-line')].map(
    line => [...line.querySelectorAll('span')].map(span => [span.textContent, getComputedStyle(span).color]))"""
MIME = "() => [...window.jupyterapp.shell.currentWidget.content.model.cells].map(cell => cell.mimeType)"
MNC = "%%mnc --control mnc\nN10 G90 G54 // comment\nN20 G1 X20.5 F100 M3\n"
TNC = "%%mnc\nBEGIN PGM A MM\nL X+5 R0 FMAX ; comment\nFN 0: Q5 = +1\nEND PGM A MM\n"


def coloured(page, *pieces):
    """text -> colour of every coloured piece in the editors of a page, once these pieces are there."""
    there = f"pieces => pieces.every(piece => ({LINES})().flat().some(([text]) => text === piece))"
    page.wait_for_function(there, arg=list(pieces), timeout=30_000)
    return {text: colour for line in page.evaluate(LINES) for text, colour in line}


def test_cells_have_the_colours_of_their_control(run_cells):
    page = run_cells(
        "%load_ext mnclab", MNC, TNC, "%%mnc --control nc-31\nS800\nM3\n", "%%mnc --control g43\nG0 X1 ; go\n", "x = 1"
    )
    mime = ["text/x-ipython", "text/x-mnc", "text/x-klartext", "text/x-nc31", "text/x-g43", "text/x-ipython"]
    page.wait_for_function(f"() => ({MIME})().join() === '{','.join(mime)}'", timeout=30_000)
    found = coloured(page, "N10", "G90", "// comment", "BEGIN PGM", "; comment")
    assert len({found[text] for text in ("N10", "G90", "M3", "// comment")}) >= 3
    assert found["G90"] == found["G1"] and found["X"] != found["20.5"]
    assert found["BEGIN PGM"] == found["G90"] and "Q5" in found and found["; comment"] == found["// comment"]
    page.get_by_text("no alarms").first.wait_for(timeout=30_000)


KLARTEXT = """0 BEGIN PGM PART MM
1 ; remark
2 TOOL CALL "MILL 10" Z S3000 F500
3 CYCL DEF 251 RECTANGULAR POCKET Q215=+0 Q218=+60
4 FC DR- R15 CLSD+ CCX+20 CCY-7
5 FLT IAN+90 LEN12
6 Q12 = ( Q1 + SIN Q2 ) * 3.5
7 QS3 = "text"
8 L A+11 C+22 FMAX M99
9 CALL PGM OTHER.H
"""
ISO = "%\n; remark\nN10 G54 G90 S2000 M3\nG43 D1 Z5\nG1 X-20.5 F300\n"
#: File, its text, groups of pieces: one colour in a group, another one in each group.
FILES = [
    ("part.mnc", "N10 G90 G54\nN20 G1 X20.5 F100 M3 // remark\nN30 G0 Z5\n", [["G90", "G54"], ["X"], ["// remark"]]),
    (
        "part.h",
        KLARTEXT,
        [
            ["BEGIN PGM", "TOOL CALL", "CYCL DEF 251", "FC", "FLT", "L", "CALL PGM"],
            ["Q215", "Q12", "Q2", "QS3"],
            ['"MILL 10"', '"text"', "OTHER.H", "PART"],
            ["CCX", "IAN", "LEN", "A", "C"],
            ["+60", "12", "+22"],
            ["; remark"],
        ],
    ),
    ("part.g43", ISO, [["G54", "G43", "G1"], ["X", "Z", "D"], ["-20.5", "5"], ["; remark"]]),
    ("part.iso", ISO, [["G54", "G43", "G1"], ["X", "Z", "D"], ["-20.5", "5"], ["; remark"]]),
    (
        "part.nc31",
        "N10 S800\nM3\nF20\nX4000 ~ *\nZ200 ~\n; remark\n",
        [["M3"], ["X", "Z"], ["4000", "200"], ["; remark"]],
    ),
    (
        "part.jnc",
        "M4\nS600 G97 F120 T1\nG00 X42 Z-4 ' remark\n",
        [["G97", "G00"], ["X", "Z"], ["42", "-4"], ["' remark"]],
    ),
]


@pytest.mark.parametrize(("name", "text", "groups"), FILES, ids=[name for name, _, _ in FILES])
def test_files_have_colours(lab, browser, name, text, groups):
    address, folder = lab
    (folder / name).write_text(text)
    page = browser.new_page(viewport={"width": 1000, "height": 700})
    page.goto(f"{address}/doc/tree/{name}?reset")
    page.locator(".cm-line").first.wait_for(timeout=60_000)
    found = coloured(page, *(piece for group in groups for piece in group))
    colours = [{found[piece] for piece in group} for group in groups]
    assert [len(colour) for colour in colours] == [1] * len(groups), colours
    assert len(set.union(*colours)) == len(groups), colours
    page.close()


def test_the_samples_open_as_programs_of_their_control(lab, browser):
    address, folder = lab
    mimes = {"mnc": "mnc", "tnc-620": "klartext", "g43": "g43", "nc-31": "nc31", "jnc-t01": "jnc"}
    page = browser.new_page()
    for control in mnclab.controls:
        sample = next(
            each for each in sorted((SAMPLES / control).iterdir()) if each.suffix in mnclab.controls[control].suffixes
        )
        shutil.copy(sample, folder / sample.name)
        page.goto(f"{address}/doc/tree/{sample.name}?reset")
        page.wait_for_function(f"() => {MIME_OF_FILE} === 'text/x-{mimes[control]}'", timeout=60_000)
    page.close()


def test_a_header_of_c_stays_one(lab, browser):
    address, folder = lab
    (folder / "c.h").write_text("#include <math.h>\nint L(int X);\n")
    page = browser.new_page()
    page.goto(f"{address}/doc/tree/c.h?reset")
    page.locator(".cm-line").first.wait_for(timeout=60_000)
    page.wait_for_function(f"() => {MIME_OF_FILE}", timeout=30_000)
    mime = page.evaluate("() => window.jupyterapp.shell.currentWidget.content.model.mimeType")
    assert "klartext" not in mime
    page.close()
