"""What a field of a form measures is found by trying; here it is compared with what the manuals say that the words mean."""

import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

import mnclab
from mnclab import Kind
from mnclab.lab.forms.dimension_lines import half_of, over, windows
from mnclab.lab.forms.example import Example, near
from mnclab.lab.forms.measuring import Angle, Length, Moves, Radius
from mnclab.machine import trial


def first(control, code, **values):
    """A cycle alone with the values that a form begins with, and others by their address; its run."""
    one = mnclab.controls[control]
    example = Example(one, one.cycles[code])
    parameters = example.cycle.parameters()
    begun = {
        p.name: trial.first_value(p)
        for p in parameters
        if p.required or p.default not in (None, math.inf) or trial.written_first(p)
    }
    begun |= {p.name: values[p.address] for p in parameters if p.address in values}
    return example, begun, example.run(begun)


def measured(control, code, address, meaning="", **values):
    """What the parameter of an address (and of a word of its meaning) measures."""
    example, begun, run = first(control, code, **values)
    assert run.ok
    return example.measured(run, parameter(example, address, meaning), begun)


def parameter(example, address, meaning=""):
    return next(p for p in example.cycle.parameters() if p.address == address and meaning in p.meaning)


#: Where a dimension begins and ends along its axis (X 0, Y 1, Z 2), as the manual defines the word; the tool stands at X20 Y10.
LEVELS = [
    ("mnc", "G83", "Z", 2, 0, -20), ("mnc", "G83", "R", 2, 0, 2), ("mnc", "G83", "K", 2, 2, -3),  # the first peck from level R
    ("mnc", "G83", "X", 0, 0, 20), ("mnc", "G83", "Y", 1, 0, 10),
    ("mnc", "G321", "A", 0, 0, 60), ("mnc", "G321", "B", 1, 0, 40), ("mnc", "G321", "W", 2, 0, -5),
    ("mnc", "G343", "W", 2, -10, -9.5),
    ("g43", "G83", "Z", 2, 0, -20), ("g43", "G84", "R", 2, 0, 2), ("g43", "G76", "X", 0, 0, 20),
    ("tnc-620", "CYCL DEF 200", "Q200", 2, 0, 2), ("tnc-620", "CYCL DEF 200", "Q201", 2, 0, -20),
    ("tnc-620", "CYCL DEF 200", "Q202", 2, 0, -5), ("tnc-620", "CYCL DEF 200", "Q204", 2, 0, 20),
    ("tnc-620", "CYCL DEF 251", "Q369", 2, -20, -19.9), ("tnc-620", "CYCL DEF 254", "Q216", 0, 0, 50),
    ("tnc-620", "CYCL DEF 22", "Q10", 2, 0, -10),
    ("tnc-620", "TCH PROBE 421", "Q273", 0, 0, 50), ("tnc-620", "TCH PROBE 421", "Q261", 2, 0, -5),  # of the middle of the ball
    ("tnc-620", "TCH PROBE 418", "Q270", 0, 0, 80), ("tnc-620", "TCH PROBE 418", "Q317", 1, 0, 60),  # of centres
    ("tnc-620", "TCH PROBE 400", "Q264", 1, 0, 10), ("tnc-620", "TCH PROBE 426", "Q265", 0, 0, 80),  # of touches
    ("tnc-620", "TCH PROBE 414", "Q326", 0, 40, 70), ("mnc", "G414", "A", 0, 20, 80),  # from one touch to the next
    ("tnc-620", "CYCL DEF 231", "Q235", 1, 0, 70), ("tnc-620", "CYCL DEF 232", "Q225", 0, 0, 10),
    ("tnc-620", "CYCL DEF 20", "Q5", 2, 0, 0), ("mnc", "G303", "Z", 2, 0, 0),  # the surface, below the clearance
    ("tnc-620", "CYCL DEF 225", "Q203", 2, 0, 0), ("tnc-620", "CYCL DEF 267", "Q239", 2, 1, -0.5),  # from 1 mm above the stud
    ("jnc-t01", "G75", "X", 0, 0, 25), ("jnc-t01", "G75", "Z", 2, 0, -15), ("jnc-t01", "G77", "Z", 2, 0, -75),
    ("nc-31", "G77", "Z", 2, 0, -20), ("nc-31", "G77", "X", 0, 0, 15), ("nc-31", "G70", "X", 0, 0, 15),  # X3000 is 30 mm wide
    ("nc-31", "G31", "X", 0, 0, 18),
    ("nc-31", "G31", "F", 2, 2, 0.5),  # a pitch of 1.5 mm, from the start
]  # fmt: skip


