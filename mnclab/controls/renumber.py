"""Block numbers written anew, with the jumps that name them; everything else of a program stays as it is."""

from __future__ import annotations

from pathlib import Path

from mnclab.controls import CONTROLS
from mnclab.controls.choice import read
from mnclab.text.alarm import Alarm
from mnclab.text.dialect import renumbered
from mnclab.text.file import encode_like, replaced
from mnclab.text.file import read as read_file
from mnclab.text.given import LARGEST, fitting, shown, whole
from mnclab.text.program import Program


@fitting
def renumber(
    source: str | Path | Program, control: str | None = None, *, start: int | None = None, step: int | None = None
) -> str:
    """The text of a program with new block numbers; GOTO, M99 P, G25 P follow them, and the path stays the same.

    `source`, `control`: as in `mnclab.run`. `start`, `step`: the first number and what is added each time, without them
    10 and 10 (Klartext: 0 and 1, NC-31: 1 and 1). Only blocks with a number get a new one; a Klartext program without any
    gets them all. An Alarm where a jump computes its target, or names a block that is not there.
    """
    program = source if isinstance(source, Program) else read(source, control)
    chosen = CONTROLS[program.control]
    if chosen.numbers is None:
        raise Alarm(f"blocks of {chosen.name} have no numbers")
    numbers = chosen.numbers(program)
    if not numbers.blocks:
        raise Alarm("no block of the program has a number")
    first = numbers.first if start is None else whole(start, "start")
    more = numbers.step if step is None else whole(step, "step")
    least = min(numbers.first, 1)
    if first < least:
        raise Alarm(f"start must be at least {least}, got {first}")
    if more < 1:
        raise Alarm(f"step must be at least 1, got {more}")
    if (last := first + more * (len(numbers.blocks) - 1)) >= LARGEST:
        raise Alarm(f"the last number would be {shown(last)}: it must be smaller than {LARGEST:g}, as every number")
    return renumbered(program.text, numbers, first, more)


def renumber_file(
    file: Path, control: str | None = None, *, start: int | None = None, step: int | None = None, out: Path | None = None
) -> str:
    """The same of a file, written to `out` in the bytes of the file: code page, marks and line ends stay."""
    program = read(file, control)
    text = renumber(program, start=start, step=step)
    if out is not None:
        content = encode_like(text, program.text, read_file(file, file), program.encoding)
        with replaced(out) as beside:
            beside.write_bytes(content)
    return text
