"""Programs that must be refused, those of one subject in one file: `refused/CONTROL/SUBJECT.SUFFIX`.

A comment `== NAME` begins each; below it the program, whose first comment says `LINE:COLUMN alarm: text (hint)`. Lines count
from that comment. A blank line before the next comment of this kind belongs to no program.

Where many programs are one program with a fault made in it, that program is written once, without a fault, below a comment
`-- SAMPLE`. A program `== NAME like SAMPLE` is its own first comments, then the sample with changes as `diff -u` writes them:
`@@ 9` goes on to line 9 of this program, the first one that is new, as it counts in the alarm; `-` takes away the line of
the sample that comes next, `+` puts one in::

    ; == depth-positive like drilled              the program that is run
    ; 4:1 alarm: … Q201 …                         1   ; 4:1 alarm: … Q201 …
    @@ 4                                          2   TOOL CALL 1 Z S1000        of the sample
    -Q201=-15                                     3   CYCL DEF 200 D             of the sample
    +Q201=15                                      4   Q201=15
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

from mnclab import Setup
from mnclab.controls.choice import read_text
from mnclab.text.program import Program

FOLDER = Path(__file__).parent.parent / "refused"
FILES = sorted(FOLDER.glob("*/*"))
HEAD = re.compile(r"(?:\A|(?<=\n)\n)(?:;|//|') (==|--) (\S+)(?: like (\S+))?\n")
PLACE = re.compile(r"@@ (\d+)")

#: What they find on the machine, where it is not what every control has by itself.
SETUPS = {"nc-31": Setup(start=(30, 0, 2))}


class Refusal(NamedTuple):
    """One program that must be refused, with the comment that says how."""

    file: Path
    name: str
    text: str

    @property
    def control(self) -> str:
        return self.file.parent.name

    @property
    def setup(self) -> Setup:
        return SETUPS.get(self.control, Setup())

    @property
    def path(self) -> str:
        """The name under which it is read: that of a file of its own."""
        return str(self.file.with_name(f"{self.name}{self.file.suffix}"))

    @property
    def program(self) -> Program:
        return read_text(self.text, self.path, self.control, str(self.file.parent))

    @property
    def expected(self) -> tuple[int, int, str]:
        """Line, column and the alarm with its hint."""
        line, column, text = re.match(r"\W+ (\d+):(\d+) alarm: (.+)\n", self.text).groups()
        return int(line), int(column), text

    def rewrite(self, headline: str) -> None:
        """Put `LINE:COLUMN: alarm: text (hint)` into its first comment."""
        mark, old = self.text.split(maxsplit=1)[0], self.text.partition("\n")[0]
        new = f"{mark} {re.sub(': alarm', ' alarm', headline, count=1)}"
        begins = re.compile(rf"( == {re.escape(self.name)}(?: like \S+)?\n){re.escape(old)}\n")
        whole = self.file.read_text(encoding="utf-8")
        self.file.write_text(begins.sub(lambda found: f"{found[1]}{new}\n", whole), encoding="utf-8")


class Written(NamedTuple):
    """What stands in a file: the samples by name, and the refusals in their order."""

    samples: dict[str, str]
    refusals: tuple[Refusal, ...]


@cache
def written(file: Path) -> Written:
    """What a file holds, every program whole."""
    before, *parts = HEAD.split(file.read_text(encoding="utf-8"))
    assert not before, f"{file} does not begin with the name of a program"
    samples: dict[str, str] = {}
    refused = []
    for kind, name, like, text in zip(parts[::4], parts[1::4], parts[2::4], parts[3::4], strict=True):
        if kind == "--":
            samples[name] = text
        else:
            refused.append(Refusal(file, name, changed(samples[like], text, f"{file} {name}") if like else text))
    return Written(samples, tuple(refused))


def changed(sample: str, changes: str, where: str) -> str:
    """A sample with changes made in it, below the comments that stand before them."""
    lines, following, begun = [], sample.split("\n"), False
    for change in changes.split("\n")[:-1]:
        if place := PLACE.fullmatch(change):
            begun, same = True, int(place[1]) - 1 - len(lines)
            assert 0 <= same < len(following), f"{where}: {change}, but its lines {len(lines)} and before are said already"
            lines, following = lines + following[:same], following[same:]
        elif begun and change.startswith("-"):
            gone, *following = following
            assert gone == change[1:], f"{where}: {change}, but the next line of the sample is {gone}"
        else:
            assert change.startswith("+") or not begun, f"{where}: a change begins with @@, - or +: {change}"
            lines.append(change[1:] if begun else change)
    return "\n".join(lines + following)


def refusals(file: Path) -> tuple[Refusal, ...]:
    """Those of a file, in their order."""
    return written(file).refusals


def of(control: str) -> list[Refusal]:
    """All refusals of a control."""
    return [refusal for file in FILES if file.parent.name == control for refusal in refusals(file)]


def programs(control: str) -> list[str]:
    """The texts of a control, without the alarms."""
    return [refusal.text.partition("\n")[2] for refusal in of(control)]
