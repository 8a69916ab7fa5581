"""What LinuxCNC has otherwise, by its own answers (rs274 and gcode.parse of 2.9, written beside each), and half-typed O words."""

import json
import math
from pathlib import Path

import pytest
from tools.running import run

import mnclab
from mnclab import Setup

DIALECT = Setup(settings={"dialect": "linuxcnc", "stopped_spindle": "accept"})


def ends(text, **given):
    found = run(text, "g43", dialect="linuxcnc", stopped_spindle="accept", **given)
    return found.toolpath.motion.end.tolist()


def said(text, setup=DIALECT):
    return [
        (alarm.span.line, alarm.message) for alarm in mnclab.run(text, "g43", setup).alarms if alarm.severity == "alarm"
    ]


def test_it_begins_in_g99():
    """rs274: Z1 between the holes and after them; Fanuc and Haas begin in G98."""
    text = "G0 Z5\nG81 X1 Z-1 R1 F100\nX2\nG80\nG0 X5\n"
    assert ends(text)[-1] == [5, 0, 1]
    assert run(text, "g43", stopped_spindle="accept").toolpath.end[-1].tolist() == [5, 0, 5]


def test_codes_that_linuxcnc_does_not_know():
    """rs274: Unknown g code used, Unknown m code used; the other controls have them."""
    for code in "G9 G15 G16 G27 G29 G40.1 G44 G50 G50.1 G51 G51.1 G54.1 G65 G66 G67 G68 G69 M13 M14 M29".split():
        text = f"G21 F100\n{code}{' P1' if code in ('G65', 'G66', 'G54.1') else ''}\nM2\n"
        assert said(text) == [(2, f"{code}: LinuxCNC does not know this code")], code
        others = said(text, Setup(settings={"stopped_spindle": "accept"}))
        assert not any("LinuxCNC" in message for _, message in others), code


def test_a_program_without_an_end():
    """rs274: File ended with no percent sign or program end; File ended with no percent sign. All motion is made before."""
    without, second = "ends without M2, M30 or two lines %", "ends without a second %"
    for text, says in (
        ("G1 X1 F100\n", without), ("%\nG1 X1 F100\n", second), ("%\nG1 X1 F100\n%\n", ""), ("G1 X1 F100\nM2\n", ""),
        ("%\nG1 X1 F100\nM30\n", ""), ("", without),
    ):  # fmt: skip
        found = mnclab.run(text, "g43", DIALECT)
        warned = [alarm.message for alarm in found.alarms]
        assert found.ok and len(warned) == bool(says) and says in "".join(warned), (text, warned)
        assert not mnclab.run(text, "g43", Setup(settings={"stopped_spindle": "accept"})).alarms


@pytest.mark.parametrize("text", ["X1\n", "G81 X1 Z-1 R1 F100\nG80\nX1 Y1\n", "G80\nG92 X0\nX1\n"])
def test_axis_words_need_a_motion(text):
    """gcode.parse: Cannot use axis values without a g code that uses them."""
    (found,) = said("G21\n" + text + "M2\n")
    assert found == (text.count("\n") + 1, "X1 has no motion: none is active")
    assert not said("G21\n" + text + "M2\n", Setup(settings={"stopped_spindle": "accept"}))


@pytest.mark.parametrize(("radius", "unit", "allowed"), [
    (0.5, "G21", 0.0282843), (25, "G21", 0.0282843), (100, "G21", 0.1), (2000, "G21", 2.0),
    (1, "G20", 0.00282843), (25, "G20", 0.025), (2000, "G20", 0.282843),
])  # fmt: skip
def test_radii_of_an_arc(radius, unit, allowed):
    """Where gcode.parse begins to refuse, found by halving: 0.02 √2 mm or 0.002 √2 in, or 0.001 of the larger radius."""
    for share, ok in ((0.999, True), (1.003, False)):
        off = share * allowed
        text = f"{unit}\nG1 X0 F10\nG2 X{2 * radius:.9f} Y0 I{radius - off / 2:.9f}\n"
        run(text, "g43", ok=ok, dialect="linuxcnc", stopped_spindle="accept")


