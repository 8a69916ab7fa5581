"""The sample programs: each says where it comes from, and runs clean on the control of its folder."""

from pathlib import Path

import pytest

import mnclab

PROGRAMS = sorted(path for path in Path(__file__).parents[2].glob("data/programs/*/*") if path.is_file())


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: "/".join(path.parts[-2:]))
def test_a_sample_runs_clean(path):
    run = mnclab.run(path)  # its suffix says which control
    assert run.control.name == path.parent.name
    assert not run.alarms and len(run.toolpath)


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: "/".join(path.parts[-2:]))
def test_a_sample_names_its_origin_in_its_first_line(path):
    first = path.read_text("utf-8").removeprefix("%\n").splitlines()[0]
    assert first.rstrip(" )").endswith("Made for this project.") or "Source:" in first


LATHES = [path for path in PROGRAMS if path.parent.name in ("jnc-t01", "nc-31")]


@pytest.mark.parametrize("path", LATHES, ids=lambda path: path.name)
def test_what_a_lathe_shows_speaks_of_no_mill(path, tmp_path):
    run = mnclab.run(path)
    shown = run.report(tmp_path / "page.html").read_text("utf-8") + repr(run.setup) + run._repr_html_()
    assert "end mill" not in shown and "roughing insert" in repr(run.setup)
