"""Random programs of O words and of what LinuxCNC's modes mean, with LinuxCNC's motion: writes iso_flow.json.gz.

    python3 tests/authorities/generate_iso_flow.py

Subprograms with arguments, values and recursion, conditions and loops inside each other, leaving them and going on; beside
them bare functions, assignments behind words, cycles that end with G80 and begin in G99, arcs that miss their end by some
hundredths. Positions are mm. What LinuxCNC refuses is kept with its sentence. Loops with `do` hold moves alone: this version
of LinuxCNC leaves them too early where other O words stand inside them.
"""

import random

from generate_iso_macros import motion
from recording import ask, save

SEED = 274
COUNT = 220
COMPARED = ("EQ", "NE", "LT", "LE", "GT", "GE")


class Writer:
    """Writes a program; `names` gives every O word one of its own."""

    def __init__(self, rng):
        self.rng, self.names, self.lines, self.subs = rng, 0, [], []

    def name(self):
        self.names += 1
        return self.rng.choice((str(100 + self.names), f"<slot{self.names}>", f"< Slot {self.names}>"))

    def value(self):
        rng = self.rng
        return rng.choice((f"#{rng.randint(1, 4)}", "#<_all>", str(rng.randint(0, 9)), f"{rng.uniform(0, 9):.2f}"))

    def formula(self):
        draw = self.rng.random()
        if draw < 0.3:
            return f"[{self.value()}+{self.value()}]"
        if draw < 0.4:
            return f"[ABS[{self.value()}-{self.value()}]*.5]"
        return f"[{self.value()}]"

    def condition(self):
        test = f"{self.value()} {self.rng.choice(COMPARED)} {self.value()}"
        return (
            f"[{test}]"
            if self.rng.random() < 0.7
            else f"[[{test}] {self.rng.choice(('AND', 'OR'))} [{self.value()} GT 2]]"
        )

    def move(self):
        rng = self.rng
        words = [f"{axis}{self.formula()}" for axis in "XYZ" if rng.random() < 0.6] or ["X1.5"]
        if rng.random() < 0.2:
            words.append(f"#{rng.randint(1, 4)}={rng.randint(0, 6)}")
        if rng.random() < 0.15:
            words[0] = f"{words[0][0]} SQRT[{rng.randint(0, 9)}]"
        self.lines.append(" ".join([rng.choice(("G0", "G1")), *words]))

    def blocks(self, depth, loop=""):
        for _ in range(self.rng.randint(1, 3)):
            self.statement(depth, loop)

    def statement(self, depth, loop):
        rng, kind = self.rng, self.rng.random()
        if depth == 0 or kind < 0.4:
            self.move()
        elif kind < 0.5:
            self.lines.append(f"#{rng.randint(1, 4)}={self.formula()}")
        elif kind < 0.65:
            self.branches(depth, loop)
        elif kind < 0.9:
            self.loop(depth)
        elif self.subs:
            arguments = " ".join(self.formula() for _ in range(rng.randint(0, 3)))
            self.lines.append(f"O{rng.choice(self.subs)} call {arguments}".rstrip())
            if rng.random() < 0.5:
                self.lines.append("G1 X#<_value> Y#<_value_returned>")

    def branches(self, depth, loop):
        name = self.name()
        self.lines.append(f"O{name} if {self.condition()}")
        self.blocks(depth - 1)
        if loop and self.rng.random() < 0.5:
            self.lines.append(f"O{loop} {self.rng.choice(('break', 'continue'))}")
        for _ in range(self.rng.choice((0, 0, 1, 2))):
            self.lines.append(f"O{name} elseif {self.condition()}")
            self.blocks(depth - 1)
        if self.rng.random() < 0.5:
            self.lines.append(f"O{name} else")
            self.blocks(depth - 1)
        self.lines.append(f"O{name} endif")

    def loop(self, depth):
        """Each has a counter of its own, so that it ends."""
        name, counter, most = self.name(), f"#<_n{self.names}>", self.rng.randint(1, 4)
        kind = self.rng.choice(("while", "do", "repeat"))
        if kind == "repeat":
            self.lines.append(f"O{name} repeat [{self.rng.choice((most, most + 0.4, 0, -1))}]")
            self.blocks(depth - 1)
            self.lines.append(f"O{name} endrepeat")
            return
        self.lines += [f"{counter}=0", f"O{name} do" if kind == "do" else f"O{name} while [{counter} LT {most}]"]
        self.lines.append(f"{counter}=[{counter}+1]")
        self.blocks(0 if kind == "do" else depth - 1, name)
        self.lines.append(f"O{name} while [{counter} LT {most}]" if kind == "do" else f"O{name} endwhile")

    def subprogram(self):
        name = self.name()
        self.lines += [f"O{name} sub", "#<own>=[#1+2]"]
        self.blocks(2)
        if self.rng.random() < 0.3:
            self.lines += [f"O{self.names}00 if {self.condition()}", f"O{name} return [#1+1]", f"O{self.names}00 endif"]
        if self.rng.random() < 0.3:  # itself, with less
            self.lines += [f"O{self.names}01 if [#2 GT 0]", f"O{name} call [#1] [#2-3]", f"O{self.names}01 endif"]
        self.lines += ["G1 Z#<own>", f"O{name} endsub" + self.rng.choice(("", " [#1*2]"))]
        self.subs.append(name)

    def modes(self):
        rng, radius, off = (
            self.rng,
            self.rng.choice((0.5, 4, 25, 120)),
            self.rng.choice((0.004, 0.02, 0.027, 0.03, 0.1, 0.13)),
        )
        return rng.choice((
            ["G81 X3 Y1 Z-2 R1", "X5", "G80", "G0 X6"], ["G0 Z4", "G98 G81 X3 Z-2 R1", "X5", "G99 X7", "X8", "G80", "G0 Z6"],
            ["G82 X1 Z-2 R1 P.5", "G80", "X4"], ["N10.5 G0 X1", "N2 G1 Y2"], ["M19 R90", "G0 X2"], ["G61", "G1 X4", "X5", "G64"],
            ["G0 X0 Y0", f"G2 X{2 * radius} Y0 I{radius - off / 2:.6f}"], ["G0 X0 Y0", f"G3 X{radius} Y{radius + off} J{radius}"],
        ))  # fmt: skip

    def program(self):
        self.lines = ["G21 G17 G90 G54 F120", "#<_all>=2"]
        for _ in range(self.rng.choice((0, 1, 2))):
            self.subprogram()
        for _ in range(self.rng.randint(2, 4)):
            self.statement(3, "")
        if self.rng.random() < 0.6:
            self.lines += self.modes()
        return "\n".join([*self.lines, "M2"]) + "\n"


def main():
    rng, records = random.Random(SEED), []
    while len(records) < COUNT:
        text = Writer(rng).program()
        answer = ask(text)
        rows = motion(answer)
        if len(rows) < 400:
            said = {} if answer["ok"] else {"line": answer["line"], "error": answer["error"]}
            records.append({"name": f"flow-{len(records)}", "text": text, "motion": [] if said else rows} | said)
    print(sum("error" in record for record in records), "refused")
    save("iso_flow.json.gz", SEED, records)


if __name__ == "__main__":
    main()
