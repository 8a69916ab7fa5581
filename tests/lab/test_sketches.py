"""Sketches: what is highlighted runs where the manuals say, beside the lines of the workpiece in the same drawing."""

import math
import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest

from mnclab.controls import CONTROLS
from mnclab.lab.sketches import MILLS, RULES, kinds, sketch
from mnclab.lab.sketches.ink import Sheet

SVG = "{http://www.w3.org/2000/svg}"
EVERY = [(control, cycle) for control in CONTROLS for cycle in dict.fromkeys(CONTROLS[control].cycles.values())]
NUMBERS = r"-?[\d.]+"


class Drawing:
    """A sketch read back: strokes of a style as lists of points, where an arc gives its end only."""

    def __init__(self, code, address, control="tnc-620", meaning=""):
        self.cycle = CONTROLS[control].cycles[code]
        found = [p for p in self.cycle.parameters() if p.address == address and meaning in p.meaning]
        self.text = sketch(self.cycle, found[0])
        self.root = ElementTree.fromstring(self.text)

    def strokes(self, style):
        """All strokes of a style, each a list of points."""
        return strokes(self.root, style)

    @property
    def ends(self):
        """First and last point of what is highlighted."""
        first, *_ = self.strokes("measure")
        return first[0], first[-1]

    @property
    def address(self):
        return next(text.text for text in self.root.iter(f"{SVG}text") if text.get("data-style") == "address")

    @property
    def surface(self):
        """The height of the workpiece: the top of its tint."""
        return min(y for stroke in self.strokes("fill") for _, y in stroke)

    @property
    def bottom(self):
        """The lowest point of the edges."""
        return max(y for stroke in self.strokes("edge") for _, y in stroke)


def strokes(root, style):
    found = []
    for path in root.iter(f"{SVG}path"):
        if path.get("data-style") == style:
            for one in path.get("d").split("M")[1:]:
                points = [re.findall(NUMBERS, part)[-2:] for part in re.split("[LA]", one)]
                found.append([(float(x), float(y)) for x, y in points])
    return found


def ink(root, style):
    """Points less than 1 apart on all strokes of a style; arcs by their middle, as SVG defines them."""
    for path in root.iter(f"{SVG}path"):
        if path.get("data-style") != style:
            continue
        at = start = (0.0, 0.0)
        for command, values in re.findall(r"([MLAZ])([^MLAZ]*)", path.get("d")):
            numbers = [float(value) for value in values.split()]
            end = (numbers[-2], numbers[-1]) if numbers else start
            half = math.dist(at, end) / 2
            if command == "M":
                start = end
            elif command == "A" and half > 0 and numbers[0] == numbers[1]:
                radius, large, left = max(numbers[0], half), numbers[3], numbers[4] == 0
                side = math.sqrt(radius**2 - half**2) * (1 if (large == 1) == left else -1) / (2 * half)
                cx = (at[0] + end[0]) / 2 - (end[1] - at[1]) * side
                cy = (at[1] + end[1]) / 2 + (end[0] - at[0]) * side
                a, b = (math.atan2(y - cy, x - cx) for x, y in (at, end))
                turn = -((a - b) % math.tau) if left else (b - a) % math.tau
                steps = math.ceil(abs(turn) * radius) + 1
                for way in (a + turn * k / steps for k in range(steps)):
                    yield cx + radius * math.cos(way), cy + radius * math.sin(way)
            else:
                steps = math.ceil(2 * half) + 1
                for share in (k / steps for k in range(steps + 1)):
                    yield at[0] + (end[0] - at[0]) * share, at[1] + (end[1] - at[1]) * share
            at = end


def numeric(cycle):
    return [p for p in cycle.parameters() if p.type not in ("text", "choice") and not p.mark]


