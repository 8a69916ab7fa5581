"""Every example in a docstring runs and says what stands there; every name of the front door and of the shelves has one.

In an example `mnc` is mnclab, beside what its own file has. They run in a folder of their own, which has the `data`.
"""

import doctest
import importlib
import inspect
from pathlib import Path

import pytest

import mnclab
from mnclab.shell.reference import public

ROOT = Path(__file__).parent.parent
FILES = [
    path.relative_to(ROOT) for path in sorted((ROOT / "mnclab").rglob("*.py")) if "\n    >>> " in path.read_text("utf-8")
]  # fmt: skip
NEEDS = {"lab": "ipywidgets", "plot": "matplotlib"}  # of a folder: what its examples need

#: Names without an example, page by page: the list may only become shorter.
WITHOUT = {
    "mnclab.area": {"Contour", "Joined", "arc", "dxf", "polygon", "rectangle", "slot"},
    "mnclab.design": {"CentreHole", "Undercut"},
    "mnclab.part": {"mesh"},
    "mnclab.schemes": {"plot_threads", "toolpath"},
    "mnclab.schemes.grooves": {"scheme_1", "scheme_2", "scheme_3", "scheme_4", "scheme_5", "scheme_6", "scheme_7"},
    "mnclab.schemes.threads": {"edge_shares", "methods_for", "thread", "thread_pass", "thread_passes"},
    "mnclab.strategies": {"engagement", "plot_times", "rest_passes", "stretches", "trochoid"},
}  # fmt: skip


@pytest.mark.parametrize("file", FILES, ids=str)
def test_examples_run(file, tmp_path, monkeypatch):
    for folder in file.parts:
        if folder in NEEDS:
            pytest.importorskip(NEEDS[folder])
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    module = importlib.import_module(".".join(file.with_suffix("").parts).removesuffix(".__init__"))
    doctests = doctest.DocTestFinder(exclude_empty=True).find(module, extraglobs={"mnc": mnclab})
    runner, told = doctest.DocTestRunner(), []
    for each in doctests:
        runner.run(each, out=told.append)
    assert runner.summarize(verbose=False).attempted > 0
    assert not runner.failures, "".join(told)


def lacking():
    """Page -> the functions and classes whose docstrings have no example."""
    for page, names in public().items():
        without = {name for name, each in names.items() if callable(each) and ">>> " not in (inspect.getdoc(each) or "")}
        if without:
            yield page, without


def test_every_name_has_an_example():
    """The list is kept true: a name that has an example now is taken off it."""
    assert dict(lacking()) == WITHOUT
    assert "mnclab" not in WITHOUT  # the front door has them all
