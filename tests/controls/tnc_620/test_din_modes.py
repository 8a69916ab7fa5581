"""What is modal in DIN/ISO programs follows the way that leads to a block, not the text above it; see `reading.din_modes`."""

from __future__ import annotations

import pytest

import mnclab as mnc


@pytest.fixture
def din(tnc):
    """Run blocks behind `%A G71` and M3 of tool 1; they begin in line 3. Ends of the moves, and what is told."""

    def run(blocks: str, **files: str) -> tuple[list[list[float]], list[tuple[str, int, str]]]:
        setup = mnc.Setup(files=files)
        text = f"%A G71 *\nT1 G17 S1000 F100 M3 *\n{blocks}\nN99999999 %A G71 *\n"
        found = tnc(text, setup)
        told = [(alarm.severity, alarm.span.line, alarm.message) for alarm in found.alarms]
        return [end[:2] for end in found.toolpath.motion.end.tolist()], told

    return run


SUB = "M2*\nG98 L1*\nY+5*\nG98 L0*"


def test_a_subprogram_goes_on_with_what_holds_where_it_is_called(din) -> None:
    assert din(f"G01 X+1*\nL1*\nX+2*\nL1*\n{SUB}") == ([[1, 0], [1, 5], [2, 5]], [])
    ends, _ = din(f"G91 G01 X+1*\nL1*\nX+2*\nL1*\n{SUB}")
    assert ends == [[1, 0], [1, 5], [3, 5], [3, 10]]


def test_what_stands_behind_the_last_call_does_not_count_in_the_subprogram(din) -> None:
    """G00 stands above the label, but G01 holds where it is called; that the two differ is told."""
    ends, told = din(f"G01 X+1*\nL1*\nG00 X+2*\n{SUB}")
    assert ends == [[1, 0], [1, 5], [2, 5]]
    left = "Y+5 is read with G01, which the call or repeat before it leaves, although G00 stands above"
    assert told == [("warning", 8, left)]


def test_what_a_subprogram_leaves_holds_behind_its_call(din) -> None:
    ends, told = din("G01 X+1*\nL1*\nX+2*\nM2*\nG98 L1*\nG91 Y+5*\nG98 L0*")
    assert ends == [[1, 0], [1, 5], [3, 5]]
    left = "X+2 is read with G91, which the call or repeat before it leaves, although G90 stands above"
    assert told == [("warning", 5, left)]


def test_a_subprogram_that_ends_as_it_began_leaves_nothing(din) -> None:
    assert din("G01 X+1*\nL1*\nX+2*\nM2*\nG98 L1*\nG91 Y+5*\nX-1 G90*\nG98 L0*") == ([[1, 0], [1, 5], [0, 5], [2, 5]], [])


def test_calls_inside_calls(din) -> None:
    """L2 calls L1, which ends in G91, and sets G90 behind it."""
    blocks = "G01 X+1*\nL2*\nX+4*\nM2*\nG98 L1*\nG91 Y+5*\nG98 L0*\nG98 L2*\nL1*\nG90*\nG98 L0*"
    assert din(blocks) == ([[1, 0], [1, 5], [4, 5]], [])


@pytest.mark.parametrize(
    ("blocks", "line", "message"),
    [
        (f"G00 X+1*\nL1*\nG01 X+2*\nL1*\n{SUB}", 9, "Y+5 has no certain path function"),
        (f"G01 X+1*\nL1*\nG91 X+2*\nL1*\n{SUB}", 9, "Y+5 could be absolute or incremental"),
        ("G01 X+1*\nG98 L1*\nX+2*\nG91 Y+1*\nL1,2*", 5, "X+2 could be absolute or incremental"),
        ("G01 X+1*\nG98 L1*\nX+2*\nG91 Y+1*\nD09 P01 +0 P02 +1 P03 1*", 5, "X+2 could be absolute or incremental"),
        ("G01*\n/G91*\nX+1*", 5, "X+1 could be absolute or incremental"),
        ("G00 X+9*\nG02 I+0 J+0 X+9*\n/G03 X+9*\nG05 X+9*", 6, "G05 needs the sense of rotation of an arc before it"),
        ('QS1 = "A"*\nG01 X+1*\nL QS1*\nX+2*\nM2*\nG98 L"A"*\nG91 Y+1*\nG98 L0*', 6, "X+2 could be absolute or incremental"),
    ],
)
def test_where_two_ways_bring_different_values_the_block_must_say_it(din, blocks: str, line: int, message: str) -> None:
    _, told = din(blocks)
    found = [(at, text) for severity, at, text in told if severity == "alarm"]
    assert [at for at, _ in found] == [line] and found[0][1].startswith(message)