@pytest.mark.parametrize(("control", "code", "address", "axis", "begin", "end"), LEVELS)
def test_a_dimension_reaches_from_where_the_manual_counts_to_the_place(control, code, address, axis, begin, end):
    found = measured(control, code, address)
    assert isinstance(found, Length)
    assert (found.begin[axis], found.end[axis]) == pytest.approx((begin, end), abs=1e-6)
    assert np.abs(np.delete(found.end - found.begin, axis)).max() < 1e-6 and abs(found.way[axis]) == pytest.approx(1)


#: (length, middle) of sizes of figures that are cut about the tool at X20 Y10, turned by 15 degrees.
SIZES = [
    ("tnc-620", "CYCL DEF 251", "Q218", 80, 15), ("tnc-620", "CYCL DEF 251", "Q219", 60, 105),
    ("tnc-620", "CYCL DEF 253", "Q218", 80, 15), ("tnc-620", "CYCL DEF 253", "Q219", 12, 105),
    ("tnc-620", "CYCL DEF 256", "Q218", 60, 15), ("tnc-620", "CYCL DEF 256", "Q219", 40, 105),
    ("mnc", "G343", "A", 60, 15), ("mnc", "G343", "B", 40, 105),
]  # fmt: skip


@pytest.mark.parametrize(("control", "code", "address", "long", "turn"), SIZES)
def test_a_size_stands_between_the_walls_though_the_path_keeps_the_tool_off_them(control, code, address, long, turn):
    found = measured(control, code, address)
    way = found.end - found.begin
    assert np.linalg.norm(way) == pytest.approx(long, abs=1e-5)
    assert ((found.begin + found.end)[:2] / 2 - (20, 10)) @ way[:2] == pytest.approx(0, abs=1e-3)
    assert math.degrees(math.atan2(way[1], way[0])) % 180 == pytest.approx(turn, abs=1e-3)


@pytest.mark.parametrize(
    ("control", "code", "address", "wide"),
    [
        ("tnc-620", "CYCL DEF 208", "Q335", 14), ("tnc-620", "CYCL DEF 262", "Q335", 10), ("mnc", "G344", "D", 50),
        ("tnc-620", "CYCL DEF 220", "Q244", 80), ("tnc-620", "CYCL DEF 254", "Q375", 80),
        ("tnc-620", "TCH PROBE 421", "Q262", 20),
    ],
)  # fmt: skip
def test_a_diameter_goes_through_the_middle(control, code, address, wide):
    middle = {"CYCL DEF 220": (50, 50), "CYCL DEF 254": (50, 50), "TCH PROBE 421": (50, 30)}.get(code, (20, 10))
    found = measured(control, code, address)
    assert np.linalg.norm(found.end - found.begin) == pytest.approx(wide, abs=1e-5)
    assert ((found.begin + found.end) / 2)[:2] == pytest.approx(middle, abs=1e-4)


def test_a_corner_has_its_radius_and_a_wall_its_allowance():
    """Of a pocket of 80 by 60, turned by 15 degrees about X20 Y10: both end at the wall, not at the path of the tool."""
    corner, thick = (measured("tnc-620", "CYCL DEF 251", address) for address in ("Q220", "Q368"))
    turn = math.radians(15)
    back = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    centre = back @ (corner.centre[:2] - (20, 10))
    assert isinstance(corner, Radius) and np.linalg.norm(corner.end - corner.centre) == pytest.approx(8, abs=1e-5)
    assert np.abs(centre) == pytest.approx([40 - 8, 30 - 8], abs=1e-4)
    ends = [back @ (end[:2] - (20, 10)) for end in (thick.begin, thick.end)]
    off = sorted(max(abs(each[0]) - 40, abs(each[1]) - 30) for each in ends)
    assert off == pytest.approx([-0.2, 0], abs=1e-5)


