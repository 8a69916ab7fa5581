"""Other programs: CALL PGM, SEL PGM, cycle 12; where they are found, what they share, what their alarms say."""

from __future__ import annotations

from pathlib import Path

import pytest

import mnclab as mnc

HOLE = "0 BEGIN PGM HOLE MM\n1 L IZ-5 R0 F50\n2 L IZ+5 R0 F500\n3 END PGM HOLE MM\n"


@pytest.fixture
def calling(inside):
    """Run blocks with other programs beside them: names -> blocks inside BEGIN PGM and END PGM, from line 2 on."""

    def run(blocks: str, settings: dict[str, object] | None = None, **programs: str) -> mnc.Run:
        files = {name: f"0 BEGIN PGM {name} MM\n{text}\n99 END PGM {name} MM\n" for name, text in programs.items()}
        return inside(blocks, mnc.Setup(files=files, settings=settings or {}))

    return run


def places(run: mnc.Run) -> list[list[float]]:
    return run.toolpath.motion.end.tolist()


def test_a_program_runs_where_it_is_called_and_comes_back(calling) -> None:
    run = calling("2 L X+1\n3 CALL PGM SUB\n4 L X+3", SUB="1 L Y+2\n2 L Z+2")
    assert run.ok, run.alarms
    assert places(run) == [[1, 0, 0], [1, 2, 0], [1, 2, 2], [3, 2, 2]]
    assert run.toolpath.motion.program.tolist() == [0, 1, 1, 0] and run.toolpath.motion.line.tolist() == [3, 2, 3, 5]
    assert [program.name for program in run.programs] == ["program", "SUB"]
    assert run.steps.program.tolist() == [0] * 4 + [1] * 4 + [0] * 2
    assert [line for line in run.lines().tolist()] == [1, 2, 3, 4, 1, 2, 3, 4, 5, 6]


def test_a_moment_and_its_explanation_are_of_the_program_that_ran(calling) -> None:
    run = calling("2 Q1 = 5\n3 CALL PGM SUB", SUB="1 L Y+Q1")
    moment = run.at(line=2, program=1)
    assert str(moment.block) == "1 L Y+Q1" and moment.position == (0, 5, 0)
    assert run.at(line=2).block.keyword == "TOOL CALL"
    assert moment.block.span.program == 1
    explained = str(run.explain(step=moment.step))
    assert explained.startswith("line 2, block 1: 1 L Y+Q1") and "= 5" in explained
    assert [m.block.keyword for m in run.when("y > 2")] == ["L"]
    assert [move.split()[0] for move in str(run.toolpath).splitlines()] == ["2", "1:2"]


def test_q_parameters_are_shared_and_ql_are_not(calling) -> None:
    run = calling("2 Q1 = 5\n3 QL1 = 6\n4 CALL PGM SUB\n5 L X+Q1 Y+QL1", SUB="1 Q1 = Q1 + 1\n2 QL1 = 40\n3 QR1 = QL1")
    assert run.ok and places(run) == [[6, 6, 0]] and run.variables == {"Q1": 6, "QL1": 6, "QR1": 40}
    assert run.history["QL1"][3:] == [6, None, None, None, 40, 40, 6, 6, 6]  # it is away from the call to the END PGM
    (alarm,) = calling("2 QL1 = 6\n3 CALL PGM SUB", SUB="1 L X+QL1").alarms
    assert alarm.message == "no value was given to QL1"


def test_labels_belong_to_their_program(calling) -> None:
    run = calling(
        "2 CALL LBL 1\n3 CALL PGM SUB\n4 CALL LBL 1\n5 M2\n6 LBL 1\n7 L IX+1\n8 LBL 0",
        SUB="1 CALL LBL 1\n2 FN 9: IF +0 EQU +0 GOTO LBL 2\n3 LBL 1\n4 L IY+10\n5 LBL 0\n6 LBL 2",
    )
    assert run.ok, run.alarms
    assert places(run)[-1] == [2, 10, 0]


def test_a_program_called_in_a_subprogram_and_in_a_repeat(calling) -> None:
    """2 rounds, each with the subprogram twice and each of those with the program once, which steps 3 times."""
    run = calling(
        "2 LBL 1\n3 CALL LBL 2\n4 CALL LBL 2\n5 CALL LBL 1 REP 1\n6 M2\n7 LBL 2\n8 CALL PGM SUB\n9 LBL 0",
        SUB="1 LBL 1\n2 L IX+1\n3 CALL LBL 1 REP 2",
    )
    assert places(run)[-1] == [12, 0, 0] and len(run.programs) == 2


def test_programs_call_programs(calling) -> None:
    run = calling("2 CALL PGM A1\n3 L Z+1", A1="1 L X+1\n2 CALL PGM A2\n3 L X+3", A2="1 L Y+2")
    assert places(run) == [[1, 0, 0], [1, 2, 0], [3, 2, 0], [3, 2, 1]]
    assert run.toolpath.motion.program.tolist() == [1, 2, 1, 0]


