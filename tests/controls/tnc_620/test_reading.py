"""Lines into blocks: numbers, comments, continuation, words with their columns; nine spellings of one program."""

from __future__ import annotations

import pytest

import mnclab as mnc
from mnclab.controls.recognition import looks_like
from mnclab.controls.tnc_620.control import CONTROL

PROGRAM = """\
0 BEGIN PGM PART MM
1 TOOL CALL 1 Z S1000 F250
2 L X+10 Y-2.5 R0 FMAX M3
3 L Z-5 R0
4 L IX+20 RL
5 L Y+30
6 RND R5
7 L X+60
8 CYCL DEF 200 DRILLING
 Q200=2 ;SET-UP CLEARANCE
 Q201=-15 ;DEPTH
 Q206=250 ;FEED
 Q202=5 ;INFEED
 Q210=0 ;DWELL
 Q203=+0 ;SURFACE
 Q204=20 ;SECOND CLEARANCE
 Q211=0.25 ;DWELL
9 L X+80 R0
10 L X+90 R0 FMAX M99
11 CYCL DEF 7.0 DATUM SHIFT
12 CYCL DEF 7.1 X+60
13 L X+0 R0
14 END PGM PART MM
"""


def without_numbers() -> str:
    return "\n".join(line if line.startswith(" ") else line.split(" ", 1)[1] for line in PROGRAM.splitlines())


def with_tilde() -> str:
    lines = PROGRAM.splitlines()
    return "\n".join(
        line + " ~" if after.startswith(" ") else line for line, after in zip(lines, [*lines[1:], ""], strict=True)
    )


SPELLINGS = {
    "lower case": PROGRAM.lower(),
    "CR LF": PROGRAM.replace("\n", "\r\n"),
    "CR": PROGRAM.replace("\n", "\r"),
    "byte order mark": "\ufeff" + PROGRAM,
    "no block numbers": without_numbers(),
    "decimal comma": PROGRAM.replace("2.5", "2,5").replace("0.25", "0,25"),
    "plus signs left out": PROGRAM.replace("+", ""),
    "lines that end in ~": with_tilde(),
    "blanks, tabs, comments, O for 0": PROGRAM.replace(" ", "  ")
    .replace("  Y-", "\tY - ")
    .replace(" R0", " RO")
    .replace("\n", " ; x\n"),
}


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_nine_spellings_give_one_path(spelling: str, tnc) -> None:
    one, other = tnc(PROGRAM), tnc(SPELLINGS[spelling])
    assert one.ok and other.ok, other.alarms
    assert str(other.toolpath) == str(one.toolpath)
    assert other.variables == one.variables


def block(text: str) -> mnc.Program:
    program = mnc.read(text + "\n", "tnc-620")
    assert program.alarms == (), program.alarms
    return program


def words(text: str) -> list[tuple[str, object, int]]:
    return [(w.address, w.value, w.span.column) for w in block(text)[0].words]


def test_words_stand_at_their_columns() -> None:
    assert words("12 L X+1,5 IY-2 RL FMAX M3") == [
        ("X", 1.5, 6),
        ("Y", -2.0, 12),
        ("RL", None, 17),
        ("FMAX", None, 20),
        ("M", 3.0, 25),
    ]
    assert [w.incremental for w in block("12 L X+1,5 IY-2")[0].words] == [False, True]
    assert words("CR X1 R-5 DR-") == [("X", 1.0, 4), ("R", -5.0, 7), ("DR", "-", 11)]
    assert words("TOOL CALL 5 Z S300 F AUTO DL+0.1 DR-.05") == [
        ("tool", 5.0, 11), ("axis", "Z", 13), ("S", 300.0, 15), ("FAUTO", None, 20), ("DL", 0.1, 27), ("DR", -0.05, 34),
    ]  # fmt: skip
    assert words('TOOL CALL "DRILL 8" Z')[0] == ("tool", "DRILL 8", 11)
    assert words('CALL LBL "A;B" REP 3/2 ; twice') == [("label", "A;B", 10), ("REP", 3.0, 16)]


def test_plain_lines_and_others_are_read_alike() -> None:
    """The first is found in bulk, the second, for its comment, alone."""
    one, other = block("7 L X+1.5 Y-2 R0 F100"), block("7 L X+1.5 Y-2 R0 F100 ;")
    assert bool(one.plain[0]) and not other.plain[0]
    assert one[0].words == other[0].words
    assert (one[0].number, one[0].keyword, one[0].span) == ("7", "L", other[0].span)


@pytest.mark.parametrize(
    "line", ["L +5", "L  ", "L", "LX+5", "L X+1 X+2", "L X", "L X+1E5", "L R5", "L X+99999999999", "L IX+5", "X+5"]
)
def test_what_is_no_plain_line(line: str) -> None:
    assert not mnc.read(line + "\n", "tnc-620").plain.any()


def test_a_quoted_semicolon_is_no_comment_and_others_are() -> None:
    program = block('5 LBL "A;B" ; real')
    assert program.labels == {'"A;B"': 0}
    assert block("5 * - drilling\n6 L X+1")[0].words == ()
    assert block("5 ; a remark")[0].comment == "a remark"


