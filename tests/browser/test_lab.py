"""JupyterLab shows what people come for."""

from pathlib import Path

import pytest

LESSONS = sorted(path.name for path in (Path(__file__).resolve().parents[2] / "notebooks").glob("*.ipynb"))

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
