"""Macro B of the ISO mill: variables, formulas, conditions, loops, and what the control keeps in variables.

What a vacant variable means is Fanuc's table as public manuals repeat it (Mitsubishi M700 instruction manual, 13.5 "undefined
variables"; NCT 99M, 20.11.3), the numbers of system variables those of the same manuals.
"""

import math
from functools import partial

import pytest
from tools import running

import mnclab
from mnclab import Setup

run = partial(running.run, control="g43")


def value(text, before="", **settings):
    """What a formula is worth; None where it is vacant."""
    found = run(f"{before}\n#100={text}\n", **settings)
    assert found.ok, found.alarms
    return found.variables.get("#100")


@pytest.mark.parametrize(
    "text, fanuc, linuxcnc",
    [
        ("1+2*3", 7, 7), ("[1+2]*3", 9, 9), ("10/4*2", 5, 5), ("2**3**2", 64, 64), ("-2**2", 4, 4), ("1--1", 2, 2),
        ("SIN[30]", 0.5, 0.5), ("COS[60]*2", 1, 1), ("TAN[45]", 1, 1), ("ACOS[-.5]", 120, 120), ("SQRT[2.25]", 1.5, 1.5),
        ("ABS[-3]", 3, 3), ("LN[EXP[2]]", 2, 2), ("POW[2,10]", 1024, None), ("BIN[18]", 12, None), ("BCD[12]", 18, None),
        ("ATAN[1]/[-1]", 135, 135), ("ATAN[-1]/[1]", 315, -45), ("ATAN[-1,1]", 315, None), ("ASIN[-.5]", 330, -30),
        ("FIX[1.8]", 1, 1), ("FIX[-1.2]", -1, -2), ("FUP[1.2]", 2, 2), ("FUP[-1.2]", -2, -1),
        ("ROUND[2.5]", 3, 3), ("ROUND[-2.5]", -3, -3), ("27 MOD 20", 7, 7), ("[-5]MOD 3", -2, 1),
        ("6AND3", 2, 1), ("6 OR 1", 7, 1), ("6XOR3", 5, 0), ("1 OR 0 AND 0", 1, 0), ("1+2 OR 4", 7, 1),
        ("[1EQ1.00005]", 0, 1), ("[2 GE 2]", 1, 1), ("[[1 LT 2] AND [3 NE 3]]", 0, 0),
    ],
)  # fmt: skip
def test_formulas_of_two_dialects(text, fanuc, linuxcnc):
    """Bits (6 is 110, 3 is 011), cutting off or rounding down, and the ranges of angles; the others agree.

    None: rs274 refuses it, "Unknown word where unary operation could be" and "Unknown operation" (`iso_blocks.json`).
    """
    assert math.isclose(value(text), fanuc, abs_tol=1e-12)
    if linuxcnc is None:
        (alarm,) = run(f"#100={text}\n", macros="linuxcnc", ok=False).alarms
        assert alarm.message.endswith("is not known to LinuxCNC")
    else:
        assert math.isclose(value(text, macros="linuxcnc"), linuxcnc, abs_tol=1e-12)


def test_rounding_in_an_address_is_to_the_least_increment():
    """Haas 96-8000, ROUND in an address: 1.00333 twice is 2.0066, in inches of four places."""
    found = run("G20\n#1=1.00333\nG0 X[ROUND[#1]+ROUND[#1]]\n#2=ROUND[#1]\nG21\nG0 Y[ROUND[#1]]\n")
    assert np_close(found, [(2.0066 * 25.4, 0, 0), (2.0066 * 25.4, 1.003, 0)])
    assert found.variables["#2"] == 1


def np_close(found, ends):
    return len(found.toolpath) == len(ends) and abs(found.toolpath.end - ends).max() < 1e-12


def test_vacant_variables():
    """An address with one is left out; in arithmetic it is 0; EQ and NE tell it from 0, the others do not."""
    found = run("G0 X1 Y#1 Z[#1+2]\n#2=#1\n#3=#1*5\n#4=#1+#1\n")
    assert np_close(found, [(1, 0, 2)])
    assert found.variables == {"#3": 0, "#4": 0}
    table = {"#1 EQ #0": 1, "#1 NE 0": 1, "#1 GE #0": 1, "#1 GT 0": 0, "#1 LE #0": 1, "#1 LT 0": 0, "#1 EQ 0": 0}
    assert {text: value(text) for text in table} == table
    zero = {"#1 EQ #0": 0, "#1 NE 0": 0, "#1 GE #0": 1, "#1 GT 0": 0, "#1 LE #0": 1, "#1 LT 0": 0}
    assert {text: value(text, "#1=0") for text in zero} == zero
    assert np_close(run("G0 X5 Y5\nG0 Y#1\n", dialect="linuxcnc"), [(5, 5, 0), (5, 0, 0)])


def test_variables_by_number_and_name():
    found = run("#2=9\n#1=2\n##1=7\n#[#1+1]=#2*2\n#<Tool Depth>=-4\nG0X##1Y#[1+2]Z#<tooldepth>\n")
    assert np_close(found, [(7, 14, -4)])
    assert found.variables == {"#1": 2, "#2": 7, "#3": 14, "#<tooldepth>": -4}
    assert run("#100=1 #101=2\n").variables == {"#100": 1, "#101": 2}


def test_variables_that_were_there_before():
    setup = Setup(variables={"#101": 2.5, "#<width>": 3})
    found = mnclab.run("G0 X#101 Y#<width>\n#101=#101+1\n", "g43", setup)
    assert found.toolpath.end.tolist() == [[2.5, 3, 0]] and found.variables["#101"] == 3.5
    assert not mnclab.run("G0 X1\n", "g43", Setup(variables={"#5001": 1})).ok


