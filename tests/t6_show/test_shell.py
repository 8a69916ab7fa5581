"""The commands of the shell: what is printed where, and the exit status."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from mnclab import __main__ as shell
from mnclab.shell import lessons

GOOD = "G90 G54 S500 M3\nG0 X0 Y0 Z5\nG1 X10.5 F100\n"
COMMA = "G90 G54 S500 M3\nG0 X0 Y0 Z5\nG1 X10,5 F100\n"
ALARM_LINE = re.compile(r"[^:]+:\d+:\d+: (alarm|warning): .+")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with a good and a faulty program, in which commands run."""
    (tmp_path / "good.mnc").write_text(GOOD)
    (tmp_path / "comma.mnc").write_text(COMMA)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def mnclab(*arguments):
    """The exit status of a command line."""
    try:
        return shell.main(arguments)
    except SystemExit as end:
        return end.code


def test_check_of_good_programs_says_nothing(folder, capsys):
    assert mnclab("check", "good.mnc", "good.mnc") == 0
    assert capsys.readouterr() == ("", "")


def test_check_names_file_line_and_column_on_stderr(folder, capsys):
    assert mnclab("check", "good.mnc", "comma.mnc") == 1
    out, err = capsys.readouterr()
    assert out == "" and ALARM_LINE.fullmatch(err.strip())
    assert err.startswith("comma.mnc:3:7: alarm: ")  # the comma is the 7th character of line 3


def test_a_warning_leaves_the_status_at_zero(folder, capsys):
    (folder / "end.mnc").write_text(GOOD + "M30\n")
    assert mnclab("check", "end.mnc") == 0
    assert capsys.readouterr().err.startswith("end.mnc:4:1: warning: M30")


def test_check_goes_on_after_a_file_that_is_not_there(folder, capsys):
    assert mnclab("check", "none.mnc", "comma.mnc") == 1
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 2 and lines[0].startswith("none.mnc: alarm: cannot be read")


def test_check_as_json(folder, capsys):
    assert mnclab("check", "--json", "good.mnc", "comma.mnc", "none.mnc") == 1
    out, err = capsys.readouterr()
    good, comma, none = json.loads(out)
    assert err == "" and good == {"file": "good.mnc", "alarms": []}
    assert [comma["alarms"][0][key] for key in ("file", "line", "column")] == ["comma.mnc", 3, 7]
    assert none["alarms"][0]["file"] == "none.mnc" and none["alarms"][0]["line"] is None


def test_run_prints_one_move_a_line(folder, capsys):
    assert mnclab("run", "good.mnc") == 0
    *before, second = capsys.readouterr().out.splitlines()
    assert "spindle" in before[0] and "rapid" in before[1] and "X10.5" in second and "F100" in second
    assert mnclab("run", "comma.mnc") == 1
    out, err = capsys.readouterr()
    assert out.splitlines() == before and ALARM_LINE.fullmatch(err.strip())


def test_run_as_json(folder, capsys):
    assert mnclab("run", "good.mnc", "--json", "--control", "mnc") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["columns"]["end_x"] == [0, 0, 10.5] and found["summary"]["cutting length"] == 10.5


def test_a_setup_file_is_used(folder, capsys):
    (folder / "s.toml").write_text("start = [0, 0, 90]\n[tools.1]\nradius = 3\nlength = 50\n")
    (folder / "tool.mnc").write_text("T1\n" + GOOD)
    assert mnclab("run", "tool.mnc", "--setup", "s.toml") == 0
    assert "T1 radius 3 tip X0 Y0 Z40" in capsys.readouterr().out  # 90 less the length of 50


def test_plot_writes_the_file_that_was_asked_for(folder, capsys):
    assert mnclab("plot", "comma.mnc", "-o", "out.svg") == 1  # a picture up to the alarm
    assert (folder / "out.svg").read_text("utf-8").startswith("<?xml")
    assert mnclab("plot", "good.mnc", "--output", "out.csv") == 0
    assert len((folder / "out.csv").read_text("utf-8").splitlines()) == 4


def test_report_writes_a_page_and_keeps_the_status(folder, capsys):
    assert mnclab("report", "comma.mnc", "-o", "out.html", "--title", "Part 7") == 1
    assert "<h1>Part 7</h1>" in (folder / "out.html").read_text("utf-8")
    assert mnclab("report", "good.mnc", "-o", "out.pdf") == 0
    assert (folder / "out.pdf").read_bytes().startswith(b"%PDF")


