"""Columns of whole numbers in few bytes: differences, zigzag, seven bits a byte, then deflate and base64.

Neighbours in a column differ little, so their differences are small: most take one to three bytes. `data.js` undoes
every step: a byte with its high bit set is followed by another one, an odd number z stands for -(z + 1) / 2.
"""

from __future__ import annotations

import base64
import json
import zlib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.show.given_away import whole

LARGEST = 2**53 // 4  # what a number of a browser holds without loss, as a zigzag difference


def varints(values: NDArray[np.int64]) -> bytes:
    """Whole numbers (n,) of either sign as bytes."""
    rest = ((values << 1) ^ (values >> 63)).astype(np.uint64)
    size = np.ones(len(rest), dtype=np.int64)
    for k in range(1, 10):
        size += rest >= np.uint64(1 << 7 * k)
    at = np.cumsum(size) - size
    found = np.zeros(int(size.sum()), dtype=np.uint8)
    for k in range(int(size.max(initial=0))):
        some = np.flatnonzero(size > k)
        more = (size[some] > k + 1).astype(np.uint8) << 7
        found[at[some] + k] = (rest[some] >> np.uint64(7 * k)).astype(np.uint8) & 127 | more
    return found.tobytes()


class Packer:
    """Columns that are added one by one, and then a text of them and of a header."""

    def __init__(self) -> None:
        self.sizes: list[int] = []
        self._parts: list[bytes] = []

    def add(self, values: ArrayLike) -> int:
        """A column of whole numbers (n,); returns its index."""
        column = np.asarray(values, dtype=np.int64)
        if len(column) and not -LARGEST <= int(column.min()) <= int(column.max()) <= LARGEST:
            raise ValueError("a number is too large for the page")
        self._parts.append(varints(np.diff(column, prepend=0)))
        self.sizes.append(len(column))
        return len(self.sizes) - 1

    def text(self, header: dict[str, Any]) -> str:
        """Header and columns as base64: length of the header (4 bytes, low first), header as JSON, columns."""
        head = json.dumps({**header, "columns": self.sizes}, ensure_ascii=False, allow_nan=False)
        start = whole(head).encode()
        content = b"".join([len(start).to_bytes(4, "little"), start, *self._parts])
        return base64.b64encode(zlib.compress(content, 9)).decode("ascii")
