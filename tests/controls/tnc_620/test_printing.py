"""FN 15 and FN 16: what a program writes, as the mask says it (Klartext manual, "FN 16: F-PRINT")."""

from __future__ import annotations

import math

import pytest

import mnclab as mnc
from mnclab.controls.tnc_620.printing import MaskFault, parse

#: 2018-09-05 07:08:09 UTC, counted from 1970: 17779 days, 7 hours, 8 minutes and 9 seconds.
CLOCK = 17779 * 86400.0 + 7 * 3600 + 8 * 60 + 9
LOG = '''"MEASURED";
* the date as the manual's example has it
"DATE: %02d.%02d.%04d",DAY,MONTH,YEAR4;
"TIME: %02d:%02d:%02d",HOUR,MIN,SEC;
"X1 = %9.3lf", Q31;
"Y1 = %9.3LF|%-9.3lf|",Q32 , q32;
L_GERMAN;
"Werkzeug %S",QS1;
L_ENGLISH;
"Tool %S",
    QS1;
L_ALL;
"%i of 100%%, 50\\\\50, %"so%"\\nnext",Q5;
'''
VALUES = '2 Q31 = 149.36\n3 Q32 = -25.5094\n4 QS1 = "MILL 10"\n5 Q5 = 7\n'
PRINT = "FN 16: F-PRINT TNC:\\MASK\\LOG.A / TNC:\\OUT.TXT"


def printed(inside, mask: str, blocks: str = f"{VALUES}6 {PRINT}", **settings: object) -> mnc.Run:
    return inside(blocks, mnc.Setup(files={"LOG.A": mask}, settings={"clock": CLOCK, **settings}))


def test_a_log_is_written_by_its_mask(inside) -> None:
    run = printed(inside, LOG)
    assert run.ok and not run.alarms, run.alarms
    assert run.files == {
        "TNC:\\OUT.TXT": "MEASURED\nDATE: 05.09.2018\nTIME: 07:08:09\nX1 =   149.360\nY1 =   -25.509|-25.509  |\n"
        'Tool MILL 10\n7 of 100%, 50\\50, "so"\nnext\n'
    }


def test_the_lines_are_those_of_the_language(inside) -> None:
    assert "Werkzeug MILL 10\n7 of" in printed(inside, LOG, language="german").files["TNC:\\OUT.TXT"]
    assert "SEC" not in (text := printed(inside, LOG, language="czech").files["TNC:\\OUT.TXT"]) and "MILL" not in text


@pytest.mark.parametrize(
    ("form", "value", "expected"),
    [
        ("%F", "2.5", "2.500000"), ("%5.0F", "2.6", "    3"), ("%D", "-3", "-3"), ("%5d", "12", "   12"), ("%-5I", "12", "12   "),
        ("%08.3f", "-1.5", "-001.500"), ("%+9.3lf", "1.5", "    1.500"), ("%.1lf", "1000000", "1000000.0"),
    ],
)  # fmt: skip
def test_formats_of_numbers(form: str, value: str, expected: str, inside) -> None:
    run = printed(inside, f'"{form}",QL1;', f"2 QL1 = {value}\n6 {PRINT}")
    assert run.ok and run.files["TNC:\\OUT.TXT"] == f"{expected}\n"


def test_a_number_that_is_not_whole_is_rounded_with_a_warning(inside) -> None:
    run = printed(inside, '"%d",Q1;', f"2 Q1 = 2.6\n3 {PRINT}")
    (warning,) = run.alarms
    assert warning.severity == "warning" and warning.span[:2] == (4, 18) and run.files["TNC:\\OUT.TXT"] == "3\n"


def test_one_file_grows_until_it_is_closed(inside) -> None:
    """Texts of one run stand behind each other; after M_CLOSE the file begins anew, with M_APPEND it goes on."""
    files = {"A.A": '"a %d",Q1;', "CLOSE.A": '"c";\nM_CLOSE;', "APPEND.A": '"p";\nM_APPEND;', "NEW.A": "M_TRUNCATE;\n\"n\";"}

    def after(*masks: str) -> str:
        blocks = "".join(f"{k} FN 16: F-PRINT {mask}.A / log.txt\n" for k, mask in enumerate(masks, 3))
        run = inside(f"2 Q1 = 5\n{blocks}", mnc.Setup(files=files))
        assert run.ok, run.alarms
        return run.files["log.txt"].replace("\n", ",")

    assert after("A", "A", "A") == "a 5,a 5,a 5,"
    assert after("A", "CLOSE", "A") == "a 5,"
    assert after("A", "CLOSE", "APPEND", "A") == "a 5,c,p,a 5,"
    assert after("A", "A", "NEW", "A") == "n,a 5,"


