"""`python3 tests` runs the fast tests on all cores; what else is typed goes to pytest.

`python3 tests -m deep` runs the deep ones, `-m browser` those in JupyterLab, `-m benchmark` those that measure time.
Tests of one file or folder, of the browser and of time run one after the other.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / ".setup"))

from environment import ROOT, run

FAST = "not deep and not browser and not benchmark"

typed = sys.argv[1:]
named = any((ROOT / argument.partition("::")[0]).exists() for argument in typed if not argument.startswith("-"))
marked = "-m" in typed
alone = named or {"browser", "benchmark"} & set(typed) or {"-n", "--version", "--help"} & set(typed)
chosen = [] if named or marked else ["-m", FAST]
cores = [] if alone else ["-n", "auto", "--dist", "worksteal"]
run("test", "pytest", *chosen, *cores, *typed)
