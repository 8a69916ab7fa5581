"""What every test shares: pictures without a screen, examples without chance, the option --rewrite, the run of a module."""

import functools
import gc
import os

import pytest

import mnclab
from mnclab.runs import lint

os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
os.environ.setdefault("MPLBACKEND", "agg")


@functools.cache
def without_chance():
    """Examples of hypothesis: the same ones every time, unless HYPOTHESIS_PROFILE is `long`."""
    from hypothesis import settings

    settings.register_profile("ci", deadline=None, derandomize=True, max_examples=60)
    settings.register_profile("long", deadline=None, max_examples=3000)
    settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))


def pytest_pycollect_makemodule(module_path):
    """Set hypothesis up before a file that uses it is imported; for the others its import costs half their time."""
    if "hypothesis" in module_path.read_text(encoding="utf-8"):
        without_chance()


def pytest_addoption(parser):
    """Add the option that renews golden listings."""
    parser.addoption("--rewrite", action="store_true", help="write golden listings anew for review")


def pytest_ignore_collect(collection_path, config):
    """Of `-m deep` and its like only those files are imported that say so: most do not, and importing all takes a while.

    For the same reason the folders of the browser and of time are passed over where neither is wanted, and files that are deep
    as a whole where nothing deep is.
    """
    mark = config.option.markexpr
    if collection_path.name in ("browser", "benchmarks") and "not browser" in mark and "not benchmark" in mark:
        return True
    if not collection_path.match("test_*.py") or not ("not deep" in mark or mark in ("deep", "browser", "benchmark")):
        return None
    text = collection_path.read_text(encoding="utf-8")
    if "not deep" in mark:
        return "\npytestmark = pytest.mark.deep\n" in text or None
    return mark not in collection_path.parts and mark not in text or None


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Thousands of tests are made and all of them stay: garbage is looked for once, after that, and never among them."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.collect()
        gc.freeze()
        gc.enable()


@pytest.fixture
def rewrite(request) -> bool:
    """Whether golden listings are to be written instead of compared."""
    return request.config.getoption("rewrite")


@pytest.fixture(autouse=True)
def fragments(request, monkeypatch) -> None:
    """Most tests of machines and controls run fragments that start no spindle: only those marked so hear what lint says."""
    folder = request.path.relative_to(request.config.rootpath / "tests").parts[0]
    if (folder[:2] in ("t2", "t3", "t4") or folder in ("controls", "design")) and not request.node.get_closest_marker("lint"):
        monkeypatch.setattr(lint, "remarks", lambda run, m: ())


@pytest.fixture(scope="module")
def run(request) -> mnclab.Run:
    """What the PROGRAM of a test module does, with its SETUP and on its CONTROL, if it has them."""
    module = request.module
    return mnclab.run(module.PROGRAM, getattr(module, "CONTROL", "mnc"), getattr(module, "SETUP", None))