@pytest.mark.parametrize(("text", "missing"), [
    ("G81 X1 Z-1 R2\nG85 X3 Z-2\n", "G85 R"), ("G81 X1 Z-1 R2\nG85 X3 R2\n", "G85 Z"),
    ("G73 X1 Z-4 R1 Q1.5\nG83 X3 R2 Z-2\n", "G83 Q"), ("G82 X1 Z-4 R1 P1.5\nG89 X3 R2 Z-2\n", "G89 P"),
    ("G81 X1 Z-1 R2\nG85 X3 R2 Z-2\n", ""), ("G81 X1 Z-1 R2\nG81 X3\nG81 X4 Z-2\n", ""), ("G82 X1 Z-1 R2 P.5\nG82 X3\n", ""),
    ("G83 X1 Z-1 R2 Q.5\nG83 X3 Z-2\n", ""),
])  # fmt: skip
def test_data_of_a_hole_are_those_of_its_cycle(text, missing):
    """gcode.parse refuses the first four (R unspecified, Z unspecified, Q missing, P missing) and takes the others."""
    found = said(f"G21 F100 S100 M3\nG0 Z5\n{text}M2\n")
    assert [(line, message[: len(missing)]) for line, message in found] == ([(4, missing)] if missing else [])
    assert not said(f"G21 F100 S100 M3\nG0 Z5\n{text}M2\n", Setup())


def test_g61_does_not_stop_on_one_line():
    """100 mm in 200 moves at 50 mm/s, 200 mm/s²: v/a + s/v = 2.25 s; a corner stops, and so does every move under G61.1."""
    line = "".join(f"G1 X{k / 2}\n" for k in range(1, 201))

    def time(code, moves, dialect="linuxcnc"):
        setup = Setup(limits="hobby-router", settings={"dialect": dialect, "stopped_spindle": "accept"})
        return mnclab.run(f"G21 F3000\n{code}\n{moves}", "g43", setup).profile().time

    assert time("G61", line) == pytest.approx(2.25)
    each = 2 * math.sqrt(0.5 / 200)  # 0.5 mm from stop to stop never reach 50 mm/s
    assert time("G61.1", line) == pytest.approx(200 * each) == time("G61", line, "fanuc")
    assert time("G61", "G1 X50\nY50\n") == pytest.approx(2 * 1.25)
    assert time("G61\nG64", "G1 X50\nY50\n") < 2 * 1.25


def test_formulas_and_assignments_in_a_block():
    """gcode.parse: Y2, X5 with #1 = 9 set behind the block, then Y9; a number of a block may have a fraction."""
    assert ends("F100\nG1 Y SQRT[4]\n#1=5\nG1 X#1 #1=9\nN1.5 G1 Y#1\n#3=4 G1 X-ATAN[1]/[1] #<a>=[#3+1]\nG1 X#<a>\n") == [
        [0, 2, 0], [5, 2, 0], [5, 9, 0], [-45, 9, 0], [5, 9, 0],
    ]  # fmt: skip
    assert said("F100\nG1 Y SQRT[4]\n", Setup())[0][1] == "Y: a function of a value stands in brackets"
    assert said("F100\nG1 X1 #1=9\n", Setup())[0][1] == "words and an assignment stand in one block"


def test_names_that_linuxcnc_gives():
    """gcode.parse: X3 Y2, then feed 100, metric 1; EXISTS is 1 for what has a value."""
    assert ends("G21 F100\nG1 X2 Y3\nG1 X#<_y> Y#<_x>\nG1 X#<_feed> Y#<_metric>\nG1 X[EXISTS[#<a>]] Z[EXISTS[#<_x>]]\n")[1:] == [
        [3, 2, 0], [100, 1, 0], [0, 1, 0],
    ]  # fmt: skip


def test_a_return_has_the_name_of_its_if_and_keywords_have_blanks():
    """gcode.parse: X1, Y5 (the value of endsub), Y8 (the value of return), X3 by `else if`."""
    sub = "O1 sub\nO7 if [#1 GT 2]\nO7 return [#1*2]\nO7 end if\nG1 X1\nO1 end sub [5]\n"
    text = sub + "O1 call [1]\nG1 Y#<_value>\nO1 call [4]\nG1 Y#<_value>\nO2 if [0]\nX2\nO2 else if [1]\nX3\nO2 endif\n"
    assert ends("G21 F100\n" + text) == [[1, 0, 0], [1, 5, 0], [1, 8, 0], [3, 8, 0]]


