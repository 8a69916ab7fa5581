"""What cannot be turned is refused by name: the feature, what was allowed, what was found; in a file with its line."""

import math

import numpy as np
import pytest

import mnclab as mnc
from mnclab.design.model import Bore, CentreHole, FaceGroove, RingGroove, Thread, TurnedDesign, Undercut
from mnclab.design.model.turned_file import FORMAT
from mnclab.geometry.contours import Contour

BAR = [(0, 20), (-30, 20)]
STEP = [(0, 12), (-30, 12), (-30, 20), (-50, 20)]


@pytest.mark.parametrize(
    ("profile", "more", "said"),
    [
        ("abc", {}, "points .z, r. or a contour, got 'abc'"),
        ([(0, 1, 2)], {}, "points .z, r. or a contour"),
        ([(0, 20)], {}, "at least two points"),
        ([(0, math.nan), (-5, 3)], {}, "finite"),
        ([(0, 20), (-1e6, 20)], {}, "point 1 of an outline .mm. must be at least -100000"),
        ([(0, 20), (-30, -2)], {}, "point 1 of the profile must have a radius of at least 0, got -2"),
        ([(0, 20), (0, 20), (-30, 20)], {}, "points 0 and 1 of the profile are the same place"),
        ([(0, 10), (-20, 10), (-10, 5), (-10, 20), (-30, 20)], {}, "the profile crosses or touches itself near"),
        ([(0, 10), (0, 20)], {}, "crosses or touches itself"),
        (Contour([(0, 5), (-20, 5)], [1, 0], closed=False), {}, None),
        (Contour([(0, 5), (-20, 5)], [-1, 0], closed=False), {}, "an arc of the profile must stay at radii of at least 0"),
        (BAR, {"roundings": {7: 1}}, "roundings must be 0 to 1, a point of the profile, got 7"),
        (BAR, {"roundings": {0: -1}}, "rounding 0 .mm. must be greater than 0, got -1"),
        (BAR, {"roundings": 3}, "roundings are sizes by the number of the corner, got 3"),
        (BAR, {"roundings": {0: 1}, "chamfers": {0: 1}}, "corner 0 of the profile is either rounded or chamfered"),
        (STEP, {"roundings": {1: 9}}, "breaks corner 1 of the profile takes 9 mm of an element that has 8"),
        (STEP, {"roundings": {1: 5}, "chamfers": {2: 4}}, "corner 1 and 2 .* takes 9 mm of an element that has 8"),
        (STEP, {"chamfers": {0: (1, 95)}}, "must lean by less than 90 degrees"),
        ([(0, 5), (-10, 10), (-20, 20), (-30, 20)], {"chamfers": {1: (1, 20)}}, "needs one line along the axis"),
        ([(0, 0), (-10, 10)], {"roundings": {0: 1}}, "corner 0 of the profile lies on the axis"),
        ([(0, 10), (-10, 10), (-20, 10)], {"roundings": {1: 1}}, "needs a corner there"),
        (BAR, {"blank": 5}, "must be a cylinder about Z, got 5"),
        (BAR, {"blank": mnc.blank.cylinder(19, -40, 0)}, "within its blank, whose radius is 19: it has 20"),
        (BAR, {"blank": mnc.blank.cylinder(20, -29, 0)}, "whose Z from is -29: it has -30"),
        (BAR, {"blank": mnc.blank.cylinder(20, -30, 0, bore=3)}, "whose bore of radius is 3: it has 0"),
        (BAR, {"tolerances": {"diameter 2": 0.1}}, "has no 'diameter 2'"),
        (BAR, {"tolerances": {"diameter 1": "x"}}, "tolerance class of diameter 1"),
        (BAR, {"title": 3}, "title of a design must be a text, got 3"),
        (BAR, {"features": [3]}, r"features\[0\] of a turned design must be one that turns, got 3"),
    ],
)
def test_profiles(profile, more, said):
    if said is None:
        assert TurnedDesign(profile, **more).volume > 0
        return
    with pytest.raises(mnc.Alarm, match=said):
        TurnedDesign(profile, **more)


