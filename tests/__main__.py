"""`python3 tests` runs the tests; what else is typed goes to pytest."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / ".setup"))

from environment import run

run("test", "pytest", *sys.argv[1:])
