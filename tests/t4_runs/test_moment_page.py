"""The page of a moment: the line as written, what the block really changed, names with units."""

import pytest

import mnclab
from mnclab.machine.cycle import help_html, help_text

SHAFT = "N1 S800\nN2 F20\nN3 Z200~\nN4 X4000~\nN10 G77*~ ; roughing\nN11 X2440*\nN12 Z-2990*\nN13 F3000*\nN14 P400\n"


def lines(run, line):
    return dict(run.at(line=line).page())


def test_a_value_written_again_is_no_change():
    run = mnclab.run(SHAFT, "nc-31")
    moment, page = run.at(line=5), lines(run, 5)
    assert not moment.changed and page["changed"] == "nothing" and ">nothing</td>" in moment._repr_html_()
    assert page["active"] == "plane ZX, speed 800 rev/min, spindle clockwise, feed 0.2 mm/rev"


@pytest.mark.parametrize(("line", "text"), [(2, "1 Q3 = 72"), (3, '2 LBL "ROUND"'), (4, "3 L X+1 R0 F100")])
def test_the_heading_is_the_line_as_written(line, text):
    run = mnclab.run('0 BEGIN PGM A MM\n1 Q3 = 72\n2 LBL "ROUND"\n3 L X+1 R0 F100\n4 END PGM A MM\n', "tnc-620")
    moment = run.at(line=line)
    assert repr(moment).splitlines()[0] == f"line {line}: {text}"
    assert f"<code>{text}</code>" in moment._repr_html_().replace("&quot;", '"')


def test_values_have_names_and_units():
    text = "G92 S2000 M4\nG96 S120\nG95 F0.2\nG0 X30 Z0\nG1 X20\nM5\n"
    run = mnclab.run(text, "jnc-t01", mnclab.Setup(start=(40, 0, 20)))
    page = " ".join(repr(run.at(line=5)).split())
    for told in ("cutting speed 120 m/min", "spindle counter-clockwise", "feed 0.2 mm/rev"):
        assert told in page
    assert "per_rev" not in page and "turning" not in page and "frame" not in page
    assert "spindle stopped" in lines(run, 6)["changed"]


def test_a_feed_that_counts_otherwise_is_told_with_its_new_unit():
    run = mnclab.run("S100 M3\nG94 F2\nG1 X1\nG41 G1 X5\nG95 F2\n", "mnc")
    assert "feed 2 mm/min" in lines(run, 2)["changed"] and "feed 2 mm/rev" in lines(run, 5)["changed"]
    assert "compensation left" in lines(run, 4)["changed"]


def test_a_column_of_help_that_is_empty_is_left_out():
    cycles = mnclab.controls["tnc-620"].cycles
    plain, noted = cycles["CYCL DEF 7"], cycles["CYCL DEF 253"]
    for cycle in (plain, noted):
        notes = any(parameter.note for parameter in cycle.parameters())
        assert (" note" in help_text(cycle)) == (">note</th>" in help_html(cycle)) == notes
    assert "2 as 1" in help_text(noted) and "0 as 1" in help_text(noted)