@pytest.mark.parametrize("control", list(CONTROLS))
def test_every_sketch_is_whole_named_and_has_its_address_in_the_clear(control):
    for cycle in [cycle for name, cycle in EVERY if name == control]:
        for parameter in cycle.parameters():
            text = sketch(cycle, parameter)
            if not text:
                continue
            root = ElementTree.fromstring(text)
            assert root.get("role") == "img" and root.find(f"{SVG}title").text == parameter.meaning
            (label,) = [element for element in root.iter(f"{SVG}text") if element.get("data-style") == "address"]
            assert parameter.address in label.text, f"{cycle.code} {parameter.address}"
            x, y, wide, high = (float(label.get(key)) for key in ("x", "y", "textLength", "font-size"))
            left, right, top, low = x - wide / 2, x + wide / 2, y - 0.7 * high, y
            assert left >= 0 and right <= 96 and top >= 0 and low <= 64, f"{cycle.code} {parameter.address} leaves the sheet"
            for style in ("edge", "tool", "thin", "dash", "tail", "measure"):
                for u, v in ink(root, style):
                    assert -0.5 <= u <= 96.5 and -0.5 <= v <= 64.5, f"{cycle.code} {parameter.address} is cut off: {style}"
                    assert not (left < u < right and top < v < low), f"{cycle.code} {parameter.address}: {style}"


def test_choices_and_texts_measure_nothing_and_nearly_all_numbers_have_a_sketch():
    numbers = [(cycle, parameter) for _, cycle in EVERY for parameter in numeric(cycle)]
    others = [(cycle, p) for _, cycle in EVERY for p in cycle.parameters() if p.type in ("text", "choice") or p.mark]
    assert len(numbers) > 1500 and not any(sketch(*each) for each in others)
    assert sum(bool(sketch(*each)) for each in numbers) >= 0.95 * len(numbers)


@pytest.mark.parametrize(
    ("code", "address", "control"),
    [("CYCL DEF 200", "Q201", "tnc-620"), ("CYCL DEF 251", "Q201", "tnc-620"), ("CYCL DEF 256", "Q201", "tnc-620"),
     ("CYCL DEF 20", "Q1", "tnc-620"), ("G300", "H", "mnc"), ("G344", "H", "mnc"), ("CYCL DEF 225", "Q201", "tnc-620")],
)  # fmt: skip
def test_a_depth_runs_from_the_surface_to_the_bottom(code, address, control):
    drawing = Drawing(code, address, control)
    (x1, top), (x2, low) = drawing.ends
    assert x1 == x2
    assert (top, low) == (drawing.surface, drawing.bottom)


def test_the_clearance_ends_at_the_surface_and_the_second_is_higher():
    first, second = Drawing("CYCL DEF 200", "Q200"), Drawing("CYCL DEF 200", "Q204")
    for drawing in (first, second):
        assert drawing.ends[0][1] == drawing.surface
        tip = max(y for _, y in drawing.strokes("tool")[0])
        assert drawing.ends[1][1] == tip < drawing.surface
    assert second.ends[1][1] < first.ends[1][1]


def test_cycles_that_mill_to_their_height_at_once_measure_the_clearance_from_it():
    """G320: clearance between tool tip and milling height; G321 mills down from where its clearance begins."""
    at_once, layers = Drawing("G320", "Q", "mnc"), Drawing("G321", "Q", "mnc")
    assert at_once.ends[0][1] == at_once.bottom > at_once.surface
    assert layers.ends[0][1] == layers.surface < layers.bottom


def test_the_first_infeed_ends_between_surface_and_bottom_at_a_line_across():
    drawing = Drawing("CYCL DEF 251", "Q202")
    (_, top), (_, low) = drawing.ends
    assert top == drawing.surface < low < drawing.bottom
    assert low in [y for stroke in drawing.strokes("dash") for _, y in stroke]


def test_the_allowance_of_a_floor_stands_on_it():
    drawing = Drawing("CYCL DEF 251", "Q369")
    assert drawing.ends[1][1] == drawing.bottom > drawing.ends[0][1] > drawing.surface