@pytest.mark.parametrize(
    ("control", "code", "address", "begin", "sweep"),
    [
        ("tnc-620", "CYCL DEF 251", "Q224", 0, 15), ("mnc", "G343", "E", 0, 15), ("tnc-620", "CYCL DEF 254", "Q376", 0, 45),
        ("tnc-620", "CYCL DEF 254", "Q248", 45, 90),  # from the starting angle on
        ("tnc-620", "TCH PROBE 421", "Q247", 0, 90), ("tnc-620", "CYCL DEF 10", "ROT", None, 30),
    ],
)  # fmt: skip
def test_an_angle_turns_about_its_middle(control, code, address, begin, sweep):
    found = measured(control, code, address)
    assert isinstance(found, Angle) and math.degrees(found.sweep) == pytest.approx(sweep, abs=1e-3)
    if begin is not None:
        assert math.degrees(math.atan2(found.arm[1], found.arm[0])) == pytest.approx(begin, abs=1e-3)


def test_no_allowance_stands_down_at_the_floor_and_not_at_the_surface():
    found = measured("tnc-620", "CYCL DEF 251", "Q369", **{"Q369": 0.0})  # the floor is at -20, 2 below where the tool lifts off
    assert -20 - 1e-6 <= found.begin[2] == found.end[2] <= -18 + 1e-6


def test_a_helix_rises_by_its_pitch():
    for address, code, pitch in (("Q239", "CYCL DEF 262", 1.5), ("Q334", "CYCL DEF 208", -1.5)):
        found = measured("tnc-620", code, address)
        assert found.end[2] - found.begin[2] == pytest.approx(pitch, abs=1e-5)


@pytest.mark.parametrize(
    ("control", "code", "address", "meaning", "column", "value"),
    [
        ("tnc-620", "CYCL DEF 251", "Q206", "", "feed", 150), ("mnc", "G321", "T", "", "feed", 800),
        ("tnc-620", "CYCL DEF 200", "Q211", "", "time", 0.25), ("mnc", "G83", "P", "", "time", 0.5),
        ("nc-31", "G77", "F", "", "per_rev", 0.2),
    ],
)  # fmt: skip
def test_a_feed_or_a_dwell_means_the_moves_that_have_it(control, code, address, meaning, column, value):
    example, begun, run = first(control, code)
    found = example.measured(run, parameter(example, address, meaning), begun)
    path = example.own(run.toolpath)
    assert isinstance(found, Moves) and found.rows.any()
    assert getattr(path, column)[found.rows] == pytest.approx(value)


def test_another_value_is_another_dimension():
    assert measured("tnc-620", "CYCL DEF 200", "Q201", Q201=-14.0, Q203=3.0).end[2] == pytest.approx(3 - 14)
    found = measured("tnc-620", "CYCL DEF 200", "Q200", Q200=3.5, Q203=2.0)
    assert found.end[2] - found.begin[2] == pytest.approx(3.5)
    assert measured("tnc-620", "CYCL DEF 251", "Q368", Q368=0.0) is not None  # nothing is left, and is shown so


def test_what_cannot_be_seen_measures_nothing():
    """A choice, a tolerance, a text."""
    assert measured("tnc-620", "CYCL DEF 251", "Q351") is None
    assert measured("mnc", "G421", "R") is None
    assert measured("tnc-620", "CYCL DEF 225", "Q500") is None


EVERY = [(name, cycle.code) for name, one in mnclab.controls.items() for cycle in dict.fromkeys(one.cycles.values())]


@pytest.mark.deep
@pytest.mark.parametrize(("control", "code"), EVERY)
def test_a_dimension_is_as_long_as_its_value(control, code):
    """In the unit of its word; on a lathe half as long where it counts on the diameter. Half a size would tell a lie."""
    example, begun, run = first(control, code)
    for p in example.cycle.parameters() if run is not None and run.ok else ():
        found = example.measured(run, p, begun)
        counts = float(p.unit.split()[0]) / (2 if "diameter" in p.unit else 1) if p.unit[:1].isdigit() else 1.0
        if isinstance(found, Length) and "mm" in p.unit:
            assert np.linalg.norm(found.end - found.begin) == pytest.approx(abs(begun[p.name]) * counts, abs=1e-5), p.address
        if isinstance(found, Angle):
            assert abs(math.degrees(found.sweep)) == pytest.approx(abs(begun[p.name]), abs=1e-3), p.address


# The picture: the cycle, a blank behind it, and dimension lines over it.