def test_help_shows_the_parameters(capsys):
    assert mnclab("help", "G83", "--control", "mnc") == 0
    assert re.search(r"^K +depth of one peck +mm +greater than 0", capsys.readouterr().out, re.M)


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["check"],
        ["frobnicate"],
        ["run", "good.mnc", "--control", "none"],
        ["run", "good.mnc", "--setup", "none.toml"],
        ["plot", "good.mnc"],
        ["report", "good.mnc", "-o", "out.svg"],
        ["plot", "good.mnc", "-o", "out.xyz"],
        ["help", "G83"],
        ["help", "G999", "--control", "mnc"],
    ],
    ids=" ".join,
)
def test_a_senseless_command_line_is_status_two(folder, capsys, arguments):
    assert mnclab(*arguments) == 2
    out, err = capsys.readouterr()
    assert out == "" and err and "Traceback" not in err
    assert sorted(path.name for path in folder.iterdir()) == ["comma.mnc", "good.mnc"]


def test_the_module_runs_and_its_output_may_be_cut_off(folder):
    command = [sys.executable, "-m", "mnclab"]
    place = {"cwd": Path(shell.__file__).parent.parent, "capture_output": True, "text": True}
    result = subprocess.run([*command, "check", str(folder / "comma.mnc")], **place)
    assert result.returncode == 1 and result.stderr.count("\n") == 1
    (folder / "long.mnc").write_text("G90 F100\n" + "".join(f"G1 X{k}\n" for k in range(1, 20_000)))
    with subprocess.Popen([*command, "run", str(folder / "long.mnc")], cwd=place["cwd"], stdout=-1, stderr=-1) as child:
        child.stdout.readline()
        child.stdout.close()
        assert child.stderr.read() == b""


def test_a_code_page_without_the_letter_does_not_stop_the_message(folder):
    (folder / "name.mnc").write_text("G90\nG1 X1 F1 Ж5\n", encoding="utf-8")
    result = subprocess.run(
        [sys.executable, "-m", "mnclab", "check", str(folder / "name.mnc")],
        cwd=Path(shell.__file__).parent.parent, capture_output=True, env={"PYTHONIOENCODING": "cp1252", "PATH": ""},
    )  # fmt: skip
    assert result.returncode == 1 and b":2:10: alarm: " in result.stderr and b"Traceback" not in result.stderr


def test_lab_needs_jupyterlab(capsys, monkeypatch):
    monkeypatch.setattr(lessons.importlib.util, "find_spec", lambda name: None)
    assert mnclab("lab") == 2
    assert 'pip install "mnclab[lab]"' in capsys.readouterr().err


def test_lab_starts_on_the_first_lesson_with_this_python(monkeypatch):
    started = []

    class Child:
        def __init__(self, command, cwd):
            started.append((command, cwd))

        def wait(self):
            return 0

    monkeypatch.setattr(lessons.subprocess, "Popen", Child)
    assert mnclab("lab", "--port", "9000") == 0
    ((command, cwd),) = started
    assert command[:3] == [sys.executable, "-m", "jupyterlab"] and command[-2:] == ["--port", "9000"]
    assert (cwd / "notebooks" / command[3].rsplit("/", 1)[1]).is_file()


FULL = pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no such device here")
MODULE = [sys.executable, "-m", "mnclab"]
HERE = Path(shell.__file__).parent.parent


@FULL
@pytest.mark.parametrize(
    "arguments",
    [["run", "long.mnc"], ["check", "comma.mnc", "--json"], ["help", "G83", "--control", "mnc"]],
    ids=" ".join,
)  # fmt: skip
def test_a_full_disk_is_one_sentence(folder, arguments):
    (folder / "long.mnc").write_text("G90 F100\n" + "".join(f"G1 X{k}\n" for k in range(1, 5_000)))
    files = [str(folder / each) if each.endswith(".mnc") else each for each in arguments]
    with Path("/dev/full").open("w") as full:
        told = subprocess.run([*MODULE, *files], cwd=HERE, stdout=full, stderr=subprocess.PIPE, text=True)
        assert told.returncode == 2 and told.stderr.startswith("mnclab: the output cannot be written: No space left")
        assert told.stderr.count("\n") == 1


@FULL
def test_a_full_disk_of_the_alarms_is_a_status(folder):
    with Path("/dev/full").open("w") as full:
        command = [*MODULE, "check", str(folder / "comma.mnc")]
        told = subprocess.run(command, cwd=HERE, stdout=subprocess.PIPE, stderr=full)
        assert (told.returncode, told.stdout) == (2, b"")
        assert subprocess.run(command, cwd=HERE, stdout=full, stderr=full).returncode == 2


