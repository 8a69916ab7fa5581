"""Two programs that do the same, and mutants of them: whether the proof says so, and where.

The motion of the pairs is known beforehand: both are written here from one list of moves (`tools.twins`), or differ by one
known block. Cycle 200, DIN cycle G81 and the sense of CP are those of the manuals (TNC 620 8.2, ISO 6983, TNC 620 6.5).
"""

import json
import math
import random
import time

import numpy as np
import pytest
from tools.twins import MUTANTS, iso, klartext, mutant, part, turned

import mnclab as mnc
from mnclab import Alarm
from mnclab.testing import assert_same_motion

TOOLS = {1: mnc.Tool(radius=3, length=60), 2: mnc.Tool(radius=4, kind="drill", angle=118, length=70)}
SETUP = mnc.Setup(tools=TOOLS)
BLANK = mnc.Setup(tools=TOOLS, stock=((-50, -50, -30), (50, 50, 0)))


def text(lines):
    return "\n".join(lines) + "\n"


def proof(one, other, controls=("g43", "g43"), setup=SETUP, **options):
    return mnc.prove(*(mnc.run(each, control, setup) for each, control in zip((one, other), controls)), **options)


def twins(seed):
    """The same part in nine ways: name -> text and control."""
    moves = part(seed)
    return {
        "ISO": (text(iso(moves)), "g43"), "inches": (text(iso(moves, inches=True)), "g43"),
        "MNC": (text(iso(moves, "mnc")), "mnc"), "Klartext": (text(klartext(moves)), "tnc-620"),
        "Klartext in inches": (text(klartext(moves, True)), "tnc-620"),
        "mirrored": (text(klartext(moves, mirrored=True)), "tnc-620"), "by radius": (text(iso(moves, by_radius=True)), "g43"),
        "turned": (text(iso(moves, frame="G68 X0 Y0 R30", back=turned(30))), "g43"),
        "shifted": (text(iso(moves, frame="G52 X7 Y-3", back=lambda x, y: (x - 7, y + 3))), "g43"),
    }  # fmt: skip


def some_pairs(seeds):
    for seed in seeds:
        first, *others = (mnc.run(*each, SETUP) for each in twins(seed).values())
        for name, other in zip([*twins(seed)][1:], others):
            found = mnc.prove(first, other)
            assert found.verdict == "same motion", (seed, name, found.sentence)
            left = {each.values[0] for each in found.differences}  # a frame that the twin leaves active is told beside it
            assert left == ({"frame none"} if name in ("turned", "shifted") else set()), (seed, name, found.sentence)


def some_mutants(seeds):
    for seed in seeds:
        first, lines = mnc.run(text(iso(part(seed))), "g43", SETUP), klartext(part(seed))
        for kind in MUTANTS:
            other, places = mutant(lines, kind, random.Random(f"{kind} {seed}")) or (lines, None)
            if places is None or (kind == "dropped" and straight_on(lines, min(places))):
                continue
            found = mnc.prove(first, mnc.run(text(other), "tnc-620", SETUP))
            assert found.verdict == "different" if kind != "order" else found, (seed, kind)
            assert found.first.lines[1] in places, (seed, kind, places, found.first.sentence)


def straight_on(lines, k):
    """Whether block k (from 0) of straight moves lies on the way from the block before to the next."""
    near = [line.split(" ")[1:4] for line in lines[k - 1 : k + 2] if line.startswith("L X")]
    if len(near) < 3:
        return False
    a, b, c = (np.array([float(word[1:]) for word in words]) for words in near)
    return bool(np.linalg.norm(np.cross(b - a, c - b)) < 1e-9)


def test_twins_are_the_same_and_mutants_are_told_at_their_line():
    some_pairs(range(4))
    some_mutants(range(6))


@pytest.mark.deep
def test_hundreds_of_twins_and_mutants():
    some_pairs(range(100, 163))  # 504 pairs
    some_mutants(range(100, 150))  # 500 mutants


# What a post gets wrong.

