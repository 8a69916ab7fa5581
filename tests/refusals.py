"""Programs that must be refused, those of one subject in one file: `refused/CONTROL/SUBJECT.SUFFIX`.

A comment `== NAME` begins each; below it the program, whose first comment says `LINE:COLUMN alarm: text (hint)`. Lines count
from that comment. A blank line before the next `== NAME` belongs to no program.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

from mnclab import Setup
from mnclab.controls.choice import read_text
from mnclab.text.program import Program

FOLDER = Path(__file__).parent / "refused"
FILES = sorted(FOLDER.glob("*/*"))
HEAD = re.compile(r"(?:\A|(?<=\n)\n)(?:;|//|') == (\S+)\n")

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
        whole = self.file.read_text(encoding="utf-8")
        self.file.write_text(whole.replace(f" == {self.name}\n{old}\n", f" == {self.name}\n{new}\n"), encoding="utf-8")


@cache
def refusals(file: Path) -> tuple[Refusal, ...]:
    """Those of a file, in their order."""
    before, *parts = HEAD.split(file.read_text(encoding="utf-8"))
    assert not before, f"{file} does not begin with the name of a program"
    return tuple(Refusal(file, name, text) for name, text in zip(parts[::2], parts[1::2], strict=True))


def of(control: str) -> list[Refusal]:
    """All refusals of a control."""
    return [refusal for file in FILES if file.parent.name == control for refusal in refusals(file)]


def programs(control: str) -> list[str]:
    """The texts of a control, without the alarms."""
    return [refusal.text.partition("\n")[2] for refusal in of(control)]
