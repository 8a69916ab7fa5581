"""The virtual environment `.venv` beside the library: made when first needed, renewed with pyproject.toml.

`python3 notebooks` and `python3 tests` both enter through `run`. Nothing may be installed yet, so this file
needs the standard library alone, and an old Python must get as far as the sentence that refuses it.
"""

import ctypes.util
import hashlib
import importlib
import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
VERSION = f"{sys.version_info[0]}.{sys.version_info[1]}"
NOWHERE = subprocess.DEVNULL
EXTRAS = ("lab", "test")  # of pyproject.toml; each contains those before it


def run(extra, *arguments):
    """Go on as `python -m ARGUMENTS` where the library and the extra are installed; does not return."""
    prepare(extra)
    os.chdir(str(ROOT))
    os.environ["PATH"] = str(PYTHON.parent) + os.pathsep + os.environ.get("PATH", "")
    command = [str(PYTHON), "-m"] + list(arguments)
    if os.name != "nt":
        os.execv(command[0], command)  # signals and the exit status are the command's own from here
    child = subprocess.Popen(command)
    while True:
        try:
            sys.exit(child.wait())
        except KeyboardInterrupt:
            pass  # Ctrl-C is for the child to answer


def prepare(extra):
    """Make `.venv` with the extra in it, unless that was done before for the same pyproject.toml."""
    if sys.version_info < (3, 11):  # noqa: UP036
        sys.exit(f"mnclab needs Python 3.11 or newer; this is Python {VERSION}.")
    stamps = {name: VENV / f"{name}.installed" for name in EXTRAS}
    if PYTHON.exists() and stamps[extra].exists() and stamps[extra].read_text() == state():
        return
    install_debian_packages()
    if not (PYTHON.exists() and succeeds([PYTHON, "-m", "pip", "--version"], stdout=NOWHERE, stderr=NOWHERE)):
        say("Making the virtual environment .venv ...")
        if not succeeds([sys.executable, "-m", "venv", "--clear", VENV]):
            sys.exit("Python could not make the virtual environment; the lines above say why.")
    say(f"Installing mnclab[{extra}] into .venv; the first time takes a minute or two and 1 GB ...")
    if not succeeds([PYTHON, "-m", "pip", "install", "-qq", "-e", f".[{extra}]"]):
        sys.exit("pip could not install the packages; the lines above say why.")
    for name in EXTRAS[: EXTRAS.index(extra) + 1]:
        stamps[name].write_text(state())


def state():
    """What an installation depends on or copies; a change of any of it installs again."""
    copied = sorted(path for path in (ROOT / "mnclab/lab/labextension").rglob("*") if path.is_file())
    contents = [path.read_bytes() for path in [ROOT / "pyproject.toml", *copied]]
    return hashlib.sha256(b"\n".join([os.fsencode(ROOT), VERSION.encode(), *contents])).hexdigest()


def install_debian_packages():
    """Install what Debian keeps apart: Python's venv, and what draws 3D scenes without a screen."""
    missing = []
    if not importlib.util.find_spec("ensurepip"):
        missing += [f"python{VERSION}-venv"]
    if sys.platform == "linux" and not ctypes.util.find_library("EGL"):
        missing += ["libegl1", "libgl1-mesa-dri"]
    if missing:
        names = " ".join(missing)
        if shutil.which("apt-get") and os.geteuid() == 0:
            say(f"Installing the Debian packages {names} ...")
            os.environ.setdefault("DEBIAN_FRONTEND", "noninteractive")
            succeeds(["apt-get", "update", "-qq"], stdout=NOWHERE)
            succeeds(["apt-get", "install", "-y", "-qq", "--no-install-recommends", *missing], stdout=NOWHERE)
            importlib.invalidate_caches()
        else:
            say(f"Missing here: {names}. On Debian, root installs them: apt-get install {names}")
    if not importlib.util.find_spec("ensurepip"):
        sys.exit(f"Without python{VERSION}-venv there can be no virtual environment.")


def succeeds(command, **streams):
    """Whether a command, run in the project's folder, ends with status 0."""
    return subprocess.call([str(part) for part in command], cwd=str(ROOT), **streams) == 0


def say(sentence):
    """Tell the user what takes time."""
    print(sentence, flush=True)