@pytest.mark.parametrize(
    ("profile", "features", "said"),
    [
        (BAR, [Bore(40)], "bore .features.0..: it takes the whole part away"),
        (BAR, [Bore(50, 10)], "its diameter must be less than that of the part there, got 50"),
        (BAR, [Bore(10, 30, 180)], "the depth must be less than the length of the part, 30, got 30"),
        (BAR, [Bore(10, 28)], "the depth, 28, and the point, 3.0043, together must be less than .* 30, got 31.0043"),
        (BAR, [Bore(10), Bore(8, name="pilot")], "pilot .features.1..: it takes nothing away"),
        (STEP, [Bore(30, 10, from_end="front")], "its diameter must be less than that of the part"),
        (STEP, [Bore(24, 10, 180)], "it takes away the front end, Z 0 becomes -10"),
        (STEP, [Bore(24, 40, 180)], "front end"),
        (BAR, [Bore(10, 5, chamfer=16)], "its chamfer 16 needs a flat face about its mouth, at least 42 wide"),
        (BAR, [Bore(10, 5, chamfer=6)], "its chamfer must be less than the depth behind its mouth, got 6"),
        (BAR, [CentreHole(10, depth=28, from_end="back")], "its depth must be less than the length of the part, 30, got 28"),
        ([(0, 2), (-30, 20)], [CentreHole(2.5)], "it needs a flat end at least 5.3 wide"),
        (BAR, [RingGroove(-28, 3, depth=1)], "must lie between the ends of the part, Z 0 to -30, got -28 to -31"),
        (BAR, [RingGroove(0, 3, depth=1)], "between the ends of the part"),
        (BAR, [RingGroove(-8, 3, diameter=40)], "bottom must be less than the part, 40, and greater than 0, got 40"),
        (BAR, [RingGroove(-8, 3, depth=20)], "bottom must be less than the part, 40, and greater than 0, got 0"),
        (BAR, [RingGroove(-8, 3, depth=1, corner=1.2)], "its corner must be at most its depth, 1, got 1.2"),
        (BAR, [RingGroove(-8, 3, depth=1, inside=True)], "there is no bore from Z -8 to -11"),
        (BAR, [Bore(10), RingGroove(-8, 3, diameter=9, inside=True)], "greater than the bore, 10, and greater than 0, got 9"),
        (BAR, [Bore(10), RingGroove(-8, 3, depth=15, inside=True)], "ring groove .features.1..: it cuts the part in 2 pieces"),
        (BAR, [Bore(10), RingGroove(-8, 3, depth=15)], "it cuts the part in 2 pieces"),
        ([(0, 10), (-30, 20)], [RingGroove(-8, 3, depth=1)], "two edges stand at diameters .* say the diameter"),
        (STEP, [FaceGroove(20, 30, 2)], "it needs a flat face wider than 20 to 30"),
        (BAR, [FaceGroove(20, 30, 30)], "its depth must be less than what stands behind its face, 30, got 30"),
        (STEP, [Thread("M20x1.5", 0, -10)], "its cylinder must have diameters 19.0257 to 20, got 24"),
        (STEP, [Thread("M24x1.5", 0, -40)], "its cylinder must have diameters 23.0257 to 24, got 40"),
        ([(0, 8), (-10, 8), (-10, 12), (-30, 12)], [Thread("M24x1.5", 0, -20)], "by at most 2 pitches, 3, got 10"),
        (STEP, [Thread("M24x1.5", 2, -10)], "within the part, Z 0 to -50, got 2 to -10"),
        (STEP, [Thread("M12", 0, -10, inside=True)], "there is no bore from Z 0 to -10"),
        (STEP, [Bore(11.8), Thread("M12", 0, -10, inside=True)], "its bore must have diameters 10.1.* to 10.8.*, got 11.8"),
        (STEP, [Undercut("M24x1.5", -20)], None),
        (STEP, [Undercut("M24x1.5", -50, thread_at="back")], "must lie within the part, Z 0 to -50, got -50 to -53.2"),
        (STEP, [Undercut("M24x1.5", -50)], "there is no shoulder at Z -50"),
        (STEP, [Undercut("M30x1.5", -30)], "less than that of the surface there, 24, got 27.7"),
        (STEP, [Undercut("M24x1.5", -30, corner=3)], "its corner must be at most its depth, 1.15, got 3"),
    ],
)
def test_features_on_a_part(profile, features, said):
    if said is None:
        assert TurnedDesign(profile, features).volume > 0
        return
    with pytest.raises(mnc.Alarm, match=said):
        TurnedDesign(profile, features)


