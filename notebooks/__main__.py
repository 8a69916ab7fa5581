"""`python3 notebooks` opens JupyterLab on the first lesson; what else is typed goes to JupyterLab."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / ".setup"))

from environment import run

options = ["--LabApp.default_url=/lab/tree/notebooks/00_first_path.ipynb"]
if hasattr(os, "geteuid") and os.geteuid() == 0:
    options += ["--allow-root"]
run("lab", "jupyterlab", *options, *sys.argv[1:])