@FULL
def test_a_file_that_cannot_be_written_is_one_sentence(folder, capsys):
    (folder / "full.csv").symlink_to("/dev/full")
    for output in ("full.csv", "none/a.svg", "none/a.html"):
        assert mnclab("plot", "good.mnc", "-o", output) == 2
        told = capsys.readouterr().err
        assert told.count("\n") == 1 and f"{output} cannot be written: " in told
    assert mnclab("report", "good.mnc", "-o", "none/a.html") == 2
    assert Path("/dev/full").is_char_device() and (folder / "full.csv").is_symlink()


def test_an_output_that_was_closed_is_no_fault(folder, monkeypatch):
    monkeypatch.setattr(sys, "stdout", None)
    assert mnclab("check", "good.mnc") == 0 and mnclab("run", "good.mnc") == 0


SETUPS = {
    "deep": "start = " + "[" * 5000 + "]" * 5000, "digit": '[tools."²"]\nradius = 5\n', "nan": "start=[nan,0,0]\n",
    "negative": "[tools.1]\nradius = -5\n", "long": "start = " + "9" * 5000, "kinematics": "[kinematics]\n",
}  # fmt: skip


@pytest.mark.parametrize("name", SETUPS)
def test_a_faulty_setup_is_one_sentence_with_its_line(folder, capsys, name):
    (folder / "s.toml").write_text(SETUPS[name], "utf-8")
    for command in ("check", "run", "time"):
        assert mnclab(command, "good.mnc", "--setup", "s.toml") == 2
        out, err = capsys.readouterr()
        assert out == "" and err.count("\n") == 1 and "s.toml" in err and len(err) < 300
        assert name in ("deep", "long") or ALARM_LINE.fullmatch(err.strip())


@pytest.mark.parametrize("option", ["--rules", "--radii"])
@pytest.mark.parametrize("value", ["", ",", " , "])
def test_a_list_of_nothing_is_a_wrong_command_line(folder, capsys, option, value):
    assert mnclab("plot", "good.mnc", "-o", "x.svg", option, value) == 2
    assert f"argument {option}: nothing stands between the commas" in capsys.readouterr().err
    assert not (folder / "x.svg").exists()


@pytest.mark.parametrize(
    "arguments", [["check", ""], ["run", ""], ["time", ""], ["plot", "", "-o", "a.csv"], ["report", "", "-o", "a.html"]]
)
def test_an_empty_name_is_said_to_be_empty(folder, capsys, arguments):
    assert mnclab(*arguments) == 1
    assert capsys.readouterr() == ("", "mnclab: alarm: the name of the program is empty\n")


