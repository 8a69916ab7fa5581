"""Boxes whose picture follows; without a browser, a value set in Python does what a person's typing does."""

import base64
import re
import threading
from concurrent.futures import ThreadPoolExecutor

import ipywidgets
import numpy as np
import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab import Alarm
from mnclab.lab import forms
from mnclab.lab.forms.fields import groups
from mnclab.lab.forms.live import DRAWING
from mnclab.show.plot import path as plot_of_path

TEMPLATE = "G90 G54 S500 M3\nG0 X0 Y0 Z5\nG1 X{side} F{feed}\nY{side}\nX0\nY0\n"


def picture(live):
    """The pixels that are shown, and what they are called."""
    found = re.search(r'<img alt="([^"]+)" style="[^"]*" src="data:image/png;base64,([^"]+)">', live.picture.value)
    data = base64.b64decode(found[2])
    assert data.startswith(b"\x89PNG")
    return data, found[1]


def widgets(parent):
    """A widget and all below it."""
    yield parent
    for child in getattr(parent, "children", ()):
        yield from widgets(child)


def test_a_panel_follows_its_boxes_at_once():
    live = mnclab.panel(TEMPLATE, "mnc", side=40.0, feed=100)
    before, name = picture(live)
    assert "X 0 to 40" in name and "no alarms; cutting 160.000 mm" in live.alarms.value
    live.boxes["side"].value = 12.5
    after, name = picture(live)
    assert after != before and "X 0 to 12.5, Y 0 to 12.5" in name
    assert np.array_equal(live.run.toolpath.bounds[1], [12.5, 12.5, 5])


def told(live):
    """The fields with a fault, and what stands there."""
    return {name: field.fault.value for name, field in live.fields.items() if field.fault in field.row.children}


def test_a_number_that_the_control_refuses_is_told_at_its_field_and_the_last_good_picture_stays():
    live = mnclab.panel(TEMPLATE, "mnc", side=40.0, feed=100)
    pixels, _ = picture(live)
    live.boxes["feed"].value = 0
    assert list(told(live)) == ["feed"] and 'role="alert"' in told(live)["feed"]
    for place in (told(live)["feed"], live.alarms.value):
        assert "F (feed rate) must be greater than 0, got 0" in place
    again, name = picture(live)
    assert again == pixels and name.startswith("last good picture; tool path") and "mnclab-past" in live.picture.value
    live.boxes["feed"].value = 50
    assert not told(live) and "alert" not in live.alarms.value and "last good" not in live.picture.value


def test_a_program_that_never_was_good_shows_how_far_it_came():
    """Nothing can be the last good picture of a panel whose first numbers are refused."""
    live = mnclab.panel(TEMPLATE, "mnc", side=40.0, feed=0)
    assert "stopped in line 3" in picture(live)[1] and list(told(live)) == ["feed"]


def test_numbers_decide_the_kind_of_box_and_are_written_as_programs_write_them():
    live = mnclab.panel("G0 X{a} Y{b} Z{c}\n", "mnc", a=3, b=1e-5, c=(2.0, 0.0, 9.0))
    kinds = [type(live.boxes[name]) for name in "abc"]
    assert kinds == [ipywidgets.IntText, ipywidgets.FloatText, ipywidgets.BoundedFloatText]
    assert live.run.program.text == "G0 X3 Y0.00001 Z2\n"
    live.boxes["c"].value = 20
    assert live.boxes["c"].value == 9


@pytest.mark.parametrize(
    ("numbers", "sentence"),
    [({"side": 1}, "{feed} has no number"), ({"side": 1, "feed": 2, "fed": 3}, "{fed} has no place.*near: feed")],
)
def test_places_and_numbers_must_match(numbers, sentence):
    with pytest.raises(Alarm) as caught:
        mnclab.panel(TEMPLATE, "mnc", **numbers)
    assert re.search(sentence, caught.value.headline)


