"""Where the lessons are: `lab` opens them in JupyterLab, `lessons` copies those of an installed mnclab."""

from __future__ import annotations

import argparse
import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

from mnclab.shell.saying import CLEAN, USAGE
from mnclab.text.file import COURSE

FIRST_LESSON = "00_first_path.ipynb"
LEFT_OUT = shutil.ignore_patterns("__main__.py", "__pycache__", ".*", "progress.json", "exercises")


def home() -> Path | None:
    """The folder that holds `notebooks`: the one where the command was started, or that of the sources."""
    places = [Path.cwd()] + ([] if COURSE.name == "course" else [COURSE])
    return next((place for place in places if (place / "notebooks" / FIRST_LESSON).is_file()), None)


def lessons(chosen: argparse.Namespace) -> int:
    """Copy the lessons, and the programs, setups and designs that they use."""
    out = Path(chosen.folder)
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        print(f"mnclab: {out} is there already, and something is in it: name another folder", file=sys.stderr)
        return USAGE
    for name in ("notebooks", "data"):
        shutil.copytree(COURSE / name, out / name, ignore=LEFT_OUT, dirs_exist_ok=True)
    print(f"{out}: {len(list(out.glob('notebooks/*.ipynb')))} lessons. To open them, in that folder: mnclab lab")
    return CLEAN


def lab(chosen: argparse.Namespace) -> int:
    """Start JupyterLab on the first lesson, with the Python that runs this."""
    if importlib.util.find_spec("jupyterlab") is None:
        print('mnclab: JupyterLab is not installed here; pip install "mnclab[lab]" brings it', file=sys.stderr)
        return USAGE
    place = home()
    if place is None:
        said = "the lessons are not here; `mnclab lessons` copies them; start this in the folder that holds notebooks/"
        print(f"mnclab: {said}", file=sys.stderr)
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
