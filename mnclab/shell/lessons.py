"""Where the lessons are, and the command `lab`, which opens them in JupyterLab."""

from __future__ import annotations

import argparse
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

from mnclab.shell.saying import USAGE

FIRST_LESSON = "00_first_path.ipynb"


def home() -> Path | None:
    """The folder that holds `notebooks`: that of this mnclab, or the one where the command was started."""
    places = (Path(__file__).resolve().parents[2], Path.cwd())
    return next((place for place in places if (place / "notebooks" / FIRST_LESSON).is_file()), None)


def lab(chosen: argparse.Namespace) -> int:
    """Start JupyterLab on the first lesson, with the Python that runs this."""
    if importlib.util.find_spec("jupyterlab") is None:
        print('mnclab: JupyterLab is not installed here; pip install "mnclab[lab]" brings it', file=sys.stderr)
        return USAGE
    place = home()
    if place is None:
        print("mnclab: the lessons are not here; start this in the folder that holds notebooks/", file=sys.stderr)
        return USAGE
    options = [f"--LabApp.default_url=/lab/tree/notebooks/{FIRST_LESSON}"]
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        options.append("--allow-root")
    command = subprocess.Popen([sys.executable, "-m", "jupyterlab", *options, *chosen.rest], cwd=place)
    while True:
        try:
            return command.wait()
        except KeyboardInterrupt:
            pass  # Ctrl-C is for JupyterLab to answer