def test_a_subprogram_in_a_file(tmp_path):
    """Looked up beside the program; #1 doubled comes back."""
    (tmp_path / "slot.ngc").write_text("o<slot> sub\nG1 X#1\no<slot> endsub [#1*2]\nM2\n")
    (tmp_path / "main.ngc").write_text("G21 F100\no<slot> call [7]\nG1 Y#<_value>\nM2\n")
    assert mnclab.run(tmp_path / "main.ngc", setup=DIALECT).toolpath.motion.end.tolist() == [[7, 0, 0], [7, 14, 0]]


@pytest.mark.parametrize(("text", "alarm"), [
    ("O1 sub\nG0 X1\n", (1, "O1 sub has no O1 endsub")),
    ("O1 while [1 GT 0]\n", (1, "O1 while has no O1 endwhile")),
    ("O1 do\nG0 X1\n", (1, "O1 do has no O1 while")),
    ("O1 endwhile\n", (1, "O1 endwhile has no O1 while before it")),
    ("O1 if [1]\nO2 endif\nO1 endif\n", (2, "O2 endif has no O2 if before it: O1 if is open")),
    ("O1 if [1]\nO1 else\nO1 elseif [1]\nO1 endif\n", (3, "O1 elseif stands behind else")),
    ("O1 while\nO1 endwhile\n", (1, "while needs a value in brackets")),
    ("O1 repeat [2]\nO1 continue\nO1 endrepeat\n", (2, "O1 continue stands in no while or do of this name")),
    ("O1 break\n", (1, "O1 break stands in no while or do or repeat of this name")),
    ("O1 return\n", (1, "O1 return stands outside O1 sub")),
    ("O1 sub\nO2 sub\nO2 endsub\nO1 endsub\n", (2, "O2 sub stands inside O1 sub")),
    ("O1 sub\nO1 endsub\nO1 sub\nO1 endsub\n", (3, "O1 sub stands twice")),
    ("O1 call\n", (1, "there is no subprogram O1")),
    ("O1 cal\n", (1, "cal is no O word")),
    ("O1 call [1] G1\n", (1, "'G' is too much behind call")),
    ("O[1+1] sub\nO2 endsub\n", (1, "only a call may work out the name of sub")),
    ("O1 sub\nO1 call\nO1 endsub\nO1 call\n", (2, "calls stand deeper inside each other than 9, the most on LinuxCNC")),
    ("O1 call" + " [1]" * 31 + "\nO1 sub\nO1 endsub\n", (1, "a call has at most 30 arguments")),
    ("#1=EXISTS[5]\n", (1, "EXISTS needs a variable in brackets")),
    ("O1 sub\n#1=", (2, "a value was expected")),
])  # fmt: skip
def test_half_typed(text, alarm):
    assert alarm in said(text)


def test_a_loop_without_an_end_stops():
    (alarm,) = said("O1 while [1 GT 0]\nO1 endwhile\n")
    assert alarm[0] == 2 and "never gets out of this loop" in alarm[1]


def test_they_are_of_one_dialect():
    loops = ("while [0]\nO1 endwhile", "repeat [0]\nO1 endrepeat", "do\nO1 while [0]")
    for code in ("sub\nO1 endsub", "call", "if [1]\nO1 endif", *loops):
        assert said(f"O1 {code}\n", Setup())[0][1] == "O words are those of LinuxCNC"


@pytest.mark.parametrize(("text", "hint"), [
    ("G0 X25 Y20\nG2 X15 Y20 I20 J20\n",
     'counted from the origin they fit, radius 5: G90.1, or the setting arc_centres="origin"'),
    ("G90.1 G0 X25 Y20\nG2 X15 Y20 I-5 J0\n",
     'counted from the start of the arc they fit, radius 5: G91.1, or the setting arc_centres="start"'),
    ("G1 X20 R5\nY20\n", "a rounding of the corner is ,R5, a chamfer ,C"),
    ("G0 X25 R3\n", "a rounding of the corner is ,R3, a chamfer ,C"),
    ("G0 X25 Y20\nG2 X15 Y30 I20 J20\n", ""),
])  # fmt: skip
def test_hints_of_the_street(text, hint):
    assert mnclab.run("F100\n" + text, "g43").alarms[0].hint == hint


def test_what_only_the_machine_knows():
    (alarm,) = mnclab.run("G21\nF#<_hal[torch.cut-feed]>\nM2\n", "g43", DIALECT).alarms
    assert (alarm.span.line, alarm.hint) == (2, "write its number")
    for text in ("#<most> = #<_ini[TOOLSENSOR]MAXPROBE>", "F #<_hal[a.b]>", "G1 X[2 * #<_hal[a.b]>]"):
        (alarm,) = mnclab.run(f"G21\n{text}\nM2\n", "g43", DIALECT).alarms
        assert (str(alarm.span.line), alarm.message) == ("2", "a HAL pin or an INI entry has a value on the machine alone")


