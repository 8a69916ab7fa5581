"""A setup read from a file, and what is said about a faulty one."""

import pytest

from mnclab import Alarm, Datum, Limits
from mnclab.machine.setup_file import FORMAT, load


def written(tmp_path, text):
    path = tmp_path / "machine.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_example_of_the_help_can_be_read(tmp_path):
    setup = load(written(tmp_path, FORMAT))
    assert setup.start == (0, 0, 300)
    assert (setup.tools[1].radius, setup.tools[1].length) == (5, 80)
    assert setup.datums == {1: Datum(100, 50, -200), 2: Datum(300, 50, -200, rotation=30)}


def test_every_part_arrives(tmp_path):
    text = (
        "[limits]\nrapid = [9000, 9000, 4000]\ntravel = [[0, 400], [0, 300], [-200, 0]]\n"
        "[probe]\nreach = 15\n[settings]\nblock_skip = true\n[files]\nSUB = 'sub.mnc'\n[presets.3]\nz = 7\n"
        "[tools.12]\nname = 'reamer'\nteeth = 6\n"
    )
    setup = load(written(tmp_path, text))
    assert setup.limits == Limits(rapid=(9000, 9000, 4000), travel=((0, 400), (0, 300), (-200, 0)))
    assert setup.probe.reach == 15 and setup.settings == {"block_skip": True}
    assert setup.files == {"SUB": tmp_path / "sub.mnc"}
    assert setup.presets[3].z == 7 and (setup.tools[12].name, setup.tools[12].teeth) == ("reamer", 6)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("start = [0, 0", "machine.toml:1:14: alarm: "),
        ("[tools.1]\nradiux = 3\n", "tools.1 has no 'radiux' (near: radius)"),
        ("[tool.1]\nradius = 3\n", "a setup has no 'tool' (near: tools)"),
        ("[tools.one]\nradius = 3\n", "a row of tools must be a whole number, got 'one'"),
        ("[tools]\n1 = 5\n", "tools.1 must be a table, got 5"),
        ("[tools.1]\nradius = '3'\n", "tools.1.radius must be a number, got '3'"),
        ("[tools.1]\nname = 3\n", "tools.1.name must be a text, got 3"),
        ("start = [0, 0]\n", "start must be three numbers [x, y, z], got [0, 0]"),
        ("[datums]\n1 = [true, 0, 0]\n", "datums.1 must be a number, got True"),
        ("limits = 3\n", "limits must be a table, got 3"),
    ],
)
def test_a_fault_is_an_alarm_that_names_it(tmp_path, text, sentence):
    with pytest.raises(Alarm) as caught:
        load(written(tmp_path, text))
    assert sentence in caught.value.headline


@pytest.mark.parametrize("data", [None, b"\xff\xfe\x00"])
def test_a_file_that_cannot_be_read_is_an_alarm(tmp_path, data):
    path = tmp_path / "machine.toml"
    if data:
        path.write_bytes(data)
    with pytest.raises(Alarm, match="the setup cannot be read"):
        load(path)
