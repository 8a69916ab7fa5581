"""Which code page the bytes of a program are written in."""

from __future__ import annotations

import codecs
import re

from mnclab.text.alarm import Alarm

_BY_FREQUENCY = "ъёфэщцюшжхйчбзгьыяупдмклврстниаео"  # Russian letters, the rarest first
_LIKE_LATIN = "АВЕЗКМНОРСТХУ"


def decode(data: bytes) -> tuple[str, str]:
    """Text of bytes in UTF-8, UTF-16 (with its mark), CP1251 or KOI8-R, and the name of the code page.

    Every byte is a letter in both Cyrillic pages, but a wrong reading has rare letters in place of frequent ones, and
    capitals after small letters. A few letters decide nothing: then it is CP1251, the page of Windows.
    """
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", errors="replace"), "utf-16"
    try:
        return data.decode("utf-8-sig"), "utf-8"
    except UnicodeDecodeError:
        windows, koi = (_russian(data.decode(page, errors="replace")) for page in ("cp1251", "koi8-r"))
        page = "koi8-r" if koi > windows + 20 else "cp1251"
        return data.decode(page, errors="replace"), page


def encode_like(text: str, before: str, data: bytes, page: str) -> bytes:
    """The bytes of a text that was made of `before`, which was read from `data`; an Alarm where that cannot be exact."""
    marks = {codecs.BOM_UTF8: "utf-8", codecs.BOM_UTF16_LE: "utf-16-le", codecs.BOM_UTF16_BE: "utf-16-be"}
    mark = next((mark for mark in marks if data.startswith(mark)), b"")
    page = marks.get(mark, page)
    if mark + before.encode(page, "replace") != data:
        raise Alarm(f"the file holds bytes that are no letters of {page}, and cannot be written back as they are")
    return mark + text.encode(page)


def _russian(text: str) -> int:
    """How much a text looks like Russian; a letter by itself is a slip for a Latin one, and looks like it."""
    words = re.findall("[а-яёА-ЯЁ]+", text)
    letters = sum(sum(map(_BY_FREQUENCY.find, word.lower())) for word in words if len(word) > 1)
    slips = sum(len(word) == 1 and word.upper() in _LIKE_LATIN for word in words)
    return letters + 40 * (slips - len(re.findall("[а-яё][А-ЯЁ]", text)))
