"""Ways between cuts that could hit something, and what a program leaves to the machine: what may be allowed, and what never."""

import math

import pytest

import mnclab as mnc
from mnclab.__main__ import main

TOOLS = {1: mnc.Tool(radius=3, length=60), 2: mnc.Tool(radius=4, length=70)}
SETUP = mnc.Setup(tools=TOOLS)
BLANK = mnc.Setup(tools=TOOLS, stock=((-50, -50, -30), (50, 50, 0)))
HARMLESS = ("lifts", "chords", "order")
PATH = (
    "G17 G90 G54\nT1 M6\nG43 H1\nS1000 M3\nG0 X0 Y0 Z{h}\nG1 Z-2 F200\nX10 F300\nG0 Z{h}\n{way}X-20 Y-20\nG1 Z-2 F200\n"
    "G0 Z50\nM5\nM30\n"
)
BEFORE, AROUND = "", "Y40\nX-20\n"  # the clamp


def path(way, height=5):
    return PATH.format(h=height, way=way)


def proof(one, other, setup=SETUP, controls=("g43", "g43"), **options):
    runs = (mnc.run(text, control, setup) for text, control in zip((one, other), controls))
    return mnc.prove(*runs, allow=HARMLESS, **options)


@pytest.mark.parametrize("setup", [SETUP, BLANK])
@pytest.mark.parametrize("ways", [(AROUND, BEFORE), (BEFORE, AROUND)])
def test_a_detour_that_is_dropped_is_never_harmless(ways, setup):
    """Both go at Z5, and a clamp may stand where only one of them does not go."""
    found = proof(*map(path, ways), setup)
    assert found and found.counts == {"aside": 1} and not found.harmless and found.first.lines[1] == 9, found
    assert "X-20 Y-20 Z5" in found.first.values[1] or "X10 Y40 Z5" in found.first.values[1]


def test_what_stands_on_the_way_to_the_first_cut_may_be_hit_too():
    """Nobody knows from where the tool comes; then one goes X40 Y40 and from there to the first cut."""
    found = proof(path(BEFORE), path(BEFORE).replace("G0 X0 Y0 Z5", "G0 X40 Y40 Z5\nX0 Y0"))
    assert found.counts == {"aside": 1} and found.first.lines == (5, 5)


def test_above_what_the_other_went_over_it_is_harmless():
    for other in (path(BEFORE, 5.5), path(AROUND, 20)):
        found = proof(path(AROUND), other.replace("G0 X0 Y0 Z20", "G0 X0 Y0 Z5"))
        assert not found and {*found.counts} == {"lifts"}, found
    assert proof(path(AROUND), path(BEFORE, 4.5)).counts == {"rapid": 2}


def clamped(top, x=-5.0):
    """A clamp of 6 mm beside the straight way from X10 Y0 to X-20 Y-20, or on it."""
    return mnc.Setup(tools=TOOLS, stock=((-50, -50, -30), (50, 50, 0)), fixtures=(((x - 3, -14, 0), (x + 3, -8, top)),))


def test_fixtures_say_what_is_clear():
    """At Z5 the straight way goes 2 mm above a clamp of 3 mm, where the way round is 4.5 mm beside it; one of 8 mm is hit."""
    ways = path(AROUND), path(BEFORE)
    far = proof(*ways, clamped(3, x=40))
    assert not far and far.counts == {"lifts": 1}
    near = proof(*ways, clamped(3))
    assert near.verdict == "different" and near.counts == {"nearer": 1}, near
    assert near.first.values[1] == "2 mm from the fixture"
    assert "collision" in proof(*ways, clamped(8)).counts
    assert not proof(ways[1], ways[0], clamped(3)) and proof(ways[1], ways[0], clamped(3)).counts == {"lifts": 1}