@pytest.mark.parametrize(
    ("blocks", "ends"),
    [
        (f"G00 X+1*\nL1*\nG01 X+2*\nL1*\n{SUB.replace('Y+5', 'G01 Y+5')}", [[1, 0], [1, 5], [2, 5]]),
        ("G01 X+1*\nG98 L1*\nG90 X+2*\nG91 Y+1*\nL1,2*", [[1, 0], [2, 0], [2, 1], [2, 2], [2, 3]]),
        ("/G90*\nG01 X+1*", [[1, 0]]),
    ],
)
def test_there_it_may_say_it(din, blocks: str, ends: list[list[float]]) -> None:
    assert din(blocks) == (ends, [])


def test_behind_another_program_a_mode_is_taken_to_hold_and_told(din) -> None:
    files = {"B.I": "%B G71*\nG91 G00 X+5*\nN9 %B G71*\n", "C.H": "BEGIN PGM C MM\nL IX+5 FMAX\nEND PGM C MM\n"}
    ends, told = din("G01 X+1*\n%B*\nX+2*\nX+3*", **files)
    assert ends == [[1, 0], [6, 0], [2, 0], [3, 0]]
    assert told == [("warning", 5, "X+2 is read with G90 as before %B")]
    assert din("G01 X+1*\n%B*\nG90 X+2*\n%C.H*\nX+3*", **files) == ([[1, 0], [6, 0], [2, 0], [7, 0], [3, 0]], [])


def test_a_block_that_nothing_reaches_is_read_with_what_stands_above(din) -> None:
    assert din("G01 X+1*\nM2*\nX+2*") == ([[1, 0]], [])


def test_many_labels_are_followed_in_time(din) -> None:
    """A chain of 300 subprograms, each called by the one below it: the rounds are bounded, and what is left is unknown."""
    chain = "".join(f"G98 L{k}*\nL{k - 1}*\nG98 L0*\n" for k in range(2, 300))
    _, told = din(f"G01 X+1*\nL299*\nX+2*\nM2*\nG98 L1*\nG91 Y+1*\nG98 L0*\n{chain}")
    assert told[0][:2] == ("alarm", 5) or "nest" in told[-1][2]


@pytest.mark.parametrize(
    ("block", "hint"),
    [
        ("G43.4 H1", "write M128"), ("G38.2 Z-5", "write G55, the probing of a point"), ("G68.2", "write G80, the working plane"),
        ("g05.1 Q1", "leave it out"), ("G83.1", ""),
    ],
)  # fmt: skip
def test_a_function_with_a_fraction_is_one_of_another_control(block: str, hint: str) -> None:
    """What stands for it here: M128 (using the cycles, TCPM), cycle 0 is G55 and cycle 19 G80 (list of the cycles)."""
    (alarm,) = mnc.run(f"%A G71 *\nT1 G17 S1000 F100 M3 *\n{block} *\nN99999999 %A G71 *\n", "tnc-620").alarms
    code = block.split()[0]
    assert alarm.message == f"{code.upper()} is no G function of DIN/ISO programs: their numbers are whole"
    assert alarm.hint == hint and (alarm.span.line, alarm.span.column, alarm.span.length) == (3, 1, len(code))
