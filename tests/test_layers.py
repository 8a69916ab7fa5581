"""The folders of mnclab are the floors of a house: a file imports only from floors below its own."""

import ast
import functools
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).resolve().parent.parent
FILES = sorted(path.relative_to(ROOT / "mnclab").as_posix() for path in (ROOT / "mnclab").rglob("*.py"))

FLOORS = {
    "text": 0,
    "geometry": 1,
    "path": 2,
    "workpiece": 3, "machining": 3,
    "comparison": 4, "machine": 4, "running": 4.1, "runs": 4.2,
    "controls": 5,
    "show": 6,
    "shell": 7,
    "design": 6.5,
    "learning": 7.5,
    "lab": 8,
}  # fmt: skip
WINGS = ("design", "learning", "lab")  # they import the core, which opens them by name: text.opening.opened

OUTSIDE = {  # package -> the only modules of mnclab that import it
    "shapely": ("geometry.shapely",),
    "matplotlib": ("show.plot", "design.drawing", "design.difference.plot", "design.difference.plot_sections"),
    "pyvista": ("show.scene", "design.difference.scene", "workpiece.part.mesh", "workpiece.part.pictures"),
    "vtkmodules": ("show.scene", "workpiece.part.mesh"),
    "ezdxf": ("geometry.dxf", "design.drawing.dxf"),
    "ipywidgets": ("lab.forms", "lab.editor", "lab.exercise_editor"),
    "IPython": ("lab.magic", "lab.forms.live"),
    "tqdm": ("text.opening",),
    "pandas": ("text.tables",),
    "nbclient": ("shell.handout",),
    "nbconvert": ("shell.handout",),
    "nbformat": ("shell.handout",),
    "pygments": ("shell.handout",),
    "pdoc": ("shell.site", "shell.reference"),
}
SEES_ALL = ("lab",)
HEAVY = {"shapely", "matplotlib", "pyvista", "vtkmodules", "ipywidgets", "IPython", "tqdm", "pandas", "nbclient", "nbconvert",
         "nbformat", "pygments", "pdoc"}
VAGUE = {"util", "utils", "helper", "helpers", "common", "base", "core", "misc"}
LONGEST = 500


class Import(NamedTuple):
    """One imported name: `from mnclab.path import toolpath` has the target `mnclab.path.toolpath`."""

    line: int
    target: str
    place: str  # "top", "types" (under TYPE_CHECKING), "function", or "door": at most two statements


def imports(node, package, place="top"):
    """Yield every import below a node; `package` is what a relative import starts from."""
    if isinstance(node, ast.Import):
        for name in node.names:
            yield Import(node.lineno, name.name, place)
    elif isinstance(node, ast.ImportFrom):
        above = package[: len(package) - node.level + 1] if node.level else []
        module = ".".join([*above, *filter(None, [node.module])])
        for name in node.names:
            yield Import(node.lineno, f"{module}.{name.name}", place)
    elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
        body = node.body[1:] if ast.get_docstring(node) is not None else node.body
        place = "door" if len(body) <= 2 else "function"
    elif isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
        place = "types"
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.stmt | ast.excepthandler | ast.match_case):  # no expression holds an import
            yield from imports(child, package, place)


def within(module, places):
    """Whether a module is one of the places or lies inside one."""
    return any(f"{module}.".startswith(f"{place}.") for place in places)


def fault(module, found):
    """What is wrong with an import in `module` (a dotted name below mnclab), or None."""
    top, _, name = found.target.partition(".")
    if top != "mnclab":
        if top in sys.stdlib_module_names or top == "numpy" or found.place == "types":
            return None
        if top not in OUTSIDE:
            return f"{top} is not among the packages that mnclab builds on"
        return None if within(module, OUTSIDE[top]) else f"only {' and '.join(OUTSIDE[top])} may import {top}"
    if within(module, SEES_ALL):
        return None
    here, there = module.split("."), name.split(".")
    if there[0] not in FLOORS:
        return "inside the package a name is imported from its own file, not from the front door"
    of_all = here[1:2] and here[1] in ("choice", "cycle_steps", "recognition", "survey", "renumber", "proving")
    if here[0] == there[0] == "controls" and len(here) > 1 and not of_all:
        alike = there[1:2] in (here[1:2], ["word_address"])
        return None if alike else "a control imports word_address and itself, never another"
    if here[0] == there[0]:
        return None
    if there[0] in WINGS and found.place == "types":
        return None
    if here[0] == "design" and there[0] in ("machine", "running", "runs", "controls"):
        return f"a design knows data, never {there[0]}"
    if here[0] == "show" and there[0] in ("machine", "running", "runs", "controls"):
        return f"pictures know data, never {there[0]}; only the lab sees all"
    if there[0] == "show" and found.place in ("door", "types"):
        return None
    if FLOORS[here[0]] > FLOORS[there[0]]:
        return None
    where = "the same floor as" if FLOORS[here[0]] == FLOORS[there[0]] else "a floor above"
    return f"{there[0]} is on {where} {here[0]}"