def test_a_chosen_program(calling) -> None:
    run = calling(
        '2 SEL PGM "SUB"\n3 CALL SELECTED PGM\n4 QS1 = "OTHER.H"\n5 SEL PGM QS1\n6 CALL SELECTED PGM\n7 CALL SELECTED PGM',
        SUB="1 L IX+1", OTHER="1 L IY+1",
    )  # fmt: skip
    assert run.ok and places(run) == [[1, 0, 0], [1, 1, 0], [1, 2, 0]]


def test_a_called_program_in_inches(inside) -> None:
    """Its lengths and those that it takes from parameters are inches; afterwards they are mm again."""
    files = {"S": "0 BEGIN PGM S INCH\n1 L X+1 F10\n2 L Y+Q1\n3 END PGM S INCH\n"}
    run = inside("2 Q1 = 2\n3 CALL PGM S\n4 L X+Q1", mnc.Setup(files=files))
    assert run.ok, run.alarms
    assert places(run) == [[25.4, 0, 0], [25.4, 50.8, 0], [2, 50.8, 0]]


# --- cycle 12 -----------------------------------------------------------------------------------------------------------


def test_a_program_as_a_cycle_where_m99_stands(inside) -> None:
    """12.3: rapid to X20 Y50, then the program once there; its line break is repaired."""
    blocks = "55 CYCL DEF 12.0 PGM CALL\n56 CYCL DEF 12.1 PGM TNC:\\KLAR35\\FK1\\50.H\n57 L X+20 Y+50 FMAX M99"
    for name in ("TNC:\\KLAR35\\FK1\\50.H", "tnc:/klar35/fk1/50.h", "50.H", "50"):
        run = inside("3 M3\n" + blocks, mnc.Setup(files={name: HOLE}))
        assert run.ok and not run.alarms, run.alarms
        assert places(run) == [[20, 50, 0], [20, 50, -5], [20, 50, 0]]
        assert [move.kind.name for move in run.toolpath.motion] == ["RAPID", "LINE", "LINE"]
        assert {run.toolpath.labels[k] for k in run.toolpath.label} == {""}


def test_the_program_of_a_cycle_runs_at_each_call(calling) -> None:
    run = calling(
        "2 CYCL DEF 12.0 PGM CALL\n3 CYCL DEF 12.1 PGM SUB\n4 L X+1 M3\n5 CYCL CALL\n6 L X+2 M99\n7 L X+3 M99",
        SUB="1 L IY+1",
    )
    assert run.ok and places(run) == [[1, 0, 0], [1, 1, 0], [2, 1, 0], [2, 2, 0], [3, 2, 0], [3, 3, 0]]


def test_a_cycle_defined_in_a_called_program_is_called_after_it(calling) -> None:
    """Its faults stand in the program that defines it."""
    drill = "1 CYCL DEF 200 D\nQ200=2\nQ201={}\nQ206=250\nQ202=5\nQ210=0\nQ203=0\nQ204=20\nQ211=0"
    run = calling("2 L Z+50 M3\n3 CALL PGM SUB\n4 L X+5 M99", SUB=drill.format(-5))
    assert run.ok and run.toolpath.end[:, 2].min() == -5
    (alarm,) = calling("2 L Z+50 M3\n3 CALL PGM SUB\n4 L X+5 M99", SUB=drill.format(5)).alarms
    assert (alarm.span.program, alarm.span[:2], alarm.place) == (1, (4, 1), "SUB:4:1")


# --- where they are found -----------------------------------------------------------------------------------------------


def test_a_program_beside_the_running_file(tmp_path: Path) -> None:
    """Without regard to case and type; the folder is that of the calling program."""
    (tmp_path / "deeper").mkdir()
    main = tmp_path / "main.h"
    main.write_text("0 BEGIN PGM MAIN MM\n1 TOOL CALL 1 Z F100\n2 CALL PGM Sub\n3 CALL PGM FAR\n4 END PGM MAIN MM\n")
    (tmp_path / "SUB.H").write_text("0 BEGIN PGM SUB MM\n1 L X+1\n2 END PGM SUB MM\n")
    (tmp_path / "deeper" / "far.h").write_text("0 BEGIN PGM FAR MM\n1 CALL PGM NEXT\n2 END PGM FAR MM\n")
    (tmp_path / "deeper" / "next.h").write_text("0 BEGIN PGM NEXT MM\n1 L Y+Q5\n2 END PGM NEXT MM\n")
    run = mnc.run(main, setup=mnc.Setup(files={"FAR": tmp_path / "deeper" / "far.h"}))
    (alarm,) = run.alarms
    assert alarm.place == f"{tmp_path / 'deeper' / 'next.h'}:2:7" and places(run) == [[1, 0, 0]]
    assert [Path(program.name).name for program in run.programs] == ["main.h", "SUB.H", "far.h", "next.h"]