def test_a_delta_length_is_another_depth():
    klartext = (
        "BEGIN PGM K MM\nTOOL CALL 1 Z S1000{}\nL X+0 Y+0 Z+5 R0 FMAX M3\nL Z-2 F200\nL X+10 F300\nL Z+50 FMAX M5\nM30\n"
        "END PGM K MM\n"
    )
    one = path(BEFORE).split("G0 Z5\n")[0] + "G0 Z50\nM5\nM30\n"
    assert not proof(one, klartext.format(""), controls=("g43", "tnc-620"))
    for delta, word in (("+", "higher"), ("-", "lower")):
        found = proof(one, klartext.format(f" DL{delta}0.1"), controls=("g43", "tnc-620"))
        assert found.verdict == "different" and found.first.kind == "depth" and found.first.lines == (6, 4), found
        assert found.first.amount == pytest.approx(0.1) and f"tip 0.1 mm {word}" in found.first.values[1]


def test_the_blank_of_one_serves_both():
    """The second one goes X10 in two cuts with a lift between: the blank of the first one shows that the part is the same."""
    other = path(BEFORE).replace("X10 F300", "X5 F300\nG0 Z5\nG1 Z-2 F200\nX10 F300")
    runs = mnc.run(path(BEFORE), "g43", BLANK), mnc.run(other, "g43", SETUP)
    for pair in (runs, runs[::-1]):
        found = mnc.prove(*pair)
        whose = "first" if pair is runs else "second"
        assert found.verdict == "same part" and found.blank == f"the blank of the {whose} program was taken for both"
        assert found.blank in found.sentence
    deeper = mnc.prove(runs[0], mnc.run(other.replace("G1 Z-2 F200\nX10", "G1 Z-3 F200\nX10"), "g43", SETUP))
    assert deeper.verdict == "different" and "the parts differ by 1.000 mm" in deeper.part


def test_a_spindle_that_is_held_through_a_tool_change_is_told():
    first, second = "T1 M6\nG43 H1\nS900 M3\nG0 X0 Y0 Z5\nG1 Z-2 F200\nG0 Z50\n", "G0 X20 Y20 Z5\nG1 Z-4\nG0 Z50\nM5\nM30\n"
    tools = first + "{}T2 M6\nG43 H2\n{}" + second
    again, held = tools.format("", "S900 M3\n"), tools.format("", "")
    for same in ((again, again), (held, held), (again, tools.format("M5\n", "M3\n"))):
        assert not proof(*same).counts
    found = proof(again, held)
    assert found.verdict == "same motion" and found.counts == {"restart": 1} and found.first.lines == (11, 10)
    assert "held through" in found.sentence
    assert proof(again, tools.format("M5\n", "")).counts["spindle"] == 1


def test_a_first_cut_that_is_missing_is_told_at_the_cut():
    found = proof(path(BEFORE), path(BEFORE).replace("G1 Z-2 F200\nX10 F300", "G1 X10 F300", 1))
    assert found.first.kind == "geometry" and found.first.lines == (6, 6) and found.first.blocks[1] == "G1 X10 F300"
    assert found.first.values == ("1 cut", "none before this block")


def test_rapids_of_a_lathe_are_told_by_their_places():
    turned = "M3\nT1\nS800 G97 G95 F0.25\nG00 X32 Z3\nG01 X14\nZ-25\nX32\nG00 Z3\nX60 Z50\nM5\n"
    setup = mnc.Setup(tools={1: mnc.Tool(kind="turning")}, stock=mnc.cylinder(30, -60))
    found = proof(turned, turned.replace("G00 Z3\nX60", "G00 X60\n"), setup, controls=("jnc-t01", "jnc-t01"))
    assert found.verdict == "same part" and not found.harmless and found.first.lines == (8, 8)
    assert found.first.values[1].startswith("by X60 (radius) Z-25, X60 (radius) Z50")


FRAME = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nM3\nL Z+100 R0 FMAX\n{}\nM5\nEND PGM A MM\n"
BODY = ((0, 0, -20), (100, 80, 0))


def klartext(one, other, stock=BODY, kinematics=None, **options):
    """The proof of two lists of blocks; the first block is on line 5."""
    tools = {1: mnc.Tool(radius=5, length=80)}
    more = {} if kinematics is None else {"kinematics": kinematics}
    setup = mnc.Setup(tools=tools, start=(0, 0, 300), stock=stock, **more)
    return mnc.prove(*(mnc.run(FRAME.format(each.replace(" / ", "\n")), "tnc-620", setup) for each in (one, other)), **options)


