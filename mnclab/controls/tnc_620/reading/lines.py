"""Where the words of a line stand: between its beginning and its comment, without the mark that joins it to the next."""

from __future__ import annotations

import re

from mnclab.text.program import ProgramBuilder

_BEFORE_COMMENT = re.compile(r'(?:[^;"]++|"[^"]*+(?:"|$))*+')


def bounds(builder: ProgramBuilder, line: int) -> tuple[int, int, int, bool]:
    """Begin and end of the words, the place of the comment or -1, and whether the line ends in ~."""
    starts, text = builder.line_starts, builder.text
    begin = int(starts[line])
    end = int(starts[line + 1]) if line + 1 < len(starts) else len(text)
    content = text[begin:end].rstrip()
    if begin == 0 and content.startswith("\ufeff"):
        begin, content = 1, content[1:]
    tilde = content.endswith("~")
    content = content.removesuffix("~")
    comment = -1
    if ";" in content and (words := _BEFORE_COMMENT.match(content)) and words.end() < len(content):
        comment, content = begin + words.end(), words.group()
    return begin, begin + len(content.rstrip(" \t")), comment, tilde