HELIX = """BEGIN PGM P MM
TOOL CALL 1 Z S1000
L X+0 Y+0 Z+20 R0 FMAX M3
L Z+2 FMAX
L X+20 Y+0 Z+0 F300
CC X+0 Y+0
CP IPA+180 IZ-1 DR+
CP IPA+180 IZ-1 DR+
CP IPA+360 DR+
L Z+20 FMAX M5
M30
END PGM P MM
"""
HELIX_ISO = """G17 G90 G54
T1 M6
G43 H1
S1000 M3
G0 X0 Y0 Z20
Z2
G1 X20 Y0 Z0 F300
G3 X-20 Y0 Z-1 I-20 J0
G3 X20 Y0 Z-2 I20 J0
G3 X20 Y0 I-20 J0
G0 Z20
M5
M30
"""


def test_a_half_circle_in_polar_words_with_the_wrong_sense():
    assert proof(HELIX_ISO, HELIX, ("g43", "tnc-620")).verdict == "same motion"
    planted = HELIX.replace("IZ-1 DR+\nCP IPA+360", "IZ-1 DR-\nCP IPA+360")
    found = proof(HELIX_ISO, planted, ("g43", "tnc-620"))
    assert found.verdict == "different" and found.first.lines[1] == 8
    backwards = HELIX.replace("CP IPA+180 IZ-1 DR+\nCP IPA+360", "CP IPA-180 IZ-1 DR-\nCP IPA+360")
    found = proof(HELIX_ISO, backwards, ("g43", "tnc-620"))
    assert found.verdict == "different" and found.first.kind == "geometry" and found.first.lines == (9, 8)


DRILLED = """G17 G90 G54
T2 M6
G43 H2
S1000 M3
G0 X10 Y10 Z20
G98 G81 Z-10 R2 F100
X30
X30 Y30
G80
G0 Z20
M5
M30
"""
PLAIN = """G17 G90 G54
T2 M6
G43 H2
S1000 M3
G0 X10 Y10 Z20
G0 Z2
G1 Z-10 F100
G0 Z20
X30
Z2
G1 Z-10
G0 Z20
Y30
Z2
G1 Z-10
G0 Z20
M5
M30
"""
CYCLE_200 = """BEGIN PGM C MM
TOOL CALL 2 Z S1000
L X+10 Y+10 Z+20 R0 FMAX M3
CYCL DEF 200 DRILLING ~
Q200=2 ~
Q201=-10 ~
Q206=100 ~
Q202=20 ~
Q210=0 ~
Q203=0 ~
Q204=20 ~
Q211=0 ~
Q395=0
CYCL CALL
L X+30 R0 FMAX M99
L Y+30 R0 FMAX M99
L Z+20 FMAX M5
M30
END PGM C MM
"""


def test_a_cycle_against_its_plain_blocks():
    assert proof(DRILLED, PLAIN).verdict == "same motion"
    assert proof(DRILLED, CYCLE_200, ("g43", "tnc-620")).verdict == "same motion"
    deeper = proof(DRILLED, CYCLE_200.replace("Q201=-10", "Q201=-10.01"), ("g43", "tnc-620"))
    assert deeper.verdict == "different" and deeper.counts == {"depth": 1} and deeper.first.moves == 3


@pytest.mark.parametrize("setup", [SETUP, BLANK])
def test_a_return_height_that_is_lower_is_never_harmless(setup):
    """Q204 counted from R instead of the surface: 2 mm lower over the clamps."""
    lower = CYCLE_200.replace("Q204=20", "Q204=18")
    found = proof(DRILLED, lower, ("g43", "tnc-620"), setup, allow=("lifts", "chords", "order"))
    assert found.verdict == "different" and found.counts == {"rapid": 1}
    assert found.first.amount == pytest.approx(2) and found.first.lines[1] in (14, 15)


def test_a_return_height_that_is_higher_may_be_allowed():
    higher = CYCLE_200.replace("Q204=20", "Q204=22")
    assert proof(DRILLED, higher, ("g43", "tnc-620")).verdict == "different"
    assert proof(DRILLED, higher, ("g43", "tnc-620"), BLANK).verdict == "same part"
    found = proof(DRILLED, higher, ("g43", "tnc-620"), allow="lifts")
    assert not found and all(each.harmless for each in found.differences)


