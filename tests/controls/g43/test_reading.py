"""How programs of the ISO mill are written: tapes, numbers, comments, block skip, spellings, corners."""

import math
from functools import partial

import numpy as np
from tools import running

import mnclab

run = partial(running.run, control="g43")
LINE = [[1, 0, 0], [1, -2.5, 0]]


def test_spellings_of_the_same_two_moves():
    spellings = [
        "G0 X1\nG1 Y-2.5 F100\n", "%\nO0001 (PLATE)\nG0 X1\nG1 Y-2.5 F100\nM30\n%\n", "g0x1.\ng1y-2.5f100\n",
        ":1 (plate)\nN10 G00 X+1.\nN20 G01 Y-02.50 F100.\n", "%\r\nO1\r\nG0X1;\r\nG1Y-2.5F100;\r\nM30;\r\n%",
        "(a comment) G0 (in the middle) X1 (and after)\nG1 Y-2.5 (feed) F100\n", "G0 X1 ; far\n;\n( )\n()\nG1 Y-2.5 F100\n",
        "#1=1\nG0 X#1\nG#1 Y-[#1*2.5] F[200/2]\n", "N1 #1=-2.5\nN2 G0 X1\nN3 IF [#1 LT 0] THEN #2=#1\nG1 Y#2 F100\n",
        "\0\0\0%\nG0 X1\nG1 Y-2.5 F100\n%\0\0", "G0 X1\r\nG1 Y-2.5 F100\r\n\x1a", "G0 X1\nG1 Y-2.5 F100\x1a\x1a\0",
        "\ufeff%\nG0X 1\nG1Y- 2.5F100\n", "G0X + 1.\nG1 Y -\t2.5 F100\n", "N0 G0 X1\nN0 G1 Y-2.5 F100\n",
    ]  # fmt: skip
    for text in spellings:
        assert run(text).toolpath.end.tolist() == LINE, text


def test_numbers_of_blocks_may_return():
    """Long programs begin their numbers anew; nothing jumps to them."""
    assert not run("N10 G0 X1\nN20 X2\nN10 X3\n").alarms


def test_what_stands_after_the_tape_is_named():
    found = run("%\nG0 X1\n%\n\n G0 X2\n")
    assert found.toolpath.end.tolist() == [[1, 0, 0]]
    assert [(alarm.message, alarm.span[:2]) for alarm in found.alarms] == [("what stands after the last % is not obeyed", (5, 2))]
    assert not run("(made by hand)\n%\nG0 X1\n%\n\n\0\0").alarms


def test_an_end_of_text_in_the_middle_is_a_fault():
    assert run("G0 X1\x1a\nG1 Y2 F100\n", ok=None).alarms[0].span[:2] == (1, 6)


def test_words_after_a_semicolon_are_named():
    assert run("G0 X1; G1 Y2\n").alarms[0].message == "what stands after ';' is taken for a comment"
    assert not run("G0 X1; 3 holes\nG0 X2 ; X\n").alarms


def test_block_skip_by_switches():
    text = "G0 X1\n/G0 X2\n/2 G0 X3\nN5 /3 G0 X4\n/ 3 G0 X5\n"
    taken = partial(lambda **settings: run(text, **settings).toolpath.end[:, 0].tolist())
    assert taken() == [1, 2, 3, 4, 5]
    assert taken(block_skip=True) == [1]
    assert taken(block_skip=True, skip_switches=13) == [1, 3]
    assert taken(block_skip=True, skip_switches=2) == [1, 2, 4, 5]
    assert [block.skip for block in mnclab.read(text, "g43")] == [0, 1, 2, 3, 3]


def test_corners():
    """A rounding of 2 touches 2 before the corner; a chamfer of 1 is 1 along each line; on the last corner an angle of 45."""
    found = run("G1 F100 X10 ,R2\nY10 ,C1\nX0\n")
    assert found.toolpath.end.tolist() == [[8, 0, 0], [10, 2, 0], [10, 9, 0], [9, 10, 0], [0, 10, 0]]
    assert found.toolpath[1].sweep == math.pi / 2 and found.toolpath[1].centre.tolist() == [8, 2, 0]
    inch = run("G20 G1 F10 X1,R.25\nY1\n")
    assert np.allclose(inch.toolpath.end / 25.4, [[0.75, 0, 0], [1, 0.25, 0], [1, 1, 0]], atol=1e-12)


def test_comments_are_told_without_their_brackets():
    program = mnclab.read("(a line)\nG0 (at rapid) X1 (and) (more)\nG1 Y2 F100; far\n", "g43")
    assert [block.comment for block in program] == ["a line", "at rapid and more", "far"]
    assert [" ".join(program.code_of(k)[0].split()) for k in range(3)] == ["", "G0 X1", "G1 Y2 F100"]


def test_a_long_program_with_comments():
    """Comments and blank lines among many plain blocks change nothing but the lines of the rows."""
    lines = [f"N{k} G1 X{math.sin(k):.4f} Y{math.cos(k):.4f} F100" for k in range(1, 3000)]
    told = [line if k % 100 else f"(part {k})\n{line}" for k, line in enumerate(lines)]
    plain, commented = run("\n".join(lines)), run("%\nO1\n" + "\n".join(told) + "\nM30\n%\n")
    assert np.array_equal(plain.toolpath.end, commented.toolpath.end)
    slow = run("%\nO1\n" + "\n".join(told) + "\nM30\n%\n", bulk=False)
    assert np.array_equal(slow.toolpath.line, commented.toolpath.line) and np.array_equal(slow.toolpath.end, plain.toolpath.end)
