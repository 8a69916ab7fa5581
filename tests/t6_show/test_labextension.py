"""The Lab extension is where JupyterLab looks for it; what it does is tested in a browser (tests/browser)."""

import json
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

import mnclab

ROOT = Path(__file__).parent.parent.parent
FOLDER = ROOT / "mnclab" / "show" / "labextension"


def test_it_is_installed_where_jupyterlab_looks():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    shared = project["tool"]["hatch"]["build"]["targets"]["wheel"]["shared-data"]
    assert shared == {"mnclab/show/labextension": "share/jupyter/labextensions/mnclab"}
    package = json.loads((FOLDER / "package.json").read_text("utf-8"))
    assert (package["name"], package["version"]) == ("mnclab", mnclab.__version__)
    assert (FOLDER / package["jupyterlab"]["_build"]["load"]).is_file()


def test_every_control_has_its_suffix_coloured():
    script = (FOLDER / "static" / "remoteEntry.js").read_text("utf-8")
    for control in mnclab.controls.values():
        for suffix in control.suffixes:
            assert f"'{suffix[1:]}'" in script or f"\\{suffix}$" in script, suffix


def test_the_script_is_javascript():
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not installed; the browser tests run the script")
    subprocess.run([node, "--check", FOLDER / "static" / "remoteEntry.js"], check=True)