COMPENSATED = """G17 G90 G54
T1 M6
G43 H1
S1000 M3
G0 X0 Y0 Z20
G1 Z-2 F200
G41 D1 X20 Y0 F300
Y30
X40
G40 X60 Y30
G0 Z20
M5
M30
"""
KLARTEXT = """BEGIN PGM K MM
TOOL CALL 1 Z S1000
L X+0 Y+0 Z+20 R0 FMAX M3
L Z-2 F200
L X+20 Y+0 RL F300
L Y+30
L X+40
L X+60 Y+30 R0
L Z+20 FMAX M5
M30
END PGM K MM
"""


def test_the_side_of_compensation():
    assert proof(COMPENSATED, KLARTEXT, ("g43", "tnc-620")).verdict == "same motion"
    found = proof(COMPENSATED, KLARTEXT.replace("RL", "RR"), ("g43", "tnc-620"))
    assert found.verdict == "different" and found.first.lines == (7, 5) and "side" in found.counts
    straight = PATH.replace("G1 Z-2", "G1 G41 D1 X0 Y-3 Z-2")  # a side that moves nothing is told all the same
    assert proof(straight, straight.replace("G41", "G42").replace("Y-3", "Y3")).verdict == "different"


# What differs beside the way.

PATH = """G17 G90 G54
T1 M6
G43 H1
S1000 M3
G0 X0 Y0 Z20
G1 Z-2 F200
X10 F300
Y5
X20
Y10
G0 Z20
M5
M30
"""


@pytest.mark.parametrize(
    ("old", "new", "kind", "line", "verdict"),
    [
        ("F300", "F400", "feed", 7, "different"),
        ("M3", "M4", "spindle", 6, "different"),
        ("S1000", "S1100", "spindle", 6, "different"),
        ("M3\n", "M3 M8\n", "coolant", 6, "same part"),
        ("Y5\n", "Y5\nG4 P500\n", "dwell", 9, "same part"),
        ("Y5\n", "Y5\nM0\n", "dwell", 9, "same part"),
        ("T1 M6\nG43 H1", "T2 M6\nG43 H2", "tool", 6, "different"),
        ("Z-2", "Z-2.01", "depth", 6, "different"),
        ("Y5\n", "Y5.01\n", "geometry", 8, "different"),
        ("G0 Z20\nM5", "G0 Z1\nX0\nZ20\nM5", "rapid", 11, "different"),
    ],
)
def test_each_kind_is_told_at_its_line(old, new, kind, line, verdict):
    found = proof(PATH, PATH.replace(old, new, 1), setup=BLANK)
    assert (found.first.kind, found.first.lines[1], found.verdict) == (kind, line, verdict), found.sentence
    assert proof(PATH, PATH.replace(old, new, 1)).verdict == "different"  # without a blank


def test_a_spindle_that_is_left_on_is_told_beside_the_motion():
    found = proof(PATH, PATH.replace("M5\nM30\n", ""))
    assert found.verdict == "same motion" and found.counts == {"leftovers": 1}
    assert "spindle off against S1000 M3" in found.sentence and not found.first.harmless


def test_the_same_feed_in_other_words():
    """300 mm/min at 1000 rev/min are 0.3 mm a turn; a feed that inches round is no other one."""
    assert proof(PATH, PATH.replace("G1 Z-2 F200", "G1 Z-2 F200.4")).verdict == "same motion"
    assert proof(PATH, PATH.replace("X10 F300", "G95 X10 F0.3")).verdict == "same motion"
    assert proof(PATH, PATH.replace("X10 F300", "G95 X10 F0.4")).first.kind == "feed"


def test_a_subprogram_against_its_blocks():
    called = """BEGIN PGM S MM
TOOL CALL 1 Z S1000
L X+0 Y+0 Z+20 R0 FMAX M3
L Z-2 F200
CALL LBL 1
CALL LBL 1
L Z+20 FMAX M5
M30
LBL 1
L IX+10 F300
L IY+5
LBL 0
END PGM S MM
"""
    assert proof(PATH, called, ("g43", "tnc-620")).verdict == "same motion"
    found = proof(PATH, called.replace("IY+5", "IY+5.01"), ("g43", "tnc-620"))
    assert found.first.lines == (8, 11) and found.first.amount == pytest.approx(0.01)


def chords(count):
    angles = np.pi * np.arange(1, count + 1) / count
    return "".join(f"X{10 + 10 * math.cos(a):.5f} Y{10 + 10 * math.sin(a):.5f}\n" for a in angles)


