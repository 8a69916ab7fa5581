"""From path to design: the features that a program makes are those that it was written for, by their numbers."""

import pytest
from designs_as_programs import plate, run_of, studs


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


@pytest.mark.parametrize("seed", range(4))
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
