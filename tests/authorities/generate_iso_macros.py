"""Random programs of variables, formulas and subprograms, with LinuxCNC's motion: writes iso_macros.json.

    python3 tests/authorities/generate_iso_macros.py

The texts are LinuxCNC's and ours alike (with the dialect linuxcnc). Positions are mm; what LinuxCNC refuses, because a number
is out of range, and what goes far away is drawn again.
"""

import random

from recording import KINDS, ask, save

SEED = 98
COUNT = 240
FAR = 1e5  # mm
FUNCTIONS = ("SIN", "COS", "TAN", "ASIN", "ACOS", "SQRT", "ABS", "EXP", "LN", "ROUND", "FIX", "FUP")
OPERATORS = ("+", "-", "*", "/", "MOD", "**", "EQ", "NE", "GT", "GE", "LT", "LE", "AND", "OR", "XOR")
WEIGHTS = (9, 9, 9, 5, 4, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1)
NAMES = ("#<width>", "#<a1>", "#<_depth>")


class Writer:
    """Writes a program; `known` are the variables that have a value."""

    def __init__(self, rng):
        self.rng, self.known = rng, []

    def number(self):
        text = f"{self.rng.uniform(0, 60):.{self.rng.randint(0, 3)}f}"
        return text.lstrip("0") if text.startswith("0.") and self.rng.random() < 0.5 else text

    def operand(self, depth):
        rng, draw = self.rng, self.rng.random()
        if draw < 0.35 and self.known:
            return rng.choice(self.known)
        if draw < 0.6 or depth == 0:
            return self.number()
        if draw < 0.7:
            return "-" + self.bracketed(depth - 1)
        if draw < 0.76:
            return f"ATAN{self.bracketed(depth - 1)}/{self.bracketed(depth - 1)}"
        return self.function(depth - 1) if draw < 0.88 else self.bracketed(depth - 1)

    def function(self, depth):
        """A function of something that it has a value for."""
        name, inside = self.rng.choice(FUNCTIONS), self.bracketed(depth)
        if name in ("ASIN", "ACOS", "EXP", "TAN"):
            return f"{name}[.9*SIN{inside}]"
        return f"{name}[ABS{inside}+.5]" if name in ("SQRT", "LN") else name + inside

    def bracketed(self, depth):
        return f"[{self.formula(depth)}]"

    def formula(self, depth):
        parts = [self.operand(depth)]
        for _ in range(self.rng.choice((0, 1, 1, 2))):
            operator = self.rng.choices(OPERATORS, WEIGHTS)[0]
            small = str(self.rng.randint(2, 3 if operator == "**" else 9))  # no zero, and no angle of many turns
            parts += [operator, small if operator in ("**", "/", "MOD") else self.operand(depth)]
        text = self.rng.choice(("", " ")).join(parts)
        return text.lower() if self.rng.random() < 0.2 else text

    def assignment(self, among, names=NAMES):
        name = self.rng.choice((*among, *names))
        line = f"{name}={self.bracketed(2)}"
        if name not in self.known:
            self.known.append(name)
        return line

    def move(self):
        words = [f"{axis}{self.rng.choice(('', '-'))}{self.bracketed(1)}" for axis in "XYZ" if self.rng.random() < 0.6]
        motion = self.rng.choice(("G0", "G1 F120"))
        return " ".join([motion, *(words or [f"X{self.rng.choice(self.known)}"])])

    def program(self):
        rng, subprograms = self.rng, rng_numbers(self.rng)
        lines = ["G21 G17 G90 G54", "#1=3 #2=.5 #101=12"]
        self.known += ["#1", "#2", "#101"]
        variables = [f"#{n}" for n in (*range(1, 9), *range(101, 105))]
        for _ in range(rng.randint(4, 7)):
            lines += [self.assignment(variables) for _ in range(rng.randint(1, 3))]
            lines.append(self.move())
            if rng.random() < 0.3:
                lines.append(f"#[1+{rng.randint(0, 2)}]={self.bracketed(2)}")
        for number in subprograms:
            lines.append(f"M98 P{number}" + (f" L{rng.randint(0, 3)}" if rng.random() < 0.6 else ""))
            lines.append(self.move())
        lines.append("M2")
        self.known = [name for name in self.known if name[1] != "<" or name[2] == "_"]  # names belong to one program
        for k, number in enumerate(subprograms):
            lines += [f"O{number}", "#101=[#101+1]", self.assignment(variables, ()), self.move()]
            if k + 1 < len(subprograms) and rng.random() < 0.4:
                lines.append(f"M98 P{subprograms[k + 1]}")
            lines.append("M99")
        return "\n".join(lines) + "\n"


def rng_numbers(rng):
    """Numbers of none to three subprograms."""
    return rng.sample(range(100, 9000), rng.choice((0, 1, 1, 2, 3)))


def motion(answer):
    """LinuxCNC's rows without those of no length."""
    rows, at = [], [0.0, 0.0, 0.0]
    for move in answer["motion"]:
        if max(abs(a - b) for a, b in zip(move["to"], at)) > 1e-9:
            rows.append({"line": move["line"], "kind": KINDS[move["kind"]], "to": move["to"]})
        at = move["to"]
    return rows


def main():
    rng, records, drawn = random.Random(SEED), [], 0
    while len(records) < COUNT:
        text = Writer(rng).program()
        drawn += 1
        answer = ask(text) if max(map(len, text.splitlines())) < 250 else {"ok": False}
        rows = motion(answer) if answer["ok"] else []
        if rows and max(abs(value) for row in rows for value in row["to"]) < FAR:
            records.append({"name": f"macros-{len(records)}", "text": text, "motion": rows})
    print(f"{drawn} drawn")
    save("iso_macros.json", SEED, records)


if __name__ == "__main__":
    main()
