"""What a wheel without extras says: one line that names the extra, at every door and every command that needs it."""

import sys

import pytest

import mnclab
from mnclab import Alarm
from mnclab import __main__ as shell
from mnclab.geometry import dxf

PROGRAM = "T1 S500 M3\nG0 X0 Y0 Z5\nG1 X10 F100\nG1 Y20\n"
LAB, DXF = 'pip install "mnclab[lab]" brings it', 'pip install "mnclab[dxf]" brings it'


@pytest.fixture(autouse=True)
def without(monkeypatch):
    """without("matplotlib") makes Python say that a package is not there."""

    def missing(*packages):
        for name in list(sys.modules):
            if name.split(".")[0] in packages or name.startswith("mnclab.show.plot"):
                monkeypatch.delitem(sys.modules, name)
        for package in packages:
            monkeypatch.setitem(sys.modules, package, None)

    return missing


PICTURES = {
    "plot": lambda run, folder: run.plot(),
    "plot of a path": lambda run, folder: run.toolpath.plot(),
    "plot_speed": lambda run, folder: run.plot_speed(),
    "plot_compensation": lambda run, folder: run.plot_compensation(),
    "profile": lambda run, folder: run.profile().plot(),
    "diff": lambda run, folder: mnclab.diff(run, run).plot(),
    "svg": lambda run, folder: run.save(folder / "a.svg"),
    "pdf": lambda run, folder: run.save(folder / "a.pdf"),
    "png": lambda run, folder: run.save(folder / "a.png"),
    "report": lambda run, folder: run.report(folder / "a.html"),
    "pdf report": lambda run, folder: run.report(folder / "a.pdf"),
    "form": lambda run, folder: mnclab.form("G83", "mnc"),
    "panel": lambda run, folder: mnclab.panel("G0 X{x}\n", "mnc", x=5),
    "editor": lambda run, folder: mnclab.editor(str(folder / "a.mnc"), "mnc"),
}
BOXES = ["form", "panel", "editor"]


@pytest.mark.parametrize("door", PICTURES)
def test_pictures_name_matplotlib(run, tmp_path, without, door):
    pytest.importorskip("ipywidgets")
    without("matplotlib")
    with pytest.raises(Alarm) as caught:
        PICTURES[door](run, tmp_path)
    assert "matplotlib" in caught.value.message and LAB in caught.value.hint
    assert not [path for path in tmp_path.iterdir() if path.suffix != ".mnc"]


@pytest.mark.parametrize("door", [*BOXES, "compensation_panel", "profile_panel", "pocket_panel"])
def test_boxes_name_ipywidgets(run, tmp_path, without, door):
    assert callable(mnclab.form)  # what its file imports is not tried here
    without("ipywidgets", "matplotlib")
    with pytest.raises(Alarm) as caught:
        if door in BOXES:
            PICTURES[door](run, tmp_path)
        else:
            given = {"compensation_panel": run, "profile_panel": run.profile()}
            getattr(mnclab, door)(given.get(door))
    assert "ipywidgets" in caught.value.message and LAB in caught.value.hint


def test_scenes_name_pyvista_and_what_turns_them(run, without):
    without("pyvista")
    with pytest.raises(Alarm, match="3D scenes need pyvista") as caught:
        run.scene()
    assert LAB in caught.value.hint


def test_cells_name_ipython(without):
    without("IPython")
    with pytest.raises(Alarm, match="need IPython") as caught:
        mnclab.load_ipython_extension(None)
    assert LAB in caught.value.hint


def test_drawings_name_ezdxf(tmp_path, without):
    without("ezdxf")
    with pytest.raises(Alarm, match="need ezdxf") as caught:
        dxf.contours(tmp_path / "a.dxf")
    assert DXF in caught.value.hint
    with pytest.raises(Alarm, match="DXF drawings need ezdxf") as caught:
        mnclab.design.Design(((0, 0, -5), (10, 10, 0))).save(tmp_path / "b.dxf")
    assert DXF in caught.value.hint and not list(tmp_path.iterdir())


def test_a_package_that_is_broken_counts_as_missing(run, tmp_path, without, monkeypatch):
    """It is there, but a part of it is not."""
    without("matplotlib")
    monkeypatch.delitem(sys.modules, "matplotlib")
    (tmp_path / "matplotlib.py").write_text("import a_part_that_is_not_there\n")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(Alarm, match="matplotlib"):
        run.plot()


NEEDED = [
    ["plot", "a.mnc", "-o", "a.svg"], ["plot", "a.mnc", "-o", "a.png"], ["plot", "a.mnc", "-o", "a.pdf"],
    ["plot", "a.mnc", "-o", "a.svg", "--compensation"], ["report", "a.mnc", "-o", "a.html"], ["report", "a.mnc", "-o", "a.pdf"],
    ["lab"],
]  # fmt: skip
SPARED = [
    ["check", "a.mnc"], ["run", "a.mnc"], ["run", "a.mnc", "--json"], ["time", "a.mnc"], ["help", "G83", "--control", "mnc"],
    *(["plot", "a.mnc", "-o", f"a.{suffix}"] for suffix in ("html", "csv", "json", "dxf", "ngc", "stl", "gltf", "glb", "vtk")),
]  # fmt: skip
EXTRAS = ("matplotlib", "pyvista", "vtkmodules", "ipywidgets", "jupyterlab", "IPython", "ezdxf", "tqdm")


@pytest.mark.deep
@pytest.mark.parametrize("arguments", NEEDED + SPARED, ids=" ".join)
def test_commands_without_any_extra(tmp_path, monkeypatch, capsys, without, arguments):
    (tmp_path / "a.mnc").write_text(PROGRAM)
    monkeypatch.chdir(tmp_path)
    without(*EXTRAS)
    try:
        status = shell.main(arguments)
    except SystemExit as end:
        status = end.code
    told = capsys.readouterr().err
    if arguments in NEEDED:
        assert status == 2 and told.count("\n") == 1 and LAB in told and len(list(tmp_path.iterdir())) == 1
    else:
        assert status == 0 and told == ""