@pytest.mark.parametrize(("control", "code"), [("tnc-620", "CYCL DEF 251"), ("tnc-620", "CYCL DEF 22"), ("nc-31", "G33")])
def test_rapids_far_from_the_cuts_are_cut_off(control, code):
    """The drill of the TNC comes from Z50, its cycle cuts from 2 to -20; no point is moved, and every cut stays."""
    example, _, run = first(control, code)
    path = example.own(run.toolpath)
    shown = near(path)
    cuts = [each[np.isin(each.kind, (Kind.LINE, Kind.ARC))] for each in (path, shown)]
    assert np.array_equal(cuts[0].end, cuts[1].end)
    assert shown.bounds[1, 2] < 30 and shown.length < path.length
    whole = path[path.kind == Kind.RAPID]
    for move in shown[shown.kind == Kind.RAPID]:  # each lies on one of the path
        on = [
            abs(math.dist(row.start, move.start) + math.dist(move.start, move.end) + math.dist(move.end, row.end)
                - math.dist(row.start, row.end)) < 1e-9
            for row in whole
        ]  # fmt: skip
        assert any(on)


def test_a_blank_stands_behind_with_the_datum_at_its_corner():
    example, begun, run = first("tnc-620", "CYCL DEF 200")
    (low, high) = example.blank(example.own(run.toolpath), begun).bounds
    assert low[:2].tolist() == [0, 0] and high[2] == 0 and low[2] < -20 and (high[:2] > (24, 14)).all()  # a hole of 8 at 20, 10
    assert example.blank(example.own(run.toolpath), begun | {"surface": 5.0}).bounds[1, 2] == 5
    example, begun, run = first("nc-31", "G77")
    bar = example.blank(example.own(run.toolpath), begun)
    assert bar.bounds[1, 0] == 20 and bar.bounds[0, 2] < -20 and bar.bounds[1, 2] == 0  # X4000 is a radius of 20


@pytest.mark.parametrize(
    ("control", "code", "kind"),
    [("jnc-t01", "G75", "grooving"), ("jnc-t01", "G73", "drill"), ("nc-31", "G31", "thread"), ("nc-31", "G33", "tap"),
     ("nc-31", "G74", "face grooving"), ("nc-31", "G77", "turning")],
)  # fmt: skip
def test_the_tool_of_the_cycle_stands_in_the_picture(control, code, kind, monkeypatch):
    from mnclab.show.plot import path as module

    drawn, lathe = [], module.lathe
    monkeypatch.setattr(module, "lathe", lambda *given: drawn.append(lathe(*given)) or drawn[-1])
    example, begun, run = first(control, code)
    example.plot(run, begun, size=(4.9, 4.2))
    assert [each.tool.kind for each in drawn] == [kind]


def sheet(control, code, address, meaning="", **values):
    """The dimension over a picture as XML, the windows of the picture, and what is measured."""
    example, begun, run = first(control, code, **values)
    picture = example.plot(run, begun, size=(4.9, 4.2))
    picture.html()
    found = example.measured(run, parameter(example, address, meaning), begun)
    size = tuple(100 * side for side in picture.get_size_inches())
    text = over(found, f"{address} value", example.own(run.toolpath), windows(picture), size)
    return ElementTree.fromstring(text), windows(picture), found, size


NUMBER = re.compile(r"-?[\d.]+")


def heads(root):
    """The tips of the arrow heads."""
    return np.array([list(map(float, NUMBER.findall(each.get("points"))))[:2] for each in root.iter("polygon")])


@pytest.mark.parametrize(
    ("control", "code", "address"),
    [("tnc-620", "CYCL DEF 251", "Q219"), ("tnc-620", "CYCL DEF 275", "Q368"), ("jnc-t01", "G75", "Z")],
)
def test_a_value_covers_no_symbol_no_tool_and_no_arrow_of_its_own(control, code, address):
    root, shown, *_ = sheet(control, code, address)
    (text,) = root.iter("text")
    place = np.array([float(text.get("x")), float(text.get("y")) - 6])
    half = half_of(text.text) + 5, 8.5 + 5  # with half of a symbol
    for taken in (*(each.taken for each in shown), heads(root)):
        assert not (np.abs(taken - place) < half).all(axis=1).any()