def test_chords_of_an_arc_are_harmless_where_they_are_allowed():
    """The chord error of a half circle of radius 10 in n chords is 10 (1 - cos(π / 2n)): 0.0005 mm of 160, 0.0077 of 40."""
    arc, fine, coarse = (PATH.replace("Y10\n", f"Y10\n{more}") for more in ("G3 X0 Y10 I-10 J0\n", chords(160), chords(40)))
    assert proof(arc, fine).verdict == "different" and proof(arc, fine).counts == {"chords": 1}
    for one, other in ((arc, fine), (fine, arc)):
        assert proof(one, other, allow=["chords"]).verdict == "same motion"
    assert proof(arc, coarse, allow=["chords"]).counts.get("geometry")
    first = proof(arc, coarse).first  # the ends of chords lie on the arc, their middles do not
    assert first.amount == pytest.approx(10 * (1 - math.cos(math.pi / 80)), abs=2e-4) and first.moves == 40
    assert first._replace(amount=float("nan")).told == "over 40 moves"
    assert proof(arc, coarse, allow=["chords"], tolerance=0.01).verdict == "same motion"


def test_a_circle_in_two_halves_is_not_one_the_other_way_round():
    whole = PATH.replace("Y10\n", "Y10\nG3 X20 Y10 I-10 J0\n")
    halves = PATH.replace("Y10\n", "Y10\nG3 X0 Y10 I-10 J0\nX20 I10 J0\n")
    assert proof(whole, halves).verdict == "same motion"
    found = proof(whole, halves.replace("G3", "G2"))
    assert found.verdict == "different" and found.first.lines == (11, 11)
    assert proof(whole.replace("I-10 J0", "I-10 J0.0005"), halves).verdict == "same motion"


def test_another_order_and_another_way():
    more = PATH.replace("M5\n", "X-30 Y-30\nG1 Z-4 F200\nX-10 F300\nG0 Z20\nM5\n")
    head, foot = PATH.split("G0 X0 Y0")[0], "M5\nM30\n"
    swapped = f"{head}G0 X-30 Y-30 Z20\nG1 Z-4 F200\nX-10 F300\nG0 Z20\nX0 Y0\n{PATH.split('Z20', 1)[1].split('M5')[0]}{foot}"
    assert proof(more, swapped).counts == {"order": 1}
    assert proof(more, swapped, allow=["order"]).verdict == "same motion"
    assert proof(more, swapped, setup=BLANK).verdict == "same part"
    back = f"{head}G0 X20 Y10 Z20\nG1 Z-2 F200\nY5 F300\nX10\nY0\nX0\nG0 Z20\n{foot}"
    assert proof(PATH, back, setup=BLANK).verdict == "same part"
    off = proof(PATH, back.replace("Y5", "Y5.01"), setup=BLANK)
    assert off.verdict == "different" and "the parts differ" in off.part


def test_an_order_that_collides_is_never_harmless():
    """A pocket floor at Z-4 first, then across it at rapid at Z-3: the other way round that rapid goes through metal."""
    head, foot = PATH.split("G0 X0 Y0")[0], "G0 Z20\nM5\nM30\n"
    slot, rapid = "G0 X0 Y0 Z20\nG1 Z-4 F200\nX30 F300\nG0 Z20\n", "G0 X0 Y0\nZ-3\nX30\nG1 Y4 F300\nG0 Z20\n"
    found = proof(head + slot + rapid + foot, head + rapid + slot + foot, setup=BLANK, allow=("order", "lifts"))
    assert found.verdict == "different" and "collision" in found.counts, found.sentence


def test_a_move_in_two_blocks_is_one_move():
    two = PATH.replace("X20\n", "X13.3333 F300\nX20\n")
    assert proof(PATH, two).verdict == "same motion"
    waits = proof(PATH, PATH.replace("X20\n", "X13.3333\nG4 P500\nX20\n"))
    assert waits.counts == {"dwell": 1} and waits.first.lines[1] == 10
    slower = PATH.replace("X20\n", "X13.3333\nX20 F100\n").replace("Y10\n", "Y10 F300\n")
    found = proof(PATH, slower)
    assert found.first.kind == "feed" and found.first.lines == (9, 10)