def breaches(file, tree):
    """Yield one sentence for every forbidden import in a file, which is named from the folder mnclab."""
    if file in ("__init__.py", "__main__.py", "testing.py"):
        return
    *folders, name = file.removesuffix(".py").split("/")
    module = ".".join([*folders, name] if name != "__init__" else folders)
    if module.split(".")[0] not in FLOORS:
        yield f"mnclab/{file} stands on no floor: the folders are {', '.join(FLOORS)}."
        return
    for found in imports(tree, ["mnclab", *folders]):
        if reason := fault(module, found):
            yield f"mnclab/{file}:{found.line} imports {found.target}: {reason}."


def complain(sentences):
    """Fail with the sentences, if there are any, and without a traceback."""
    if sentences := list(sentences):
        pytest.fail("\n".join(sentences), pytrace=False)


@functools.cache
def tree_of(file):
    """The statements of a file of mnclab."""
    return ast.parse((ROOT / "mnclab" / file).read_text("utf-8"))


def test_imports_point_down():
    complain(sentence for file in FILES for sentence in breaches(file, tree_of(file)))


DOOR = "def plot(self):\n    'A door.'\n    from mnclab.show.plot import path\n    return path(self)\n"


@pytest.mark.parametrize(
    ("file", "source", "reason"),
    [
        ("path/toolpath.py", "import numpy as np, math", None),
        ("path/toolpath.py", "from ..geometry import arcs", None),
        ("path/toolpath.py", "from .tool import Tool", None),
        ("path/toolpath.py", "from ..runs.run import Run", "a floor above"),
        ("path/toolpath.py", "from mnclab import machine", "a floor above"),
        ("path/toolpath.py", "from mnclab import Toolpath", "front door"),
        ("path/toolpath.py", "import scipy.optimize", "not among the packages"),
        ("path/toolpath.py", "if True:\n    def f():\n        from mnclab.runs import run", "a floor above"),
        ("path/toolpath.py", "from ..show.plot import path", "a floor above"),
        ("path/toolpath.py", DOOR, None),
        ("path/toolpath.py", DOOR.replace("    return", "    self = 1\n    return"), "a floor above"),
        ("path/toolpath.py", DOOR.replace("show.plot", "runs.run"), "a floor above"),
        ("path/toolpath.py", "if TYPE_CHECKING:\n    import matplotlib", None),
        ("workpiece/stock.py", "from mnclab.machining import holes", "the same floor"),
        ("comparison/runs.py", "from mnclab.machine import run", "the same floor"),
        ("geometry/shapely.py", "import shapely", None),
        ("geometry/offsets.py", "import shapely", "only geometry.shapely"),
        ("show/plot/path.py", "from matplotlib.figure import Figure", None),
        ("show/scene.py", "def f():\n    import pyvista", None),
        ("show/player.py", "from matplotlib.figure import Figure", "only show.plot"),
        ("show/player.py", "from ..runs.run import Run", "pictures know data"),
        ("lab/forms/cycle_form.py", "import ipywidgets, mnclab\nfrom mnclab.controls import mnc", None),
        ("lab/editor.py", "from mnclab.design.model import Design", None),
        ("show/plot/part.py", "from mnclab.design.model import Design", "a floor above"),
        ("show/plot/part.py", "def plot():\n    from mnclab.lab import forms\n    return forms", "a floor above"),
        ("workpiece/workpiece.py", "def f():\n    from mnclab.design.model import Design\n    return Design", "a floor above"),
        ("workpiece/workpiece.py", "if TYPE_CHECKING:\n    from mnclab.design.model import Design", None),
        ("design/model/slabs.py", "from mnclab.runs.run import Run", "a design knows data"),
        ("controls/__init__.py", "from . import mnc, nc_31", None),
        ("controls/mnc/drilling.py", "from ..word_address import motion\nfrom . import polar", None),
        ("controls/mnc/drilling.py", "from mnclab.controls.nc_31 import grooving", "never another"),
        ("controls/mnc/__init__.py", "from mnclab import controls", "never another"),
        ("controls/word_address/motion.py", "from ..mnc import polar", "never another"),
        ("extra.py", "", "stands on no floor"),
    ],
)
def test_the_rules_themselves(file, source, reason):
    found = list(breaches(file, ast.parse(source)))
    assert len(found) == (reason is not None)
    assert reason is None or reason in found[0]


