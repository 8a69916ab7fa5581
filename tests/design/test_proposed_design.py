"""From path to design: the features that a program makes are those that it was written for, by their numbers."""

from pathlib import Path

import pytest
from design.designs_as_programs import TIP3, TOOLS, plate, run_of, studs

import mnclab
from mnclab import Alarm, Setup, Tool
from mnclab.design.model import Design, Hole, Pocket, Slot
from mnclab.workpiece.blank import cylinder


def told(feature):
    """A feature by its kind and what a drawing says of it; a slot looks the same from either end."""
    said = {each.name: each.text or each.nominal for each in feature.measures()}
    said["angle"] = said.get("angle", 0.0) % 180 if feature.kind == "slot" else said.get("angle", 0.0)
    contour = getattr(getattr(feature, "contour", None), "contour", None)
    if contour is not None:
        said["rim"], said["area"] = contour.length, contour.area if contour.closed else 0.0
    said["islands"] = [told_shape(each) for each in getattr(feature, "islands", ())]
    return feature.kind, said


def told_shape(shape):
    return {each.name: each.nominal for each in shape.measures()}


def same(one, other):
    (kind, here), (other_kind, there) = told(one), told(other)
    islands = len(here["islands"]) == len(there["islands"])
    if kind != other_kind or here.keys() != there.keys() or not islands:
        return False
    pairs = [*zip(here.pop("islands"), there.pop("islands")), (here, there)]
    return all(a == pytest.approx(b, abs=1e-6) for one, other in pairs for a, b in ((one[name], other[name]) for name in one))


def check(design, found):
    """The same features, each once, in any order."""
    left = list(found.features)
    missing = []
    for each in design.features:
        match = next((other for other in left if same(each, other)), None)
        if match is None:
            missing.append(each)
        else:
            left.remove(match)
    assert (missing, left) == ([], []), found.notes


@pytest.mark.parametrize("seed", range(2))
def test_a_random_plate_is_found(seed):
    design, text = plate(seed)
    run = run_of(design, text)
    assert run.ok
    found = run.design()
    check(design, found)
    assert found.notes == ()


@pytest.mark.parametrize("seed", range(2))
def test_a_stud_is_found(seed):
    design, text = studs(seed)
    check(design, run_of(design, text).design())


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(2, 200))
def test_more_random_plates_are_found(seed):
    design, text = plate(seed)
    check(design, run_of(design, text).design())


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(2, 40))
def test_more_studs_are_found(seed):
    design, text = studs(seed)
    check(design, run_of(design, text).design())


# --- by hand: a plate of 80 by 60 by 20, an end mill 10 (T1), a drill 8 (T3) -------------------------------------------------

BLANK = ((0, 0, -20), (80, 60, 0))


def made(*blocks, stock=BLANK, tools=TOOLS):
    text = "\n".join(f"N{10 * (k + 1)} {block}" for k, block in enumerate(("G17 G90 G54", "G0 Z20", "T1 S2000 M3", *blocks)))
    return mnclab.run(text + "\n", control="mnc", setup=Setup(tools=tools, stock=stock))


def the_only(run):
    (found,) = run.design().features
    return found


def straight(x0, y0, x1, y1, z, back="G0 Z20"):
    return (f"G0 X{x0} Y{y0}", f"G1 Z{z} F100", f"G1 X{x1} Y{y1} F300", back)


def test_a_step_at_the_edge_ends_at_the_edge():
    step = the_only(made(*straight(7, -10, 7, 70, -5), *straight(2, 70, 2, -10, -5)))
    assert told(step) == told(Pocket.rectangle(6, 30, 12, 60, 5))


def test_a_slot_that_leaves_the_part_on_one_side():
    slot = the_only(made(*straight(40, -10, 40, 30, -4)))
    assert told(slot) == told(Slot((40, -10), (40, 30), 10, 4))


def test_a_slot_right_through_is_a_rectangle():
    slot = the_only(made(*straight(40, -10, 40, 70, -4)))
    assert told(slot) == told(Pocket.rectangle(40, 30, 10, 60, 4))


def test_a_slot_at_the_edge_of_a_round_blank():
    slot = the_only(made(*straight(-60, 0, 0, 0, -4), stock=cylinder(40, -20, 0)))
    assert told(slot) == told(Slot((-60, 0), (0, 0), 10, 4))


def test_a_slope_has_no_name():
    found = made("G0 X20 Y30", "G1 Z0 F100", "G1 X60 Z-6", "G0 Z20").design()
    assert len(found.notes) == 1 and found.notes[0].startswith("what is cut aslant has no name (")


def test_a_ramp_into_a_pocket_is_none():
    """Down along the slot, and once more along its floor."""
    found = made("G0 X20 Y30", "G1 Z0 F100", "G1 X60 Z-3", "G1 X20", "G0 Z20").design()
    assert [told(each) for each in found.features] == [told(Slot((20, 30), (60, 30), 10, 3))] and found.notes == ()


def test_a_ball_leaves_what_has_no_name():
    found = made(*straight(20, 30, 60, 30, -3), tools={1: Tool(radius=5, corner=5, kind="mill")}).design()
    assert found.features == () and "what a round tool cuts has no name" in found.notes[0]


def test_a_deeper_pocket_takes_its_layers_with_it():
    """Two layers of one slot, the lower one as long: one feature, as deep as the lower one."""
    slot = the_only(made(*straight(20, 30, 60, 30, -3), *straight(60, 30, 20, 30, -6)))
    assert told(slot) == told(Slot((20, 30), (60, 30), 10, 6))


def test_a_predrilled_hole_is_one_hole():
    """A drill 5 and then a drill 8 to the same depth of the shoulder: only the wider one is left."""
    holes = made("T4", "G0 X30 Y30", "G1 Z-8 F100", "G0 Z20", "T3", "G0 X30 Y30", f"G1 Z{-10 - TIP3:.9f}", "G0 Z20")
    assert told(the_only(holes)) == told(Hole(30, 30, 8, 10))


def test_nothing_cut_is_a_blank_without_features():
    found = made("G0 X10 Y10").design()
    assert found.features == () and found.volume == 80 * 60 * 20


def test_another_blank():
    """As for a workpiece it stands in the coordinates of the machine, here those of the path."""
    found = made(*straight(20, 30, 60, 30, -3), stock=None).design(stock=((0, 0, -10), (80, 60, 0)))
    assert found.bounds.tolist() == [[0, 0, -10], [80, 60, 0]] and len(found.features) == 1


def test_without_a_blank_it_is_an_alarm():
    with pytest.raises(Alarm, match="no blank"):
        made(*straight(20, 30, 60, 30, -3), stock=None).design()


def test_a_path_of_a_surface_is_refused():
    blocks = [f"G1 X{k % 80} Y{k % 60} Z-1 F300" for k in range(20_001)]
    with pytest.raises(Alarm, match="at most 20000 moves"):
        made(*blocks).design()


def test_a_proposal_is_a_design_that_is_kept(tmp_path):
    """It is written like any other, and reads back with the same features."""
    design, text = studs(3)
    found = run_of(design, text).design()
    assert Design.load(found.save(tmp_path / "part.toml")).features == found.features


def test_it_has_the_name_of_its_program():
    programs = Path(__file__).parents[2] / "data" / "programs"
    assert mnclab.run(programs / "tnc-620" / "holes.h").design().title == "holes"