def test_a_program_that_stops_proves_nothing():
    broken = PATH.replace("X20\n", "X20 QQ\n")
    for one, other in ((PATH, broken), (broken, PATH), (broken, broken)):
        found = proof(one, other, allow=("lifts", "chords", "order"))
        assert found.verdict == "different" and found.sentence.startswith("not proven") and "stops" in found.counts
    assert proof("", "").sentence == "not proven: there is no motion in either" and proof("", "").verdict == "different"


TURNED = "M3\nT1\nS800 G97 G95 F0.25\nG00 X32 Z3\nG01 X14\nZ-25\nX32\nG00 Z3\nX60 Z50\nM5\n"
BAR = mnc.Setup(tools={1: mnc.Tool(kind="turning")}, stock=mnc.cylinder(30, -60))


def test_a_lathe():
    """A bar of radius 30 turned to 14, in one cut and in two: the part is the same, as is not one 0.01 mm thicker."""
    controls = ("jnc-t01", "jnc-t01")
    twice = TURNED.replace("G01 X14\nZ-25\nX32\nG00 Z3\n", "G01 X16\nZ-25\nX32\nG00 Z3\nG01 X14\nZ-25\nX32\nG00 Z3\n")
    assert proof(TURNED, TURNED, controls, BAR).verdict == "same motion"
    assert proof(TURNED, twice, controls, BAR).verdict == "same part"
    for old, new, line in (("X14", "X14.01", 5), ("Z-25", "Z-25.01", 6), ("F0.25", "F0.3", 5), ("G97 G95", "G96 G95", 5)):
        found = proof(TURNED, TURNED.replace(old, new), controls, BAR)
        assert found.verdict == "different" and found.first.lines[1] == line, found.sentence


def test_zero_points_that_are_two_are_told():
    setup = mnc.Setup(tools=TOOLS, datums={1: (100, 0, 0), 2: (200, 0, 0)})
    found = proof(PATH.replace("M6\n", "M6\nG0 X0 Y0 Z100\n"), PATH.replace("M6\n", "M6\nG0 X0 Y0 Z100\n"), setup=setup)
    assert found.sentence == "the same motion within 0.001 mm"
    assert "X100 Y0 Z0 and X200 Y0 Z0" in proof(PATH, PATH.replace("G54", "G55"), setup=setup).sentence


