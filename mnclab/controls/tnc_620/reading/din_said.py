"""How alarms about a DIN/ISO program are worded: with the G functions that stand there, and the block as it was read.

The language knows the conversational names alone. An alarm that says `CP needs a pole` is told as `G13 needs a pole`, and
its hint tells what the block is read as.
"""

from __future__ import annotations

import re

from mnclab.controls.tnc_620.reading.iso_names import ISO_NAMES
from mnclab.text.alarm import Alarm
from mnclab.text.program import Block, Program

_CYCLES = {code: name for name, code in ISO_NAMES.items() if name != "G53"} | {"CYCL DEF 18": "G86"}
_NAMES = {
    "CT": "G06", "CTP": "G16", "CHF": "G24", "RND": "G25", "APPR LCT": "G26", "DEP LCT": "G27", "BLK FORM 0.1": "G30",
    "BLK FORM 0.2": "G31", "STOP": "G38", "TOOL CALL": "T", "CYCL CALL": "G79", "CYCL CALL PAT": "G79 PAT",
    "CYCL CALL POS": "G79:G01", "LBL": "G98 L", "CALL LBL": "L", "CALL PGM": "%", "BEGIN PGM": "%", "END PGM": "%",
}  # fmt: skip
_BY_SENSE = {"C": ("G02", "G03"), "CR": ("G02", "G03"), "CP": ("G12", "G13")}
_BY_FEED = {"L": ("G00", "G01"), "LP": ("G10", "G11")}
_FN, _CYCLE = re.compile(r"FN (\d+)"), re.compile(r"CYCL DEF (\d+)")


def said(alarm: Alarm, program: Program) -> Alarm:
    """The alarm in the words of the program that it is about."""
    block = _block(alarm, program)
    if block is None or not block.keyword or block.keyword == "Q":
        return alarm
    name, message = name_of(block), alarm.message
    message = re.sub(rf"(?<![\w.]){re.escape(block.keyword)}(?![\w.])", lambda _: name, message) if name else message
    read = f"the block is read as {' '.join([block.keyword, *map(str, block.words)])}"
    return alarm.changed(message=message, hint=f"{alarm.hint}; {read}" if alarm.hint else read, args=(message,))


def name_of(block: Block) -> str:
    """The G function of a block that was read as a statement of the language; empty if it stands there as it is."""
    keyword, words = block.keyword, {word.address: word.value for word in block.words}
    if keyword in _BY_SENSE:
        return _BY_SENSE[keyword][words.get("DR") == "+"]
    if keyword in _BY_FEED:
        return _BY_FEED[keyword]["FMAX" not in words]
    if keyword == "TOOL DEF":
        return "G99" if {"L", "R"} & words.keys() else "G51"
    if found := _FN.fullmatch(keyword):
        return f"D{int(found[1]):02}"
    if keyword == "CYCL DEF 7" and "#" in words:
        return "G53"
    if keyword in _CYCLES:
        return _CYCLES[keyword]
    found = _CYCLE.fullmatch(keyword)
    return f"G{found[1]}" if found else _NAMES.get(keyword, "")


def _block(alarm: Alarm, program: Program) -> Block | None:
    """The block that an alarm stands in."""
    if alarm.span is None or not len(program):
        return None
    offset = int(program.line_starts[alarm.span.line - 1]) + alarm.span.column - 1
    return program[max(int(program.start.searchsorted(offset, "right")) - 1, 0)]
