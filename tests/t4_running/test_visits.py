"""A visit is repeated as columns only where it leaves the machine as it found it: tried with everything that a machine has."""

import copy

import numpy as np
import pytest

import mnclab
from mnclab.geometry import frames
from mnclab.machine import state
from mnclab.machine.rows import row_state
from mnclab.machine.state import Snapshot
from mnclab.path.recorder import State
from mnclab.path.tool import Tool
from mnclab.running import repeating
from mnclab.running.interpreter import Interpreter
from mnclab.text.alarm import Alarm

POINTS = np.array([(k * k, 7 * k % 5 + 1) for k in range(1, 21)], dtype=float)
#: What may change: where the program stands; and the table of what a block may change, as far as a visit is asked for it.
COMPARED = {"flow", *state.COMPARED[state.PATTERN]}


def new_machine():
    control = mnclab.controls["tnc-620"]
    machine = Interpreter(control, mnclab.Setup(), mnclab.read("BEGIN PGM A MM\nEND PGM A MM\n", "tnc-620")).machine
    machine.change("feed", 100.0)
    machine.change("speed", 500.0)
    machine.change("turning", 1)
    machine.memory.defaults = {"deep": [{"number": 1.0}], "array": np.zeros(3)}
    return machine


def visited(m, alter, points=POINTS):
    """At how many of the points the visit was really made; `alter` gets the number of the visit."""
    made = []

    def go(x, y):
        made.append((x, y))
        m.rapid(x=x, y=y)
        alter(len(made))
        m.line(z=-1)
        m.rapid(z=5)

    repeating.at_each(m, points, go)
    return len(made)


def changed(value, count):
    """Another value of the same kind, each time a new one."""
    if isinstance(value, bool):
        return count % 2 == 1
    if isinstance(value, int | float):
        return count if value != value or abs(value) == np.inf else value + count
    if isinstance(value, str):
        return f"{value} {count}"
    if isinstance(value, tuple):
        return tuple(one + count for one in value)
    if isinstance(value, np.ndarray):
        other = value.copy()
        other[..., -1] += count
        return other
    if isinstance(value, Tool):
        return Tool(radius=count)
    return float(count)


def alteration(m, name):
    """What changes an attribute: put in its place, or into it where it holds other things."""
    value = getattr(m, name)
    if isinstance(value, dict):
        return lambda count: dict.__setitem__(value, "added", str(count))
    if name == "alarms":
        return lambda count: value.append(Alarm("doubtful", severity="warning"))
    if isinstance(value, list):
        return lambda count: value.append(lambda: count)
    if isinstance(value, set):
        return lambda count: value.add(count)
    if name == "memory":
        return lambda count: setattr(value, "preset", count)
    if name == "frames":
        return lambda count: value.set("more", frames.shift(z=1e-9 * count))
    if name == "tables":
        return lambda count: value.tools.update({99: Tool(radius=count)})
    if name == "flow":
        return lambda count: setattr(value, "depth", count)
    return lambda count: setattr(m, name, changed(value, count))


def test_a_visit_that_changes_nothing_is_made_four_times():
    assert visited(new_machine(), lambda count: None) == 4


@pytest.mark.parametrize("name", sorted(COMPARED))
def test_whatever_a_visit_changes_is_seen(name):
    m = new_machine()
    assert visited(m, alteration(m, name)) == len(POINTS)


def test_the_place_and_what_a_visit_makes_are_left_out():
    """The place is moved; the rows are those of the visit; the history and the part are made from them; of an alarm it is
    noted where it stands."""
    assert set(state.TABLE) - COMPARED == {"tip", "programmed", "recorder", "logs", "cut_so_far", "alarms"}


@pytest.mark.parametrize("what", ["a number in the depth", "an array", "a program called", "a row of the datum table"])
def test_values_are_compared_in_their_depth(what):
    m = new_machine()
    other = {
        "a number in the depth": lambda count: m.memory.defaults["deep"][0].update(number=count),
        "an array": lambda count: np.add.at(m.memory.defaults["array"], 1, count),
        "a program called": lambda count: m.flow.begin(0),
        "a row of the datum table": lambda count: m.tables.datums.update({1: (count,)}),
    }

    def alter(count):
        other[what](count)
        m.step = m.flow.begun - 1

    assert visited(m, alter) == len(POINTS)


