"""One table says what a block may change: snapshots, the history, the rows and recorded contours follow it."""

import re
from pathlib import Path

import numpy as np
import pytest

import mnclab
from mnclab import Tool
from mnclab.geometry import frames
from mnclab.machine.state import HISTORY, PUT_BACK, ROWS, TABLE
from mnclab.machining.steps import Write
from mnclab.running.cycles import write
from mnclab.running.interpreter import Interpreter
from mnclab.text.alarm import Alarm

#: What a block cannot change, and what is worked out from the table.
GIVEN, WORKED_OUT = {"control", "setup", "settings", "flow"}, {"matrix", "shift", "row_state"}
OTHER = {
    "step": 7, "source_line": 7, "program": 1, "ended": False, "recorded_only": True, "unheard": "M",
    "origin": (1.0, 2.0, 3.0), "origin_chosen": True,
    "tip": (1.0, 2.0, 3.0), "programmed": (1.0, 2.0, 3.0), "pole": (1.0, 2.0), "rotary": (0.1, 0.2, 0.3), "pending": "free",
    "variable_unit": 25.4, "cycle": "another", "position_cycle": "another", "plane": "YZ", "feed": 99.0, "per_rev": True,
    "per_time": True, "speed": 99.0, "turning": -1, "spindle_angle": 30.0, "surface": 200.0, "speed_limit": 3000.0,
    "tool": Tool(radius=7), "side": 1, "corner_rule": 2, "look_ahead": True, "exact": True, "exact_here": True,
    "synchronous": True, "tolerance": 0.1, "label": "G83 peck", "cut_so_far": "less than it was", "stopped": "somewhere",
    "cylinder": 1, "from_angle": 0.5, "felt": "a part", "arrived": (1.0, 0.0, -1.0), "reckoned": None,
    "turned": frames.shift(z=1.0),
}  # fmt: skip
#: What is altered in its place.
WITHIN = {
    "block_end": lambda m: m.at_block_end(print),
    "alarms": lambda m: m.alarms.append(Alarm("doubtful", severity="warning")),
    "noted": lambda m: m.noted.add(("doubtful", None)),
    "logs": lambda m: m.logs.add("feed", 3, 50.0),
    "frames": lambda m: m.frames.set("more", frames.shift(z=1e-9)),
    "modal": lambda m: m.modal.update(motion="G1"),
    "tables": lambda m: m.tables.tools.update({99: Tool(radius=7)}),
    "variables": lambda m: m.variables.update(Q1=2.0),
    "measured": lambda m: m.measured.update(x=2.0),
    "touches": lambda m: m.touches.append("a touch"),
    "figures": lambda m: m.figures.append("a figure"),
    "measurements": lambda m: m.measurements.append("a line"),
    "memory": lambda m: m.memory.rotation_angles.update(rotation=30.0),
    "feed_rules": lambda m: m.feed_rules.append((0, 1)),
    "recorder": lambda m: m.add_row(mnclab.Kind.STOP, m.tip),
    "programmed_pieces": lambda m: m.programmed_pieces.append("a path"),
    "settled": lambda m: m.settled.append("a path"),
    "altered": lambda m: m.put(altered=True),
    "cut": lambda m: m.put(cut=3),
    "gouges": lambda m: m.gouges.append((1.0, 2.0)),
}


@pytest.fixture
def m():
    control = mnclab.controls["tnc-620"]
    program = mnclab.read("BEGIN PGM A MM\nL X+1 F100\nL X+2\nEND PGM A MM\n", "tnc-620")
    interpreter = Interpreter(control, mnclab.Setup(), program)
    interpreter.run()
    return interpreter.machine


def test_the_table_names_every_attribute(m):
    assert set(vars(m)) == set(TABLE) | GIVEN | WORKED_OUT


def test_every_part_is_altered_here():
    assert set(OTHER) | set(WITHIN) == set(TABLE) and not set(OTHER) & set(WITHIN)


@pytest.mark.parametrize("name", TABLE)
def test_a_snapshot_stays_and_is_put_back(m, name):
    before = m.snapshot()
    assert m.snapshot() == before
    for _ in range(2):  # what is put back can be altered, and put back once more
        WITHIN[name](m) if name in WITHIN else m.put(**{name: OTHER[name]})
        assert m.snapshot() != before and before.differences(m.snapshot()) == [name]
        m.restore(before)
        assert m.snapshot() == before


def test_what_is_put_back_makes_the_same_rows(m):
    m.rapid(z=1)
    before, made = m.snapshot(), []
    for _ in range(2):
        m.set_frame("shift", frames.shift(x=5))
        m.line(x=9, f=200)
        made.append(m.recorder.copy().take())
        m.restore(before)
    assert m.to_machine((0, 0, 0)) == (0, 0, 0) and m.recorder.made == 3
    for name in ("start", "end", "feed", "line"):
        assert np.array_equal(getattr(made[0], name), getattr(made[1], name)), name


@pytest.mark.parametrize("name", sorted(ROWS))
def test_what_rows_carry_makes_another_state(m, name):
    m.add_row(mnclab.Kind.STOP, m.tip)
    assert m.row_state is not None
    m.put(**{name: OTHER.get(name, m.frames)})
    assert m.row_state is None


@pytest.mark.parametrize("name", sorted(HISTORY - {"plane"}))
def test_the_history_hears_of_a_change(m, name):
    m.change(name, OTHER[name])
    assert m.logs.by_name[name].values[-1] == OTHER[name]


def test_the_history_has_the_code_of_the_plane(m):
    m.modal["plane"] = "G17"
    m.change("plane", "YZ")
    assert "plane" not in m.logs.by_name


def test_attributes_that_rows_carry_are_changed_by_methods_alone():
    """`change`, `put` and `within` work out the state of the rows anew; an assignment would not."""
    carried = "|".join(ROWS)
    assignment = re.compile(rf"\b(m|machine)\.(_\w+|{carried})(, [\w.]+)* = ")
    root = Path(mnclab.__file__).parent
    found = [path.name for path in root.rglob("*.py") if assignment.search(path.read_text("utf-8"))]
    assert found == []


def test_what_a_control_keeps_has_fields_and_no_others(m):
    write(m, Write("memory", 33.0, "orientation"))
    assert m.memory.orientation == 33
    with pytest.raises(AttributeError, match="tnc-620 keeps no orientatoin"):
        write(m, Write("memory", 33.0, "orientatoin"))


RECORDED = """BEGIN PGM A MM
CYCL DEF 14.0 CONTOUR
CYCL DEF 14.1 CONTOUR LABEL 1
M2
LBL 1
Q5 = 7
CYCL DEF 10.0 ROTATION
CYCL DEF 10.1 ROT+30
L X+0 Y+0 RR
M8
CC X+3 Y+4
L X+10 F300
L Y+10
L X+0 Y+0
LBL 0
"""


def test_of_a_recorded_contour_only_what_outlives_it_stays():
    interpreter = Interpreter(mnclab.controls["tnc-620"], mnclab.Setup(), mnclab.read(RECORDED, "tnc-620"))
    interpreter.run()
    m = interpreter.machine
    m.put(ended=False)
    before = m.snapshot()
    recording = m.record("1")
    assert recording.path.end.shape == (3, 3) and recording.memory.rotation_angles == {"rotation": 30.0}
    changed = before.differences(m.snapshot())
    assert m.variables["Q5"] == 7 and "variables" in changed and not set(changed) & set(PUT_BACK)
    assert "recorder" not in changed  # a contour has one of its own
