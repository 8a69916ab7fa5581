"""Tools, blanks and machines in the words that a user tries first."""

from dataclasses import fields, replace
from inspect import signature

import pytest

import mnclab as mnc
from mnclab.path.limits import Limits
from mnclab.path.tool import Tool

GROOVE = "G90 G54 T1 S1000 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX40\nG0 Z5\n"


def alarm_of(act):
    with pytest.raises(mnc.Alarm) as raised:
        act()
    return raised.value


def test_a_tool_is_given_and_read_by_its_diameter():
    tool = mnc.Tool(diameter=8, length=80)
    assert tool == mnc.Tool(radius=4, length=80)
    assert (tool.diameter, tool.radius) == (8, 4)
    assert replace(tool, length=3).diameter == 8
    assert "diameter" in signature(mnc.Tool).parameters
    assert {each.name for each in fields(Tool)} < set(signature(mnc.Tool).parameters)


@pytest.mark.parametrize("sizes", [{"radius": 4, "diameter": 8}, {"diameter": -1}, {"diameter": "8"}, {"diameter": float("nan")}])
def test_a_diameter_that_makes_no_sense(sizes):
    assert "diameter" in alarm_of(lambda: mnc.Tool(**sizes)).message


def test_a_bare_number_is_no_tool():
    found = alarm_of(lambda: mnc.run(GROOVE, "mnc", tools={1: 8}))
    assert "tools[1] must be a Tool" in found.message
    assert "a radius or a diameter" in found.hint


def test_tools_and_blank_without_a_setup():
    run = mnc.run(GROOVE, "mnc", tools={1: mnc.Tool(diameter=8, kind="mill")}, stock=(80, 60, 20))
    # a slot 8 wide along the lower edge of the blank, 2 deep: the half of it above Y0, and a quarter of a disc beyond X40
    removed = 2 * (40 * 4 + 3.141592653589793 * 16 / 4)
    assert run.workpiece().removed == pytest.approx(removed, abs=1e-2)
    assert run.stock.bounds.tolist() == [[0, 0, -20], [80, 60, 0]]


def test_a_blank_by_its_sizes_stands_at_the_datum_wherever_that_is():
    shifted = mnc.run(GROOVE, "mnc", datums={1: (100, 50, -200)}, stock=(80, 60, 20))
    assert shifted.toolpath.origin.tolist() == [100, 50, -200]
    assert shifted.stock.bounds.tolist() == [[0, 0, -20], [80, 60, 0]]
    assert shifted.workpiece().removed == pytest.approx(mnc.run(GROOVE, "mnc", stock=(80, 60, 20)).workpiece().removed)
    assert mnc.run(GROOVE, "mnc").workpiece(stock=(80, 60, 20)).removed == pytest.approx(shifted.workpiece().removed)


def test_parts_beside_a_setup_replace_its_own():
    setup = mnc.Setup(tools={1: mnc.Tool(radius=1)}, stock=(10, 10, 10))
    run = mnc.run(GROOVE, "mnc", setup, stock=mnc.box(80, 60, 20))
    assert run.setup.tools[1].radius == 1
    assert run.stock.bounds.tolist() == [[0, 0, -20], [80, 60, 0]]


@pytest.mark.parametrize("stock", ["80x60x20", (80, 60), (80, 60, 0), (80, 60, -20), 80, {"x": 80}, ((0, 0, 0), (1, 1)), "cut"])
def test_what_is_no_blank_is_refused(stock):
    assert "stock must be three sizes" in alarm_of(lambda: mnc.run(GROOVE, "mnc", stock=stock)).message


def test_an_unknown_option_names_the_nearest():
    assert "tools" in alarm_of(lambda: mnc.run(GROOVE, "mnc", tool={})).hint
    assert "stock" in alarm_of(lambda: mnc.run(GROOVE, "mnc", blank=(1, 1, 1))).hint


