"""What a run gives out: arrays that nobody can write to, and a result that can be copied and sent to another process."""

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import mnclab
from mnclab import Setup, Tool, Toolpath
from mnclab.path.toolpath import COLUMNS
from mnclab.workpiece.part import ball, box, contact, cylinder, plane

TNC = """0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 L X+0 Y+0 Z+10 R0 FMAX M3
3 Q1 = 5 + 3
4 CYCL DEF 200 DRILLING ~
  Q200=2 Q201=-15 Q206=120 Q202=5 Q210=0 Q203=0 Q204=20 Q211=0
5 L X+Q1 Y+3 R0 FMAX M99
6 APPR LT X+20 Y+20 LEN15 RL F100
7 L X+40
8 RND R3
9 L Y+60
10 DEP LT LEN10
11 L Z+50 R0 FMAX K5
12 END PGM A MM
"""
PROGRAMS = {
    "mnc": "T1 S500 M3\nG90 G54\nG0 X0 Y0 Z5\nG41 G1 X10 F100\nG3 X20 Y10 I10 J0\nG40 X40\nG83 X20 Y10 Z-30 R2 K5 F120\n",
    "tnc-620": TNC,
    "g43": "T2 M6\nG43 G0 X0 Y0 Z20 S1000 M3\nG81 X5 Y5 Z-10 R2 F100\nG80\n",
    "nc-31": "S800\nM3\nF20\nX4000 ~ *\nZ200 ~\nZ-1000\n",
    "jnc-t01": "G90 G94 F100\nT1 S800 M3\nG0 X40 Z5\nG1 Z-20\n",
}
PART = (plane((0, 0, 0), (0, 0, 1)) | box((0, 0, 0), (9, 9, 9)) - ball((5, 5, 9), 3)) & cylinder(
    (0, 0, -9), (0, 0, 9), 9
)
SETUP = Setup(datums={1: (1, 2, 3)}, part=PART.placed(np.eye(4)))


@pytest.fixture(scope="module", params=PROGRAMS)
def run(request):
    return mnclab.run(PROGRAMS[request.param], request.param, SETUP)


def columns_of(path: Toolpath):
    return {name: getattr(path, name) for name in COLUMNS}


def assert_same(one, other):
    for left, right in ((one.toolpath, other.toolpath), (one.programmed, other.programmed)):
        for name, column in columns_of(left).items():
            assert np.array_equal(column, getattr(right, name), equal_nan=column.dtype.kind == "f"), name
        assert (str(left), left.labels, left.origin.tolist()) == (str(right), right.labels, right.origin.tolist())
    assert [str(alarm) for alarm in one.alarms] == [str(alarm) for alarm in other.alarms] and one.ok == other.ok
    assert one.variables == other.variables and one.settings == other.settings
    assert one.program.text == other.program.text and one.control is other.control
    last = len(one.steps.block) - 1
    assert one.at(step=last) == other.at(step=last) and one.profile().time == other.profile().time
    assert one._repr_html_() == other._repr_html_()


def test_no_array_can_be_overwritten(run):
    profile, path = run.profile(), run.toolpath
    given = [*columns_of(path).values(), *columns_of(run.programmed).values(), *columns_of(path[1:3]).values()]
    given += [*path.columns().values(), path.lengths, path.origin, *run.steps, *profile.columns().values()]
    given += [profile.t, profile.s, profile.v, profile.seconds, profile.starts, *(frame for _, frame in run.frames)]
    given += [value for value in vars(run.program).values() if isinstance(value, np.ndarray)]
    assert not [array for array in given if array.flags.writeable]
    with pytest.raises(ValueError, match="read-only"):
        path.end[0] = 5


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda run: pickle.loads(pickle.dumps(run))])
def test_a_run_can_be_copied(run, again):
    assert_same(run, again(run))
    path = again(run.toolpath)
    assert not any(column.flags.writeable for column in columns_of(path).values())
    for thing in (run.program, run.setup, run.control, run.history, run.steps, run.profile(), *run.alarms):
        again(thing)


def test_a_constant_column_costs_nothing_in_a_pickle():
    text = "G90 F100\n" + "".join(f"G1 X{k % 7} Y{k % 5}\n" for k in range(20_000))
    path = mnclab.run(text, "mnc").toolpath
    size, back = len(pickle.dumps(path)), pickle.loads(pickle.dumps(path))
    assert (
        size < 20_000 * 80 and back.axis.strides[0] == 0 and len(back) == len(path)
    )  # two points and more; all are 300


def test_a_process_pool_returns_runs():
    with ProcessPoolExecutor(1) as pool:
        waiting = {control: pool.submit(mnclab.run, text, control, SETUP) for control, text in PROGRAMS.items()}
        for control, future in waiting.items():
            assert_same(mnclab.run(PROGRAMS[control], control, SETUP), future.result())


def test_an_alarm_keeps_its_place():
    (alarm,) = mnclab.run("G0 X5\nG1 X6\n", "mnc").alarms
    for again in (copy.copy(alarm), copy.deepcopy(alarm), pickle.loads(pickle.dumps(alarm))):
        assert str(again) == str(alarm) and "^" in str(again) and again.as_dict() == alarm.as_dict()


def test_a_part_is_the_same_after_its_way():
    again = pickle.loads(pickle.dumps(SETUP.part))
    points = np.random.default_rng(3).uniform(-12, 12, (200, 3))
    assert np.array_equal(again(points), SETUP.part(points))
    assert contact(again, (3, 3, 20), (0, 0, -1), 1, 30) == contact(SETUP.part, (3, 3, 20), (0, 0, -1), 1, 30)


TABLES = {"tools": Tool(radius=9), "datums": (1, 2, 3), "presets": (1, 2, 3), "correctors": (1, 2, 3)}
GIVEN = TABLES | {"files": "G0 X1\n", "settings": True, "variables": 5.0}


@pytest.mark.parametrize("name", GIVEN)
def test_a_run_keeps_its_setup(name):
    key, value = 1 if name in TABLES else "block_skip", GIVEN[name]
    setup = Setup(**{name: {key: value}})
    run = mnclab.run("G0 X1\n", "mnc", setup)
    getattr(setup, name)[key] = None
    getattr(setup, name)["more"] = None
    for each in (run, copy.deepcopy(run), pickle.loads(pickle.dumps(run))):
        assert dict(getattr(each.setup, name)) == {key: value}
        with pytest.raises(TypeError):
            getattr(each.setup, name)[key] = value
    getattr(copy.deepcopy(run.setup.with_settings()), name)[key] = value  # a setup of one's own can be written to


def test_numbers_in_lists_are_kept_too():
    row, corner = [1, 2, 3], [0.0, 0.0, -5.0]
    setup = Setup(datums={1: row}, stock=(corner, [9, 9, 0]), limits=mnclab.Limits(rapid=row))
    run = mnclab.run("G0 X1\n", "mnc", setup)
    row[0] = corner[0] = -77
    assert run.setup.datums[1] == (1, 2, 3) and run.stock.low[0] == 0 and run.setup.limits.rapid == (1, 2, 3)


def test_tools_stay_what_they_are_in_every_later_run():
    run = mnclab.run("T1\nG0 X1\n", "mnc")
    run.tables.tools[1] = Tool(radius=77)
    assert mnclab.run("T1\nG0 X1\n", "mnc").tables.tools[1].radius == 5
