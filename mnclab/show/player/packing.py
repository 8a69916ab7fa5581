"""Values as the page has them, in few bytes.

Numbers are whole parts of a unit, columns are logs of their changes, objects are JSON. Columns are packed as differences,
zigzag, seven bits a byte, then deflate and base64: neighbours in a column differ little, so their differences are small, most
take one to three bytes. `data.js` undoes every step: a byte with its high bit set is followed by another one, an odd number z
stands for -(z + 1) / 2.
"""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Mapping
from dataclasses import asdict, is_dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.show.given_away import whole

LARGEST = 2**53 // 4  # what a number of a browser holds without loss, as a zigzag difference
ROOM = LARGEST // 4  # of what the page holds: places are sent as differences

Array = NDArray[np.float64]


def plain(value: Any) -> Any:
    """A value of the history as JSON has it: a tool as its fields, points and frames as lists, a datum in words."""
    if isinstance(value, tuple) and "__str__" in type(value).__dict__ and all(isinstance(each, int | float) for each in value):
        return str(value)
    if is_dataclass(value) and not isinstance(value, type):
        return {name: plain(each) for name, each in asdict(value).items()}
    if isinstance(value, Mapping):
        return {str(name): plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not np.isfinite(value):
        return None if np.isnan(value) else "inf" if value > 0 else "-inf"
    return value if value is None or isinstance(value, str | int | float | bool) else str(value)


def parted(values: ArrayLike, scale: float) -> NDArray[np.int64]:
    """Whole numbers of the parts of a unit; what has no end is as large as can be."""
    found = np.nan_to_num(np.round(np.asarray(values, dtype=np.float64) * scale), posinf=ROOM, neginf=-ROOM)
    return found.clip(-ROOM, ROOM).astype(np.int64)


def columns(pack: Packer, values: NDArray[np.int64]) -> list[int]:
    """The columns of whole numbers (n, k), as their indices."""
    return [pack.add(values[:, k]) for k in range(values.shape[1])]


def log(pack: Packer, column: Any) -> dict[str, Any]:
    """A column (n,) or (n, 3) as its changes."""
    column = np.asarray(column)
    if not len(column):
        return {"at": pack.add([]), "of": pack.add([]), "values": []}
    if column.dtype.kind == "f":
        same = (column[1:] == column[:-1]) | (np.isnan(column[1:]) & np.isnan(column[:-1]))
    else:
        same = column[1:] == column[:-1]
    at = np.flatnonzero(np.append(True, ~(same.all(axis=1) if column.ndim == 2 else same)))
    return changes(pack, at, column[at].tolist())


def changes(pack: Packer, at: ArrayLike, values: list[Any]) -> dict[str, Any]:
    """Changes at some places; equal values are sent once."""
    index: dict[str, int] = {}
    kept: list[Any] = []
    of = []
    for value in map(plain, values):
        of.append(index.setdefault(repr(value), len(kept)))
        if of[-1] == len(kept):
            kept.append(value)
    return {"at": pack.add(at), "of": pack.add(of), "values": kept}


def parts_of(finest: float, *columns: Array) -> float:
    """How many parts a unit is counted in: `finest`, or the power of ten at which no value is too large for the page."""
    most = max((float(np.abs(column[np.isfinite(column)]).max(initial=0.0)) for column in columns), default=0.0)
    return finest if most * finest <= ROOM else 10.0 ** np.floor(np.log10(ROOM / most))


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
