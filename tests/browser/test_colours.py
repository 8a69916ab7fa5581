"""Part programs have colours: in cells that begin with %%mnc, and in files."""

import pytest

LINES = """() => [...document.querySelectorAll('.jp-CodeMirrorEditor .cm-line')].map(
    line => [...line.querySelectorAll('span')].map(span => [span.textContent, getComputedStyle(span).color]))"""
MIME = "() => [...window.jupyterapp.shell.currentWidget.content.model.cells].map(cell => cell.mimeType)"
MNC = "%%mnc --control mnc\nN10 G90 G54 // comment\nN20 G1 X20.5 F100 M3\n"
TNC = "%%mnc\nBEGIN PGM A MM\nL X+5 R0 FMAX ; comment\nFN 0: Q5 = +1\nEND PGM A MM\n"


def coloured(page):
    """text -> colour of every coloured piece in the editors of a page."""
    page.wait_for_function(f"() => ({LINES})().flat().length > 8", timeout=10_000)
    return {text: colour for line in page.evaluate(LINES) for text, colour in line}


def test_cells_have_the_colours_of_their_control(run_cells):
    page = run_cells("%load_ext mnclab", MNC, TNC, "%%mnc --control nc-31\nS800\nM3\n", "x = 1")
    mime = ["text/x-ipython", "text/x-mnc", "text/x-klartext", "text/x-nc31", "text/x-ipython"]
    page.wait_for_function(f"() => ({MIME})().join() === '{','.join(mime)}'", timeout=10_000)
    found = coloured(page)
    assert len({found[text] for text in ("N10", "G90", "M3", "// comment")}) >= 3
    assert found["G90"] == found["G1"] and found["X"] != found["20.5"]
    assert found["BEGIN PGM"] == found["G90"] and "Q5" in found and found["; comment"] == found["// comment"]
    page.get_by_text("no alarms").first.wait_for(timeout=5000)


@pytest.mark.parametrize(
    ("name", "text", "pieces"),
    [
        ("part.mnc", "N10 G90 G54\nN20 G1 X20.5 F100 M3 // comment\nN30 G0 Z5\n", ("N10", "G90", "// comment")),
        ("part.h", "0 BEGIN PGM A MM\n1 L X+5 R0 FMAX ; comment\n2 FN 0: Q5 = +1\n", ("BEGIN PGM", "Q5", "; comment")),
        ("part.nc31", "N10 S800\nM3\nF20\nX4000 ~ *\nZ200 ~\n; comment\n", ("M3", "4000", "; comment")),
    ],
)
def test_files_have_colours(lab, browser, name, text, pieces):
    address, folder = lab
    (folder / name).write_text(text)
    page = browser.new_page(viewport={"width": 1000, "height": 700})
    page.goto(f"{address}/doc/tree/{name}?reset")
    page.locator(".cm-line").first.wait_for(timeout=60_000)
    found = coloured(page)
    assert len({found[piece] for piece in pieces}) == len(pieces)
    page.close()


def test_a_header_of_c_stays_one(lab, browser):
    address, folder = lab
    (folder / "c.h").write_text("#include <math.h>\nint L(int X);\n")
    page = browser.new_page()
    page.goto(f"{address}/doc/tree/c.h?reset")
    page.locator(".cm-line").first.wait_for(timeout=60_000)
    mime = page.evaluate("() => window.jupyterapp.shell.currentWidget.content.model.mimeType")
    assert "klartext" not in mime
    page.close()
