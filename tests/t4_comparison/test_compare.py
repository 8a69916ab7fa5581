"""The table that sets strategies side by side, against areas and lengths worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest

from mnclab import Alarm, Limits, Tool
from mnclab.comparison.strategies import COLUMNS, compare
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.geometry.shapes import rectangle
from mnclab.machining.milling import concentric
from mnclab.machining.milling.strategies import STRATEGIES

BOX = Region.of(rectangle(60, 40))


@pytest.fixture(scope="module")
def found():
    return compare(BOX, Tool(radius=4, dr=1), overlap=0.5, depth=2, feed=600, plunge_feed=100, rapid=6000)


def test_every_strategy_is_a_row(found):
    table = found.columns()
    assert list(table) == list(COLUMNS)
    assert table["strategy"].tolist() == list(STRATEGIES)
    assert (table["covered"] > 99.9).all()
    assert table["corners"] == pytest.approx((4 - np.pi) * 25, abs=0.05)
    assert table["rest"] == pytest.approx(0, abs=0.05)
    assert "trochoidal" in repr(found) and found._repr_html_().count("<tr>") == 6


def test_rings_by_hand(found):
    """Rings of 80, 120 and 160 and two links of 5, and 4 down from 2 above (2 deep): 374; then at 600 and 100 mm/min."""
    row = found["rings"].row
    assert row["length"] == pytest.approx(80 + 120 + 160 + 10 + 4)
    assert row["time"] == pytest.approx(370 / 600 * 60 + 4 / 100 * 60 + 4 / 6000 * 60)
    assert row["rapid"] == pytest.approx(4) and row["lifts"] == 0


def test_harder_and_gentler(found):
    """Trochoidal work takes the longest way and the least engagement; a slot engages half a turn."""
    table = found.columns()
    k = table["strategy"].tolist().index("trochoidal")
    assert table["mean"][k] == table["mean"].min() and table["length"][k] == table["length"].max()
    assert found["rings"].row["most"] == pytest.approx(180, abs=0.5)
    rate = 10 * 2 * 600 / 1000  # width 10, depth 2, feed 600
    assert found["rings"].row["removal_most"] == pytest.approx(rate, abs=0.05)


def test_what_is_left_is_found():
    """One round along the wall of 60 × 40 with R 5 leaves a core of 40 × 20."""
    once = concentric.rectangle(60, 40, 5, 100).passes[-1]
    clearing = concentric.rectangle(60, 40, 5, 5)
    piece = replace(clearing.pieces[0], passes=(once,), linked=(), labels=("wall",), place=None)
    trial = compare(BOX, 5.0, {"once": replace(clearing, pieces=(piece,))})["once"]
    assert trial.rest.area == pytest.approx(800, abs=0.5)
    reach = 60 * 40 - (4 - np.pi) * 25
    assert trial.covered == pytest.approx(1 - 800 / reach, abs=1e-4)
    assert trial.rest.loops[0].bounds == pytest.approx(np.array([[-20, -10], [20, 10]]), abs=0.01)


def test_own_functions_and_other_names():
    own = compare(BOX, 5.0, {"mine": lambda region, radius, step: concentric.rectangle(60, 40, radius, step)})
    assert own["mine"].covered > 0.999
    assert own[0].entries.tolist() == [[0, 0]]
    with pytest.raises(KeyError, match="there are mine"):
        own["rings"]
    with pytest.raises(Alarm, match="overlap"):
        compare(BOX, 5.0, overlap=1.0)
    with pytest.raises(Alarm, match="does not fit"):
        compare(Region.of(Contour.circle((0, 0), 4)), 5.0)


def test_time_under_limits_of_the_axes():
    """With axes that start at once it is length over feed; stops in the corners of rings cost time."""
    free = compare(BOX, 5.0, ["rings"], feed=2000)["rings"].time
    quick, slow = (
        compare(BOX, 5.0, ["rings"], feed=2000, limits=Limits(acceleration=a))["rings"].time for a in (1e7, 200)
    )
    assert quick == pytest.approx(free, rel=1e-3)
    assert slow > 1.05 * free