def wave(count, deeper=0.0, setup=SETUP):
    """Rows of a surface in moves of 0.1 mm."""
    k = np.arange(count)
    places = zip((k % 1000 * 0.1).tolist(), (k // 1000 * 0.5).tolist(), (np.sin(k * 0.01) * 2 - 3 - deeper).tolist())
    head, foot = PATH.split("X10 F300")[0], "G0 Z20\nM5\nM30\n"
    return mnc.run(head + "F300\n" + "".join(f"X{x:.3f} Y{y:.3f} Z{z:.3f}\n" for x, y, z in places) + foot, "g43", setup)


@pytest.mark.benchmark
def test_a_million_moves_a_side():
    one = wave(1_000_000)
    for other, verdict in ((one, "same motion"), (wave(1_000_000, 0.01), "different")):
        begun = time.process_time()
        assert mnc.prove(one, other).verdict == verdict
        assert time.process_time() - begun < 10


@pytest.mark.benchmark
@pytest.mark.parametrize("setup", [SETUP, BLANK])
def test_five_hundred_moves_a_side(setup):
    one, other = wave(500, setup=setup), wave(500, 0.01, setup)
    begun = time.process_time()
    assert mnc.prove(one, other).counts == {"depth": 1}
    assert time.process_time() - begun < 1


# What is given and what is shown.

def test_what_is_shown_names_both_programs(tmp_path):
    found = proof(PATH, PATH.replace("Y5\n", "Y5.01\n"))
    assert "`Y5.01`" in found.sentence and "`Y5`" in found.sentence and "0.01 mm" in str(found)
    assert json.loads(found.save(tmp_path / "p.json").read_text())["differences"][0]["lines"] == [8, 8]
    assert "<img" in found.save(tmp_path / "p.html").read_text()
    assert found.save(tmp_path / "p.csv").read_text().count("\n") == 2 and "Y5.01" in found._repr_html_()
    assert found.plot().alt.startswith("geometry")


def test_what_makes_no_sense_is_refused():
    for options in ({"tolerance": 0}, {"tolerance": "a"}, {"allow": ["feed"]}, {"allow": 3}):
        with pytest.raises(Alarm):
            proof(PATH, PATH, **options)
    with pytest.raises(Alarm):
        mnc.prove(PATH, 5)


def test_a_test_of_a_post():
    assert_same_motion(mnc.run(PATH, "g43"), mnc.run(PATH, "g43"))
    with pytest.raises(AssertionError, match=r"not the same motion within 0\.001 mm(.|\n)*line 8"):
        assert_same_motion(mnc.run(PATH, "g43"), mnc.run(PATH.replace("Y5\n", "Y5.01\n"), "g43"))


def test_from_a_shell(tmp_path, capsys):
    from mnclab.__main__ import main

    one, other, wrong = (tmp_path / name for name in ("a.g43", "b.h", "c.h"))
    one.write_text(HELIX_ISO)
    other.write_text(HELIX)
    wrong.write_text(HELIX.replace("F300", "F3000"))
    assert mnc.prove(str(one), other).verdict == "same motion" and not mnc.prove(one, HELIX, setup=SETUP)
    assert main(["prove", str(one), str(other)]) == 0 and "the same motion" in capsys.readouterr().out
    assert main(["prove", str(one), str(wrong), "--json", "--allow", "lifts,order"]) == 1
    assert json.loads(capsys.readouterr().out)["counts"] == {"feed": 1}


# Parts that differ where a few samples would miss it: each of these was once called the same part.

HOLE = "G21 G17 G90 G94 G54 T1 M6\nS1000 M3\nG0 X{} Y{} Z5\nG1 Z-9 F200\n{}G0 Z5\nM30\n"
CUTS = {  # a program, another one that leaves another part, and one that leaves the same
    "a hole": ((50, 40, ""), [(50, y, "") for y in (40.01, 40.1, 39.9)], []),
    "a slot": (
        (40, 20, "Y60\n"), [(40, 20, "Y60.1\n"), (40, 19.9, "Y60\n"), (40, 20, "Y45\nX40.1\nX40\nY60\n")],
        [(40, 60, "Y20\n")],
    ),
    "a contour": (
        (10, 10, "X90\nY70\nX10\nY10\n"), [(10, 10, f"X50\nY{10 + g}\nY10\nX90\nY70\nX10\nY10\n") for g in (0.1, 0.5, 1.5)],
        [(10, 10, "Y70\nX90\nY10\nX10\n")],
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", CUTS)
def test_a_part_that_is_gouged_in_one_place_is_not_the_same(what):
    setup = mnc.Setup(tools={1: mnc.Tool(radius=5, number=1)}, stock=((0, 0, -20), (100, 80, 0)))
    one, others, same = CUTS[what]
    for cut, verdict in [*((each, "different") for each in others), *((each, "same part") for each in same)]:
        found = mnc.prove(*(mnc.run(HOLE.format(*each), "g43", setup) for each in (one, cut)))
        assert found.verdict == verdict, cut


def test_cuts_that_meet_no_blank_prove_no_part():
    setup = mnc.Setup(tools={1: mnc.Tool(radius=5, number=1)}, stock=((200, 200, -20), (300, 280, 0)))
    found = mnc.prove(*(mnc.run(HOLE.format(x, 40, ""), "g43", setup) for x in (50, 70)))
    assert found.verdict == "different" and "neither of them cuts anything" in found.part


def test_what_one_cuts_the_other_must_not_go_at_rapid():
    runs = [mnc.run(HOLE.format(-30, -30, "").replace(*each), "g43") for each in (("", ""), ("G1 Z-9 F200", "G0 Z-9"))]
    found = mnc.prove(*runs)
    assert found.verdict == "different" and found.counts["rapid"] == 1


def test_another_number_of_the_same_tool_is_told_and_no_motion():
    tools = {1: mnc.Tool(radius=5, number=1), 2: mnc.Tool(radius=5, number=2), 3: mnc.Tool(radius=4, number=3)}
    one, two, three = (mnc.run(HOLE.format(5, 5, "").replace("T1", f"T{k}"), "g43", tools=tools) for k in (1, 2, 3))
    assert mnc.prove(one, two).verdict == "same motion" and mnc.prove(one, two).differences[0].values == ("T1", "T2")
    assert mnc.prove(one, three).verdict == "different" and mnc.prove(one, three).differences[0].values == ("T1", "T3")


@pytest.mark.parametrize("more, told", [
    ("G52 X9\n", ("frame none", "frame shifted by X9 Y0 Z0")), ("G91\n", ("dimension G90", "dimension G91")),
    ("G55\n", ("datum G54", "datum G55")), ("G18\n", ("plane G17", "plane G18")),
])  # fmt: skip
def test_what_is_left_active_is_told_beside_the_motion(more, told):
    text = HOLE.format(5, 5, "").removesuffix("M30\n")
    found = mnc.prove(mnc.run(text, "g43"), mnc.run(text + more, "g43"))
    assert found.verdict == "same motion" and [each.values for each in found.differences] == [told]


def test_pecks_that_go_on_in_their_own_hole_are_no_lower_rapid():
    """G81 and cycle 200 with pecks of 3 mm make one part, whichever is trusted; a rapid beside the hole is lower."""
    setup = mnc.Setup(tools={1: mnc.Tool(radius=3, number=1, kind="drill")}, stock=((0, 0, -20), (100, 80, 0)))
    one = "G21 G17 G90 G94 G54 T1 M6\nS1000 M3\nG0 X20 Y20 Z20\nG99 G81 X20 Y20 Z-10 R2 F150\nX60\nX60 Y60\nG80\nG0 Z50\nM30\n"
    other = (
        "BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F150\nL Z+20 R0 FMAX M3\nCYCL DEF 200 D\nQ200=2\nQ201=-10\nQ206=150\nQ202=3\n"
        "Q210=0\nQ203=0\nQ204=2\nQ211=0\nL X+20 Y+20 FMAX M99\nL X+60 FMAX M99\nL Y+60 FMAX M99\nL Z+50 FMAX\nEND PGM A MM\n"
    )
    runs = mnc.run(one, "g43", setup), mnc.run(other, "tnc-620", setup)
    assert [mnc.prove(*pair).verdict for pair in (runs, runs[::-1])] == ["same part", "same part"]
    beside = mnc.run(other.replace("L Z+50 FMAX", "L X+40 FMAX\nL Z-1 FMAX\nL Z+50 FMAX"), "tnc-620", setup)
    assert mnc.prove(runs[0], beside).verdict == "different"


@pytest.mark.parametrize("swapped", [False, True])
def test_of_many_blocks_on_one_way_the_one_that_leaves_it_is_told(swapped):
    """A line in 200 blocks, one of them 0.01 mm off; an arc of radius 20 in 90 chords, one of their ends 1 mm off in X."""
    head = "G21 G17 G90 G94 G54 T1 M6\nS1000 M3\nG0 X0 Y20 Z5\nG1 Z-2 F200\n"
    line = "".join(f"X{k / 2:.1f}\n" for k in range(1, 201))
    ends = [(20 * math.sin(math.radians(k)), 40 - 20 * math.cos(math.radians(k))) for k in range(1, 91)]
    chords = ["".join(f"X{x + (k == off):.4f} Y{y:.4f}\n" for k, (x, y) in enumerate(ends)) for off in (-1, 40)]
    pairs = {
        104: (line, line.replace("X50.0\n", "X50.0 Y20.01\n").replace("X50.5\n", "X50.5 Y20\n")),
        45: ("G3 X20 Y40 R20\n", chords[1]),
    }
    for number, pair in pairs.items():
        runs = [mnc.run(head + text + "G0 Z5\nM30\n", "g43") for text in pair]
        found = mnc.prove(*(runs[::-1] if swapped else runs), allow=["chords"], tolerance=0.005)
        assert found.verdict == "different" and found.first.lines[not swapped] == number
    good = [mnc.run(head + text + "G0 Z5\nM30\n", "g43") for text in (pairs[45][0], chords[0])]
    assert mnc.prove(*good, tolerance=0.005, allow="chords").verdict == "same motion"


def test_a_tool_that_turns_on_the_way_that_another_goes_upright():
    """Under M128 the tip keeps to its line while the table leans by 20 degrees: 2 sin(1) of 100 mm after the first of ten rows.
    A table that turns about the tool is the same motion on the part."""
    head = "BEGIN PGM A MM\nTOOL CALL 1 Z S2000\nL X-30 Y+0 Z+50 R0 FMAX M3\nL Z-5 F500\nM128\n"
    setup = mnc.Setup(tools={1: mnc.Tool(radius=5, length=80)}, kinematics="table-ac")
    one, leans, turns = (
        mnc.run(f"{head}L X+30 {axis} F300\nM129\nL Z+50 FMAX\nM2\nEND PGM A MM\n", "tnc-620", setup)
        for axis in ("", "A+20", "C+60")
    )
    for first, second in ((one, leans), (leans, one)):
        found = [each for each in mnc.prove(first, second).differences if each.kind == "geometry"]
        assert [each.amount for each in found] == [pytest.approx(200 * math.sin(math.radians(1)), abs=1e-6)]
        assert "3.4905 mm apart" in found[0].told
        assert mnc.prove(first, turns).verdict == ("same motion" if first is one else "different")


def test_a_picture_is_about_the_place_of_a_difference_and_not_about_its_row():
    """A face in a tilted plane, 80 mm long: 1 mm more at its end is seen there: in the plane Y80 Z-1
    and Y81 Z-1, turned by 20 degrees."""
    plane = "PLANE SPATIAL SPA+20 SPB+0 SPC+0 TURN MB50 FMAX"
    text = f"TOOL CALL 1 Z S900\nL X+0 Y+0 Z+5 R0 FMAX M3\n{plane}\nL X+100 Z-1 F500\nL Y+{{}} F200\n"
    setup = mnc.Setup(tools={1: mnc.Tool(radius=4, length=50)}, kinematics="table-ac", start=(0, 0, 400))
    found = mnc.prove(*(mnc.run(text.format(y), "tnc-620", setup) for y in (80, 81)))
    c, s = np.cos(np.radians(20)), np.sin(np.radians(20))
    ends = np.array([[80, -1], [81, -1]]) @ [[c, s], [-s, c]]
    assert np.allclose([each[1:] for each in found.first.places], ends, atol=1e-9)
    for ax, k in zip(found.plot().axes, (0, 1)):
        low, high = ax.get_ylim()
        assert abs((low + high) / 2 - ends[:, k].mean()) < 1 and high - low < 40


def waves(count, pieces):
    """Half circles of 5 mm above and below X in turn, and lines between points on them: where they meet, two lines are one."""
    head = "T1 M6\nS1000 M3\nG0 X0 Y0 Z5\nG1 Z-1 F300\n"
    turns = "".join(f"G{2 + k % 2} X{10 * k + 10} Y0 I5\n" for k in range(count))
    shares = np.arange(1, pieces * count + 1) / pieces
    k = np.ceil(shares) - 1
    x, y = 10 * k + 5 - 5 * np.cos(np.pi * (shares - k)), 5 * (-1) ** k * np.sin(np.pi * (shares - k))
    lines = [f"G1 X{a:.5f} Y{b:.5f}\n" for a, b in zip(x.tolist(), y.tolist())]
    return f"{head}{turns}G0 Z5\nM2\n", head, lines


def test_chords_of_arcs_whose_ends_lie_within_lines():
    arcs, head, lines = waves(120, 64)
    chords = f"{head}{''.join(lines)}G0 Z5\nM2\n"
    assert mnc.prove(arcs, chords, tolerance=0.01, allow="chords").verdict == "same motion"
    for k in (700, 4000, 7600):
        x, y = (float(word[1:]) for word in lines[k].split()[1:])
        middle = 10 * (k // 64) + 5  # a point is 0.05 mm too far out
        wrong = [*lines[:k], f"G1 X{middle + 1.01 * (x - middle):.5f} Y{1.01 * y:.5f}\n", *lines[k + 1 :]]
        found = mnc.prove(arcs, f"{head}{''.join(wrong)}G0 Z5\nM2\n", tolerance=0.01, allow="chords")
        (told,) = [each for each in found.differences if each.kind == "geometry"]
        assert found.verdict == "different" and told.lines[1] == k + 5 and told.amount == pytest.approx(0.05, abs=1e-3)
