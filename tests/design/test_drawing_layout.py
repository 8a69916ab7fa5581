"""Nothing on a drawing lies on something else: boxes are compared by shapely, which the drawing does not use for that."""

from time import process_time

import numpy as np
import pytest
from design.drawn import covering, plate, shaft
from shapely import LineString, Polygon, STRtree
from tools.together import deep_but_one_in

from mnclab.design.drawing.drawing import draw
from mnclab.design.drawing.ink import value_block
from mnclab.design.drawing.view import Kind

VIEWS = {"plate": plate, "shaft": shaft}


def area(box):
    return Polygon(box.corners)


def check(drawing, views):
    """Boxes apart, within the frame and beside the title block; texts off the visible lines; each dimension once."""
    boxes = drawing.boxes()
    for sheet in range(1, len(drawing.sheets) + 1):
        mine = [box for box in boxes if box.sheet == sheet]
        inks = [box for box in mine if box.kind in ("text", "arrow")]
        (frame,) = [area(box) for box in mine if box.kind == "frame"]
        (block,) = [area(box) for box in mine if box.kind == "title block"]
        assert frame.covers(block)
        for a, b in covering(inks):
            assert a.of is b.of and not a.kind == b.kind == "text", (a, b)
        for box in inks:
            home = block if box.of in ("title block",) else frame
            assert home.buffer(1e-6).covers(area(box)), box
            if box.of != "title block":
                assert not area(box).intersects(block), box
        for laid, place in drawing.sheets[sheet - 1].views:
            visible = [stroke.contour.points_within(0.05) + place for stroke in laid.strokes if stroke.kind is Kind.VISIBLE]
            visible = [LineString(points) for points in visible]
            marks = laid.marks
            dims = [LineString(np.array(line[1:]) + place) for mark in marks for line in mark.lines]
            tree = STRtree([*visible, *dims])
            owners = [None] * len(visible) + [mark.of for mark in marks for _ in mark.lines]
            for box in inks:
                if box.kind == "text":
                    hits = tree.query(area(box).buffer(-0.05), predicate="intersects")
                    assert all(box.of is owners[k] and owners[k] is not None for k in hits), box
    wanted = [dimension for view in views for dimension in view.dimensions]
    drawn = [mark.of for sheet in drawing.sheets for laid, _ in sheet.views for mark in laid.marks]
    for dimension in wanted:
        assert sum(dimension is each for each in drawn) == 1
        texts = [box.text for box in boxes if box.of is dimension and box.kind == "text"]
        first = dimension.lines[0] if hasattr(dimension, "lines") else value_block(dimension.value).text
        assert texts[0] == first
    assert sum(map(len, (view.dimensions for view in views))) == sum(mark in wanted for mark in drawn)


@pytest.mark.parametrize("seed", deep_but_one_in(3, range(12)))
@pytest.mark.parametrize("kind", VIEWS)
def test_nothing_lies_on_something_else(kind, seed):
    views = VIEWS[kind](seed)
    began = process_time()
    drawing = draw(views, f"{kind} {seed}")
    assert process_time() - began < 3
    check(drawing, views)


def test_more_than_forty_dimensions():
    views = plate(3, holes=11)
    assert sum(len(view.dimensions) for view in views) > 40
    check(draw(views, "crowded"), views)


@pytest.mark.deep
@pytest.mark.parametrize("kind", VIEWS)
def test_nothing_lies_on_something_else_on_many_more(kind):
    for seed in range(100, 250):
        views = VIEWS[kind](seed)
        check(draw(views, f"{kind} {seed}"), views)