@pytest.mark.parametrize(
    ("control", "code", "address", "view"),
    [("mnc", "G83", "Z", 1), ("mnc", "G83", "X", 0), ("tnc-620", "CYCL DEF 251", "Q218", 0), ("nc-31", "G77", "Z", 0)],
)
def test_the_heads_of_a_dimension_stand_over_its_ends(control, code, address, view):
    """Their distance is that of the ends at the scale of the picture, in the view where it is seen in full."""
    root, shown, found, size = sheet(control, code, address)
    tips = heads(root)
    ends = shown[view].at(np.stack([found.begin, found.end]))
    assert len(tips) == 2 and np.linalg.norm(tips[1] - tips[0]) == pytest.approx(np.linalg.norm(ends[1] - ends[0]), abs=0.2)
    way = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    assert sorted(tips @ way) == pytest.approx(sorted(ends @ way), abs=0.2)
    left, top, right, bottom = shown[view].box
    assert ((tips >= (left - 1, top - 1)) & (tips <= (right + 1, bottom + 1))).all()


WRITTEN = [("mnc", "G83"), ("tnc-620", "CYCL DEF 254"), ("nc-31", "G31"), ("tnc-620", "CYCL DEF 28")]


@pytest.mark.parametrize(("control", "code"), WRITTEN)
def test_every_value_is_written_within_the_picture(control, code):
    for p in mnclab.controls[control].cycles[code].parameters():
        root, _, _, (wide, high) = sheet(control, code, p.address, p.meaning)
        (text,) = root.iter("text")
        assert 0 < float(text.get("x")) < wide and 0 < float(text.get("y")) < high and text.text == f"{p.address} value"
        assert float(root.find("g").get("font-size")) >= 16  # large


def test_the_ticks_of_the_axes_stand_where_a_window_says(monkeypatch):
    """matplotlib's own way from data to pixels is the other one."""
    example, begun, run = first("tnc-620", "CYCL DEF 251")
    picture = example.plot(run, begun, size=(4.9, 4.2))
    picture.png()
    for window, (ax, *_) in zip(windows(picture), picture.views, strict=True):
        place = np.zeros((1, 3))
        place[0, window.right], place[0, window.up] = 12.0, -7.0
        (x, y) = ax.transData.transform((12.0, -7.0)) * 100 / picture.dpi
        assert window.at(place)[0] == pytest.approx([x, 100 * picture.get_figheight() - y], abs=0.1)


def test_a_dimension_from_beyond_the_window_has_one_head_clear_of_its_border():
    root, shown, found, _ = sheet("tnc-620", "TCH PROBE 412", "Q322")
    (tip,) = heads(root)
    left, _, right, _ = shown[0].box
    assert left + 6 < tip[0] < right - 6 and tip[1] == pytest.approx(shown[0].at(found.end)[0][1], abs=0.2)


@pytest.mark.parametrize(("code", "address"), [("CYCL DEF 251", "Q219"), ("CYCL DEF 221", "Q226")])
def test_a_value_that_has_no_room_beside_its_line_stands_beyond_an_end(code, address):
    """Whole, in the letters that take the most room, and not over the path."""
    root, shown, _, size = sheet("tnc-620", code, address)
    (value,) = root.iter("text")
    bold = FontProperties(family="DejaVu Sans", weight="bold", size=17)
    wide = TextPath((0, 0), value.text, prop=bold).get_extents().width
    x, y = float(value.get("x")), float(value.get("y"))
    assert wide / 2 < x < size[0] - wide / 2
    example, _, run = first("tnc-620", code)
    path = example.own(run.toolpath)
    path = path[path.is_motion & (path.kind != 0)]
    places = shown[0].at(path.points(0.1)[0])
    assert not ((abs(places[:, 0] - x) < wide / 2) & (abs(places[:, 1] - y + 6) < 9)).any()


@pytest.mark.parametrize(("control", "code"), [("mnc", "G412"), ("tnc-620", "CYCL DEF 233")])
def test_no_value_covers_the_numbers_of_an_axis(control, code):
    """They stand to the left of a window and below it: there no text begins or ends."""
    for p in mnclab.controls[control].cycles[code].parameters():
        root, shown, *_ = sheet(control, code, p.address, p.meaning)
        (text,) = root.iter("text")
        half, x, y = half_of(text.text), float(text.get("x")), float(text.get("y"))
        for left, top, right, bottom in (window.box for window in shown[-1:]):
            assert x - half > left or x + half < left - 40 or not top < y < bottom, text.text
            assert not bottom + 4 < y < bottom + 20 or not left < x < right, text.text


def test_a_meaning_that_begins_with_its_word_says_it_once():
    from mnclab.lab.forms.fields import name_of

    said = [name_of(p) for control in mnclab.controls.values() for cycle in control.cycles.values() for p in cycle.parameters()]
    assert said and not [name for name in said if len(words := name.split(" ")) > 1 and words[0] == words[1]]
