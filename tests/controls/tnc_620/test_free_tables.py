"""FN 26, FN 27 and FN 28: freely definable tables (Klartext manual: TABOPEN, TABWRITE, TABREAD)."""

from __future__ import annotations

import pytest

import mnclab as mnc

TABLE = (
    "BEGIN TAB1.TAB MM\n"
    "NR  X       Y       RADIUS  DOC\n"
    "0   +10.5   -20     +5      first hole\n"
    "1   +30                     \n"
    "7   0,25    4       2.5     last\n"
    "[END]\n"
)
OPEN = "2 FN 26: TABOPEN TNC:\\DIR1\\TAB1.TAB\n"


def tabled(inside, blocks: str, table: str = TABLE) -> mnc.Run:
    return inside(OPEN + blocks, mnc.Setup(files={"TAB1.TAB": table}))


def test_fields_of_a_row_come_into_parameters(inside) -> None:
    """The manual: the first value into the parameter, the next ones into those after it."""
    blocks = (
        '3 FN 28: TABREAD Q10 = 0/"X,Y,RADIUS"\n4 Q5 = 7\n5 FN 28: TABREAD QR2 = +Q5/"x, radius"\n'
        '6 FN28:TABREAD QS1=0/"DOC"'
    )
    run = tabled(inside, blocks)
    assert run.ok, run.alarms
    names = ("Q10", "Q11", "Q12", "QR2", "QR3", "QS1")
    assert [run.variables[name] for name in names] == [10.5, -20, 5, 0.25, 2.5, "first hole"]
    assert run.files == {}


def test_fields_are_written_and_read_again(inside) -> None:
    blocks = (
        '3 Q1 = 12.75\n4 Q2 = -3\n5 QS5 = "new"\n6 FN 27: TABWRITE 1/"RADIUS,Y" = Q1\n7 FN 27: TABWRITE 7/"DOC" = QS5\n'
        '8 FN 28: TABREAD Q10 = 1/"Y,RADIUS"\n9 FN 26: TABOPEN TNC:\\DIR1\\TAB1.TAB\n10 FN 28: TABREAD Q12 = 1/"X,Y"'
    )
    run = tabled(inside, blocks)
    assert run.ok, run.alarms
    assert [run.variables[f"Q{k}"] for k in range(10, 14)] == [-3, 12.75, 30, -3]
    assert run.files["TNC:\\DIR1\\TAB1.TAB"] == TABLE.replace(
        "1   +30                     ", "1   +30     -3      12.75"
    ).replace("last", "new")


def test_a_table_beside_the_program(tmp_path) -> None:
    (tmp_path / "tab1.tab").write_text(TABLE, encoding="utf-8")
    file = tmp_path / "P.H"
    file.write_text('0 BEGIN PGM P MM\n1 FN 26: TABOPEN TAB1\n2 FN 28: TABREAD Q1 = 7/"Y"\n3 END PGM P MM\n', encoding="utf-8")
    run = mnc.run(file)
    assert run.ok and run.variables["Q1"] == 4


@pytest.mark.parametrize(
    ("block", "message"),
    [
        ('FN 28: TABREAD Q1 = 5/"X"', "FN 28: the table TNC:\\DIR1\\TAB1.TAB has no row 5 (rows: 0, 1, 7)"),
        ('FN 28: TABREAD Q1 = 0/"X,Z"', "FN 28: the table TNC:\\DIR1\\TAB1.TAB has no column Z"),
        ('FN 28: TABREAD Q1 = 1/"Y"', "FN 28: TNC:\\DIR1\\TAB1.TAB, line 4: Y must be a number, got nothing"),
        ('FN 28: TABREAD Q1 = 0/"DOC"', "FN 28: TNC:\\DIR1\\TAB1.TAB, line 3: DOC must be a number, got first hole"),
        ('FN 28: TABREAD Q1 = 0.5/"X"', "FN 28 row must be a whole number from 0 to 999999999, got 0.5"),
        ('FN 27: TABWRITE 0/"X" = Q77', "FN 27: no value was given to Q77"),
        ('FN 27: TABWRITE 0/"X" = QL1', "FN 27: QL1 is 12345.678, and its column has room for 7 characters"),
        ('FN 28: TABREAD Q1999 = 0/"X,Y"', "2 parameters from Q1999 on do not exist: the last is Q1999"),
    ],
)  # fmt: skip
def test_what_the_table_lacks_is_named(block: str, message: str, inside) -> None:
    (alarm,) = tabled(inside, f"3 QL1 = 12345.678\n4 {block}").alarms
    assert alarm.message == message and alarm.span.line == 5


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (TABLE.replace("MM", "INCH"), "line 1: a table in inches is not built yet"),
        (TABLE.replace("NR", "D "), "line 2: the column NR is missing"),
        (TABLE.replace("[END]", ""), "line 7: [END] is missing"),
        (TABLE.replace("7   0", "0   0"), "line 5: NR must be a whole number that no other row has"),
        (TABLE.replace("+10.5   ", "+10.50000"), "line 3: a field stands under two columns"),
    ],
)
def test_a_faulty_table_is_refused_at_its_line(table: str, message: str, inside) -> None:
    (alarm,) = tabled(inside, "3 L X+1", table).alarms
    assert alarm.message == f"FN 26 TNC:\\DIR1\\TAB1.TAB, {message}" and alarm.span[:2] == (3, 18)


def test_tables_in_a_program_in_inches_are_refused(tnc) -> None:
    setup = mnc.Setup(files={"TAB1.TAB": TABLE})
    (alarm,) = tnc("0 BEGIN PGM A INCH\n1 FN 26: TABOPEN TAB1.TAB\n2 END PGM A INCH\n", setup).alarms
    assert alarm.message == "FN 26: tables in a program in inches are not built yet"
