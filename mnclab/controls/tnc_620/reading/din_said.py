"""How alarms about a DIN/ISO program are worded: with the G functions that stand there, and the block as it was read.

The language knows the conversational names alone. An alarm that says `CP needs a pole` is told as `G13 needs a pole`, and
its hint tells what the block is read as.
"""

from __future__ import annotations

import re

from mnclab.controls.tnc_620.reading.din_statements import STATEMENTS
from mnclab.controls.tnc_620.reading.iso_names import ISO_NAMES
from mnclab.text.alarm import ALARM, Alarm
from mnclab.text.program import Block, Program

_CYCLES = {code: name for name, code in ISO_NAMES.items()} | {
    statement.keyword: f"G{code:02}" for code, statement in STATEMENTS.items() if code not in (53, 76, 78)
}
#: Statements that have one name only.
_NAMES = {
    "CTP": "G16", "CT": "G06", "CHF": "G24", "RND": "G25", "APPR LCT": "G26", "DEP LCT": "G27", "BLK FORM 0.1": "G30",
    "BLK FORM 0.2": "G31", "STOP": "G38", "TOOL CALL": "T", "CYCL CALL PAT": "G79 PAT", "CYCL CALL POS": "G79:G01",
    "CYCL CALL": "G79", "LBL": "G98 L", "CALL LBL": "L", "CALL PGM": "%", "BEGIN PGM": "%", "END PGM": "%",
}  # fmt: skip
_BY_SENSE = {"C": ("G02", "G03"), "CR": ("G02", "G03"), "CP": ("G12", "G13")}
_BY_FEED = {"L": ("G00", "G01"), "LP": ("G10", "G11")}
#: Addresses of the language by keyword, and the letters that stand for them.
_LETTERS = {keyword: {"IPA": "G91 H", "IPR": "G91 R", "PA": "H", "PR": "R"} for keyword in ("LP", "CP", "CTP")}
for _statement in STATEMENTS.values():
    for _letter, _address in _statement.words.items():
        if _address != _letter and _address not in "XY" and not _address.islower():
            _LETTERS.setdefault(_statement.keyword, {}).setdefault(_address, _letter)
#: What alarms say of other blocks.
_ELSEWHERE = {keyword: name for keyword, name in _NAMES.items() if " " in keyword} | {
    "R0": "G40", "RL": "G41", "RR": "G42", "CC X… Y…": "I… J…", "no CC": "no I J", "FMAX is": "G00 is",
}  # fmt: skip
_FN, _CYCLE = re.compile(r"FN (\d+)"), re.compile(r"CYCL DEF (\d+)(?:\.\d)?")


def said(alarm: Alarm, program: Program) -> Alarm:
    """The alarm in the words of the program that it is about."""
    block = _block(alarm, program)
    if block is None or not block.keyword or block.keyword == "Q":
        return alarm
    message, name = alarm.message, name_of(block)
    if name:
        message = _renamed(message, block.keyword, name)
        for address, letter in _LETTERS.get(block.keyword, {}).items():
            message = _renamed(message, address, letter)
    message, hint = (_CYCLE.sub(_cycle, part) for part in (message, alarm.hint))
    for keyword, other in _ELSEWHERE.items():
        message, hint = (_renamed(part, keyword, other) for part in (message, hint))
    if alarm.severity == ALARM and not re.fullmatch(r"G\d{3,}", name):  # whose words have the same letters
        read = f"the block is read as {' '.join([block.keyword, *map(str, block.words)])}"
        hint = f"{hint}; {read}" if hint else read
    return alarm.changed(message=message, hint=hint, args=(message,))


def name_of(block: Block) -> str:
    """The G function of a block that was read as a statement of the language; empty if it stands there as it is."""
    keyword, words = block.keyword, {word.address: word.value for word in block.words}
    if keyword in _BY_SENSE:
        return _BY_SENSE[keyword][words.get("DR") == "+"]
    if keyword in _BY_FEED:
        return _BY_FEED[keyword]["FMAX" not in words]
    if keyword == "TOOL DEF":
        return "G99" if {"L", "R"} & words.keys() else "G51"
    if keyword == "CYCL DEF 7" and "#" in words:
        return "G53"
    if found := _FN.fullmatch(keyword):
        return f"D{int(found[1]):02}"
    found = _CYCLE.fullmatch(keyword)
    return _cycle(found) if found else _CYCLES.get(keyword) or _NAMES.get(keyword, "")


def _cycle(found: re.Match[str]) -> str:
    """The G function of a cycle."""
    return _CYCLES.get(f"CYCL DEF {found[1]}", f"G{int(found[1]):02}")


def _renamed(message: str, name: str, by: str) -> str:
    """The message with another word for a keyword or an address, which a number may follow."""
    blank = " ?" if by == "%" else ""
    return re.sub(rf"(?<![\w.]){re.escape(name)}(?![A-Za-z_.]){blank}", lambda _: by, message)


def _block(alarm: Alarm, program: Program) -> Block | None:
    """The block that an alarm stands in."""
    if alarm.span is None or not len(program):
        return None
    offset = int(program.line_starts[alarm.span.line - 1]) + alarm.span.column - 1
    return program[max(int(program.start.searchsorted(offset, "right")) - 1, 0)]
