"""Designs in files: read back equal, whatever stands in them, and alarms that show the line."""

from dataclasses import replace

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

import mnclab
from mnclab import Alarm, Design
from mnclab.design import Chamfer, Circle, Face, Groove, Hole, Outline, Pocket, Rectangle, Slope, Slot, Stud
from mnclab.design.model.design_file import FORMAT, design_of, text_of
from mnclab.text.file import File, table_of
from mnclab.workpiece.blank import cylinder

NAMESPACE = {name: getattr(mnclab.design, name) for name in mnclab.design.__all__}

near = st.floats(0.011, 0.9)  # with all their digits
text = st.text(st.characters(exclude_categories=["Cs"]), max_size=12)
tolerance = st.one_of(st.floats(0, 1), st.tuples(st.floats(-1, 0), st.floats(0, 1)))
rectangle = st.builds(
    lambda x, y, a, b, c, t: Rectangle(30 + x, 20 + y, 10 + a, 8 + b, c, t), near, near, near, near, near, st.floats(-90, 90)
)
circle = st.builds(lambda x, y, d: Circle(30 + x, 20 + y, 9 + d), near, near, near)
outline = st.builds(
    lambda x, y, b: Outline(((20 + x, 10), (40, 10 + y), (35, 30)), (0.0, b / 5, 0.0)), near, near, near
)
line = st.builds(lambda x, b: Outline(((20 + x, 10), (40, 20), (30, 30)), (b / 3, 0.0, 0.0), closed=False), near, near)
shape = st.one_of(rectangle, circle, outline)
small = st.builds(lambda x, d: Circle(30 + x / 9, 20, 1 + d), near, near)
more = st.fixed_dictionaries({}, optional={"name": text, "top": st.floats(-2, -0.01), "tolerances": st.fixed_dictionaries({"depth": tolerance})})  # noqa: E501


def of(kind, *fields, **named):
    return st.builds(lambda args, keys, rest: kind(*args, **keys, **rest), st.tuples(*fields), st.fixed_dictionaries(named), more)


depth = near.map(lambda d: 3 + d)
feature = st.one_of(
    of(Face, depth), of(Pocket, shape, depth), of(Stud, shape, depth), of(Groove, st.one_of(shape, line), near, depth),
    of(Pocket, rectangle, depth, st.tuples(small)),
    of(Slot, st.tuples(near, near), st.tuples(near.map(lambda x: 20 + x), near), near, depth),
    st.builds(lambda a, b, t: Slope(30, 20, 10 + a, 8 + b, 3 + a, 1 + b, t), near, near, st.floats(-90, 90)),
    of(Hole, near, near, near.map(lambda d: 5 + d), depth, point=st.sampled_from([90, 118, 180.0])),
    of(Hole, near, near, near, depth, countersink=st.tuples(near.map(lambda d: 2 + d), st.floats(60, 120))),
    of(Hole, near, near, st.none(), depth, thread=st.sampled_from(["M8", "M8x1"]), counterbore=st.tuples(st.just(14), near)),
    st.builds(lambda s, w, i, a: Chamfer(s, w, a, i), shape, near, st.booleans(), st.floats(60, 120)),
)  # fmt: skip
blank = st.one_of(
    st.builds(lambda a, b: ((-5 - a, -6.5, -20 - b), (60 + b, 40 + a, 0)), near, near),
    st.builds(lambda r, b, x: cylinder(60 + r, -20 - b, b, "Z", (20 + x, 20.0, 0.5), b), near, near, near),
)


@st.composite
def designs(draw):
    sides = {side: tuple(draw(st.lists(feature, max_size=3))) for side in ("features", "back")}
    texts = {name: draw(text) for name in ("title", "number", "material", "general", "author", "date")}
    return Design(draw(blank), **sides, **texts, turn=draw(st.sampled_from(["x", "y"])))


@settings(max_examples=20, phases=[Phase.generate], deadline=None, suppress_health_check=list(HealthCheck))
@given(designs())
@pytest.mark.deep
def test_a_file_and_a_repr_are_read_back_equal(design):
    written = text_of(design)
    assert design_of(table_of(written), File("d.toml", written)) == design
    assert eval(repr(design), dict(NAMESPACE)) == design