@pytest.mark.parametrize("name", State._fields)
def test_every_column_that_rows_share_is_compared(name):
    m = new_machine()
    usual = m.recorder.states[row_state(m)]

    def alter(count):
        value = getattr(usual, name)
        shift = tuple(one + count for one in value) if isinstance(value, tuple) else changed(value, count)
        m.row_state = m.recorder.state(usual._replace(**{name: shift})) if count % 2 else m.recorder.state(usual)

    assert visited(m, alter) == len(POINTS)


def labelled(m, label):
    m.label = label
    m.line(z=-2)
    m.label = ""


ROWS = {
    "the way out": lambda m, k: m.rapid(z=-2 - k),
    "a dwell": lambda m, k: m.dwell(k),
    "a feed": lambda m, k: m.line(z=-2, f=100 + k),
    "a label": lambda m, k: labelled(m, f"number {k}"),
    "a place of the machine": lambda m, k: m.line(x=3, y=4),
    "an event": lambda m, k: m.coolant() if k % 2 else None,
}


@pytest.mark.parametrize("what", ROWS)
def test_rows_that_are_others_are_made_one_by_one(what):
    m = new_machine()
    assert visited(m, lambda count: ROWS[what](m, count)) == len(POINTS)


@pytest.mark.parametrize("frame", ["none", "turned", "mirrored", "tilted", "scaled"])
@pytest.mark.parametrize("first", ["over the place before", "beside the place before"])
def test_what_is_done_over_the_place_before_stays_there(frame, first):
    """A visit that first goes down where the last one ended, and ends beside its place: points are not evenly spaced."""
    matrix = {
        "none": np.eye(4), "turned": frames.turn(0.3), "mirrored": frames.mirror("x", (7, 0, 0)),
        "tilted": frames.turn(0.4, "x") @ frames.turn(0.2, "y"), "scaled": frames.scale(2, 0.5, 3),
    }[frame]  # fmt: skip
    paths = []
    for few in (8, 10**9):
        m = new_machine()
        m.set_frame("frame", matrix)

        def go(x, y, m=m):
            m.rapid(z=2)
            m.rapid(x=x, y=y)
            m.line(z=-1)
            m.turn((x, y + 3), 1.0) if frame != "scaled" else m.line(x + 2)
            m.rapid(x=x + (first != "over the place before"), y=y)
            m.rapid(z=50)

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(repeating, "FEWEST", few)
            repeating.at_each(m, POINTS, go)
        paths.append((m.recorder.take(), m.tip, m.programmed))
    (columns, *place), (single, *other) = paths
    assert len(columns) == len(single) == 6 * len(POINTS)
    for name in ("start", "end", "centre", "sweep", "kind", "feed"):
        assert np.allclose(getattr(columns, name), getattr(single, name), rtol=0, atol=1e-9, equal_nan=True), name
    assert np.allclose(place, other, rtol=0, atol=1e-9)


def test_a_way_of_no_length_is_no_row():
    """The place where one visit ends is the next one's: its rows begin there without a way to it."""
    points = np.array([(k, 0.0) for k in (0, 2, 4, 5, 7, 9, 11, 12, 14, 16)])
    m = new_machine()

    def go(x, y):
        m.rapid(x=x, y=y)
        m.line(z=-1)
        m.rapid(x=x + 1)
        m.rapid(z=5)

    repeating.at_each(m, points, go)
    path = m.recorder.take()
    assert (path.lengths > 0).all() and len(path) == 4 * len(points) - 3  # to the first of all, and after 4 and 11


def test_snapshots_do_not_follow_what_they_were_taken_from():
    value = {"a": [1.0, float("nan"), {"b": np.arange(3)}]}
    before = Snapshot(value)
    assert before == Snapshot(value)
    for change in (lambda v: v["a"].append(2), lambda v: v["a"][2]["b"].__setitem__(0, 9), lambda v: v.update(c=1)):
        other = copy.deepcopy(value)
        change(other)
        assert Snapshot(other) != before