def test_importing_mnclab_loads_numpy_and_nothing_heavy():
    script = "import sys, mnclab; print(*sys.modules)"
    result = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    loaded = {name.partition(".")[0] for name in result.stdout.split()}
    assert "numpy" in loaded
    assert not loaded & HEAVY


def test_every_file_can_be_read_in_one_sitting():
    kinds = (".py", ".html", ".js", ".css")
    written = [path for path in (ROOT / "mnclab").rglob("*") if path.suffix in kinds]
    lengths = {path: len(path.read_text("utf-8").splitlines()) for path in written}
    complain(
        f"{path.relative_to(ROOT).as_posix()} has {length} lines; {LONGEST} is the most."
        for path, length in lengths.items()
        if length > LONGEST
    )


def test_every_name_says_something():
    complain(
        f"mnclab/{file} has a name that says nothing of what it holds."
        for file in FILES
        if VAGUE & set(file.removesuffix(".py").split("/"))
    )


def test_every_file_says_what_it_is():
    complain(
        f"mnclab/{file} has no docstring in its first line."
        for file in FILES
        if not ast.get_docstring(tree_of(file))
    )


def test_no_path_of_one_machine_is_in_the_tree():
    if not (shutil.which("git") and (ROOT / ".git").exists()):
        pytest.skip("git cannot say which files are tracked")
    listing = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT, text=True)
    own = re.compile(rb"/(?:work|root)/|/tmp/(?:bash)")
    tracked = [ROOT / name for name in listing.split("\0") if name]
    complain(
        f"{path.relative_to(ROOT).as_posix()} names a folder of one machine: {found[0].decode()}"
        for path in tracked
        if path.is_file() and (content := path.read_bytes()) and b"\0" not in content
        if (found := own.search(content))
    )


STATE = re.compile(r"(?:\b|\.)(?:m|machine)$")


def assigned(node):
    """Yield what statements below a node assign to, part by part."""
    for each in ast.walk(node):
        if isinstance(each, ast.Assign):
            targets = each.targets
        elif isinstance(each, ast.AugAssign | ast.AnnAssign):
            targets = [each.target]
        else:
            continue
        for target in targets:
            yield from (part for part in ast.walk(target) if isinstance(part, ast.Attribute | ast.Subscript))


def intrusions(file, tree):
    """Yield one sentence for every private attribute of a machine that is assigned, and every memory with text for keys."""
    for target in assigned(tree):
        private = isinstance(target, ast.Attribute) and target.attr.startswith("_")
        if private and STATE.search(ast.unparse(target.value)) and not file.startswith("machine/"):
            yield f"mnclab/{file}:{target.lineno} assigns {ast.unparse(target)}, which belongs to the machine."
    for node in ast.walk(tree):
        if isinstance(node, ast.Subscript):
            owner = node.value
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in ("get", "pop"):
            owner = node.func.value
        else:
            continue
        if "memory" in (getattr(owner, "attr", None), getattr(owner, "id", None)):
            yield f"mnclab/{file}:{node.lineno} keeps {ast.unparse(node)} under a text: it is a field of the control's state."


def test_nobody_else_assigns_the_state_of_a_machine():
    complain(sentence for file in FILES for sentence in intrusions(file, tree_of(file)))


@pytest.mark.parametrize(
    ("file", "source", "reason"),
    [
        ("running/bulk.py", "m._state = 1", "belongs to the machine"),
        ("running/bulk.py", "flow.machine._span, x = 1, 2", "belongs to the machine"),
        ("running/bulk.py", "self.m._columns[3] += 1", "belongs to the machine"),
        ("machine/state.py", "m._state = 1", None),
        ("running/bulk.py", "self._state = form._state = m.state", None),
        ("controls/mnc/polar.py", "m.memory['pole'] = 1", "under a text"),
        ("controls/mnc/polar.py", "machine.memory.get('pole')", "under a text"),
        ("controls/mnc/polar.py", "m.memory.pole = rows['pole']", None),
    ],
)
def test_the_rules_of_state_themselves(file, source, reason):
    found = list(intrusions(file, ast.parse(source)))
    assert len(found) == (reason is not None)
    assert reason is None or reason in found[0]


def test_docstrings_have_one_dialect():
    """Single backticks, no roles: nothing renders them here."""
    foreign = re.compile(r"``|:[a-z]+:`")
    for file in FILES:
        for node in ast.walk(tree_of(file)):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and (text := ast.get_docstring(node)):
                found = foreign.search(text)
                assert not found, f"mnclab/{file}: {found[0]} in the docstring of {getattr(node, 'name', 'the file')}"