TWO_CUTS = (
    "L X+10 Y+10 Z+50 FMAX / L Z+2 FMAX / L Z-2 F300 / L X+30 F300 / L Z+50 FMAX / L X-20 FMAX / L X+60 FMAX / L Z+2 FMAX / "
    "L Z-2 F300 / L X+70 / L Z+50 FMAX"
)


@pytest.mark.parametrize(
    ("old", "new", "lower", "line"),
    [
        ("L X-20 FMAX", "L X-20 FMAX / L Z-15 FMAX / L Z+50 FMAX", 65, 11),  # the first one goes by there at Z50
        ("L X-20 FMAX", "L X-20 FMAX / L Z+5 FMAX / L Z+50 FMAX", 45, 11),  # above its last Z, and a clamp may stand there
        ("L X+60 FMAX", "L X+60 FMAX / L Z-20 FMAX", 22, 12),  # ends at Z2 there
        ("L X+30 F300", "L X+20 F300 / L Z-30 FMAX / L Z-2 FMAX / L X+30 F300", 80, 9),  # sideways at Z50 at least
        ("L X+70 / L Z+50 FMAX", "L X+70", 52, 14),  # the tool stays in the part at Z-2
    ],
)
def test_a_rapid_that_dips_is_lower(old, new, lower, line):
    dips = TWO_CUTS.replace(old, new)
    found = klartext(TWO_CUTS, dips, allow=HARMLESS)
    (told,) = [each for each in found.differences if each.kind == "rapid"]
    assert found.verdict == "different" and told.amount == pytest.approx(lower) and told.lines[1] == line, found
    assert "lifts" not in found.counts and {*klartext(dips, TWO_CUTS, allow=HARMLESS).counts} <= {"lifts", "collision"}


def test_of_very_many_ways_one_that_dips_is_lower_too(monkeypatch):
    """Of more ways than are looked at one by one."""
    monkeypatch.setattr("mnclab.comparison.ways.MOST", 0)
    dips = TWO_CUTS.replace("L X-20 FMAX", "L X-20 FMAX / L Z-15 FMAX / L Z+50 FMAX")
    assert klartext(TWO_CUTS, dips).counts == {"rapid": 1}


def test_a_rapid_that_goes_low_where_the_other_is_high_is_lower():
    """Both go sideways at Z5 at last: the first one from X50 on, where it stands clear, the second from X30 on."""
    one = TWO_CUTS.replace("L X-20 FMAX", "L X+50 FMAX / L Z+5 FMAX")
    found = klartext(one, one.replace("L X+30 F300 / L Z+50 FMAX", "L X+30 F300 / L Z+5 FMAX"), allow=HARMLESS)
    assert found.counts == {"rapid": 1} and found.first.amount == pytest.approx(45), found


BIG = ((-40, -40, -40), (80, 40, 0))
LEANS = "M128 / L X+0 Y+0 Z+50 FMAX / L Z-2 F300 / L X+50 B+15 F300 / L Z+50 FMAX / M129"
TILTED = (
    "PLANE SPATIAL SPA+0 SPB+20 SPC+0 TURN FMAX / L X+0 Y+0 Z+30 FMAX / L Z-3 F300 / L X+20 / L Z+200 FMAX / "
    "PLANE RESET TURN FMAX / L X+0 Y+0 Z+60 FMAX"
)


