"""The Lab extension is where JupyterLab looks for it; what it does is tested in a browser (tests/browser)."""

import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

import mnclab
from mnclab.lab.vocabulary import vocabulary

ROOT = Path(__file__).parent.parent.parent
FOLDER = ROOT / "mnclab" / "lab" / "labextension"


def test_it_is_installed_where_jupyterlab_looks():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    shared = project["tool"]["hatch"]["build"]["targets"]["wheel"]["shared-data"]
    assert shared == {"mnclab/lab/labextension": "share/jupyter/labextensions/mnclab"}
    package = json.loads((FOLDER / "package.json").read_text("utf-8"))
    assert (package["name"], package["version"]) == ("mnclab", mnclab.__version__)
    assert (FOLDER / package["jupyterlab"]["_build"]["load"]).is_file()


def test_every_control_has_its_suffix_coloured():
    script = "".join((FOLDER / "static" / name).read_text("utf-8") for name in ("languages.js", "remoteEntry.js"))
    for control in mnclab.controls.values():
        for suffix in control.suffixes:
            assert f"'{suffix[1:]}'" in script or f"\\{suffix}$" in script, suffix


def test_the_words_are_those_that_the_controls_declare(rewrite):
    """`python3 tests tests/lab/test_labextension.py --rewrite` writes them anew after a cycle has changed."""
    file = FOLDER / "static" / "words.json"
    told = {}
    for name, control in mnclab.controls.items():
        known = vocabulary(control)
        told[name] = known._asdict() | {"codes": {code: list(one) for code, one in known.codes.items()}}
    if rewrite:
        file.write_text(json.dumps(told, ensure_ascii=False, separators=(",", ":"), indent=0) + "\n", "utf-8")
    assert json.loads(file.read_text("utf-8")) == told


def test_no_word_is_offered_that_nobody_writes():
    """A call of its own accord (G66 after a motion) is no code, and one that is always refused (JNC: N, M2, M30) no help."""
    offered = {name: vocabulary(control).codes.keys() for name, control in mnclab.controls.items()}
    assert "G66" in offered["g43"] and "G66 again" not in offered["g43"]
    assert not offered["jnc-t01"] & {"N", "M2", "M30"}


def test_every_control_has_words_to_point_at():
    script = (FOLDER / "static" / "languages.js").read_text("utf-8")
    assert {f"control: '{name}'" in script for name in mnclab.controls} == {True}


@pytest.mark.parametrize(
    "name", ["remoteEntry.js", "languages.js", "words.js", "hover.js", "editor.js", "forms.js", "completer.js"]
)
def test_the_script_is_javascript(name, tmp_path):
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not installed; the browser tests run the script")
    script = FOLDER / "static" / name
    if name != "remoteEntry.js":  # the others are modules
        script = shutil.copy(script, tmp_path / name.replace(".js", ".mjs"))
    subprocess.run([node, "--check", script], check=True)


PROBES = ("// said", "/ / said", "; said", "(said)", "' said")


@pytest.mark.parametrize("name", mnclab.controls)
def test_what_is_coloured_as_a_comment_is_one_to_the_control(name):
    """The authority is the reader of the control: behind its own mark stands a comment, and nothing else is one."""
    script = (FOLDER / "static" / "languages.js").read_text("utf-8")
    mark = re.compile(mnclab.controls[name].read("", "").comment_mark)
    rule = r".*?(?:ISO\(|\[)/((?:[^/\\\n]|\\.)+)/y(?:\)|, 'comment'\])"
    languages = re.findall(rf"\{{\s*name: '[^']*', control: '{name}',{rule}", script, re.S)
    assert languages
    for pattern in languages:
        if pattern == r"\s+":
            continue
        for probe in PROBES:
            assert bool(re.match(pattern, probe)) == bool(mark.match(probe)), (pattern, probe)
