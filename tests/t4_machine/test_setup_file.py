"""A setup read from a file, and what is said about a faulty one."""

import math
from dataclasses import fields

import numpy as np
import pytest

import mnclab
from mnclab import Alarm, Datum, Limits, Tool
from mnclab.machine.setup_file import FORMAT, load
from mnclab.workpiece.blank import Box, cylinder


def written(tmp_path, text):
    path = tmp_path / "machine.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_example_of_the_help_can_be_read(tmp_path):
    setup = load(written(tmp_path, FORMAT))
    assert setup.start == (0, 0, 300)
    assert (setup.tools[1].radius, setup.tools[1].length) == (5, 80)
    assert setup.datums == {1: Datum(100, 50, -200), 2: Datum(300, 50, -200, rotation=30)}


def test_the_help_names_every_field_of_a_tool():
    text = FORMAT.replace("\n", " ")
    assert not [each.name for each in fields(Tool) if each.name != "number" and each.name not in text]


def test_a_blank_is_a_box_or_a_cylinder(tmp_path):
    setup = load(written(tmp_path, "[stock]\nlow = [0, 0, -20]\nhigh = [60, 40, 0]\n"))
    assert setup.stock == Box((0, 0, -20), (60, 40, 0))
    setup = load(written(tmp_path, "[stock]\nradius = 20\nlow = -50\nhigh = 0\naxis = 'X'\nat = [0, 1, 2]\n"))
    assert setup.stock == cylinder(20, -50, 0, "X", (0, 1, 2))


@pytest.mark.parametrize(
    ("text", "place"),
    [
        (
            "[settings]\nblok_skip = true\n",
            "machine.toml:2:1: alarm: mnc has no setting 'blok_skip' (near: block_skip)",
        ),
        ("\n[settings]\n 'block_skip'=3\n", "machine.toml:3:2: alarm: setting block_skip "),
        ("# block_skip = 1\nsettings = { block_skip = 3 }\n", "machine.toml:2:14: alarm: setting block_skip "),
        ("settings.block_skip = 3\n", "machine.toml:1:10: alarm: setting block_skip "),
    ],
)
def test_a_wrong_setting_is_an_alarm_at_its_line_of_the_file(tmp_path, text, place):
    setup = load(written(tmp_path, text))
    with pytest.raises(Alarm) as caught:
        mnclab.run("G0 X1\n", "mnc", setup)
    assert place in caught.value.headline
    with pytest.raises(Alarm) as caught:  # a setting of one's own is none of the file's
        mnclab.run("G0 X1\n", "mnc", load(written(tmp_path, "[settings]\n")).with_settings(block_skip=3))
    assert caught.value.source is None


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
        ("start = [0, 0", "machine.toml:1:9: alarm: the bracket is not closed"),
        ("[tools.1]\nradiux = 3\n", "tools.1 has no 'radiux' (near: radius)"),
        ("[tool.1]\nradius = 3\n", "a setup has no 'tool' (near: tools)"),
        ("[tools.one]\nradius = 3\n", "a row of tools must be a whole number, got 'one'"),
        ("[tools]\n1 = 5\n", "tools.1 must be a table, got 5"),
        ("[tools.1]\nradius = '3'\n", "tools.1.radius must be a number, got '3'"),
        ("[tools.1]\nname = 3\n", "tools.1.name must be a text, got 3"),
        ("start = [0, 0]\n", "start must be three numbers [x, y, z], got [0, 0]"),
        ("[datums]\n1 = [true, 0, 0]\n", "datums.1 must be a number, got True"),
        ("[stock]\nradius = 0\n", "stock: a cylinder needs radius > bore"),
        ("[stock]\nlow = [0, 0, 0]\n", "or a radius: stock.high is missing"),
        ("[stock]\n", "stock needs low and high, two corners [x, y, z], or a radius: stock.low is missing"),
        ("[stock]\nhigh = [0, 0, 0]\n", "or a radius: stock.low is missing"),
        *(
            (f"[{name}.1]\n[{name}.01]\n", f"machine.toml:2:{len(name) + 3}: alarm: {name} has the row 1 twice")
            for name in ("tools", "datums", "presets", "correctors")
        ),
        ("[tools.1]\nnumber = 7\n", "machine.toml:2:1: alarm: tools.1.number must be 1, that of its row, got 7"),
        ("[tools.1]\nteeth = 2.5\n", "machine.toml:2:1: alarm: the teeth of a tool must be a whole number, got 2.5"),
        ("[tools.1]\nkind = 'zz'\n", "machine.toml:2:1: alarm: a tool cannot be of the kind 'zz' (known: mill, "),
        ("[tools.1]\nkind = 'Drill'\n", "a tool cannot be of the kind 'Drill' (near: drill)"),
        (
            "[tools.1]\nradius = 1\ncorner = 9\n",
            "corner radius of a tool must not be greater than its radius, got 9 and 1",
        ),
        ("[stock]\ndiameter = 3\n", "stock without a radius has no 'diameter'"),
        ("limits = 3\n", "limits must be a table, got 3"),
    ],
)
def test_a_fault_is_an_alarm_that_names_it(tmp_path, text, sentence):
    with pytest.raises(Alarm) as caught:
        load(written(tmp_path, text))
    assert sentence in caught.value.headline


