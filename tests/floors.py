"""A short sample of the tests with the lowest versions that pyproject.toml declares, in a virtual environment of their own.

    python3 tests/floors.py [folder of the environment]

Lowest versions have no wheels for a Python that is newer than they are: 3.11 and 3.12 run the sample, others say so.
"""

import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SAMPLE = [
    "tests/t1_geometry/test_dxf_blocks.py", "tests/t3_workpiece/test_part_mesh.py",
    "tests/t3_workpiece/test_collisions_lathe.py", "tests/t6_show/test_plot_regions.py",
    "tests/t6_show/test_plot_strategy.py", "tests/t6_show/test_export_read_back.py", "tests/t6_show/test_site.py",
]  # fmt: skip
INSTALLED_ALONE = "jupyterlab"  # no module of it is imported: it finds the extension by itself


def floors() -> dict[str, str]:
    """The lowest version of each package, as declared."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    words = [*project["dependencies"], *extras["lab"], *extras["dxf"], *extras["site"]]
    return {name: low for name, low in (re.fullmatch(r"([\w-]+)>=([\d.]+)", word).groups() for word in words)}


def main() -> int:
    if sys.version_info >= (3, 13):
        print("the lowest versions have no wheels for this Python; 3.11 and 3.12 run them")
        return 0
    with tempfile.TemporaryDirectory() as made:
        folder = Path(sys.argv[1] if len(sys.argv) > 1 else made) / "floors"
        python = folder / "bin/python"
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        lowest = [f"{name}=={low}" for name, low in floors().items() if name != INSTALLED_ALONE]
        print("with", " ".join(lowest), flush=True)
        others = ["pytest>=8.2", "hypothesis", "pyyaml"]
        subprocess.run([python, "-m", "pip", "install", "-qq", "--only-binary=:all:", *lowest, *others], check=True)
        mark = "not deep and not browser and not benchmark"
        return subprocess.run([python, "-m", "pytest", "-p", "no:cacheprovider", "-m", mark, *SAMPLE], cwd=ROOT).returncode


if __name__ == "__main__":
    sys.exit(main())
