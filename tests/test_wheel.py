"""What is installed is whole: the wheel carries the lessons and their data, and runs without the sources."""

import shutil
import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest

import mnclab

ROOT = Path(__file__).resolve().parent.parent
LESSON = """import nbformat, sys
from nbclient import NotebookClient
notebook = nbformat.read(sys.argv[1], as_version=4)
NotebookClient(notebook, timeout=100, kernel_name="python3", resources={"metadata": {"path": "notebooks"}}).execute()
print(sum(bool(cell.get("outputs")) for cell in notebook.cells))"""


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The names in the wheel, and the Python of an environment that has the wheel and what it needs."""
    folder = tmp_path_factory.mktemp("wheel")
    source = folder / "source"
    for name in ("mnclab", "data", "notebooks", "tests"):
        shutil.copytree(ROOT / name, source / name, ignore=shutil.ignore_patterns("__pycache__", ".ipynb_checkpoints"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, source)
    subprocess.run([sys.executable, "-m", "pip", "wheel", "-qq", "--no-deps", "-w", folder, source], check=True)
    (wheel,) = folder.glob("*.whl")
    environment = folder / "environment"
    venv.create(environment, with_pip=True)
    python = environment / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "-qq", "--no-deps", wheel], check=True)
    (site,) = environment.glob("lib/*/site-packages")
    (site / "needed.pth").write_text(sysconfig.get_path("purelib"))  # what mnclab needs, from the environment of the tests
    return zipfile.ZipFile(wheel).namelist(), python


@pytest.mark.deep
def test_a_wheel_is_whole_and_runs_alone(built, tmp_path):
    names, python = built
    inside = {name for name in names if name.startswith("mnclab/")}
    assert {"mnclab/py.typed", "mnclab/area.pyi", "mnclab/__init__.pyi", "mnclab/shell/pages/page.html.jinja2"} <= inside
    assert "mnclab/course/data/exercises/mnc/mnc-07.toml" in inside
    assert any("share/jupyter/labextensions/mnclab/package.json" in name for name in names)
    assert not [name for name in names if "tests/" in name or "__pycache__" in name]

    def shell(*typed):
        done = subprocess.run([python.with_name("mnclab"), *typed], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert mnclab.__version__ in shell("--version")
    shell("lessons", "course")
    assert len(list((tmp_path / "course/notebooks").glob("*.ipynb"))) == len(list((ROOT / "notebooks").glob("*.ipynb")))
    shell("check", "course/data/programs/mnc/square.mnc")
    assert "small-mill" in shell("time", "course/data/programs/mnc/square.mnc", "--machine", "small-mill")
    asked = "import mnclab; print(mnclab.__file__, mnclab.exercise('mnc-07').title, mnclab.area.Region)"
    said = subprocess.run([python, "-c", asked], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert "environment" in said and mnclab.exercise("mnc-07").title in said
    run = [python, "-c", LESSON, "notebooks/00_first_path.ipynb"]
    assert int(subprocess.run(run, cwd=tmp_path / "course", capture_output=True, text=True, check=True).stdout) >= 8