def test_what_a_part_leaves_out_proves_no_part():
    """Rows on which the tool turns are not in a part: by X25 Y20 a groove goes 20 mm beside the first one."""
    found = klartext(LEANS, LEANS.replace("L X+50 B+15 F300", "L X+25 Y+20 B+8 F300 / L X+50 Y+0 B+15"), BIG, "head-bc")
    assert found.verdict == "different" and "left out" in found.part and "8" in found.part, found
    assert klartext(LEANS, LEANS.replace("B+15", "B+40"), BIG, "head-bc").verdict == "different"
    dips = LEANS.replace("L Z+50 FMAX / M129", "L Z-30 B+25 FMAX / L Z-2 B+15 FMAX / L Z+50 FMAX / M129")
    assert "rapid" in klartext(LEANS, dips, BIG, "head-bc").counts
    higher = LEANS.replace("L Z+50 FMAX / M129", "L Z+60 FMAX / M129")  # what is upright is judged
    assert klartext(LEANS, higher, BIG, "head-bc").verdict == "same part"


def test_a_tool_that_turns_in_the_part_is_no_detour():
    """Without its lift by 200 along the tool it turns at Z-3 cos(20) - 20 sin(20), where the first one keeps above Z60."""
    found = klartext(TILTED, TILTED.replace(" / L Z+200 FMAX", ""), BIG, "table-ac")
    assert found.verdict == "different" and found.first.kind == "rapid" and found.first.lines[1] == 9, found
    assert found.first.amount == pytest.approx(60 + 3 * math.cos(math.radians(20)) + 20 * math.sin(math.radians(20)), abs=1e-6)


def test_what_could_hurt_comes_before_a_lift(tmp_path):
    """The first way is 5 mm higher, the last cut 1 mm deeper: line 14 is why the parts differ, and what is shown."""
    other = TWO_CUTS.replace("L X+60 FMAX", "L Z+55 FMAX / L X+60 FMAX").replace("L X+70", "L X+70 Z-3")
    found = klartext(TWO_CUTS, other)
    assert found.counts == {"depth": 1, "lifts": 1} and found.differences[0].kind == "lifts"
    assert found.first.kind == "depth" and found.first.lines == (14, 15) and found.plot().alt.startswith("depth")
    assert "different (1 other depth, 1 other lift)" in found.sentence and "first depth" in found.sentence
    page = found.save(tmp_path / "p.html").read_text()
    assert "<code>L X+70 Z-3</code>" in page and "`" not in page.split("<img")[0] and "margin:1em 0" in page


HOLES = "CYCL DEF 200 D / Q200=2 / Q201={} / Q206=150 / Q202=5 / Q210=0 / Q203=0 / Q204=20 / Q211=0 / Q395=0 / "
HOLES += "L X+20 Y+20 R0 FMAX M99 / L X+40 R0 FMAX M99 / L X+60 R0 FMAX M99 / L Z+50 FMAX"


@pytest.mark.parametrize("depth", [9.5, 11, 16])
def test_a_hole_with_a_peck_more_is_another_depth(depth):
    """Of 10 mm in pecks of 5: 11 takes one more, 16 two."""
    for one, other in ((10, depth), (depth, 10)):
        found = klartext(HOLES.format(-one), HOLES.format(-other))
        assert found.counts == {"depth": 3} and [each.lines for each in found.differences] == [(k, k) for k in (15, 16, 17)]
        assert all(each.amount == pytest.approx(abs(depth - 10)) for each in found.differences)
        assert [each.places[1][2] for each in found.differences] == [pytest.approx(-other)] * 3


def test_along_a_tilted_tool_nothing_goes_sideways():
    """The plane is tilted by 20 degrees: Z+4 in it is 4 cos(20) = 3.759, and the way there goes along the tool."""
    found = klartext(TILTED, TILTED.replace("L Z-3 F300", "L Z+4 FMAX / L Z-3 F300"), BIG, "table-ac")
    assert found.first.kind == "rapid" and "sideways at Z3.759" not in found.sentence and "rapid ends at Z3.759" in found.sentence


def test_a_tilted_hole_with_a_peck_more_is_another_depth():
    """1 mm deeper along the tool."""
    holes = TILTED.replace("L X+0 Y+0 Z+30 FMAX / L Z-3 F300 / L X+20 / ", HOLES.replace("L Z+50 FMAX", ""))
    found = klartext(holes.format(-10), holes.format(-11), BIG, "table-ac")
    assert found.counts == {"depth": 3} and [each.amount for each in found.differences] == [pytest.approx(1)] * 3
    assert klartext(holes.format(-10), holes.format(-10), BIG, "table-ac").verdict == "same motion"