def test_all_figures_are_drawn_in_one_thread(monkeypatch):
    threads, draw = set(), plot_of_path.plot_run

    def watch(*arguments, **options):
        threads.add(threading.current_thread().name)
        return draw(*arguments, **options)

    monkeypatch.setattr(plot_of_path, "plot_run", watch)
    live = mnclab.panel(TEMPLATE, "mnc", side=40.0, feed=100)
    with ThreadPoolExecutor(3) as several:  # as JupyterLab calls from a thread of its own
        list(several.map(lambda side: setattr(live.boxes["side"], "value", side), [10.0, 20.0, 30.0]))
    assert len(threads) == 1 and threads.pop().startswith("drawing")


def test_a_form_is_made_from_the_declaration_of_its_cycle():
    live = mnclab.form("G83", "mnc")
    assert list(live.boxes) == [p.name for p in mnclab.controls["mnc"].cycles["G83"].parameters()]
    assert live.boxes["peck_depth"].description == "K depth of one peck [mm]"
    assert "greater than 0" in live.boxes["peck_depth"].tooltip
    assert not any(isinstance(widget, ipywidgets.FloatSlider | ipywidgets.IntSlider) for widget in widgets(live))


def test_a_box_has_a_unit_only_where_there_is_one():
    boxes = forms.form("CYCL DEF 251", "tnc-620").boxes
    assert boxes["machining_operation"].description == "Q215 machining operation"
    assert boxes["first_side_length"].description == "Q218 first side length [mm]"


def test_a_form_runs_its_cycle():
    live = mnclab.form("G83", "mnc")
    for name, value in (("bottom", -20), ("r_level", 2), ("peck_depth", 4)):
        live.boxes[name].value = value
    assert live.run.ok and live.run.toolpath.bounds[0, 2] == -20
    levels = live.run.toolpath[live.run.toolpath.kind == mnclab.Kind.LINE].end[:, 2]
    assert levels == pytest.approx([-2, -6, -10, -14, -18, -20])  # from level R in steps of 4
    live.ticks["peck_depth"].value = False
    assert live.boxes["peck_depth"].disabled
    assert "K" not in live.run.program.text.splitlines()[3]
    assert (live.run.toolpath.kind == mnclab.Kind.LINE).sum() == 1


def test_a_form_shows_the_alarm_of_its_cycle():
    live = mnclab.form("G300", "mnc")
    live.boxes["infeed"].value = 0
    assert 'role="alert"' in live.alarms.value and "G300 P" in live.alarms.value


@pytest.mark.parametrize(
    ("control", "code", "name", "value", "sentence"),
    [
        ("mnc", "G83", "peck_depth", 0, "must be greater than 0, got 0"),
        ("tnc-620", "CYCL DEF 251", "infeed", -5, "must be"),  # Q202 is how far down a layer goes, and never negative
        ("tnc-620", "CYCL DEF 200", "infeed", 1e12, "smaller than 1e"),  # the reader points into the word
        ("jnc-t01", "G77", "depth", -1, "without sign"),
        ("nc-31", "G77", "stock", -1, ""),
    ],
)
def test_a_fault_stands_at_its_field(control, code, name, value, sentence):
    live = mnclab.form(code, control)
    if name not in live.boxes:  # the second of two words P: it is told by its meaning
        name = next(p.name for p in mnclab.controls[control].cycles[code].parameters() if name in p.meaning)
    before = live.boxes[name].value
    live.boxes[name].value = value
    assert live.boxes[name].value == value, "a box pushes nothing back in silence"
    assert list(told(live)) == [name] and sentence in told(live)[name]
    assert live.boxes[name].tooltip.startswith(re.sub("<[^>]*>", "", told(live)[name])[:20])
    live.boxes[name].value = before
    assert not told(live)


def test_a_fault_that_is_of_no_field_stands_above_them():
    live = mnclab.panel(lambda side: f"G0 X{1 / side}\n", "mnc", side=2.0)
    live.boxes["side"].value = 0
    assert not told(live) and "ZeroDivisionError" in live.alarms.value
    first = live.children[-2].children[0].children[0]
    assert "ZeroDivisionError" in first.value and 'role="alert"' in first.value