def test_a_text_has_no_folder(tnc, tmp_path: Path, monkeypatch) -> None:
    (tmp_path / "sub.h").write_text(HOLE)
    monkeypatch.chdir(tmp_path)
    (alarm,) = tnc("0 BEGIN PGM A MM\n1 CALL PGM SUB\n2 END PGM A MM\n").alarms
    assert (alarm.message, alarm.span[:2]) == ("CALL PGM SUB: there is no program of this name", (2, 12))


def test_a_program_is_read_once(calling, monkeypatch) -> None:
    from mnclab.controls.tnc_620.control import CONTROL

    read = []
    monkeypatch.setattr(
        type(CONTROL),
        "read",
        property(lambda self: lambda text, name: read.append(name) or reader(text, name)),
        raising=False,
    )
    reader = CONTROL.__dict__["read"]
    run = calling("2 LBL 1\n3 CALL PGM SUB\n4 CALL LBL 1 REP 9", SUB="1 L IX+1")
    assert places(run)[-1] == [10, 0, 0] and read.count("SUB") == 1


# --- what is wrong ------------------------------------------------------------------------------------------------------


def test_an_alarm_carries_the_name_of_its_program(calling) -> None:
    run = calling("2 CALL PGM SUB", SUB="1 L X+1\n2 L X=5")
    (alarm,) = run.alarms
    assert alarm.span == mnc.run("L X=5\n", "tnc-620").alarms[0].span._replace(line=3, column=5, program=1)
    assert str(alarm).splitlines()[:2] == [
        "SUB:3:5: alarm: X needs a number, found '=' (no = between an address and its number)",
        "    2 L X=5",
    ]
    assert places(run) == [[1, 0, 0]]


def test_a_fault_found_in_a_pass_stands_in_the_called_program(calling) -> None:
    (alarm,) = calling("2 L X+10\n3 CALL PGM SUB", SUB="1 L Y+4\n2 RND R5\n3 L X+4").alarms
    assert alarm.place == "SUB:3:1" and "a rounding of R5 does not fit" in alarm.message


def test_warnings_of_a_called_program(calling) -> None:
    run = calling("2 CALL PGM SUB\n3 L X+5", SUB="1 END PGM OTHER MM")
    assert run.ok and [(a.place, a.message) for a in run.alarms] == [
        ("SUB:2:11", "END PGM names OTHER, BEGIN PGM SUB"), ("SUB:3:1", "nothing after END PGM is obeyed"),
    ]  # fmt: skip
    assert places(run) == [[5, 0, 0]]


def test_rings_of_programs_are_refused(calling) -> None:
    run = calling("2 CALL PGM A1", A1="1 L X+1\n2 CALL PGM A2", A2="1 CALL PGM A1")
    (alarm,) = run.alarms
    assert alarm.place == "A2:2:12"
    assert alarm.message == "A1 is running already: a program cannot call itself, nor one that calls it"


def test_a_file_that_calls_itself(tmp_path: Path) -> None:
    main = tmp_path / "main.h"
    main.write_text("0 BEGIN PGM MAIN MM\n1 CALL PGM MAIN\n2 END PGM MAIN MM\n")
    (alarm,) = mnc.run(main).alarms
    assert "is running already" in alarm.message and alarm.span[:2] == (2, 12)


def test_both_tiers_agree_in_a_called_program(calling) -> None:
    plain = "\n".join(f"{k} L X+{k} Y+{k % 7}" for k in range(10, 110))
    runs = [
        calling(f"2 CALL PGM SUB\n{plain}\n3 CALL PGM SUB\n4 L Z+1", {"bulk": bulk}, SUB=plain)
        for bulk in (True, False)
    ]
    one, other = runs
    assert one.ok and str(one.toolpath) == str(other.toolpath)
    assert one.steps.block.tolist() == other.steps.block.tolist()
    assert one.steps.program.tolist() == other.steps.program.tolist()
    assert one.toolpath.program.tolist() == other.toolpath.program.tolist()


def test_the_sample_of_an_ellipse() -> None:
    """Four rounds of 72 lines; every point is on the ellipse, and each round ends where it began."""
    run = mnc.run(Path(__file__).parents[3] / "data/programs/tnc-620/ellipse.h")
    assert run.ok and not run.alarms, run.alarms
    rounds = run.toolpath[run.toolpath.program == 1]
    x, y, z = rounds.end.T
    assert len(rounds) == 4 * 72 and sorted(set(z)) == [-8, -6, -4, -2]
    assert ((x / 40) ** 2 + (y / 25) ** 2).tolist() == pytest.approx([1] * len(x))
    assert rounds.end[71::72, :2].ravel().tolist() == pytest.approx([40, 0] * 4, abs=1e-9)
