"""A third party's control is shown as the house's own are: forms, magic, colours, without a word about it in `show`."""

import re

import numpy as np
import pytest

import mnclab
from mnclab import Kind
from mnclab.controls.word_address.reader import reader
from mnclab.lab import cell, forms
from mnclab.lab.forms.live import DRAWING
from mnclab.machine.control import Control, FunctionTable
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.trial import number
from mnclab.machining.steps import Go
from mnclab.show.plot import colours

FUNCTIONS, CYCLES = FunctionTable(), CycleTable()


@FUNCTIONS("G0", "Rapid", group="motion", takes="X Y Z", power_on="G0", moves=True)
def rapid(m, words):
    m.rapid(**{axis.lower(): m.value(word) for axis, word in words.items() if axis in "XYZ"})


@CYCLES("G81", "Punch", runs="definition", source="here")
class Punch(Cycle):
    """Goes down at feed and up at rapid."""

    depth: float = param("P", "depth of the punch", above=0, at_most=20, example=3)
    way: float = param("W", "way up", "choice", default=0, choices={0: "to the surface", 1: "2 mm above it"})

    def moves(self, m):
        yield Go("down", -self.depth, 50)
        yield Go("up", 2 * self.way)


def around(cycle, words):
    return f"G0 X1 Y1 Z0\n{cycle.code} {' '.join(letter + number(value) for letter, value in words)}\n"


TOY = Control("toy", "Toy", reader("toy", comment=";"), FUNCTIONS, CYCLES, ("motion",), (".toy",), trial=around)


@pytest.fixture(autouse=True)
def toy():
    yield mnclab.controls.add(TOY)
    mnclab.controls.remove("toy")


def test_its_cycle_has_a_form_that_follows():
    live = mnclab.form("G81", "toy")
    assert live.run.program.text == "G0 X1 Y1 Z0\nG81 P3\n" and live.run.toolpath.bounds[0, 2] == -3
    assert live.boxes["way"].options[1] == ("1 2 mm above it", 1) and "<img alt=" in live.picture.value
    live.boxes["depth"].value, live.boxes["way"].value = 5, 1
    assert live.run.program.text.endswith("G81 P5 W1\n") and live.run.toolpath.end[-1, 2] == 2


def test_without_a_trial_program_the_form_says_so():
    mnclab.controls.add(Control("toy", "Toy", TOY.read, FUNCTIONS, CYCLES, ("motion",)))
    assert "no picture yet" in forms.form("G81", "toy").picture.value


def test_its_help_says_what_choices_mean():
    assert re.search(r"W +way up +choice +0 to the surface +0\n +1 2 mm above it\n", str(mnclab.help("G81", "toy")) + "\n")


def test_its_moves_have_the_colours_of_all_moves():
    run = mnclab.run("G0 X5\nG81 P3\n", "toy")
    assert np.array_equal(run.toolpath.kind, [Kind.RAPID, Kind.LINE, Kind.RAPID])
    used = {line.get_color() for axes in run.plot().axes for line in axes.lines}
    assert {colours.RAPID.colour, colours.FEED.colour} <= used


def test_it_can_be_named_wherever_a_control_is_named():
    """Cells list it among their options, the editor and a panel read programs of it, files are known by their suffix."""
    assert "toy" in cell.options().format_help() and cell.run_cell("--control toy", "G81 P3", {})[1].ok
    assert mnclab.panel("G81 P{depth}\n", "toy", depth=4).run.toolpath.bounds[0, 2] == -4
    assert "toy" in list(mnclab.controls) and "G81" in mnclab.help("toy")._repr_html_()


def test_its_files_open_in_the_editor(tmp_path):
    live = mnclab.editor(tmp_path / "part.toy")
    live.text.value = "G81 P7\n"
    DRAWING.submit(lambda: None).result()  # a busy machine may still be drawing
    assert live.run.control is TOY and live.run.toolpath.bounds[0, 2] == -7