def test_a_byte_order_mark_is_none_of_the_text(tmp_path):
    setup = load(written(tmp_path, "\ufeff[tools.1]\nradius = 3\nnumber = 1\n"))
    assert setup.tools[1].radius == 3
    with pytest.raises(Alarm, match="radiux") as caught:
        load(written(tmp_path, "\ufefftools.1.radiux = 3\n"))
    assert caught.value.headline.startswith(f"{tmp_path}/machine.toml:1:9: ")


def test_a_lathe_tool_has_a_nose_and_a_cutter_of_less_radius_a_smaller_corner():
    assert Tool(radius=0.1, corner=0.8, kind="turning").corner == 0.8
    ball = mnclab.Setup(tools={1: Tool(radius=5, corner=5)})
    assert ball.with_radius(2).tools[1] == Tool(radius=2, corner=2) and ball.with_radius(9).tools[1].corner == 5


@pytest.mark.parametrize("control", mnclab.controls)
def test_no_setting_is_without_a_bound_where_rows_are_counted(control):
    with pytest.raises(Alarm, match="setting most_rows .* must be a number from 1000 to 1000000000, got 1e[+]300"):
        mnclab.run("", control, mnclab.Setup(settings={"most_rows": 1e300}))


@pytest.mark.parametrize("data", [None, b"\xff\xfe\x00"])
def test_a_file_that_cannot_be_read_is_an_alarm(tmp_path, data):
    path = tmp_path / "machine.toml"
    if data:
        path.write_bytes(data)
    with pytest.raises(Alarm, match="the setup cannot be read"):
        load(path)


@pytest.mark.parametrize(
    ("text", "place", "sentence"),
    [
        (
            "[settings]\n[limits]\n[tools.1]\nradius = 5\n\n[tools.2]\nlength = 1\nradius = -5\n",
            "8:1",
            "at least 0, got -5",
        ),
        ("tools.1.radius = 5\ntools.2.radius = nan\n", "2:9", "must be a finite number, got nan"),
        ("[tools]\n1 = { radius = 5 }\n2 = { length = 1, radius = inf }\n", "3:19", "must be a finite number, got inf"),
        ("[tools.1]\nname = 3\n", "2:1", "tools.1.name must be a text"),
        ("[tools.1]\nnane = 'a'\n", "2:1", "tools.1 has no 'nane'"),
        ('[tools."²"]\nradius = 5\n', "1:8", "a row of tools must be a whole number, got '²'"),
        ('[tools]\n1 = {}\n"²" = { radius = 5 }\n', "3:1", "a row of tools must be a whole number, got '²'"),
        ("[tools.99999999999999]\n", "1:8", "a row of tools must be a whole number"),
        ("\nstart=[nan,0,0]\n", "2:1", "start must be a finite number, got nan"),
        ("start = [0, 0]\n", "1:1", "start must be three numbers"),
        ("[datums]\n1 = [0, 0, 0]\n2 = [\n 0, 0, inf]\n", "3:1", "datums.2 must be a finite number, got inf"),
        ("[datums.7]\nx = 1\n'y' = nan\n", "3:1", "datums.7.y must be a finite number, got nan"),
        ("[presets]\n3 = { rotation = -inf }\n", "2:7", "rotation of a datum must be a finite number"),
        ("[limits]\nrapid = [9000, -1, 9000]\n", "2:1", "limit rapid must be greater than 0, got -1"),
        ("[limits]\ntravel = [[0, 400], [300, 0], [-200, 0]]\n", "2:1", "limit travel of Y must go up, got 300 to 0"),
        ("[limits]\nacceleration = inf\n", "2:1", "limit acceleration must be a finite number"),
        ("[limits]\ncorner_speed = 'fast'\n", "2:1", "limit corner_speed must be one of"),
        ("[probe]\nreach = 0\n", "2:1", "the reach of a probe must be greater than 0"),
        ("[stock]\nlow = [0, 0, 0]\nhigh = [0, nan, 0]\n", "3:1", "stock.high must be a finite number"),
        ("[stock]\nradius = 5\nhigh = inf\n", "3:1", "stock.high must be a finite number"),
        ("[kinematics]\nA = 1\n", "2:1", "kinematics has no 'A'"),
        ("[kinematics]\ntable = [{ centre = [0, 0, 0] }]\n", "2:1", "kinematics.table.0 needs the name of the axis"),
        ("[kinematics]\ntable = [{ name = 'C', limits = [9, 1] }]\n", "2:1", "limits of axis C must go up"),
        ("kinematics = 'small-mill'\n", "1:1", "the machine small-mill has no rotary axes"),
        ("[true_tools.1]\nradius = -1\n", "2:1", "the radius of a tool must be at least 0"),
        ('[probe]\npositioning = "slow"\n', "2:1", "the positioning of a probe must be probe or machine"),
        ("[files]\nSUB = 3\n", "2:1", "files.SUB must be a text, got 3"),
        ("[tools.1]\nradius = " + "9" * 400 + "\n", "2:1", "must be a finite number, got inf"),
    ],
)
def test_a_fault_is_shown_at_its_line(tmp_path, text, place, sentence):
    with pytest.raises(Alarm) as caught:
        load(written(tmp_path, text))
    assert f"machine.toml:{place}: alarm: " in caught.value.headline and sentence in caught.value.message