def test_codes_may_be_formulas():
    """Planned with the numbers that they have: G1 with a feed, then G3 about (10, 10), M3."""
    found = run("#1=1\nG#1 X10 F[50*2]\n#1=#1+2\nG#1 X20 Y10 I0 J10\nM#1 S300\nG[90+1] G1 X-1 Y#7\n")
    assert [row.kind.name for row in found.toolpath.motion] == ["LINE", "ARC", "LINE"]
    assert found.toolpath.motion.end.tolist() == [[10, 0, 0], [20, 10, 0], [19, 10, 0]]
    assert found.history.at(4)["turning"] == 1


def test_conditions_jumps_and_loops():
    """Triangular numbers three ways: 1 + 2 + … + 10 = 55."""
    assert run("#1=0\n#2=1\nWHILE[#2LE10]DO1\n#1=#1+#2\n#2=#2+1\nEND1\n").variables["#1"] == 55
    assert run("#1=0\n#2=1\nN1 IF[#2GT10]GOTO2\n#1=#1+#2\n#2=#2+1\nGOTO 1\nN2 G0 X#1\n").toolpath.end[-1, 0] == 55
    found = run("#1=0\n#2=0\nDO 2\n#2=#2+1\n#1=#1+#2\nIF [#2 EQ 10] GOTO 99\nEND 2\nN99 #3=[#1 EQ 55]\n")
    assert found.variables["#3"] == 1
    nested = "#1=0\n#2=0\nWHILE [#2 LT 3] DO 1\n#3=0\nWHILE [#3 LT 4] DO 2\n#1=#1+1\n#3=#3+1\nEND 2\n#2=#2+1\nEND 1\n"
    assert run(nested).variables["#1"] == 12
    assert run("IF [1 EQ 2] THEN #1=5\nIF [1 EQ 1] THEN #2=6\nWHILE [1 GT 2] DO 1\n#3=1\nEND 1\n").variables == {"#2": 6}


def test_a_jump_goes_to_the_next_block_of_its_number():
    found = run("N10 G0 X1\n#1=#1+1\nIF [#1 EQ 2] GOTO 20\nGOTO 10\nN10 G0 X2\nGOTO 10\nN20 G0 X3\n")
    assert found.toolpath.end[:, 0].tolist() == [1, 2, 1, 3]
    assert {alarm.message for alarm in found.alarms} == {"N10 stands 2 times: the next one below counts, or else the first"}


def test_where_the_tool_is():
    """Corrector 1 is 80 long, the tool 30, the work offset (10, 20, 5): on the machine Z is 5 + 2 + 80."""
    text = "T1 M6\nG55 G43 D1 G0 X1 Y2 Z2\n#101=#5001\n#102=#5003\n#103=#5021\n#104=#5023\n#105=#5043\n#106=#5220\n#107=#4014\n"
    setup = Setup(tools={1: mnclab.Tool(radius=4, length=30)}, correctors={1: (0, 0, 80)}, datums={2: (10, 20, 5)})
    found = mnclab.run(text + "#108=#4001\n#109=#4008\n#110=#5410\n#111=#4120\n", "g43", setup).variables
    expected = {101: 1, 102: 2, 103: 11, 104: 87, 105: 82, 106: 2, 107: 55, 108: 0, 109: 43, 110: 8, 111: 1}
    assert {int(name[1:]): number for name, number in found.items()} == expected


def test_positions_and_offsets_in_inches():
    found = run("G20\nG0 X2\n#5221=1\n#1=#5001\n#2=#5021\n#3=#5221\nG0 X0\n#4=#4006\n")
    assert found.toolpath.end[:, 0].tolist() == [50.8, 25.4]
    assert found.variables == {"#1": 1, "#2": 2, "#3": 1, "#4": 20}
    assert found.tables.datums[1].x == 25.4


def test_stop_with_a_message():
    found = run("G0 X1\n#3006=1 (TURN THE PART)\nG0 X2\n")
    assert [row.kind.name for row in found.toolpath] == ["RAPID", "STOP", "RAPID"]
    assert "TURN THE PART" in found.alarms[0].message and found.ok


def test_an_explanation_has_the_values_of_formulas():
    told = str(run("#1=4\nG0 X[#1*2.5] Y#2\n").explain(2))
    assert "X[#1*2.5]" in told and "= 10" in told


@pytest.mark.parametrize("dialect", ["fanuc", "linuxcnc"])
def test_a_loop_without_an_end_says_its_bound_and_counts_formulas(dialect):
    """A block with a formula counts as two: of 1000 that are allowed half or a few more are obeyed."""
    text = "#1=0\nN5 #1=[#1+1+SIN[#1]]\n#2=[#1*2]\nIF[#1 GE 0]GOTO5\nM30\n"
    if dialect == "linuxcnc":
        text = "#1=0\no1 while [#1 GE 0]\n#1=[#1+1+SIN[#1]]\n#2=[#1*2]\no1 endwhile\nM2\n"
    run = mnclab.run(text, "g43", mnclab.Setup(settings={"dialect": dialect, "most_blocks": 1000}))
    assert "ran as much work as 1000 blocks without an end" in run.alarms[0].message
    assert "most_blocks" in run.alarms[0].hint and 400 < len(run.steps.block) < 700
    plain = mnclab.run("#1=0\n" * 3000 + "M30\n", "g43", mnclab.Setup(settings={"most_blocks": 1000}))
    assert plain.ok and len(plain.steps.block) == 3001
