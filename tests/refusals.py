"""Programs that must be refused: `refused/CONTROL/NAME.SUFFIX`, and its first comment says `LINE:COLUMN alarm: text (hint)`."""

from __future__ import annotations

import re
from pathlib import Path

from mnclab import Setup

FOLDER = Path(__file__).parent / "refused"
FILES = sorted(file for folder in sorted(FOLDER.iterdir()) for file in folder.iterdir())

#: What they find on the machine, where it is not what every control has by itself.
SETUPS = {"nc-31": Setup(start=(30, 0, 2))}


def setup_of(file: Path) -> Setup:
    return SETUPS.get(file.parent.name, Setup())


def expected(file: Path) -> tuple[int, int, str]:
    """Line, column and the alarm with its hint."""
    first = file.read_text(encoding="utf-8").partition("\n")[0]
    line, column, text = re.fullmatch(r"\W+ (\d+):(\d+) alarm: (.+)", first).groups()
    return int(line), int(column), text


def programs(control: str) -> list[str]:
    """The texts of a control, without the alarms."""
    files = [file for file in FILES if file.parent.name == control]
    return [file.read_text(encoding="utf-8").partition("\n")[2] for file in files]
