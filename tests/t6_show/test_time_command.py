"""`mnclab time`: the breakdown, as text and as JSON, on machines with and without a name."""

import json
import math
import re

import pytest

from mnclab import Alarm
from mnclab import __main__ as shell
from mnclab.path import machines as limits
from mnclab.text.tables import clock

PROGRAM = "G90 G54\nT1\nG1 X30 F6000\nG4 P0.5\nG0 X0\n"
MACHINE = '[limits]\nacceleration = [1000, 500, 500]\nrapid = 6000\ntool_change = 2\ncorner_speed = "jump"\n'


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with a program and a machine."""
    (tmp_path / "p.mnc").write_text(PROGRAM)
    (tmp_path / "m.toml").write_text(MACHINE)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_breakdown_sums_up(folder, capsys):
    assert shell.main(["time", "p.mnc", "--machine", "m.toml", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    # both moves: 30 mm at 100 mm/s and 1000 mm/s² take 0.3 + 0.1 s
    assert found["time"] == pytest.approx(2 + 0.4 + 0.5 + 0.4)
    assert found["cause"] == pytest.approx(
        {"cutting": 0.3, "rapid": 0.3, "acceleration": 0.2, "dwell": 0.5, "tool change": 2}
    )
    assert found["line"] == pytest.approx({"2": 2, "3": 0.4, "4": 0.5, "5": 0.4})
    for key in ("cause", "tool", "kind", "line"):
        assert sum(found[key].values()) == pytest.approx(found["time"])


def test_the_text_names_machine_causes_and_lines(folder, capsys):
    assert shell.main(["time", "p.mnc", "--machine", "small-mill", "--override", "50"]) == 0
    out = capsys.readouterr().out
    assert "small-mill" in out and "acceleration" in out and "G1 X30 F6000" in out
    assert re.search(r"cutting +0\.600 s", out)  # 30 mm at half of 100 mm/s


def test_a_machine_that_does_not_exist_is_a_wrong_command_line(folder, capsys):
    with pytest.raises(SystemExit) as end:
        shell.main(["time", "p.mnc", "--machine", "small-mil"])
    assert end.value.code == 2
    assert "near: small-mill" in capsys.readouterr().err
    with pytest.raises(SystemExit) as end:
        shell.main(["time", "p.mnc", "--override", "0"])
    assert end.value.code == 2


def test_an_alarm_in_the_program_is_status_one(folder, capsys):
    (folder / "wrong.mnc").write_text("G90\nG1 X3,5 F100\n")
    assert shell.main(["time", "wrong.mnc"]) == 1
    assert "wrong.mnc:2:6: alarm" in capsys.readouterr().err


@pytest.mark.parametrize("name", limits.names())
def test_every_named_machine_states_its_assumptions(name):
    machine = limits.load(name)
    assert machine.title and len(machine.assumes) >= 3
    assert (machine.limits.axes("acceleration") > 0).all()


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("limit = 1", "a machine has no 'limit'"),
        ("[limits]\nacceleration = 0", "limit acceleration must be greater than 0"),
        ("[limits]\nspeed = 0", "limits has no 'speed'"),
        ("assumes = 3", "assumes must be a list of texts"),
        ("title = 3", "title must be a text"),
        ("[limits", "Expected"),
    ],
)
def test_a_faulty_machine_is_an_alarm(tmp_path, text, says):
    (tmp_path / "m.toml").write_text(text)
    with pytest.raises(Alarm, match=says):
        limits.load(tmp_path / "m.toml")
    with pytest.raises(Alarm, match="cannot be read"):
        limits.load(tmp_path / "none.toml")


def test_times_as_people_say_them():
    assert [clock(t) for t in (3.214, 75, 3723)] == ["3.21 s", "1:15", "1:02:03"]
    assert [clock(t) for t in (math.inf, 1e300)] == ["inf s", "1e+300 s"]