def test_a_folded_group_opens_for_its_fault():
    live = mnclab.form("CYCL DEF 251", "tnc-620")
    head = live.fields["milling_feed"].head
    assert "Feeds" in head.description and head.value is False
    live.boxes["milling_feed"].value = -1
    assert head.value is True


def test_the_fields_of_a_long_form_stand_in_groups():
    """Where the manual's words put them: sides in the plane, Q201 down, F of milling, climb or conventional a strategy."""
    live = mnclab.form("CYCL DEF 251", "tnc-620")
    group = {name: field.head.description for name, field in live.fields.items()}
    wanted = {"first_side_length": "Shape", "depth": "Depths", "milling_feed": "Feeds", "overlap": "Strat"}
    assert all(group[name].startswith(head) for name, head in wanted.items())
    heads = list(dict.fromkeys(group.values()))
    assert all(int(re.search(r"\((\d+)\)", head)[1]) == list(group.values()).count(head) for head in heads)


def test_a_field_lights_its_dimension_up_in_the_picture_as_it_is_now():
    live = mnclab.form("CYCL DEF 200", "tnc-620")
    live.light("depth")
    assert "Q201 \N{MINUS SIGN}20 mm" in live.lit.value and live.lit.value.count("<polygon") == 2
    live.boxes["depth"].value = -14
    DRAWING.submit(int).result()  # it follows after the picture
    assert "Q201 \N{MINUS SIGN}14 mm" in live.lit.value
    live.light("feed") if "feed" in live.boxes else live.light("plunging_feed")
    assert "150 mm/min" in live.lit.value and "<polygon" not in live.lit.value
    live.boxes["depth"].value = 1e12
    DRAWING.submit(int).result()
    assert live.lit.value == "", "the picture is that of another value"


def test_a_value_is_written_as_a_help_picture_has_it():
    """In mm where a word counts in parts of them, with the meaning of a choice, nothing where the word is left out."""
    live = mnclab.form("G77", "nc-31")
    for name, text in (("x", "X 30 mm ⌀"), ("feed", "F 0.2 mm/rev")):
        live.light(name)
        assert f"<title>{text}</title>" in live.lit.value
    live = mnclab.form("CYCL DEF 251", "tnc-620")
    live.light(next(name for name, box in live.boxes.items() if box.description.startswith("Q224")))
    assert "<title>Q224 15°</title>" in live.lit.value
    live = mnclab.form("G83", "mnc")
    live.ticks["peck_depth"].value = False
    live.light("peck_depth")
    assert live.lit.value == ""
    with pytest.raises(Alarm, match="a parameter must be"):
        live.light("peck")


def test_the_picture_of_a_form_has_no_legend_and_shows_the_blank():
    live = mnclab.form("G83", "mnc")
    assert live.figure.legends == [] and len(live.figure.axes) == 2
    assert all(any(each.get_label() == "_blank" for each in ax.patches) for ax in live.figure.axes)
    used = max(ax.get_position().y1 for ax in live.figure.axes) * live.figure.get_figheight()
    assert live.figure.get_figheight() - used < 0.2  # the views have the room of the legend


@pytest.mark.parametrize("code", ["22", "24", "251"])
def test_the_blank_of_a_form_goes_round_its_pocket(code):
    """Beyond each wall, a radius of the tool from the path, stands as much on one side as on the other."""
    live = mnclab.form(code, "tnc-620")
    (x0, y0, _), (x1, y1, _) = live.run.toolpath[np.isin(live.run.toolpath.kind, (1, 2))].bounds
    patches = [each for ax in live.figure.axes for each in ax.patches if each.get_label() == "_blank"]
    (left, low), (right, high) = patches[0].get_path().get_extents().get_points()
    sides = x0 - left, right - x1, y0 - low, high - y1
    assert min(sides) > live.run.toolpath.radius.max() + 2 and max(sides) - min(sides) < 1e-6
    view = live.figure.axes[0].get_xlim()
    assert right - left > 0.5 * (view[1] - view[0])


