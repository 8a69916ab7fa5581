"""How far long work is: a bar, where tqdm is installed and the work takes more than a moment.

It is shown from the main thread alone: a form draws in a thread of its own, and a bar there would stand under another cell.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

SOON = 1.0  # s of work before a bar appears


@contextmanager
def progress(what: str, total: int, unit: str) -> Iterator[Callable[[int], None]]:
    """`with progress("running", 10_000, "blocks") as at: …; at(300)`, now and then; the bar goes with the end of the block."""
    begin = time.monotonic()
    bar: Any = None
    refused = threading.current_thread() is not threading.main_thread()

    def at(done: int) -> None:
        nonlocal bar, refused
        if refused or (bar is None and time.monotonic() - begin < SOON):
            return
        if bar is None:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                refused = True
                return
            bar = tqdm(total=total, desc=what, unit=f" {unit}", leave=False)
        bar.total = max(bar.total, done)  # a loop in a program runs blocks again
        bar.update(done - bar.n)

    try:
        yield at
    finally:
        if bar is not None:
            bar.close()