def test_the_format_of_the_help_is_a_design(tmp_path):
    path = tmp_path / "d.toml"
    path.write_text(FORMAT, "utf-8")
    design = Design.load(path)
    assert [each.kind for each in design.features] == ["pocket", "hole", "slot", "chamfer", "groove", "face", "slope"]
    assert design.features[0] == Pocket.rectangle(
        30, 20, 40, 25, 8, corner=5, name="pocket A", islands=(Circle(30, 20, 10),),
        tolerances={"length": 0.1, "width": "H9", "depth": (0, 0.2)},
    )  # fmt: skip
    assert design.back == (Pocket.circle(50, 30, 30, 5),)
    again = design.save(tmp_path / "again.toml")
    assert Design.load(again) == design
    assert eval(repr(design), dict(NAMESPACE)) == design


@pytest.mark.parametrize(
    ("was", "now", "line", "said"),
    [
        ("depth = 8", "depth = -8", 15, "the depth of a pocket .* must be greater than 0, got -8"),
        ("depth = 8", "dept = 8", 15, r"has no 'dept' \(near: depth\)"),
        ("depth = 8", 'depth = "8"', 15, "the depth of a pocket .* must be a number, got '8'"),
        ('kind = "hole"', 'kind = "hol"', 21, r"got 'hol' \(near: hole\)"),
        ('kind = "face"', "", 47, r"features\[5\] has no kind"),
        ("[11, 6]", "[11, 6, 5]", 25, "the counterbore of a hole must be its diameter"),
        ("width = 8\n", "", 27, "a slot has no width"),
        ('"H9"', '"Q9"', 17, "the tolerance class of width of pocket A"),
        ("length = 0.1", "lenth = 0.1", 17, "pocket A has no 'lenth' for a tolerance"),
        ("diameter = 10 }", "diameter = -10 }", 18, "the diameter of a circle"),
        ("low = [0, 0, -20]", "low = [0, 0]", 5, "blank.low must be three numbers"),
        ("[blank]", "[black]", 4, r"a design has no 'black' \(near: blank\)"),
        ("corner = 5 }", "corner = 50 }", 37, "a corner radius of 50 does not fit"),
        ('turn = "x"', 'turn = "z"', 2, "must be x or y, got 'z'"),
        ("bulge = [0, 0.2, 0]", "bulge = [0, 0.2]", 42, "a bulge for each of 3 points, got 2"),
        ("end = [90, 45]", "end = 90", 30, r"the end of a slot \(mm\) must be two numbers"),
        ("depth = 0.5", "depth = 0.5\ntop = 9", 47, "takes nothing away"),
        ("contour = {", "x = 3\nlength = 4\n#", 34, "stands in a table"),
        ("depth = 0.5", "depth = ", 49, "Invalid value"),
    ],
)
def test_an_alarm_shows_the_line(tmp_path, was, now, line, said):
    path = tmp_path / "d.toml"
    assert was in FORMAT
    path.write_text(FORMAT.replace(was, now, 1), "utf-8")
    with pytest.raises(Alarm, match=said) as alarm:
        Design.load(path)
    assert alarm.value.span.line == line


@pytest.mark.parametrize(
    ("name", "said"), [("d.doc", "cannot write a design as .doc"), ("d", "no suffix"), (5, "written to a path")]
)
def test_what_is_no_file_of_a_design(tmp_path, name, said):
    with pytest.raises(Alarm, match=said):
        Design(((0, 0, 0), (1, 1, 1))).save(tmp_path / name if isinstance(name, str) else name)
    with pytest.raises(Alarm, match="no character"):
        replace(Design(((0, 0, 0), (1, 1, 1))), title="\ud800").save(tmp_path / "d.toml")


def test_a_body_is_saved(tmp_path):
    design = Design(((0, 0, -10), (40, 30, 0)), Pocket.rectangle(20, 15, 20, 10, 4))
    assert design.save(tmp_path / "d.stl", step=1.0).stat().st_size > 84
