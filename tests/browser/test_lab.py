"""JupyterLab shows what people come for."""

import json
import re
from pathlib import Path

import pytest

NOTEBOOKS = sorted((Path(__file__).resolve().parents[2] / "notebooks").glob("*.ipynb"))
LIVE = re.compile(r"\b(?:player|editor|\w*panel|form)\(")


def is_live(path):
    """Whether something of a lesson lives in the page; the others run without one in the deep tests."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    code = ("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    return any(LIVE.search(source) for source in code if not source.startswith("# your"))


LESSONS = [path.name for path in NOTEBOOKS if is_live(path)]

FIGURE = """
import matplotlib.pyplot as plt
plt.plot([0, 1], [0, 1]);
"""


@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_runs_from_top_to_bottom(run_lesson, name):
    page = run_lesson(name)
    assert page.locator("[data-mime-type='application/vnd.jupyter.stderr']").all_inner_texts() == []


def test_a_figure_shows(run_cells):
    page = run_cells(FIGURE)
    assert page.locator(".jp-OutputArea-output img").count() == 1