def test_a_short_form_has_no_groups():
    assert not any(field.head for field in mnclab.form("G77", "jnc-t01").fields.values())


@pytest.mark.parametrize("control", mnclab.controls)
def test_every_field_stands_in_one_group_and_in_the_order_of_the_manual(control):
    for code, cycle in mnclab.controls[control].cycles.items():
        declared = cycle.parameters()
        found = groups(declared)
        assert sorted(p.name for those in found.values() for p in those) == sorted(p.name for p in declared), code
        assert all([p for p in declared if p in those] == those for those in found.values()), code
        assert len(declared) <= 8 or len(found) > 1, f"{code} has one long group"


def test_the_steps_of_a_form_follow_it():
    """Lesson 6: infeeds 6, then shrinking by 3 but not below 2, of 15 mm: to -6, -9, -11, -13, -15."""
    live = mnclab.form("G303", "mnc")
    cells = lambda: re.sub("<[^>]*>", " ", live.steps_view.value)  # noqa: E731
    assert "peck 1 of 5" in cells() and "-11" in cells()
    live.boxes["infeed"].value = 15
    live.boxes["min_infeed"].value = 15
    assert "drill" in cells() and "peck" not in cells() and "-11" not in cells()


def test_the_moves_in_the_program_stand_for_steps_that_need_one():
    live = mnclab.form("CYCL DEF 275", "tnc-620")
    assert live.run.ok and "layer 1 of 2, trochoid" in live.steps_view.value
    moved = live.run.toolpath
    own = [label.startswith("CYCL DEF 275 ") for label in np.array(moved.labels)[moved.label]]
    assert live.steps_view.value.count("<tr>") == 1 + sum(own) > 200, "a row of each of its moves, none cut"
    heads = [re.findall("<th[^>]*>([^<]*)", form.steps_view.value) for form in (live, mnclab.form("CYCL DEF 251", "tnc-620"))]
    assert heads[0] == heads[1] and "feed, mm/min" in heads[0]
    live.boxes["infeed"].value = 0.0
    assert "<table" not in live.steps_view.value and "other values" in live.steps_view.value


def test_the_field_with_the_cursor_stays_lit_when_one_before_it_changes_late():
    """The next field has the cursor already when the value that was typed before it arrives."""
    live = mnclab.form("CYCL DEF 200", "tnc-620")
    live.boxes["depth"].value = -14.0
    DRAWING.submit(int).result()
    assert "<title>Q201 \N{MINUS SIGN}14 mm</title>" in live.lit.value, "nobody says where the cursor is"
    live.asked.value = str([*live.boxes].index("feed"))
    live.boxes["depth"].value = -15.0
    DRAWING.submit(int).result()
    assert "<title>Q206 150 mm/min</title>" in live.lit.value


def test_what_is_said_of_a_parameter_is_what_an_alarm_says():
    live = mnclab.form("CYCL DEF 251", "tnc-620")
    live.boxes["infeed"].value = 0.0
    assert "must be greater than 0" in told(live)["infeed"]
    assert "greater than 0" in live.boxes["infeed"].tooltip and "at least 0" not in live.boxes["infeed"].tooltip


EVERY = [(name, code) for name in mnclab.controls for code in mnclab.controls[name].cycles]
FEW = 10  # of so many one is drawn each time, all of them with the deep tests


@pytest.mark.parametrize(
    ("control", "code"),
    [
        pytest.param(*pair, id=" ".join(pair), marks=[pytest.mark.deep] if number % FEW else [])
        for number, pair in enumerate(EVERY)
    ],
)
def test_every_cycle_has_a_form(control, code):
    live = mnclab.form(code, control)
    declared = mnclab.controls[control].cycles[code].parameters()
    assert list(live.boxes) == [parameter.name for parameter in declared]  # whose order is that of the manual
    for parameter in declared:
        box = live.boxes[parameter.name]
        assert parameter.address in box.description and parameter.meaning in box.description
        assert parameter.several or not parameter.refuses(box.value), "the first value is outside what is allowed"
        if parameter.example is not None and not parameter.several:
            assert box.value == parameter.example
    assert live.run is not None or "no picture yet" in live.picture.value
    if live.run and all(parameter.example is not None for parameter in declared):
        assert not live.run.alarms and len(live.run.toolpath) >= 2, "examples make a program that runs"


