"""Where no thread can be started and there is no pyvista, as in a browser's Python: all but bodies in space works."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LIVE = re.compile(r"\b(?:player|editor|\w*panel|form)\(")
#: Lessons in which something lives, but for those that show a body in space or mark a class, each answer in a process.
LESSONS = [
    path for path in sorted((ROOT / "notebooks").glob("*.ipynb"))
    if LIVE.search(text := path.read_text("utf-8")) and "scene(" not in text and "mnc.mark(" not in text
]  # fmt: skip
BARE = """
import sys, threading

def refused(thread):
    raise RuntimeError("can't start new thread")

threading.Thread.start = refused
sys.modules["pyvista"] = sys.modules["vtk"] = sys.modules["jupyterlab"] = None
"""
BOXES = """
import mnclab as mnc

form = mnc.form("G83", "mnc")
before = form.picture.value
form.boxes["peck_depth"].value = 1.5
assert form.picture.value != before and "data:image" in form.picture.value
panel = mnc.panel("G17 G90 S900 M3\\nG0 X0 Y0 Z5\\nG1 Z-{depth} F100\\nX40 Y{depth}\\n", "mnc", depth=3)
shown = panel.picture.value
panel.boxes["depth"].value = 7
assert panel.picture.value != shown and "data:image" in shown
editor = mnc.editor(PATH)
editor.boxes["text"].value = "G17 G90\\nG0 X1 Y1 Z1\\nG5 X2\\n"
assert "G5" in editor.run.alarms[0].message and "G5" in editor.alarms.value and "data:image" in editor.picture.value
run = mnc.run("G17 G90\\nG0 X0 Y0 Z5\\nG1 Z-1 F100\\nX30\\n", "mnc", stock=(40, 20, 10))
assert "<canvas" in run.player()._repr_html_() or "<iframe" in run.player()._repr_html_()
run.plot(), run.profile().plot(), run.workpiece().plot()
try:
    mnc.mark(FOLDER)
    raise SystemExit("marked")
except mnc.Alarm as alarm:
    assert "none can be begun" in alarm.message
assert threading.active_count() == 1
"""
LESSON = """
import json
from IPython.core.interactiveshell import InteractiveShell
from traitlets.config import Config

settings = Config()
settings.HistoryManager.enabled = False
shell = InteractiveShell.instance(config=settings)
shell.display_pub.publish = lambda *given, **options: None
for cell in json.load(open(PATH, encoding="utf-8"))["cells"]:
    source = "".join(cell["source"])
    if cell["cell_type"] == "code" and not source.startswith("!"):
        done = shell.run_cell(source, silent=True)
        shown = done.result
        for way in ("_repr_mimebundle_", "_repr_html_"):
            if hasattr(shown, way):
                getattr(shown, way)()
        done.raise_error()
assert threading.active_count() == 1
"""


def run(code, folder):
    found = subprocess.run([sys.executable, "-c", BARE + code], capture_output=True, text=True, cwd=folder)
    assert found.returncode == 0, found.stderr[-3000:]


def test_forms_panels_editor_player(tmp_path):
    answer = tmp_path / "class" / "anna" / "mnc-03.mnc"
    answer.parent.mkdir(parents=True)
    answer.write_text("G90 X0\n")
    run(BOXES.replace("PATH", repr(str(tmp_path / "a.mnc"))).replace("FOLDER", repr(str(tmp_path / "class"))), tmp_path)


@pytest.mark.deep
@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_a_lesson(lesson, tmp_path):
    run(LESSON.replace("PATH", repr(str(lesson))), lesson.parent)
