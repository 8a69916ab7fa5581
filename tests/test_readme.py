"""What the README shows is so: its program, its alarm, and every call of its table."""

import ast
import os
import re
import shlex
import subprocess
import sys
from functools import partial
from importlib import import_module
from pathlib import Path

import pytest

import mnclab
from mnclab import area
from mnclab.__main__ import parser
from mnclab.controls.g43.language import modes
from mnclab.machine.control import FunctionTable

ROOT = Path(__file__).parent.parent
TEXT = (ROOT / "README.md").read_text("utf-8")
ROWS = [re.findall(r"`([^`]+)`", line.split("|")[2]) for line in TEXT.partition("you write |")[2].splitlines()[2:17]]


@pytest.fixture
def names(tmp_path, monkeypatch):
    """The names that the table takes for granted."""
    (tmp_path / "data").symlink_to(ROOT / "data")
    (tmp_path / "part.mnc").write_text("G0 X1\n")
    monkeypatch.chdir(tmp_path)
    run = mnclab.run("data/programs/mnc/first_path.mnc")
    blank = ((0, 0, -20), (100, 60, 0))
    return {
        "mnc": mnclab, "run": run, "other": mnclab.run("data/programs/mnc/compensated.mnc"), "blank": blank,
        "part": run.workpiece(stock=blank), "plate": mnclab.Design(blank, [mnclab.design.Hole(14, 14, 8)]),
        "region": area.Region.of(area.rectangle(30, 20, 5)),
        "profile": area.Contour([(0, 20), (-40, 20), (-50, 30)], closed=False),
    }  # fmt: skip


def test_it_begins_with_a_program_and_an_alarm(names):
    exec(TEXT.partition("```python")[2].partition("```")[0], names)
    assert names["run"].ok
    typed, _, answer = TEXT.partition(">>> ")[2].partition("```")[0].partition("\n")
    assert repr(eval(typed, names)) == answer.rstrip()


def test_every_call_of_the_table_runs(names):
    assert len(ROWS) == 15 and all(ROWS)
    for call in (call for row in ROWS[:-1] for call in row):
        exec(compile(ast.parse(call), call, "exec"), names)
    assert mnclab.run(names["run"].program, setup=names["shop"]).workpiece().removed > 0  # its tools and its blank are those


WRONG = ("run.plot(colr='feed')", "run.save('a.svg', size_mm='wide')", "run.profile('small-mill').plot(whole='yes')",
         "mnc.Tool(diametr=8)", "mnc.compare(region, 4.0).best(1)", "run.toolpath.nothing", "mnc.Setup(limits=5)",
         "run.workpiece().plot(section=5)", "plate.plot(size=5)", "run.collisions().plot(sections='XZ')")  # fmt: skip


@pytest.mark.deep
def test_type_checkers_know_every_call(tmp_path):
    """The Python of the README and of its table, as a file of a user; below it are wrong calls, which alone are told."""
    (block,) = re.findall(r"```python\n(.*?)```", TEXT, re.S)
    right = [*block.splitlines(), *NAMES.splitlines(), *(call for row in ROWS[:-1] for call in row)]
    right.append("run.plot(title='mine').savefig('a.png')")
    told = typed(tmp_path, "\n".join([*right, *WRONG]))
    lines = [int(line.split(":")[1]) for line in told]
    assert lines == [len(right) + k for k in range(1, len(WRONG) + 1)], told


NAMES = """
other = mnc.run("data/programs/mnc/compensated.mnc")
blank = ((0.0, 0.0, -20.0), (100.0, 60.0, 0.0))
part = run.workpiece(stock=blank)
plate = mnc.Design(blank, [mnc.design.Hole(14, 14, 8)])
region = mnc.area.Region.of(mnc.area.rectangle(30, 20, 5))
profile = mnc.area.Contour([(0, 20), (-40, 20), (-50, 30)], closed=False)
"""


def typed(folder, text):
    """What mypy says of a file."""
    file = folder / "readme.py"
    file.write_text(text, "utf-8")
    command = [sys.executable, "-m", "mypy", "--config-file", str(ROOT / "pyproject.toml"), str(file)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(ROOT)})
    return [line for line in done.stdout.splitlines() if "error:" in line]