def test_a_function_has_no_form():
    with pytest.raises(Alarm, match="'G1' has no parameters"):
        forms.form("G1", "mnc")


def test_a_text_has_a_text_box_that_is_written_in_quotes():
    live = mnclab.form("CYCL DEF 225", "tnc-620")
    box = live.boxes["text"]
    assert isinstance(box, ipywidgets.Text) and '  Q500="ABC"' in live.run.program.text
    narrow = live.run.toolpath.bounds
    box.value = "ABCABC"
    assert 'Q500="ABCABC"' in live.run.program.text and live.run.ok
    assert live.run.toolpath.bounds[1][0] > narrow[1][0]
    assert isinstance(mnclab.form("CYCL DEF 12", "tnc-620").boxes["program_name"], ipywidgets.Text)


def test_a_rapid_that_is_left_out_is_a_word_to_tick():
    """Q208 of cycle 22 stands for FMAX where it is not written; no number in a box means that."""
    live = mnclab.form("CYCL DEF 22", "tnc-620")
    assert "Q208" not in live.run.program.text and not live.ticks["retract_feed"].value
    live.ticks["retract_feed"].value = True
    assert "Q208=+120" in live.run.program.text


def test_a_form_shows_the_steps_of_its_cycle():
    """Pecks of 6 from the surface 0 to -14: -6, -12 and the rest; the box changes them to 7: -7, -14."""
    form = mnclab.form("CYCL DEF 200", "tnc-620")
    form.boxes["depth"].value, form.boxes["infeed"].value = -14, 6
    pecks = [step.z for step in form.steps() if step.label.startswith("peck")]
    form.boxes["infeed"].value = 7
    assert pecks == [-6, -12, -14] and [s.z for s in form.steps() if s.label.startswith("peck")] == [-7, -14]


SUB_BLOCKS = {
    "CYCL DEF 7": "CYCL DEF 7.1 X+60\nCYCL DEF 7.2 Y+25\n", "CYCL DEF 8": "CYCL DEF 8.1 X\n",
    "CYCL DEF 10": "CYCL DEF 10.1 ROT+30\n", "CYCL DEF 11": "CYCL DEF 11.1 SCL +0.5\n",
    "CYCL DEF 12": "CYCL DEF 12.1 PGM ABC\n", "CYCL DEF 14": "CYCL DEF 14.1 CONTOUR LABEL 1/2\n",
    "CYCL DEF 19": "CYCL DEF 19.1 B+30\n", "CYCL DEF 26": "CYCL DEF 26.1 X+1.4\n",
}  # fmt: skip


@pytest.mark.parametrize("code", SUB_BLOCKS)
def test_a_cycle_in_sub_blocks_has_a_picture(code):
    live = mnclab.form(code, "tnc-620")
    assert SUB_BLOCKS[code] in live.run.program.text and live.run.ok
    assert "no alarms; cutting" in live.alarms.value and picture(live)[1]


@pytest.mark.parametrize("number", deep_but_one_in(3, [20, 21, 22, 23, 24, 25, 27, 28, 29, 39, 270, 275, 276]))
def test_a_contour_cycle_machines_a_contour_in_its_form(number):
    live = mnclab.form(f"CYCL DEF {number}", "tnc-620")
    assert live.run.ok and not live.run.alarms and "CYCL DEF 14.1 CONTOUR LABEL 1" in live.run.program.text
    assert live.run.summary()["cutting length"] > 20
    _, name = picture(live)
    assert ("developed cylinder" in name) == (number in (27, 28, 29, 39))