@pytest.mark.parametrize("arguments", [["check"], ["check", "--json"], ["time"], ["time", "--csv", "times.csv"]])
def test_a_folder_without_programs_is_not_one_where_all_is_well(folder, capsys, arguments):
    (folder / "elsewhere").mkdir()
    (folder / "elsewhere" / "notes.md").write_text("no program")
    assert mnclab(arguments[0], "elsewhere", *arguments[1:]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("mnclab: alarm: there is no program in elsewhere (") and err.count("\n") == 1
    assert not (folder / "times.csv").exists()


@pytest.mark.parametrize(
    ("option", "says"),
    [("--setup", "the setup must be the name of a file"), ("--machine", "no machine has the name ''")],
)
def test_an_empty_option_is_not_left_out(folder, capsys, option, says):
    assert mnclab("time", "good.mnc", option, "") == 2
    assert says in capsys.readouterr().err


@pytest.mark.parametrize("value", ["nan", "inf", "-5", "0", "1e-300", "1e300"])
def test_an_override_that_cannot_be_is_one_sentence(folder, capsys, value):
    assert mnclab("time", "good.mnc", f"--override={value}") == 2
    assert capsys.readouterr().err.startswith("mnclab: alarm: the feed override (1 for 100 %) must be")


def test_a_radius_that_cannot_be_is_one_sentence(folder, capsys):
    for radius in ("nan", "-5", "inf"):
        assert mnclab("plot", "good.mnc", "-o", "a.svg", f"--radii={radius}") == 2
        err = capsys.readouterr().err
        assert err.startswith("mnclab: alarm: ") and "radius" in err and radius in err and err.count("\n") == 1
    assert not (folder / "a.svg").exists()


SLOT = "T1 M6\nS1000 M3\nG43 G0 X-10 Y20 Z5\nG0 Z-4\nG1 X70 F300\nG0 Z50\n"
CRASH = SLOT.replace("G1 X70 F300", "G0 X70")


@pytest.fixture
def material(folder):
    """The same folder with a slot, one that is cut at rapid, and a blank for both."""
    (folder / "slot.g43").write_text(SLOT)
    (folder / "crash.g43").write_text(CRASH)
    (folder / "blank.toml").write_text("[stock]\nlow = [0, 0, -20]\nhigh = [60, 40, 0]\n")
    return folder


def test_check_of_material_names_collisions_on_stderr(material, capsys):
    assert mnclab("check", "--material", "--setup", "blank.toml", "slot.g43") == 0
    assert capsys.readouterr() == ("", "")
    assert mnclab("check", "--material", "--setup", "blank.toml", "slot.g43", "crash.g43") == 1
    out, err = capsys.readouterr()
    warning, collision = err.splitlines()
    assert out == "" and warning.startswith("crash.g43:5:1: warning: a rapid goes through the blank")
    assert collision.startswith("crash.g43:5: collision: rapid motion in material, 4.000 mm deep")


def test_check_without_material_does_not_look(material, capsys):
    assert mnclab("check", "--setup", "blank.toml", "crash.g43") == 0
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("crash.g43:5:1: warning: ") and "collision" not in err


def test_check_of_material_as_json(material, capsys):
    assert mnclab("check", "--material", "--json", "--setup", "blank.toml", "slot.g43", "crash.g43") == 1
    good, crash = json.loads(capsys.readouterr().out)
    assert good == {"file": "slot.g43", "alarms": [], "collisions": []}
    (collision,) = crash["collisions"]
    assert (collision["kind"], collision["line"], collision["file"]) == ("rapid", 5, "crash.g43")


@pytest.mark.parametrize("command", [("check", "--material", "slot.g43"), ("part", "slot.g43", "-o", "a.stl")])
def test_without_a_blank_there_is_nothing_to_check(material, capsys, command):
    assert mnclab(*command) == 1
    told = "slot.g43: alarm: there is no blank to cut (give one: a [stock] in the file of --setup (mnclab --help shows one))\n"
    assert capsys.readouterr() == ("", told)
    assert not (material / "a.stl").exists()


@pytest.mark.parametrize("name, begins", [("a.stl", b""), ("a.png", b"\x89PNG"), ("a.csv", b"")])
def test_part_saves_what_is_left(material, name, begins):
    assert mnclab("part", "slot.g43", "--setup", "blank.toml", "-o", name) == 0
    saved = (material / name).read_bytes()
    assert saved.startswith(begins) and len(saved) > 500
    assert mnclab("part", "slot.g43", "--setup", "blank.toml", "-o", f"early-{name}", "--line", "4") == 0
    assert (material / f"early-{name}").read_bytes() != saved


@pytest.mark.parametrize("wrong", [("-o", "a.xyz"), ("-o", "a.stl", "--line", "99")])
def test_a_part_that_cannot_be_saved_is_a_wrong_command_line(material, capsys, wrong):
    assert mnclab("part", "slot.g43", "--setup", "blank.toml", *wrong) == 2
    assert capsys.readouterr().err.startswith("mnclab: alarm: ")


@pytest.mark.parametrize("command", [["check"], ["time"], ["exercise", "list"], ["grade"]])
def test_a_table_is_asked_for_alike_and_no_program_is_taken_for_its_name(folder, capsys, command):
    """`--csv`, `--csv -` and `--csv OUT.csv` wherever there is a table; what follows and is no .csv stays as it was."""
    (folder / "pupils" / "anna").mkdir(parents=True)
    (folder / "pupils" / "anna" / "mnc-03.mnc").write_text("G0 X0\n")
    places = {"check": ["good.mnc"], "time": ["good.mnc"], "grade": ["pupils"]}.get(command[0], [])
    before = (folder / "good.mnc").read_bytes()
    for words in ([*places, "--csv"], ["--csv", *places], [*places, "--csv", "-"]):
        assert mnclab(*command, *words) in (0, 1)
        printed = capsys.readouterr().out
        assert len(printed.splitlines()[0].split(",")) > 2
    assert mnclab(*command, "--csv", "out.csv", *places) in (0, 1)
    assert (folder / "out.csv").read_text("utf-8") == printed and capsys.readouterr().out == ""
    assert mnclab(*command, *places, "--csv=out.txt") == 2 and not (folder / "out.txt").exists()
    assert (folder / "good.mnc").read_bytes() == before


def test_a_stroke_is_stdout_and_no_file(folder, capsys):
    assert mnclab("time", "good.mnc", "--csv", "-") == 0
    dashed = capsys.readouterr().out
    assert mnclab("time", "good.mnc", "--csv") == 0
    assert dashed == capsys.readouterr().out and dashed.startswith("file,")
    assert not (folder / "-").exists()