@pytest.mark.parametrize(
    "text",
    ["start = " + "[" * 5000 + "]" * 5000, "start" + ".a" * 900 + " = 1", "a = " + "{a=" * 3000 + "1" + "}" * 3000,
     "start = " + "9" * 5000, "x" * 20_000 + " = 1", f"start = '{'x' * 20_000}'", "start = 1e999999",
     "a" + ".a" * 400_000 + " = 1", "[" + "a . " * 200_000 + "]", "x = {" + "a.1-b_." * 100_000 + "c = 1}"],
    ids=lambda text: text[:8],
)  # fmt: skip
def test_no_text_of_a_setup_is_more_than_an_alarm(tmp_path, text):
    with pytest.raises(Alarm) as caught:
        load(written(tmp_path, text + "\n"))
    assert len(caught.value.message) < 400 and str(caught.value)


def test_a_setup_has_a_bound(tmp_path):
    with pytest.raises(Alarm, match="the setup cannot be read: it has more than 1 MB"):
        load(written(tmp_path, "# " + "x" * 1_000_001))


HOLE = "[blank]\nlow = [0, 0, -20]\nhigh = [60, 40, 0]\n\n[[features]]\nkind = 'hole'\nx = 8\ny = 8\ndiameter = 6\ndepth = 5\n"


def test_the_part_of_a_design_is_the_next_blank(tmp_path):
    """The design stands beside the setup; a hole 5 deep is in the upper side, or turned over in the lower one."""
    (tmp_path / "part.toml").write_text(HOLE)
    stock = load(written(tmp_path, "[stock]\ndesign = 'part.toml'\n")).stock
    assert stock.faces(np.array([8.0]), np.array([8.0]))[1] == [pytest.approx(-5 - 3 / math.tan(math.radians(59)))]
    stock = load(written(tmp_path, "[stock]\ndesign = 'part.toml'\nturned_over = true\n")).stock
    assert [side.tolist() for side in stock.faces(np.array([10.9]), np.array([32.0]))] == [
        [pytest.approx(-15 + 0.1 / math.tan(math.radians(59)))], [0]
    ]  # fmt: skip


@pytest.mark.parametrize(("text", "place", "said"), [
    ("[stock]\ndesign = 'none.toml'\n", "2:1", "stock.design: none.toml: the design cannot be read"),
    ("[stock]\ndesign = 3\n", "2:1", "stock.design must be the name of a file, got 3"),
    ("[stock]\ndesign = 'part.toml'\nlow = 3\n", "3:1", "stock of a design has no 'low'"),
    ("[stock]\ndesign = 'part.toml'\nturned_over = 3\n", "3:1", "stock.turned_over must be true or false, got 3"),
    ("[stock]\ndesign = 'bad.toml'\n", "2:1", "stock.design: bad.toml:11: a hole has no 'deep'"),
])  # fmt: skip
def test_what_is_wrong_with_the_design_of_a_blank(tmp_path, text, place, said):
    (tmp_path / "part.toml").write_text(HOLE)
    (tmp_path / "bad.toml").write_text(HOLE + "deep = 3\n")
    with pytest.raises(Alarm) as told:
        load(written(tmp_path, text))
    assert said in str(told.value) and f":{place}: " in str(told.value)


def test_a_row_of_a_code_is_shown_at_its_line(tmp_path):
    setup = load(written(tmp_path, "[datums]\n1 = [0, 0, 0]\n54 = [1, 2, 3]\n"))
    with pytest.raises(Alarm) as caught:
        mnclab.run("G0 X1\n", "g43", setup)
    assert "machine.toml:3:1: alarm: row 54 of datums" in caught.value.headline
