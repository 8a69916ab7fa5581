"""Steps carried out: their answers, what they write, and that places at which something is asked are visited one by one."""

from collections.abc import Iterator

import numpy as np
import pytest

import mnclab
from mnclab.geometry.contours import Contour
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Along, Each, Go, Say, Step, Swivel, Touch, Write
from mnclab.path.toolpath import Kind
from mnclab.running.cycles import perform
from mnclab.running.interpreter import Interpreter
from mnclab.workpiece.part import box

#: A stair: its upper step ends at X 50.
STAIR = box((-10, -10, -50), (50, 50, 0)) | box((50, -10, -50), (500, 50, -7))
POINTS = np.column_stack([10.0 + 9 * np.arange(10), np.zeros(10)])


@pytest.fixture
def machine() -> Machine:
    control = mnclab.controls["tnc-620"]
    made = Interpreter(control, mnclab.Setup(part=STAIR), control.read("", "")).machine
    made.change_tool(mnclab.Tool(radius=1, number=6, kind="probe"))
    made.rapid(0, 0, 10)
    return made


def test_every_touch_of_a_pattern_is_made(machine: Machine) -> None:
    """The second place is like the third, and so would the others be if they were made as columns: but there is a stair."""
    found = []

    def visit(x: float, y: float) -> Iterator[Step]:
        yield Go("over the place", x=x, y=y)
        contact = yield Touch("down", x, y, -20, feed=100)
        found.append(contact.point[2])
        yield Go("up", 10)

    perform(machine, "PROBE", [Each(POINTS, visit)], about=(0.0, 0.0))
    expected = np.where(POINTS[:, 0] < 50, 0.0, -7.0)
    assert np.allclose(found, expected + 1)  # the centre of the ball
    machine.settle()
    rows = [move for path in machine.settled for move in path]
    assert np.allclose([move.end[2] for move in rows if move.kind == Kind.PROBE], expected)


def test_what_a_visit_writes_is_written_at_every_place(machine: Machine) -> None:
    def visit(x: float, y: float) -> Iterator[Step]:
        yield Go("over the place", x=x, y=y)
        yield Write("variable", machine.variables.get("Q1", 0.0) + 1, "Q1")
        yield Go("down", -5)
        yield Go("up", 10)

    perform(machine, "COUNT", [Each(POINTS, visit)], about=(0.0, 0.0))
    assert machine.variables["Q1"] == len(POINTS)


def test_steps_of_a_list_get_no_answer_and_a_generator_returns_its_own(machine: Machine) -> None:
    def asking() -> Iterator[Step]:
        contact = yield Touch("down", 0, 0, -20, feed=100)
        return contact.hit

    assert perform(machine, "PROBE", [Touch("down", 0, 0, -20, feed=100), Go("up", 10)]) is None
    assert machine.programmed == (0, 0, 10)
    assert perform(machine, "PROBE", asking()) is True


def test_rows_carry_the_code_and_the_label_of_their_step(machine: Machine) -> None:
    machine.label = "before"
    perform(machine, "G1", [Go("down", 5, 100), Swivel("turn", (90, 0, 0), 3600), Say("says this", "so")])
    path = machine.recorder.take()
    assert [path.labels[k] for k in path.label[-2:]] == ["G1 down", "G1 turn"] and machine.label == "before"
    assert path.rotary[-1] == pytest.approx((np.pi / 2, 0, 0)) and path.time[-1] == pytest.approx(1.5)
    assert [(alarm.message, alarm.hint) for alarm in machine.alarms] == [("G1 says this", "so")]


@pytest.mark.parametrize("length", [9e-4, 1e-5, 7e-8])
def test_an_arc_too_short_to_tell_its_ends_apart_is_no_full_circle(machine: Machine, length: float) -> None:
    """A contour from the inset of an area: a quarter of a circle of 10 that is met by arcs of less than a micrometre."""
    angle = np.cumsum([0, length / 10, np.pi / 2, length / 10, -length / 10])
    points, bulge = 10 * np.stack([np.cos(angle), np.sin(angle)], axis=1), np.tan(np.append(np.diff(angle), 0) / 4)
    contour = Contour(points, bulge, closed=False)
    perform(machine, "RING", [Go("to the ring", x=10, y=0), Along("ring", contour, 100)], about=(0.0, 0.0))
    machine.settle()
    rows = [move for path in machine.settled for move in path if move.label == 1 or move.feed == 100]
    assert np.sum([abs(move.sweep) for move in rows]) == pytest.approx(np.pi / 2, abs=3 * length)
    assert np.allclose(rows[-1].end[:2], contour.points[-1], atol=1e-9)


def test_a_circle_of_two_halves_is_one_full_circle(machine: Machine) -> None:
    perform(machine, "RING", [Go("to the ring", x=10, y=0), Along("ring", Contour.circle((0, 0), 10), 100)], about=(0.0, 0.0))
    machine.settle()
    (ring,) = (move for path in machine.settled for move in path if move.feed == 100)
    assert ring.kind == Kind.ARC and abs(ring.sweep) == pytest.approx(2 * np.pi)