def test_a_repeat_writes_in_every_pass(inside) -> None:
    run = printed(inside, '"%d",Q1;', f"2 Q1 = 0\n3 LBL 1\n4 Q1 = Q1 + 1\n5 {PRINT}\n6 CALL LBL 1 REP 4")
    assert run.files["TNC:\\OUT.TXT"] == "1\n2\n3\n4\n5\n"
    assert run.history.at(len(run.steps.block) - 1)["file TNC:\\OUT.TXT"].text == "5\n"


def test_names_of_files_may_stand_in_texts(inside) -> None:
    run = printed(inside, '"x";', "2 QS3 = \"LOG\"\n3 QS4 = \"PART 7\"\n4 FN 16: F-PRINT :'QS3'.A / TNC:\\:'QS4'.TXT")
    assert run.ok and run.files == {"TNC:\\PART 7.TXT": "x\n"}


def test_small_and_capital_letters_name_one_file(inside) -> None:
    run = printed(inside, '"x";', "2 FN16:F-PRINT LOG / Out.txt\n3 fn 16: f-print log.a/OUT.TXT")
    assert run.files == {"Out.txt": "x\nx\n"}


def test_the_window_is_closed(inside) -> None:
    run = printed(inside, '"x";', "2 FN 16: F-PRINT LOG / SCREEN:\n3 FN 16: F-PRINT LOG / SCLR:\n4 FN 16: F-PRINT LOG / SCREEN:")
    assert run.ok and run.files == {"SCREEN:": "x\n"}


def test_texts_without_a_value(inside) -> None:
    mask = '"%S",QS9;\nM_EMPTY_HIDE;\n"%S",QS9;\n"T: %S",QS9;\nM_EMPTY_SHOW;\n"%RS",QS9;'
    assert printed(inside, mask).files["TNC:\\OUT.TXT"] == "\nT: \n\n"


def test_the_name_of_the_program(inside) -> None:
    assert printed(inside, '"%S",CALL_PATH;').files["TNC:\\OUT.TXT"] == "program\n"


def test_the_mask_lies_beside_the_program(tmp_path) -> None:
    (tmp_path / "Log.a").write_text('"X%5.1f",Q1;', encoding="utf-8")
    file = tmp_path / "PART.H"
    file.write_text(f"0 BEGIN PGM PART MM\n1 Q1 = 2\n2 {PRINT}\n3 END PGM PART MM\n", encoding="utf-8")
    assert mnc.run(file).files == {"TNC:\\OUT.TXT": "X  2.0\n"}


def test_a_mask_that_is_missing_leaves_the_path_alone(inside) -> None:
    run = inside(f"2 {PRINT}\n3 L X+5")
    (warning,) = run.alarms
    assert warning.severity == "warning" and warning.message.endswith("there is no mask of this name: nothing is written")
    assert run.files == {} and run.toolpath.motion.end[-1, 0] == 5


def test_nothing_counts_that_was_written_after_a_fault(inside) -> None:
    run = printed(inside, '"x";', f"2 {PRINT}\n3 FN 14: ERROR = 5\n4 {PRINT}")
    assert not run.ok and run.files == {"TNC:\\OUT.TXT": "x\n"}