def test_every_command_is_known():
    for call in ROWS[-1][:2]:
        _, *words = shlex.split(call)
        parser().parse_args(words)


def test_the_map_of_the_house_names_what_is_there():
    section = (ROOT / "CONTRIBUTING.md").read_text("utf-8").partition("## One program's way")[2].partition("\n## ")[0]
    named = re.findall(r"`([a-z_0-9/]+(?:\.py|/))`", section)
    assert len(named) > 30 and not [name for name in named if not (ROOT / "mnclab" / name).exists()]


def test_what_is_named_by_its_place_is_there():
    """Modules and files of mnclab that code and prose name: `mnclab.room.file`, `room/file.py`."""
    rooms = [folder.name for folder in (ROOT / "mnclab").iterdir() if (folder / "__init__.py").exists()]
    lost = []
    for file in sorted((ROOT / "mnclab").rglob("*.py")):
        text = file.read_text("utf-8")
        for room, name in re.findall(rf"`mnclab\.({'|'.join(rooms)})\.([a-z_.]+[a-z_])", text):
            first, *more = [room, *name.split(".")]
            here = ROOT / "mnclab" / first
            while more and (here / more[0]).is_dir():
                here /= more.pop(0)
            module = here / f"{more.pop(0)}.py" if more and (here / f"{more[0]}.py").exists() else here / "__init__.py"
            if more and not re.search(rf"\b{more[0]}\b", module.read_text("utf-8")):
                lost.append(f"{file.relative_to(ROOT)}: {room}.{name}")
        for path in re.findall(rf"`((?:{'|'.join(rooms)}|tnc_620)/[a-z_0-9/]+\.py)`", text):
            if not any((ROOT / "mnclab" / above / path).exists() for above in ("", "controls")):
                lost.append(f"{file.relative_to(ROOT)}: {path}")
    assert lost == []


def test_the_recipe_of_a_code_runs_as_it_is_written(monkeypatch):
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    (code,) = re.findall(r"```python\n(@FUNCTIONS\(\"M88.*?)```", text, re.S)
    table = FunctionTable()
    exec(code, {**vars(modes), "FUNCTIONS": table})
    monkeypatch.setitem(mnclab.controls["g43"].functions, "M88", table["M88"])
    assert mnclab.run("S800 M3\nM88\nG1 X10 F100\nM30\n", "g43").ok
    (alarm,) = mnclab.run("M88\n", "g43").alarms
    assert (alarm.message, alarm.hint) == ("M88 needs a spindle that turns", "write S and M3 before it")


def test_the_recipes_run_as_they_are_written(tmp_path, monkeypatch, request):
    """Each file of a recipe can be run, the control by its entry in the list, and the picture shows all its words."""
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    made = []
    for name, code in zip(("circle_", "press_", "heights_"), re.findall(r"```python\n(\"{3}.*?)```", text, re.S)):
        (tmp_path / f"{name}.py").write_text(code, "utf-8")
        made.append(import_module(name))
        request.addfinalizer(partial(sys.modules.pop, name))
    circle, press, heights = made
    assert circle.CYCLES.keys() == {"G13"} and press.CONTROL.cycles.keys() == {"G81"}
    ((name, folder),) = ast.literal_eval("{" + re.findall(r'^ +("[a-z-]+": "[a-z_]+")$', text, re.M)[0] + "}").items()
    assert name == press.CONTROL.name and f"mnclab/controls/{folder}/__init__.py" in text
    mnclab.controls.add(press.CONTROL)
    request.addfinalizer(lambda: mnclab.controls.remove(name))
    assert mnclab.run("F120 S800 M3\nG0 X10 Z5\nG81 Z-8 R5\n", name).ok
    picture = heights.plot_heights(mnclab.run("G1 X10 F100\n", "mnc"))
    picture.canvas.draw()
    (axes,) = picture.axes
    for label in (axes.xaxis.label, axes.yaxis.label):
        box = label.get_window_extent()
        assert picture.bbox.contains(box.x0, box.y0) and picture.bbox.contains(box.x1, box.y1)
