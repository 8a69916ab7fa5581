"""The words of a control and what they mean without a run: for the completion of words, and for help at the pointer.

A program that is being typed cannot be run at every key, so that all is found by a look at the text: the code that a word
belongs to is the nearest one in its block that takes it, or the motion or the cycle that is still on from a block before.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from mnclab.machine.control import Control, Function
from mnclab.machine.cycle import Cycle
from mnclab.runs.explanation import meant

BACK = 200  # lines that are looked through for what is still on
_WORDS = re.compile(r"([,#%]?[A-Z]+)(?:[ \t]*(\d+(?:\.\d+)?))?")
_ADDRESS = re.compile(r",?[A-Z]+[0-9]?")
GENERAL = {
    **{axis: f"coordinate {axis}" for axis in "XYZ"}, **{axis: f"rotary axis {axis}, degrees" for axis in "ABC"},
    "F": "feed rate", "S": "spindle speed", "T": "number of the tool", "N": "number of the block",
}  # fmt: skip
_VARIABLES = dict.fromkeys(("Q", "QL", "QR", "QS"), "variable of the program")
_COORDINATES = {axis: GENERAL[axis] for axis in "XYZABC"}


class Code(NamedTuple):
    """A function or a cycle: its title, its words with what they mean, whether it holds for later blocks with words alone.

    An address that may be repeated has its meanings in their order, divided by `; then `.
    """

    title: str
    words: dict[str, str]
    stays: bool


class Vocabulary(NamedTuple):
    """Codes as they are written, what an address means elsewhere, what a comment begins with (a regular expression), the
    sign that joins a line to the next, and whether keywords begin the blocks (a letter is no code of its own then)."""

    codes: dict[str, Code]
    addresses: dict[str, str]
    comment: str
    joined: str
    keywords: bool


class WordAt(NamedTuple):
    """A word in a text: letters and digits as the tables have them, its columns from 0, and the code, if it is one."""

    name: str
    begin: int
    end: int
    code: str


def vocabulary(control: Control) -> Vocabulary:
    """All that is known of the words of a control."""
    codes = {code: _function(control, one) for code, one in control.listed.items() if code[0].isalnum()}
    codes |= {code: _cycle(one) for code, one in control.cycles.items()}
    codes |= {name: codes[code] for name, code in control.names.items() if code in codes}
    said = {address: meaning for address, meaning in control.meanings.items() if _ADDRESS.fullmatch(address)}
    keywords = not control.word_functions
    joined = "~" if keywords else "*" if control.one_command else ""
    said |= _VARIABLES if keywords else {}
    return Vocabulary(codes, GENERAL | said, control.read("", "").comment_mark, joined, keywords)


def _function(control: Control, function: Function) -> Code:
    words: dict[str, str] = {}
    for taken in function.takes:
        address = taken.rstrip("*").rpartition(":")[2]
        if taken == "axis":
            words |= dict.fromkeys("XYZ", control.meanings.get("axis", "axis"))
        elif _ADDRESS.fullmatch(address):
            known = meant(control, function.code, taken.rstrip("*")) or meant(control, function.code, address)
            words[address] = known or _COORDINATES.get(address) or GENERAL.get(address) or function.title.lower()
    return Code(function.title, words, function.moves)


def _cycle(cycle: type[Cycle]) -> Code:
    words: dict[str, str] = {}
    for p in cycle.parameters():
        unit = f", {p.unit}" if p.unit and p.unit not in ("choice", "count", "text") else ""
        choices = f": {', '.join(f'{value:g} {meaning}' for value, meaning in p.choices.items())}" if p.choices else ""
        meaning = f"{p.meaning}{unit}{choices}"
        for address in (p.address, *p.aliases):
            words[address] = f"{words[address]}; then {meaning}" if address in words else meaning
    return Code(cycle.title, words, cycle.runs == "position")


def found_in(line: str, known: Vocabulary) -> Iterator[WordAt]:
    """The words of a line before its comment; a code of keywords stands at its beginning, after the number."""
    mark = re.search(known.comment, line)
    text = (line[: mark.start()] if mark else line).upper()
    text = re.sub(r'"[^"]*+"?|\((?=[^()]*[A-Z]{2})[^()]*+\)', lambda quoted: " " * len(quoted[0]), text)
    first = re.match(r"\s*/?(\d+(?=\s))?\s*", text)
    at = first.end() if first else 0
    if keyword := keyword_at(text[at:], known):
        end = at + len(keyword[1])
        yield WordAt(keyword[0], at, end, keyword[0])
        at = end
    for word in _WORDS.finditer(text, at):
        letters, number = word[1], word[2] or ""
        whole = letters + (str(int(number)) if number.isdigit() else number)
        names = (whole,) if known.keywords else (whole, letters)
        code = next((name for name in names if name in known.codes and (number or not known.keywords)), "")
        yield WordAt(whole, *word.span(), code)


def keyword_at(text: str, known: Vocabulary) -> tuple[str, str] | None:
    """The longest code of several words, or of one, that a text begins with: as it is known, and as it is written."""
    pieces = [(piece[0], piece.end()) for piece in re.finditer(r"[^\s:]+", text)][:4]
    for count in range(len(pieces), 0, -1):
        name = " ".join(piece for piece, _ in pieces[:count])
        if name in known.codes:
            return name, text[: pieces[count - 1][1]]
    return None


def up_to(text: str, at: int, known: Vocabulary) -> tuple[list[str], int]:
    """The lines of a text up to that of a place, that one whole, and how many of the last ones are its block so far."""
    end = text.find("\n", at)
    lines = text[: end if end >= 0 else len(text)].split("\n")[-BACK:]
    block = 1
    for line in reversed(lines[:-1]):
        bare = re.split(known.comment, line, maxsplit=1)[0].rstrip()
        if not known.joined or known.joined not in bare[-2:]:
            break
        block += 1
    return lines, block


def owners(text: str, at: int, known: Vocabulary) -> list[str]:
    """The codes that a word at a place may belong to: those of its block, the nearest first, then what is still on."""
    lines, block = up_to(text, at, known)
    column = at - text.rfind("\n", 0, at) - 1
    here = [word for word in found_in(lines[-1], known) if word.code]
    codes = [word.code for word in sorted(here, key=lambda word: (word.begin > column, abs(word.begin - column)))]
    for back, line in enumerate(reversed(lines[:-1]), 2):
        found = [word.code for word in found_in(line, known) if word.code][::-1]
        codes += found if back <= block else [code for code in found if known.codes[code].stays]
    return sorted(dict.fromkeys(codes), key=lambda code: code.isalpha() and not known.keywords)  # a letter after a code


def meaning_at(text: str, at: int, control: Control) -> tuple[str, str, str] | None:
    """The word at a place of a program: as it is called, the code it belongs to, what it means; None for no word."""
    known = vocabulary(control)
    begin = text.rfind("\n", 0, at) + 1
    line = text[begin:].split("\n", 1)[0]
    word = next((word for word in found_in(line, known) if word.begin <= at - begin < word.end), None)
    if word is None:
        return None
    if word.name == word.code and (known.keywords or not word.name.isalpha()):
        return word.code, word.code, known.codes[word.code].title
    for name in dict.fromkeys((word.name, word.name.rstrip("0123456789."))):
        for code in owners(text, at, known):
            if says := known.codes[code].words.get(name):
                return name, code, says
        if says := known.addresses.get(name):
            return name, "", says
        if name in known.codes:
            return name, name, known.codes[name].title
    return None


# What may be typed next at a place of a program: codes, the words of the cycle at hand, labels, files that are called.

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
    codes = [(code, one.title) for code, one in known.codes.items()  # a keyword stands at the beginning of a block alone
             if " " not in code and (not known.keywords or re.fullmatch(r"M\d+", code))]  # fmt: skip
    if not begun:
        alone = not known.keywords and not any(word.code for word in found_in(before, known))
        return "", words + codes if alone else words
    wanted = re.sub(r"(?<=[A-Z])0+(?=\d)", "", begun.upper())
    return begun, [each for each in [*words, *codes] if each[0].startswith(wanted) and each[0] != wanted]


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