def test_a_tool_that_turns_about_its_tip_is_told():
    """In a cut, and at rapid, where its shank may meet a clamp."""
    cut = LEANS.replace("L X+50 B+15 F300", "L X+50 B+15 F300 / L X+50 B+0")
    found = klartext(LEANS, cut, BIG, "head-bc", allow=HARMLESS)
    assert found.verdict == "different" and found.counts["geometry"] == 1 and found.first.lines[1] == 9, found
    rapid = LEANS.replace("L Z+50 FMAX / M129", "L Z+50 B+40 FMAX / M129")
    (told,) = [each for each in klartext(LEANS, rapid, BIG, "head-bc", allow=HARMLESS).differences if each.kind != "collision"]
    assert told.kind == "aside" and told.lines[1] == 9 and told.values == ("tool B15", "B40, tilted otherwise by 25°"), told


def test_a_tool_that_stays_at_a_turned_part_is_told():
    turned = "M3\nT1\nS800 G97 G95 F0.25\nG00 X32 Z3\nG01 X14\nZ-25\nX32\n"
    setup = mnc.Setup(tools={1: mnc.Tool(kind="turning")}, stock=mnc.cylinder(30, -60))
    found = proof(turned + "G00 Z3\nX60 Z50\nM5\n", turned + "M5\n", setup, controls=("jnc-t01", "jnc-t01"))
    assert found.counts == {"aside": 1} and not found.harmless


def test_a_tilt_is_told_as_one():
    leans = "M128 / L X+0 Y+0 Z+50 A-20 FMAX / L Z-2 F300 / L X+50 F300 / L Z+50 FMAX / M129"
    found = klartext(leans, leans.replace("A-20", "A-21"), BIG, "table-ac")
    assert found.first.lines == (6, 6)  # where it is turned
    assert {each.values for each in found.differences} == {("tool A-20", "A-21, tilted otherwise by 1°")}, found
    found = klartext(TILTED, TILTED.replace("SPB+20", "SPB+21"), BIG, "table-ac")
    heights = [30 * math.cos(math.radians(angle)) for angle in (20, 21)]  # where the swivel has ended, not its first row
    assert [place[2] for place in found.first.places] == [pytest.approx(z, abs=1e-6) for z in heights]
    assert found.differences[1].values[1].endswith("tilted otherwise by 1°")


def test_inches_for_mm_are_called_so():
    found = proof(path(BEFORE), "G20\n" + path(BEFORE))
    assert "25.4 times" in found.sentence


def test_the_status_from_a_shell(tmp_path, capsys):
    texts = {"a": path(BEFORE, 5), "higher": path(BEFORE, 9)}
    texts["cut"] = path(BEFORE).replace("X10 F300", "X10 F300\nX0\nX10")
    for name, text in texts.items():
        (tmp_path / f"{name}.g43").write_text(text)
    setup = tmp_path / "s.toml"
    setup.write_text("[stock]\nlow = [-50, -50, -30]\nhigh = [50, 50, 0]\n[tools.1]\nradius = 3\nlength = 60\n")

    def status(name, *more):
        return main(["prove", str(tmp_path / "a.g43"), str(tmp_path / name), *more])

    blank = "--setup", str(setup)
    assert status("a.g43") == 0 and status("a.g43", "--same-motion") == 0
    assert status("higher.g43") == 1  # no blank: nothing is known of the part
    assert status("higher.g43", *blank) == 0 and status("higher.g43", *blank, "--same-motion") == 1
    assert status("higher.g43", "--allow", "lifts", "--same-motion") == 0
    assert status("cut.g43", *blank) == 1  # the same part by other cuts
    capsys.readouterr()
    assert status("missing.g43") == 2 and "missing.g43" in capsys.readouterr().err
    assert main(["prove", str(tmp_path / "none.g43"), str(tmp_path / "a.g43")]) == 2 and "none.g43" in capsys.readouterr().err
