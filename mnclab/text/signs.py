"""Signs by which a text is told from others: a pattern, how much it says, and in which words.

Signs are sought in the code of a program. What stands inside comments is blanked there, since people write about every
control; the characters that begin and end a comment are left, since these are signs themselves.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

FLAGS = re.IGNORECASE | re.MULTILINE
QUOTED = 24  # characters of a finding that are shown
_COMMENTS = re.compile(r"(\(|;|//)(?:(?<=\()[^)\n]*|[^\n]*)")


class Sign(NamedTuple):
    """A pattern, what it weighs each time it is found (less than nothing: it speaks against), and what it is.

    It counts `most` times at most. In `whole` texts comments are not blanked.
    """

    pattern: re.Pattern[str]
    weight: float
    says: str
    most: int = 1
    whole: bool = False


class Finding(NamedTuple):
    """What a sign was found to weigh in a text, and where first: line (from 1), and the characters there."""

    weight: float
    says: str
    line: int
    text: str

    def __str__(self) -> str:
        return f"{self.says} (line {self.line}: {self.text})" if self.text else self.says


def sign(pattern: str, weight: float, says: str, most: int = 1, *, whole: bool = False) -> Sign:
    """A sign whose pattern has ^ and $ at the ends of lines, and letters of either case."""
    return Sign(re.compile(pattern, FLAGS), weight, says, most, whole)


def code_of(text: str) -> str:
    """A text of the same length whose comments are blank."""
    return _COMMENTS.sub(lambda match: match[1].ljust(len(match[0])), text)


def found(signs: Iterable[Sign], text: str, code: str) -> list[Finding]:
    """The signs that a text has; `code` is its `code_of`."""
    findings = []
    for each in signs:
        where, count, first = text if each.whole else code, 0, None
        for match in each.pattern.finditer(where):
            first, count = first or match, count + 1
            if count == each.most:
                break
        if first is not None:
            shown = " ".join(first[0].split())
            line = text.count("\n", 0, first.start() + len(first[0]) - len(first[0].lstrip())) + 1
            short = shown if len(shown) <= QUOTED else shown[: QUOTED - 1] + "…"
            findings.append(Finding(each.weight * count, each.says, line, short))
    return findings
