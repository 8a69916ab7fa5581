"""Files of a user: read whole and within a bound, written beside and then put in their place.

Read are files alone, no device and no pipe, which may never end or never begin. A file that is written is either whole or
as it was: the new one grows under a name of its own in the same folder and takes the place at the end.
"""

from __future__ import annotations

import os
import secrets
import stat
import time
import zlib
from collections.abc import Collection, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from mnclab.text.alarm import Alarm
from mnclab.text.given import shown

LARGEST = 100_000_000  # bytes of a part program
OLD = 3600  # s
NO_FILE = "it is no file, but a folder, a device or a pipe"


def reason(error: OSError | ValueError) -> str:
    """Why a file cannot be opened, in words; a ValueError is that of a name with a NUL in it."""
    return error.strerror or str(error) if isinstance(error, OSError) else "no file has such a name"


def read(path: str | Path, what: str | Path, most: int = LARGEST) -> bytes:
    """The bytes of a file; an Alarm that begins with `what` if it cannot be read, is no file, or is too large."""
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise Alarm(f"{what} cannot be read: {NO_FILE}")
        with open(path, "rb", opener=_without_waiting) as file:
            content = file.read(most + 1)
    except (OSError, ValueError) as error:
        raise Alarm(f"{what} cannot be read: {reason(error)}") from None
    if len(content) > most:
        raise Alarm(f"{what} cannot be read: it has more than {most // 1_000_000} MB")
    return content


def _without_waiting(path: str, flags: int) -> int:
    """Open a file, even if it has just become a pipe, without waiting for a writer."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


@contextmanager
def replaced(path: str | Path) -> Iterator[Path]:
    """A new file to write, which takes the place of `path` at the end, or is gone if anything fails.

    The target of a symbolic link is replaced and the link stays; the new file has the mode of the old one and the same
    suffix under another name. An Alarm if it cannot be written.
    """
    try:
        target = Path(os.path.realpath(path))
        mode = os.stat(target).st_mode if target.exists() else None
        if mode is not None and not stat.S_ISREG(mode):
            raise Alarm(f"{path} cannot be written: {NO_FILE}")
        mark = f".{zlib.crc32(os.fsencode(target.name)):08x}-"  # the same for each save of this file
        _swept(target.parent, mark)
        beside = target.with_name(f"{mark}{secrets.token_hex(8)}{target.suffix}")
        os.close(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))
    except (OSError, ValueError) as error:
        raise Alarm(f"{path} cannot be written: {reason(error)}") from None
    try:
        yield beside
        with open(beside, "rb+") as file:
            os.fsync(file.fileno())  # what a full disk does not take is known here, not after the old file is gone
        if mode is not None:
            os.chmod(beside, stat.S_IMODE(mode))
        os.replace(beside, target)
    except OSError as error:
        raise Alarm(f"{path} cannot be written: {reason(error)}") from None
    finally:
        beside.unlink(missing_ok=True)


def _swept(folder: Path, mark: str) -> None:
    """Take away what saves of a file left that were killed: it is old, for a save ends soon."""
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.startswith(mark) and time.time() - entry.stat().st_mtime > OLD:
                Path(entry.path).unlink(missing_ok=True)


def named(path: str | Path, known: Collection[str], refused: str) -> tuple[Path, str]:
    """The path of a file and its suffix, which is one of the known ones; an Alarm where it is not, in `refused` words."""
    if not isinstance(path, str | Path):
        raise Alarm(f"a file is written to a path, got {shown(path)}")
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in known:
        what = refused.format(suffix) if suffix else f"{path.name!r} has no suffix to say what to write"
        raise Alarm(what, hint=f"known: {', '.join(known)}")
    return path, suffix