def test_sizes_are_no_fixture():
    assert "that has a place" in alarm_of(lambda: mnc.Setup(fixtures=((10, 10, 10),))).message


def test_boxes_and_bars():
    assert mnc.box((0, 0, -20), (80, 60, 0)) == mnc.box(80, 60, 20)
    assert mnc.cylinder(diameter=50, length=60) == mnc.blank.cylinder(25, -60, 0)
    assert mnc.cylinder(radius=25, length=60, high=2) == mnc.blank.cylinder(25, -58, 2)
    assert "radius or diameter" in alarm_of(mnc.cylinder).message
    assert "not both" in alarm_of(lambda: mnc.cylinder(25, -60, length=5)).message
    assert "three sizes" in alarm_of(lambda: mnc.box(80, 60)).message


def test_the_card_says_which_usual_tools_were_taken():
    told = mnc.run(GROOVE, "mnc")._repr_html_()
    assert "no tools were given, so the usual ones: T1 end mill 10" in told
    assert "usual" not in mnc.run(GROOVE, "mnc", tools={1: mnc.Tool(radius=5)})._repr_html_()


def test_a_machine_by_its_name():
    known = [each.name for each in mnc.machines()]
    assert "small-mill" in known
    limits = mnc.machines()[known.index("small-mill")].limits
    run = mnc.run(GROOVE, "mnc", limits="small-mill")
    assert run.setup.limits == limits == mnc.Setup(limits="small-mill").limits
    bare = mnc.run(GROOVE, "mnc")
    assert bare.profile("small-mill").time == bare.profile(machine="small-mill").time == run.profile().time
    assert bare.profile().time != run.profile().time
    assert "small-mill" in repr(mnc.machines()) and "<table" in mnc.machines()._repr_html_()


def test_a_machine_that_is_not_there():
    assert "small-mill" in alarm_of(lambda: mnc.Setup(limits="small-mil")).hint
    run = mnc.run(GROOVE, "mnc")
    assert "give one of them" in alarm_of(lambda: run.profile("small-mill", machine=Limits())).message
    assert "Limits or the name" in alarm_of(lambda: run.profile(machine=5)).message


def test_a_setup_file_names_its_machine(tmp_path):
    file = tmp_path / "s.toml"
    file.write_text('limits = "small-mill"\n')
    from mnclab.machine.setup_file import load

    assert load(file).limits == mnc.Setup(limits="small-mill").limits
    file.write_text('limits = "small"\n')
    assert alarm_of(lambda: load(file)).span.line == 1
    assert alarm_of(lambda: mnc.run(GROOVE, "mnc", str(file))).span.line == 1


def test_a_setup_file_stands_for_the_setup(tmp_path):
    file = tmp_path / "s.toml"
    file.write_text("start = [1, 2, 30]\n")
    assert mnc.run(GROOVE, "mnc", file).setup.start == mnc.run(GROOVE, "mnc", str(file)).setup.start == (1, 2, 30)
    assert mnc.run(GROOVE, "mnc", file, stock=(60, 40, 20)).setup.start == (1, 2, 30)
    assert "no such file" in str(alarm_of(lambda: mnc.run(GROOVE, "mnc", "other.toml"))).lower()
    assert "setup must be a Setup" in alarm_of(lambda: mnc.run(GROOVE, "mnc", "small-mill")).message


def test_a_machine_is_its_limits():
    assert mnc.run(GROOVE, "mnc", machine="small-mill").setup.limits == mnc.Setup(limits="small-mill").limits
    assert "give one of them" in alarm_of(lambda: mnc.run(GROOVE, "mnc", machine="small-mill", limits="small-mill")).message


def test_what_a_user_calls_is_what_tab_shows():
    shown = dir(mnc)
    assert {"run", "box", "cylinder", "machines", "compare", "panel", "help"} <= set(shown)
    assert not {"TYPE_CHECKING", "text", "load_ipython_extension", "Any", "Shelf", "OPENED"} & set(shown)
