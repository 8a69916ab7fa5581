"""JupyterLab shows what people come for."""

from pathlib import Path

import pytest

FIRST = Path(__file__).resolve().parent.parent.parent / "notebooks" / "00_first_path.ipynb"

FIGURE = """
import matplotlib.pyplot as plt
plt.plot([0, 1], [0, 1]);
"""


@pytest.mark.skipif(not FIRST.exists(), reason="there is no first lesson yet")
def test_first_lesson_runs_from_top_to_bottom(run_lesson):
    run_lesson(FIRST.name)


def test_a_figure_shows(run_cells):
    page = run_cells(FIGURE)
    assert page.locator(".jp-OutputArea-output img").count() == 1
