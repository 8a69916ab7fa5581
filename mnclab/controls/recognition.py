"""Which control a program is for: signs are weighed, and none is chosen where two weigh about the same.

Each control declares its signs, and `foreign` those of programs that no control here reads. A suffix that only one control
uses decides by itself; those that many makers share say little.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePath
from typing import NamedTuple

from mnclab.controls.foreign import FOREIGN, SUFFIXES
from mnclab.machine.control import Control
from mnclab.text.alarm import Alarm
from mnclab.text.dialect import Finding, code_of, found

LOOKED_AT = 20_000  # characters of a program that tell its control
LEAST = 2.0  # what the signs of a control must weigh
AHEAD, SHARE = 1.0, 0.2  # by how much more than those of the next: so much, and so much of the whole
TOLD = 3  # findings that an alarm tells of each
#: Suffixes of a control that others use too, and what they weigh.
SHARED = {".h": 4.0, ".i": 4.0, ".iso": 4.0}
BINARY = 0.02  # share of characters that no text has


class Candidate(NamedTuple):
    """A control, or what else a text looks like, and what speaks for and against it."""

    name: str
    findings: list[Finding]
    foreign: bool = False

    @property
    def weight(self) -> float:
        return sum(finding.weight for finding in self.findings)

    @property
    def described(self) -> str:
        return self.name if self.foreign else f"a program of {self.name}"

    def reasons(self) -> str:
        """The weightiest findings that speak for it."""
        best = sorted((one for one in self.findings if one.weight > 0), key=lambda one: -one.weight)
        return ", ".join(map(str, best[:TOLD]))


def is_binary(text: str) -> bool:
    """Whether a text has characters that no text has: NUL, or many control characters and replaced bytes."""
    head = text[:LOOKED_AT]
    strange = sum(head.count(c) for c in map(chr, (*range(1, 9), *range(14, 27), 28, 29, 30, 31, 0xFFFD)))
    return "\0" in head.rstrip("\0") or strange > max(2.0, BINARY * len(head))


def candidates(name: str, text: str, controls: Mapping[str, Control]) -> list[Candidate]:
    """Whatever has signs in a text or the suffix of its file, the weightiest first."""
    head = text[:LOOKED_AT].replace("\r\n", "\n").replace("\r", "\n").removeprefix("\ufeff")
    if len(text) > LOOKED_AT:  # whole lines
        head = head[: head.rfind("\n") + 1] or head
    code, suffix = code_of(head), PurePath(name).suffix.lower()
    of_suffix = {one.name: SHARED[suffix] for one in controls.values() if suffix in one.suffixes and suffix in SHARED}
    of_suffix |= dict([SUFFIXES[suffix]]) if suffix in SUFFIXES else {}
    listed = [(one.name, one.signs, False) for one in controls.values()]
    listed += [(name, signs, True) for name, signs in FOREIGN.items()]
    made = []
    for name, signs, foreign in listed:
        findings = found(signs, head, code)
        if name in of_suffix:
            findings.append(Finding(of_suffix[name], f"the suffix {suffix}", 0, ""))
        made.append(Candidate(name, findings, foreign))
    return sorted((one for one in made if one.weight > 0), key=lambda one: -one.weight)


def leading(ranked: list[Candidate]) -> list[Candidate]:
    """Those between which nobody can decide: one where it is clear, none where nothing says enough."""
    if not ranked or ranked[0].weight < LEAST:
        return []
    best = ranked[0].weight
    return [one for one in ranked if one.weight > best - max(AHEAD, SHARE * best) or one is ranked[0]]


def recognise(name: str, text: str, controls: Mapping[str, Control]) -> Control:
    """The control that a program is for; an Alarm says what else it looks like, or between which it cannot be decided."""
    suffix = PurePath(name).suffix.lower()
    by_suffix = [one for one in controls.values() if suffix and suffix in one.suffixes and suffix not in SHARED]
    if len(by_suffix) == 1:
        return by_suffix[0]
    choose = f"control= one of {', '.join(controls)}"
    if is_binary(text):
        hint = f"Mazatrol and other programs of menus are no text; {choose} reads it all the same"
        raise Alarm("this is a binary file, and no part program in letters and numbers", hint=hint)
    fitting = leading(candidates(name, text, controls))
    if not fitting:
        hint = choose if text.strip() else f"the text is empty; {choose}"
        raise Alarm("nothing in the text or the file's name says which control it is for: name it", hint=hint)
    if all(one.foreign for one in fitting):
        kinds = " or ".join(one.name for one in fitting)
        why = "; ".join(one.reasons() for one in fitting)
        hint = f"{why}; {choose} reads it all the same"
        raise Alarm(f"this looks like {kinds}, which is none of mnclab's controls", hint=hint)
    if len(fitting) > 1:
        why = "; ".join(f"{one.name}: {one.reasons()}" for one in fitting)
        first = next(one.name for one in fitting if not one.foreign)
        said = " or ".join(one.described for one in fitting)
        raise Alarm(f"this may be {said}: name the control", hint=f'{why}; control="{first}" chooses')
    return controls[fitting[0].name]


def looks_like(text: str, controls: Mapping[str, Control]) -> str:
    """What a text plainly looks like, in words: "a program of mnc", "a SINUMERIK program"; empty where that is not plain."""
    fitting = leading(candidates("", text, controls))
    return fitting[0].described if len(fitting) == 1 else ""