def test_coordinates_begin_at_the_datum():
    drawing = Drawing("CYCL DEF 200", "Q203")
    signs = [y for stroke in drawing.strokes("solid") for _, y in stroke]
    assert min(signs) < drawing.ends[0][1] < max(signs)
    assert drawing.ends[1][1] == drawing.surface


def holes_of(drawing):
    """Middles of full circles among the edges."""
    return [((a[0][0] + a[1][0]) / 2, (a[0][1] + a[1][1]) / 2) for a in drawing.strokes("edge") if len(a) == 3]


def direction(middle, point):
    return math.degrees(math.atan2(middle[1] - point[1], point[0] - middle[0])) % 360


def test_the_stepping_angle_lies_between_two_neighbours_on_the_pitch_circle():
    drawing = Drawing("CYCL DEF 220", "Q247")
    pitch = drawing.strokes("dash")[0]
    middle = ((pitch[0][0] + pitch[1][0]) / 2, pitch[0][1])
    angles = sorted(direction(middle, hole) for hole in holes_of(drawing))
    ends = [direction(middle, end) for end in drawing.ends]
    near = [min(range(len(angles)), key=lambda k: abs(angles[k] - end)) for end in ends]
    assert near[1] == near[0] + 1 and all(abs(angles[k] - end) < 1 for k, end in zip(near, ends, strict=True))
    first = Drawing("CYCL DEF 220", "Q245")
    assert [round(direction(middle, end)) for end in first.ends] == [0, round(angles[0])]
    last = Drawing("CYCL DEF 220", "Q246")
    assert round(direction(middle, last.ends[1])) == round(angles[-1])


def test_the_diameter_of_a_pitch_circle_goes_through_its_middle():
    drawing = Drawing("CYCL DEF 220", "Q244")
    right, left, _ = drawing.strokes("dash")[0]
    assert math.dist(*drawing.ends) == pytest.approx(right[0] - left[0], abs=0.2)
    assert sum(x for x, _ in drawing.ends) == pytest.approx(right[0] + left[0], abs=0.2)


def test_spacings_run_from_hole_to_next_hole_along_their_axis():
    across, up = Drawing("CYCL DEF 221", "Q237"), Drawing("CYCL DEF 221", "Q238")
    columns, rows = sorted({x for x, _ in holes_of(across)}), sorted({y for _, y in holes_of(up)}, reverse=True)
    assert [x for x, _ in across.ends] == columns[:2]
    assert [y for _, y in up.ends] == rows[:2]


@pytest.mark.parametrize(
    ("code", "control", "x", "y"),
    [("CYCL DEF 251", "tnc-620", "Q218", "Q219"), ("G343", "mnc", "A", "B"), ("CYCL DEF 256", "tnc-620", "Q218", "Q219"),
     ("CYCL DEF 253", "tnc-620", "Q218", "Q219"), ("CYCL DEF 232", "tnc-620", "Q218", "Q219")],
)  # fmt: skip
def test_sides_span_the_whole_figure(code, control, x, y):
    for drawing, axis in ((Drawing(code, x, control), 0), (Drawing(code, y, control), 1)):
        ends = sorted(end[axis] for end in drawing.ends)
        outline = [point[axis] for stroke in drawing.strokes("edge") for point in stroke]
        assert ends == [min(outline), max(outline)]
        assert len({end[1 - axis] for end in drawing.ends}) == 1


def test_the_stepover_is_the_factor_times_the_radius():
    drawing = Drawing("CYCL DEF 251", "Q370")
    assert drawing.address == "Q370·R"
    assert sorted(y for _, y in drawing.ends) == sorted(stroke[0][1] for stroke in drawing.strokes("dash"))


def test_feeds_point_where_the_tool_goes():
    down, up = Drawing("CYCL DEF 201", "Q206"), Drawing("CYCL DEF 201", "Q208")
    assert down.ends[1][1] > down.surface > down.ends[0][1]
    assert up.ends[0][1] > up.surface > up.ends[1][1]