@pytest.mark.parametrize(
    ("mask", "message"),
    [
        ('"x"', "line 1: a statement ends with ;"), ('\n"x;', "line 2: a statement ends with ;"),
        ('"%d";', "line 1: 1 places in the text, and 0 values"), ('"x";\n"%k",Q1;', "line 2: %k is no format"),
        ('"%d",X1;', "line 1: X1 cannot be put out"), ("M_FOO;", "line 1: M_FOO is no keyword of a mask"),
        ('"%S",Q1;', "line 1: %S does not put out Q1: %S is for texts, %F and %D are for numbers"),
        ("M_APPEND_MAX20;", "line 1: M_APPEND_MAX20 is not built yet"), ('"%d" Q1;', "line 1: a comma stands between the text"),
        ('"%999d",Q1;', "line 1: a field has at most 255 characters"), ('"%S",STR_MONTH;', "line 1: STR_MONTH is not built yet"),
    ],
)  # fmt: skip
def test_a_faulty_mask_is_refused_at_its_line(mask: str, message: str, inside) -> None:
    with pytest.raises(MaskFault, match="line"):
        parse(mask)
    (alarm,) = printed(inside, mask, f"2 Q1 = 5\n3 {PRINT}").alarms
    assert alarm.message.startswith(f"FN 16: mask TNC:\\MASK\\LOG.A, {message}") and alarm.span[:2] == (4, 18)


def test_parameters_alone(inside) -> None:
    """FN 15: PRINT of the older controls; a number names a text of theirs."""
    run = inside("2 Q1 = 1.25\n3 QL2 = -3\n4 FN 15: PRINT 20/Q1/QL2")
    (warning,) = run.alarms
    assert warning.severity == "warning" and run.files == {"%FN15RUN.A": "text 20\nQ1 = 1.25\nQL2 = -3\n"}


def test_files_show_as_a_table(inside) -> None:
    files = printed(inside, LOG).files
    assert repr(files).splitlines()[2].split("  ")[:3] == ["TNC:\\OUT.TXT", "8 lines", "MEASURED"]
    assert "<td" in files._repr_html_() and "MEASURED" in files._repr_html_()
    assert repr(printed(inside, LOG, "2 L X+1").files) == "no files were written"


def test_a_loop_that_writes_for_ever_ends(inside) -> None:
    mask = '"' + "x" * 2000 + '";\n'
    run = printed(inside, mask * 10, f"2 LBL 1\n3 Q1 = {math.pi}\n4 {PRINT}\n5 CALL LBL 1 REP 99999")
    (alarm,) = run.alarms
    assert "as much work as" in alarm.message and len(run.files["TNC:\\OUT.TXT"]) < 2e8


def test_the_functions_under_their_names_of_din_iso(tnc) -> None:
    """D15, D16, D19, D20 and D23 are the same functions."""
    text = (
        "%A G71 *\nN10 Q30 = 3 *\nN11 Q31 = 0 *\nN12 Q32 = -3 *\nN13 Q33 = 0 *\nN14 Q34 = 0 *\nN15 Q35 = 3 *\n"
        "N20 D23 Q20 P01 Q30 *\nN30 D16 P01 F-PRINT LOG.A / OUT.TXT *\nN40 D19 P01 +10 P02 +Q20 *\nN50 D20 *\n"
        "N60 D15 P01 +Q22 *\nN99 %A G71 *\n"
    )
    run = tnc(text, mnc.Setup(files={"LOG.A": '"R%7.2f",Q22;'}))
    assert run.ok and [alarm.span.line for alarm in run.alarms] == [10, 11, 12]
    assert run.files == {"OUT.TXT": "R   3.00\n", "%FN15RUN.A": "Q22 = 3\n"}


def test_a_contour_that_is_read_writes_nothing_and_says_so(inside) -> None:
    blocks = (
        "2 CYCL DEF 14.0 CONTOUR\n3 CYCL DEF 14.1 LABEL1\n4 CYCL DEF 20 CONTOUR DATA\nQ1=-5\nQ2=1\nQ3=0\nQ4=0\nQ5=0\nQ6=2\n"
        "Q7=50\nQ8=0\nQ9=-1\n5 CYCL DEF 22 ROUGH-OUT\nQ10=-5\nQ11=100\nQ12=200\nQ18=0\nQ19=0\nQ208=9999\nQ401=100\nQ404=0\n"
        f"6 L Z+50 FMAX M3\n7 CYCL CALL\n8 M30\n9 LBL 1\n10 {PRINT}\n11 L X+0 Y+0 RL\n12 L X+40\n13 L Y+40\n14 L X+0\n15 L Y+0\n"
        "16 LBL 0"
    )
    run = printed(inside, '"x";', blocks)
    assert run.ok and run.files == {}
    assert "FN 16 writes nothing while a contour is read" in {alarm.message for alarm in run.alarms}
