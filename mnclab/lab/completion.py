"""What may be typed next at a place of a program: codes, the words of the cycle at hand, labels, files that are called."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from mnclab.lab.vocabulary import Vocabulary, found_in, owners, up_to, vocabulary
from mnclab.machine.control import Control

Choices = list[tuple[str, str]]  # a word, and what it means

_FILE = re.compile(r"\b(?:(?:CALL|SEL) +PGM|SEL +(?:CONTOUR|PATTERN|TABLE)|QC\d+ *=|CONTOUR +DEF.*=) +[\"']?([^\s\"']*)$", re.I)
_LABEL = re.compile(r"(?:CALL|GOTO) +LBL +([\"']?[^\s\"']*)$", re.I)
_LABELS = re.compile(r"^\s*(?:\d+\s+)?LBL +(\"[^\"]+\"|[1-9]\d*)", re.I | re.M)
_TYPED = re.compile(r"[\d.]*+[A-Za-z]*+[,#%]?")  # a word read from its end


def completions(text: str, at: int, control: Control, files: Iterable[str] = ()) -> tuple[str, Choices]:
    """What of a word stands before a place already, and what the whole of it may be; `files` are those that can be called."""
    known = vocabulary(control)
    before = text[text.rfind("\n", 0, at) + 1 : at]
    if re.search(known.comment, before):
        return "", []
    if known.keywords and (called := _FILE.search(before)):
        begun = called[1]
        return begun, [(name, "file") for name in files if name.lower().startswith(begun.lower())]
    if known.keywords and (called := _LABEL.search(before)):
        begun = called[1]
        labels = dict.fromkeys(_LABELS.findall(text))
        return begun, [(label, "label") for label in labels if label.startswith(begun)]
    if known.keywords and up_to(text, at, known)[1] == 1 and (found := _keywords(before, known)):
        return found
    typed = _TYPED.match(before[::-1])
    begun = typed[0][::-1] if typed else ""
    if not begun and (before.endswith(("+", "-", "=")) or before[-1:].isalnum()):  # a number comes; a letter of no word
        return "", []
    words = [*_words(text, at, known, at - len(begun))]
    codes = [(code, one.title) for code, one in known.codes.items() if " " not in code and not _begins_blocks(code, known)]
    if not begun:
        alone = not known.keywords and not any(word.code for word in found_in(before, known))
        return "", words + codes if alone else words
    wanted = re.sub(r"(?<=[A-Z])0+(?=\d)", "", begun.upper())
    return begun, [each for each in [*words, *codes] if each[0].startswith(wanted) and each[0] != wanted]


def _begins_blocks(code: str, known: Vocabulary) -> bool:
    """Whether a code is a keyword at the beginning of a block, and stands nowhere else."""
    return known.keywords and not re.fullmatch(r"M\d+", code)


def _keywords(before: str, known: Vocabulary) -> tuple[str, Choices] | None:
    """The rest of the codes that begin as a block does; None where the block has its code."""
    head = re.sub(r"^\s*/?(\d+\s+)?\s*", "", before)
    titles = {code: one.title for code, one in known.codes.items() if head or not re.fullmatch(r"G\d+", code)}
    begun, choices = rest_of(head, titles)  # a code of DIN/ISO only to one who begins so
    return (begun, choices) if choices else None


def rest_of(head: str, titles: Mapping[str, str]) -> tuple[str, Choices]:
    """The last word of what is written, and what it and the words after it may be, so that one of the names stands there."""
    *done, begun = re.split(r"\s+", head)
    count = len(done)
    wanted = [word.upper() for word in done]
    choices = []
    for name, title in titles.items():
        words = name.split(" ")
        if words[:count] == wanted and len(words) > count and words[count].upper().startswith(begun.upper()):
            choices.append((" ".join(words[count:]), title))
    return begun, choices


def _words(text: str, at: int, known: Vocabulary, begin: int) -> Iterator[tuple[str, str]]:
    """The words of the codes in a block, and of what is still on, that are not written in it yet."""
    lines, block = up_to(text, at, known)
    start = text.rfind("\n", 0, at) + 1
    lines[-1] = lines[-1][: begin - start] + " " + lines[-1][at - start :]  # without what is being typed
    there = {word.name for line in lines[-block:] for word in found_in(line, known)}
    there |= {name.rstrip("0123456789.") for name in there}
    of_block = {word.code for line in lines[-block:] for word in found_in(line, known)}
    codes = owners(text, begin, known)
    own = [code for code in codes if code in of_block]
    told: set[str] = set()
    for code in [*own, *[code for code in codes if code not in own][:1]]:
        for address, meaning in known.codes[code].words.items():
            if address not in there | told:
                told.add(address)
                yield address + "=" * bool(known.keywords and re.fullmatch(r"QS?\d+", address)), f"{meaning} ({code})"
