"""Calls inside each other and subprograms on the way, with LinuxCNC's motion or refusal: writes iso_calls.json.

    python3 tests/authorities/generate_iso_calls.py

Chains of 8 to 11 subprograms that stand before their calls or behind M2, a subprogram that calls itself as often, and
programs by M98; subprograms that the program comes to again behind a call, or passes without one. Positions are mm.
"""

import re

from generate_iso_macros import motion
from recording import ask, save

HEAD = ["G21 G17 G90 G54 F120"]


def chain(count, between=()):
    """Subprograms of which each calls the next one."""
    lines = []
    for k in range(1, count + 1):
        lines += [f"O{k} sub", *between, f"G1 X{k}", *([f"O{k + 1} call"] if k < count else []), f"O{k} endsub"]
    return lines


def numbered(count):
    lines = []
    for k in range(1, count + 1):
        lines += [f"O{k}", f"G1 X{k}", *([f"M98 P{k + 1}"] if k < count else []), "M99"]
    return lines


ITSELF = ["O1 sub", "G1 X#1", "O2 if [#1 GT 1]", "O1 call [#1-1]", "O2 endif", "O1 endsub"]
ONE, TWO = ["O1 sub", "G1 X1", "O1 endsub"], ["O2 sub", "G1 X2", "O2 endsub"]
CALL, END = ["O1 call", "G1 Y1"], ["G1 Y2", "M2"]
LOOP = ["O9 repeat [2]", "O8 repeat [2]", "O1 call", "O8 endrepeat", "O9 endrepeat"]


def programs():
    for count in (8, 9, 10, 11):
        yield f"chain {count}", [*chain(count), *CALL, "M2"]
        yield f"chain behind {count}", [*CALL, "M2", *chain(count)]
        yield f"itself {count}", [*ITSELF, f"O1 call [{count}]", "M2"]
        yield f"M98 {count}", ["M98 P1", "G1 Y1", "M2", *numbered(count)]
        yield f"in repeats {count}", [*chain(count), *LOOP, "M2"]
    yield "passed, then called", [*ONE, *CALL, "O1 call", *END]
    yield "called, then passed", [*CALL, *ONE, *END]
    yield "called, then passed, then called", [*CALL, *ONE, "O1 call", *END]
    yield "another passed", [*CALL, *TWO, *END, *ONE]
    yield "another passed, then called", [*CALL, *TWO, "O2 call", *END, *ONE]
    yield "called inside another, then passed", [*["O1 sub", "O2 call", "O1 endsub"], "O1 call", *TWO, *END]
    yield "passed before, behind a call", [*TWO, *CALL, *END, *ONE]


def main():
    records = []
    for name, lines in programs():
        text = "\n".join([*HEAD, *lines]) + "\n"
        answer = ask(text)
        said = {} if answer["ok"] else {"line": answer["line"], "error": re.sub(r"File:\S*/", "File:", answer["error"])}
        records.append({"name": name, "text": text, "motion": motion(answer)} | said)
    print(sum("error" in record for record in records), "refused")
    save("iso_calls.json", 0, records)


if __name__ == "__main__":
    main()