@pytest.mark.parametrize(
    ("kind", "given", "said"),
    [
        (Bore, {"diameter": 0}, "the diameter of a bore .mm. must be greater than 0, got 0"),
        (Bore, {"diameter": "5"}, "the diameter of a bore .mm. must be a number, got '5'"),
        (Bore, {"diameter": 5, "point": 200}, "at most 180, got 200"),
        (Bore, {"diameter": 5, "depth": 4, "corner": 1}, "the corner of a bore is that of a flat bottom"),
        (Bore, {"diameter": 5, "from_end": "left"}, "the from_end of a bore must be front or back, got 'left'"),
        (Bore, {"diameter": 1e7}, "at most 100000"),
        (CentreHole, {"pilot": 3}, "a pilot of 1, 1.25, .* by DIN 332-1, or its diameter and depth given, got 3"),
        (CentreHole, {"pilot": 3, "diameter": 2, "depth": 9}, "diameter of a centre hole .mm. must be greater than 3, got 2"),
        (CentreHole, {"pilot": 2, "depth": 1}, "the depth of a centre hole .mm. must be greater than 1.9"),
        (RingGroove, {"z": -5, "width": 2}, "either a depth or the diameter of its bottom, got neither"),
        (RingGroove, {"z": -5, "width": 2, "depth": 1, "diameter": 9}, "got both"),
        (RingGroove, {"z": -5, "width": 2, "depth": 1, "corner": 1.5}, "corner of a ring groove .mm. must be at most 1"),
        (RingGroove, {"z": -5, "width": 2, "depth": 1, "inside": 3}, "inside of a ring groove must be True or False, got 3"),
        (FaceGroove, {"inner": 9, "outer": 8, "depth": 1}, "outer diameter of a face groove .mm. must be greater than 9"),
        (Thread, {"thread": "G1/2", "start": 0, "end": -5}, "a thread is M and its diameter"),
        (Thread, {"thread": "M8", "start": -5, "end": 0}, "its end is less than -5, got 0"),
        (Undercut, {"thread": "M20x1.3", "z": 0}, "DIN 76-1 has undercuts for the pitches .*, got 1.3"),
        (Undercut, {"thread": "M20", "z": 0, "thread_at": "up"}, "thread_at of an undercut must be front or back"),
        (Bore, {"diameter": 5, "name": 3}, "the name of a bore must be a text"),
        (Bore, {"diameter": 5, "tolerances": {"width": 1}}, "has no 'width'"),
        (Bore, {"diameter": 5, "tolerances": 3}, "tolerances of a bore are names and values"),
    ],
)
def test_features_alone(kind, given, said):
    with pytest.raises(mnc.Alarm, match=said):
        kind(**given)


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("{ z = -30, r = 20,", "{ z = -30, q = 20,", 5, "point 2 of the profile has no 'q'"),
        ("rounding = 1", "rounding = 100", 5, "what breaks corner 2"),
        ("arc = 40", "arc = 4", 6, "the radius of an arc must be at least half its chord, 5.09902, got 4"),
        ("r = 18", "r = -18", 7, "point 4 of the profile must have a radius of at least 0, got -18"),
        ("r = 18 }", "r = 18, arc = 3 }", 7, "the last point has no arc after it"),
        ("[blank] ", "[blank ", 11, "Expected"),
        ("radius = 22", "radius = 19", 11, "whose radius is 19"),
        ('= "h6"', '= "h66"', 16, "the tolerance class of diameter 1"),
        ('kind = "bore"', 'kind = "boer"', 21, "near: bore"),
        ("depth = 20", "depth = 59", 23, "bore A .features.0..: the depth, 59, and the point"),
        ("pilot = 2.5", "pilot = 2.6", 30, "a pilot of 1, 1.25"),
        ("width = 4", 'width = "4"', 36, "the width of a ring groove .mm. must be a number"),
        ("start = 0", "", 51, "a thread has no start"),
        ("end = -27", "end = -47", 53, "its cylinder must have diameters 23.0257 to 24, got"),
        ("title =", "titel =", 1, "near: title"),
    ],
)
def test_files_with_the_line(old, new, line, said, tmp_path):
    assert old in FORMAT
    path = tmp_path / "design.toml"
    path.write_text(FORMAT.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(mnc.Alarm, match=said) as caught:
        mnc.Design.load(path)
    assert caught.value.span.line == line and caught.value.place.startswith(f"{path}:{line}:")


def test_the_format_is_a_design(tmp_path):
    path = tmp_path / "design.toml"
    path.write_text(FORMAT, encoding="utf-8")
    design = TurnedDesign.load(path)
    assert [each.kind for each in design.features] == [
        "bore", "centre hole", "ring groove", "face groove", "undercut", "thread"
    ]  # fmt: skip
    assert TurnedDesign.load(design.save(path)) == design


def test_dimensions_of_features_lie_on_the_section():
    """Every place that a dimension names, but tips and the fronts that lengths count from, lies on the finished surface."""
    design = TurnedDesign(
        STEP,
        (Bore(10, 25, chamfer=1), RingGroove(-35, 4, depth=2, corner=0.5), FaceGroove(26, 36, 3, from_end="back", corner=0.5),
         Undercut("M24x1.5", -30), Thread("M24x1.5", -1, -26), RingGroove(-10, 2, diameter=12, inside=True, corner=0.3)),
    )  # fmt: skip
    region = design.bodies[-1].section
    found = [(name, each) for name, feature in zip(design.drawn_names(), design.dimensions_of_features()) for each in feature]
    assert len(found) == sum(len(each.measures()) for each in design.features)
    for name, each in found:
        if each.measure.kind == "radius":
            arms = np.hypot(*(np.array([each.start, each.end]) - each.centre).T)
            assert arms == pytest.approx(each.measure.nominal) and region.distance([each.start, each.end]).max() < 1e-9
        elif each.measure.name == "diameter" and each.measure.kind == "diameter":
            assert each.start[1] == pytest.approx(each.measure.nominal / 2), name
        elif each.measure.name in ("width", "depth", "length") and name != "undercut":
            assert np.hypot(*np.subtract(each.start, each.end)) == pytest.approx(each.measure.nominal), name


def test_angles_of_nearly_nothing_and_endless_numbers():
    profile = [(0, 10), (-20, 10), (-20, 15), (-40, 15)]
    with pytest.raises(mnc.Alarm, match="the point of a bore .* must be at least 1"):
        TurnedDesign(profile, Bore(10, 15, point=5e-324))
    with pytest.raises(mnc.Alarm, match="the angle of an undercut .* must be at least 1"):
        TurnedDesign(profile, Undercut("M20x1.5", -20, angle=5e-324))
    with pytest.raises(mnc.Alarm, match="the profile of a turned design must be points"):
        TurnedDesign(10**400)