WORDS = json.loads((Path(__file__).parents[2] / "authorities" / "iso_words.json").read_text("utf-8"))["records"]


def test_the_oriented_stop():
    """R is an angle up to a full turn and P the direction, a whole number to 2; it moves nothing."""
    for record in WORDS:
        run = mnclab.run(record["text"], "g43", DIALECT)
        assert run.ok == ("error" not in record), (record["text"], record.get("error"), run.alarms)
        assert run.toolpath.motion.end.tolist() == [pytest.approx(row["to"]) for row in record["motion"]]
    run = mnclab.run("G21 S500 M3\nM19 R90 P1\nM19 P2\n", "g43", DIALECT)
    assert list(run.history["spindle angle"])[-2:] == [90, 0]


@pytest.mark.parametrize(("text", "alarm"), [
    ("G1 @5 ^30", "@ is a distance of polar coordinates on LinuxCNC: not built (write X and Y)"),
    ("^30", "^ is an angle of polar coordinates on LinuxCNC: not built (write X and Y)"),
    ("G31 Z-5", "G31: LinuxCNC does not know this code (G38.2 moves until the probe touches)"),
    ("G72 Q100 X1", "G72 is refused: not built: holes along a line (Haas), write G81 and their places; on LinuxCNC a lathe"
                    " roughs with it"),
    ("G71.1 Q100 X1",
     'G71.1 is refused: it belongs to a lathe: choose control="jnc-t01" or write the program for the mill'),
    ("G8", 'G8 is refused: on LinuxCNC it makes X a radius, on a lathe (choose control="jnc-t01", or leave it out on a mill)'),
    ("G71", "G71 is no unit on LinuxCNC but roughs a contour on a lathe (write G21 for the unit;"
            " lathes have the control jnc-t01)"),
    ("G70 Q100 X15", "G70 Q100 is a contour cycle of a lathe (a program of a lathe; write G20 or G21 for the unit, and the"
                     " motion itself)"),  # G70 Q- [X- Z- D- E- P-] of LinuxCNC
    ("G71 Q100 X15 D1 R1 I1", "G71 Q100 is a contour cycle of a lathe (a program of a lathe; write G20 or G21 for the unit,"
                              " and the motion itself)"),
    ("M101 P1", "P1 has no meaning in this block (what M101 takes, the maker of the machine says: leave P1 out)"),
    ("G103 P5", "G103 is refused: no code of LinuxCNC (leave it out; G64 P says how far a corner may be cut)"),
    ("G5.1 X[.1+.2]", "G5.1 stands in a block without motion, X0.3 does not belong to it (write two blocks; the splines of"
                      " LinuxCNC are not built: write lines or arcs)"),
    ("O1 callsub", "callsub is no O word (write call)"),
    ("G1 W5", "W is refused: increments of a lathe, or axes that are not built: write X, Y or Z under G91"),
])  # fmt: skip
def test_what_is_not_built_is_told(text, alarm):
    (found,) = mnclab.run(f"G21 G90 F100\n{text}\nM2\n", "g43", DIALECT).alarms
    assert f"{found.message}{f' ({found.hint})' if found.hint else ''}" == alarm


def test_a_change_of_material_is_one_of_the_machine():
    (found,) = mnclab.run("M190 P1\nM2\n", "g43", DIALECT).alarms
    assert found.severity == "warning" and "M190 is a function of the machine's maker" in found.message


@pytest.mark.parametrize(("text", "runs"), [
    ("F100 S100 M3|G94|G1 X1", False),  # rs274: Cannot do g1 with zero feed rate
    ("F100 S100 M3|G95|G1 X1", False),
    ("F100 S100 M3 G94|G1 X1", True),
    ("S100 M3|G94 F100|G1 X1", True),
])  # fmt: skip
def test_a_feed_mode_forgets_the_feed(text, runs):
    """LinuxCNC asks for F after each G94 and G95, even where it is active; Fanuc keeps the feed of G94 through G94."""
    text = "G21\n" + text.replace("|", "\n") + "\nM2\n"
    assert mnclab.run(text, "g43", DIALECT).ok is runs
    assert mnclab.run(text, "g43").ok is (runs or "G94" in text)
