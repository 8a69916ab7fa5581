"""Cycle 450: what is saved comes back, in the same program and from a file; the log and the table as people read them."""

import tomllib

import pytest
from controls.tnc_620.spheres import BALL, LENGTH, SPHERE, cycle, definition, measured, sphere_setup

from mnclab import Axis, Kinematics

RAW = Kinematics(
    head=(Axis("B", centre=(0.1, -1 / 3, 180.0), limits=(-30, 110)),),
    table=(Axis("C", centre=(1e-7, 2 / 3, 12.3456789), direction=(1e-4, 2e-4, 1), home=30),),
    title='head "B" and Tisch C', shift=(0.001, 0.0, -0.002),
)  # fmt: skip
TRUE = Kinematics(head=RAW.head, table=(Axis("C", centre=(0.2, 0.5, 0), direction=RAW.table[0].direction),), shift=RAW.shift)


def save(name, mode=0):
    return definition(450, Q410=mode, **({"QS409": f'"{name}"'} if isinstance(name, str) else {"Q409": name}))


def test_what_is_saved_comes_back_from_the_file():
    """To the last digit, with limits and home."""
    files = measured(save("A-HEAD1"), sphere_setup(RAW)).files
    assert set(files) == {"DATA450.KD", "TCHPR450.TXT"}
    other = Kinematics(head=(Axis("B"),), table=(Axis("C"),), title=RAW.title)
    restored = measured(save("A-HEAD1", 1), sphere_setup(other, files=files)).tables.kinematics
    assert restored.shift == RAW.shift
    for axis in RAW.sequence:
        assert (restored.axis(axis.name).centre, restored.axis(axis.name).direction) == (axis.centre, axis.direction)
        assert restored.axis(axis.name).limits == other.axis(axis.name).limits  # no transformation
    table = tomllib.loads(files["DATA450.KD"])["A-HEAD1"]
    assert table["title"] == RAW.title and table["head"][0]["limits"] == [-30, 110] and table["table"][0]["home"] == 30


@pytest.mark.parametrize("name", ["data450.kd", "TNC:\\table\\DATA450.KD", "TNC:/table/Data450.kd"])
def test_the_table_is_found_by_its_name(name, tmp_path):
    """With its folder on the control or without, as a text or as a file."""
    text = measured(save("A"), sphere_setup(RAW)).files["DATA450.KD"]
    (file := tmp_path / "saved.txt").write_text(text, encoding="utf-8")
    for given in (text, file):
        assert "  A: " in measured(save(0, 2), sphere_setup(RAW, files={name: given})).files["TCHPR450.TXT"]


def test_an_optimization_is_undone():
    """Saved, optimized, restored: all in one program, and equal to what it was."""
    believed = Kinematics(table=(Axis("C"),))
    true = Kinematics(table=(Axis("C", centre=(0.2, -0.1, 0)),))
    text = save(5) + cycle(451, {"C": (90, 270, 0, 3)})
    optimized, undone = (measured(each, sphere_setup(believed, true)).tables.kinematics for each in (text, text + save(5, 1)))
    assert optimized != believed == undone
    axes = measured(text + save(5, 1) + "L X+0 Y+0 Z+50 FMAX\n", sphere_setup(believed, true)).axes()
    assert [axes.X[-1], axes.Y[-1], axes.Z[-1]] == pytest.approx([0, 150, SPHERE[2] + 50 + LENGTH], abs=1e-9)


def test_what_is_equal_is_not_written():
    run = measured(save(5) + save(5, 1), sphere_setup(RAW))
    assert "kinematics" not in run.history and run.tables.kinematics == RAW


def test_a_name_that_is_there_is_saved_anew():
    run = measured("".join(save(k) for k in range(16)) + save(7), sphere_setup(RAW))
    assert len(tomllib.loads(run.files["DATA450.KD"])) == 16


def test_the_last_record_takes_the_table_with_it():
    run = measured(save(1) + save(2) + save(1, 3) + save(2, 3), sphere_setup(RAW))
    assert "DATA450.KD" not in run.files and "Deleted records:\n  2: " in run.files["TCHPR450.TXT"]
    again = measured(save(1) + save(1, 3) + save(9), sphere_setup(RAW))
    assert list(tomllib.loads(again.files["DATA450.KD"])) == ["9"]


def test_nothing_is_deleted_that_is_not_confirmed():
    run = measured(save(1) + save("*", 3), sphere_setup(RAW, settings={"delete_confirmed": False}))
    assert list(tomllib.loads(run.files["DATA450.KD"])) == ["1"]
    assert "it was not confirmed" in run.files["TCHPR450.TXT"]


def test_the_records_are_displayed():
    run = measured(save("ONE") + save("TWO") + save(0, 2), sphere_setup(RAW, settings={"clock": 1e9}))
    assert run.files["TCHPR450.TXT"] == run.files["SCREEN:"] == (
        "Log for Probing Cycle 450 Save kinematics\nDate: 09-09-2001\nTime: 1:46:40\nProgram: program\n"
        f"Kinematics: {RAW.title}\nTool: 5 TCH PROBE\nSaved records: 2 of 16\n  ONE: {RAW.title}\n  TWO: {RAW.title}\n"
        "End of log\n"
    )
    assert 'date = "2001-09-09 01:46:40"' in run.files["DATA450.KD"]


def test_the_log_of_saving_tells_every_transformation():
    log = measured(save(947), sphere_setup(RAW)).files["TCHPR450.TXT"]
    assert "Saved as 947:\n  B in the head: centre 0.100000 -0.333333 180.000000 direction 0.000000 1.000000 0.000000\n" in log
    assert "  C in the table: centre 0.000000 0.666667 12.345679 direction 0.000100 0.000200 1.000000\n" in log
    assert "  shift 0.001000 0.000000 -0.002000\n" in log


def test_a_name_may_stand_in_a_parameter():
    run = measured('QS5 = "HEAD 7"\nTCH PROBE 450 X\nQ410=0\nQS409=QS5\n', sphere_setup(RAW))
    assert list(tomllib.loads(run.files["DATA450.KD"])) == ["HEAD 7"]


def test_the_mean_of_two_machines_lies_between():
    one, two = (Kinematics(table=(Axis("C", centre=(x, 0, 0), direction=(x / 100, 0, 1)),), shift=(0, x, 0)) for x in (0.1, 0.3))
    files = {"DATA450.KD": measured(save("H1"), sphere_setup(one)).files["DATA450.KD"]}
    both = measured(save("H2") + save("H#", 1), sphere_setup(two, files=files)).tables.kinematics
    assert both.axis("C").centre == pytest.approx((0.2, 0, 0)) and both.shift == pytest.approx((0, 0.2, 0))
    assert both.axis("C").direction[0] == pytest.approx(0.002, rel=1e-5)
    assert BALL == 2