def test_a_shift_shows_a_figure_before_and_after():
    """The figure lies from X10 Y5 to X50 Y30, 40 by 25; moved by 60 and 25 it ends at X110 Y55."""
    live = mnclab.form("CYCL DEF 7", "tnc-620")
    live.ticks["y"].value = True
    cuts = live.run.toolpath[live.run.toolpath.kind == mnclab.Kind.LINE].end
    assert cuts[:, :2].min(axis=0).tolist() == [10, 5] and cuts[:, :2].max(axis=0).tolist() == [110, 55]
    live.boxes["x"].value = -60.0
    cuts = live.run.toolpath[live.run.toolpath.kind == mnclab.Kind.LINE].end
    assert cuts[:, 0].min() == -50 and live.run.program.text.count("CYCL DEF 7") == 3


def test_labels_and_axes_are_typed_as_a_program_has_them():
    """The pocket is 90 by 60; the second one, a circle of 15 about its right edge, makes it 105 long: R 5 and 0.2 stay."""
    live = mnclab.form("CYCL DEF 14", "tnc-620")
    box = live.boxes["labels"]
    assert isinstance(box, ipywidgets.Text) and box.value == "1/2"
    box.value = "1/3"
    cuts = live.run.toolpath[live.run.toolpath.kind <= mnclab.Kind.ARC]
    assert cuts.bounds[1, 0] == pytest.approx(105 - 5.2) and live.run.ok
    box.value = "1/9"
    assert "names label 9, which does not exist" in live.alarms.value
    box.value = "one"
    assert 'role="alert"' in live.alarms.value
    mirror = mnclab.form("CYCL DEF 8", "tnc-620")
    mirror.boxes["mirrored_axes"].value = "X Y"
    cuts = mirror.run.toolpath[mirror.run.toolpath.kind == mnclab.Kind.LINE].end
    assert cuts[:, :2].min(axis=0).tolist() == [-50, -30]
    assert [row.step.value for row in mirror.steps().rows if hasattr(row.step, "value")]


def test_a_count_has_no_unit():
    named = [box.description for n in (7, 21, 22, 24) for box in mnclab.form(f"CYCL DEF {n}", "tnc-620").boxes.values()]
    assert not [name for name in named if "[count]" in name or "[text]" in name]


def test_a_probe_does_not_turn_in_the_program_of_a_form():
    """A control refuses to turn a touch probe; a drill turns."""
    live = mnclab.form("TCH PROBE 421", "tnc-620")
    assert live.run.ok and "M3" not in live.program.value
    assert "M3" in mnclab.form("CYCL DEF 200", "tnc-620").program.value


@pytest.mark.parametrize(("code", "place", "away"), [
    ("TCH PROBE 412", (50, 30, -8), 10),  # the middle of a bore of 20 mm
    ("TCH PROBE 412", (54, 33, -8), 5),
    ("TCH PROBE 413", (62, 46, -8), 10),  # 20 mm from the middle of a stud of 20 mm
    ("TCH PROBE 410", (50, 30, -8), 10),  # the middle of a pocket of 40 by 20 mm
    ("TCH PROBE 411", (75, 30, -8), 5),  # beside a block of 40 by 20 mm
    ("TCH PROBE 418", (20, 60, -8), 4), ("TCH PROBE 418", (50, 40, -8), -5),  # the middle of a bore, and between four of them
    ("TCH PROBE 402", (95, 20, -8), 5), ("TCH PROBE 402", (50, 20, -8), 20),  # two studs of 20 mm about X20 and X80
    ("TCH PROBE 1411", (75, 30, -8), 10), ("TCH PROBE 416", (70, 30, -8), 4),
])  # fmt: skip
def test_a_form_that_probes_has_the_part_that_its_cycle_is_for(code, place, away):
    live = mnclab.form(code, "tnc-620")
    assert live.run.ok and live.run.setup.part([place]) == pytest.approx(away)


def test_the_edge_that_two_touches_lie_on_may_lean():
    live = mnclab.form("TCH PROBE 400", "tnc-620")
    next(box for name, box in live.boxes.items() if live.fields[name].parameter.address == "Q266").value = 22
    assert live.run.ok and live.run.setup.part([(20, 10, -8), (50, 16, -8), (80, 22, -8)]) == pytest.approx(0, abs=1e-9)