def test_a_diameter_of_turning_lies_on_both_sides_of_the_axis_and_a_radius_on_one():
    """NC-31: X is the diameter of the finished surface; JNC-T01: X is a radius."""
    across, up = Drawing("G70", "X", "nc-31"), Drawing("G77", "X", "jnc-t01")
    axis = across.strokes("dash")[0][0][1]
    assert sorted(abs(y - axis) for _, y in across.ends) == [up.ends[0][1] - up.ends[1][1]] * 2
    assert across.address == "⌀X" and up.address == "X"
    assert up.ends[0][1] == axis > up.ends[1][1]


def test_what_is_told_on_the_diameter_is_half_on_one_side():
    assert Drawing("G77", "P", "nc-31", "stock removed").address == "P/2"
    assert Drawing("G78", "P", "nc-31", "stock removed").address == "P"
    assert Drawing("G31", "P", "nc-31", "depth of the thread").address == "P"


def test_a_hole_is_level_on_a_lathe_and_upright_on_a_mill():
    turned, milled = Drawing("G73", "Z", "jnc-t01"), Drawing("G83", "Z", "mnc")
    assert turned.ends[0][1] == turned.ends[1][1] and milled.ends[0][0] == milled.ends[1][0]


def test_the_probe_measures_with_the_middle_of_its_ball_and_travels_above_it():
    level, clear = Drawing("TCH PROBE 421", "Q261"), Drawing("TCH PROBE 421", "Q260")
    for drawing, below in ((level, 0), (clear, 1)):
        right, left, _ = drawing.strokes("tool")[0]
        radius = (right[0] - left[0]) / 2
        ends = [y for _, y in drawing.ends]
        assert right[1] + below * radius in ends  # at the middle, or at the lowest point of the ball
        assert drawing.surface in ends


def test_limits_lie_outside_and_inside_the_nominal_size():
    nominal, most, least = (Drawing("TCH PROBE 421", address) for address in ("Q262", "Q275", "Q276"))
    assert math.dist(*least.ends) < math.dist(*nominal.ends) < math.dist(*most.ends)


@pytest.mark.parametrize("code", ["CYCL DEF 262", "CYCL DEF 267"])
def test_a_pitch_is_from_crest_to_crest(code):
    drawing = Drawing(code, "Q239")
    (_, top), (_, low) = drawing.ends
    heights = {}
    for x, y in drawing.strokes("edge")[0]:
        heights.setdefault(x, []).append(y)
    crests = sorted(next(ys for ys in heights.values() if top in ys and len(ys) > 2))
    assert crests[crests.index(top) + 1] == low


def test_what_is_not_known_has_no_sketch_and_signs_are_escaped():
    cycle = CONTROLS["tnc-620"].cycles["CYCL DEF 200"]
    depth = next(p for p in cycle.parameters() if p.address == "Q201")
    assert sketch(cycle, replace(depth, meaning="colour of the chips")) == ""
    assert ElementTree.fromstring(sketch(cycle, replace(depth, address='<"&')))


def test_cycles_of_others_are_drawn_by_the_words_of_their_declaration():
    class Peck:
        title, does = "Deep drilling in the cellar", "visits points"

    parameter = next(p for p in CONTROLS["mnc"].cycles["G300"].parameters() if p.address == "H")
    assert "<title>depth from the surface to the bottom</title>" in sketch(Peck, parameter)


@pytest.mark.parametrize("table", ["MILLED", "TOUCHED", "TURNED"])
def test_every_rule_draws_for_every_kind_of_work_that_it_names(table):
    """Cycles of others may join any kind with any meaning."""
    for kind in {kind for _, kind in getattr(kinds, table)} | ({kinds.OTHER} if table == "MILLED" else set()):
        for named, words, draw in RULES.get(kind.section, MILLS):
            if re.fullmatch(named, kind.section) or re.fullmatch(named, kind.figure):
                sheet = Sheet("Q1")
                draw(sheet, kind)
                assert any(sheet.paths[style] for style in ("measure", "head")), f"{kind} {words} highlights nothing"