@pytest.mark.parametrize("head", ["/5 L X+1", "5 / L X+1", "/ 5 L X+1", "/L X+1"])
def test_block_skip_stands_before_or_after_the_number(head: str, tnc) -> None:
    text = f"{head} F100\n6 L Y+1 F100\n"
    assert mnc.read(text, "tnc-620")[0].skip
    assert len(tnc(text).toolpath) == 2
    assert len(tnc(text, block_skip=True).toolpath) == 1


def test_sub_blocks_become_one_block() -> None:
    program = block("13 CYCL DEF 7.0 DEPL. DECALARE OR.\n14 CYCL DEF 7.1 X+60\n15 CYCL DEF 7.2 IY+40\n16 L X+0")
    assert [b.keyword for b in program] == ["CYCL DEF 7", "L"]
    assert [(str(w), w.span.line, w.span.column) for w in program[0].words] == [("X60", 2, 17), ("IY40", 3, 17)]


@pytest.mark.parametrize(
    "line", ["CONTUR1/2/3/4", "ETICH. CONTUR 1/2/3/4", "CONTOUR LABEL1 /2 /3 /4", "ETICH.\nCONTUR1/2/3/4"]
)
def test_contour_labels(line: str) -> None:
    """The manual prints them in many ways: the numbers count."""
    program = block(f"12 CYCL DEF 14.0 CONTUR\n13 CYCL DEF 14.1 {line}")
    assert program[0].keyword == "CYCL DEF 14"
    assert [(w.address, w.value) for w in program[0].words] == [("LBL", 1), ("LBL", 2), ("LBL", 3), ("LBL", 4)]


def test_the_lines_of_a_definition() -> None:
    text = "5 TCH PROBE 419 PUNCT DE REFERINTA\n Q 263=+25,5 ;x\nQ264=-Q5 ; y ~\n\nQ301=FMAX\n6 Q263=1"
    program = block(text)
    assert [b.keyword for b in program] == ["TCH PROBE 419", "Q"]
    assert [str(w) for w in program[0].words] == ["Q263=25.5", "Q264=-Q5", "Q301=FMAX"]
    assert [w.address for w in program[1].words] == ["target", "value"]


def test_a_definition_is_over_at_the_first_line_without_a_tilde() -> None:
    """Where its lines are joined by ~; the assignment below it is one, though no block has a number."""
    program = block("CYCL DEF 200 D ~\nQ200=2 ~\nQ201=-5\nQ5=3\nL X+1")
    assert [b.keyword for b in program] == ["CYCL DEF 200", "Q", "L"]


@pytest.mark.parametrize("name", ["GĂURIRE ADÂNCĂ", "Bohren – schnell", "穴あけ", "СВЕРЛЕНИЕ", "7 STRAT 3,5", ""])
def test_the_name_of_a_cycle_is_a_comment_in_any_language(name: str) -> None:
    program = block(
        f"5 CYCL DEF 200 {name}\nQ200=+2 ;DISTANŢA DE SIGURANŢĂ\n6 CYCL DEF 10.0 {name}\n7 CYCL DEF 10.1 ROT+35"
    )
    assert [[str(w) for w in b.words] for b in program] == [["Q200=2"], ["ROT35"]]


def test_a_long_name_may_be_broken() -> None:
    """CYCL DEF 239 DETERMINARE / INCARCAR in the manual: the next line is still the name."""
    assert [str(w) for w in block("5 CYCL DEF 239 DETERMINARE\nINCARCAR\nQ570=0")[0].words] == ["Q570=0"]


def test_inches_become_millimetres(tnc) -> None:
    run = tnc(
        "0 BEGIN PGM I INCH\n1 TOOL CALL 1 Z F10\n2 L X+1 Y-0.5 R0\n3 Q1 = 2\n4 L X+Q1 Y+0 F20 ;\n5 END PGM I INCH\n"
    )
    assert run.ok
    moves = run.toolpath.motion
    assert moves.end.ravel().tolist() == pytest.approx([25.4, -12.7, 0, 50.8, 0, 0])
    assert moves.feed.tolist() == pytest.approx([25.4, 50.8])
    assert run.variables == {"Q1": 2}


def test_first_fault_of_a_block_once_and_reading_goes_on() -> None:
    program = mnc.read("1 L X Y Z\n2 L X+1 ;\n3 FOO\n4 L Y O\n", "tnc-620")
    assert [(a.span.line, a.span.column) for a in program.alarms] == [(1, 5), (3, 3), (4, 5)]
    assert len(program) == 4


def test_the_control_is_found_by_the_text_and_the_suffix(tmp_path) -> None:
    for text in ("0 BEGIN PGM A MM\n", "%\n 12 l ix+5\n", "3 TOOL CALL 5 Z"):
        assert looks_like(text, mnc.controls) == "a program of tnc-620"
    assert looks_like("N10 G1 X5\nN20 M30\n", mnc.controls) == ""
    file = tmp_path / "A.H"
    file.write_text("1 L X+1\n")
    assert mnc.read(file, "tnc-620").control == "tnc-620" and CONTROL.suffixes == (".h", ".i")
