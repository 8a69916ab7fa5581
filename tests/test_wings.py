"""The core stands by itself, with one control: a copy of the house without its wings runs, plots, cuts and saves.

The tests of a wing are a folder of their own: `controls/NAME`, `design`, `learning`, `lab`. What lies directly in `controls`
asks all controls that there are. The tests of the core import no wing, and those of them that name none pass in the copy too.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from mnclab.controls import MODULES

ROOT = Path(__file__).resolve().parent.parent
WINGS = ["design", "learning", "lab", *(f"controls/{module.rpartition('.')[2]}" for module in MODULES.values())]
MILLED = "mnclab.Setup(tools={1: mnclab.Tool(radius=4)}, stock=mnclab.box((0, 0, -10), (60, 40, 0)))"
TURNED = "mnclab.Setup(start=(30, 0, 10), stock=mnclab.cylinder(radius=15, low=-40, high=0))"
ISO = "G17 G90 G54 T1 M6\nG0 X-10 Y20 Z5 S900 M3\nZ-3\nG1 X70 F200\nG0 Z5\nM30\n"
KLARTEXT = (
    "BEGIN PGM A MM\nTOOL CALL 1 Z S900\nL X-10 Y+20 Z+5 R0 FMAX M3\nL Z-3 FMAX\nL X+70 F200\nL Z+5 FMAX M30\nEND PGM A MM\n"
)
JNC = "M3\nT1\nS800 G97 G95 F0.25\nG00 X13 Z3\nG01 Z-20\nX17\nG00 Z3\n"
NC_31 = "N1 S600\nN2 F15\nN3 X2600~\nN4 Z300~\nN5 Z-2000\nN6 X3400\nN7 Z300~\n"
SHAFT = 3.141592653589793 * (15**2 * 20 + 13**2 * 20)

#: Folder -> name, a program that cuts a groove or a step, its setup, and what is left of it, mm³.
ALONE = {
    "mnc": ("mnc", ISO.replace("T1 M6", "T1"), MILLED, 60 * 40 * 10 - 60 * 8 * 3),
    "g43": ("g43", ISO, MILLED, 60 * 40 * 10 - 60 * 8 * 3),
    "tnc_620": ("tnc-620", KLARTEXT, MILLED, 60 * 40 * 10 - 60 * 8 * 3),
    "jnc_t01": ("jnc-t01", JNC, TURNED, SHAFT),
    "nc_31": ("nc-31", NC_31, TURNED, SHAFT),
}
FLOORS = sorted(folder.name for folder in (ROOT / "tests").glob("t[0-9]_*"))
#: Floors whose tests are run in the copy: they run programs and take seconds.
RUN_ALONE = ("t0_text", "t4_comparison", "t4_machine", "t4_running")
WING = re.compile(rf"^(?:from|import) (?:mnclab\.)?(?:{'|'.join(WINGS).replace('/', '[.]')})\b", re.M)
#: What a file of tests says that asks for another control than the one that is there, or for a wing.
NAMES_ANOTHER = re.compile(
    r"tnc-620|BEGIN PGM|g43|jnc-t01|nc-31|[Dd]esign|\.(?:lab|form|editor|compare|exercises?)\b|mnc(?:lab)?\.mark\b"
)
SCRIPT = """
import mnclab
assert mnclab.__file__.startswith({home!r}), mnclab.__file__
assert list(mnclab.controls) == [{name!r}], list(mnclab.controls)
run = mnclab.run({text!r}, {name!r}, {setup})
assert run.ok, run.alarms
run.plot(), run.toolpath.plot(), run.profile().plot(), run.workpiece().plot(), run.removal().plot()
run.save({home!r} + "/path.svg"), run.save({home!r} + "/player.html"), run.report({home!r} + "/report.html")
assert abs(run.workpiece().volume - {left!r}) < 0.02 * {left!r}, run.workpiece().volume
assert str(run.explain(2)) and run._repr_html_()
assert all(str(mnclab.help(code, {name!r})) for code in mnclab.controls[{name!r}].cycles)
for door in (
    lambda: mnclab.Design, lambda: mnclab.design.Hole, lambda: mnclab.form, lambda: mnclab.exercise, lambda: run.design()
):
    try:
        door()
    except mnclab.Alarm as alarm:
        assert "was left out of this mnclab" in str(alarm), alarm
    else:
        raise AssertionError("a door opened into a wing that is not there")
"""


@pytest.fixture(scope="module")
def core(tmp_path_factory):
    """A copy of the house without any wing."""
    home = tmp_path_factory.mktemp("core")
    home.joinpath("tests").mkdir()
    leave = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "mnclab", home / "mnclab", ignore=leave)
    for wing in WINGS:
        shutil.rmtree(home / "mnclab" / wing)
    return home


def test_the_tests_of_the_core_import_no_wing():
    for folder in ("tools", *FLOORS):
        for file in (ROOT / "tests" / folder).glob("*.py"):
            found = WING.search(file.read_text("utf-8"))
            assert not found, f"tests/{folder}/{file.name} says {found[0]}: it belongs into the folder of that wing"


@pytest.mark.deep
@pytest.mark.parametrize("folder", ALONE)
def test_the_core_with_one_control_runs(core, folder):
    name, text, setup, left = ALONE[folder]
    shutil.copytree(ROOT / "mnclab" / "controls" / folder, core / "mnclab" / "controls" / folder)
    try:
        script = SCRIPT.format(home=str(core), name=name, text=text, setup=setup, left=left)
        command = [sys.executable, "-c", script]
        found = subprocess.run(command, cwd=core, capture_output=True, text=True, env={"MPLBACKEND": "agg"})
        assert found.returncode == 0, found.stderr[-3000:]
    finally:
        shutil.rmtree(core / "mnclab" / "controls" / folder)


@pytest.mark.deep
def test_the_core_passes_its_own_tests(core):
    """With one control, and without the folders of tests of all others."""
    shutil.copytree(ROOT / "mnclab" / "controls" / "mnc", core / "mnclab" / "controls" / "mnc")
    for name in ("conftest.py", "tools", "authorities", *RUN_ALONE):
        (shutil.copytree if (ROOT / "tests" / name).is_dir() else shutil.copy)(ROOT / "tests" / name, core / "tests" / name)
    shutil.copy(ROOT / "pyproject.toml", core)
    files = [file for name in RUN_ALONE for file in sorted((core / "tests" / name).glob("test_*.py"))]
    chosen = [file for file in files if not NAMES_ANOTHER.search(file.read_text("utf-8"))]
    assert len(chosen) > len(files) / 3
    environment = os.environ | {"MPLBACKEND": "agg", "PYTHONPATH": str(core)}
    try:
        command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-m", "not deep", *chosen]
        found = subprocess.run(command, cwd=core, capture_output=True, text=True, env=environment)
        assert found.returncode == 0, found.stdout[-3000:] + found.stderr[-1000:]
    finally:
        shutil.rmtree(core / "mnclab" / "controls" / "mnc")
