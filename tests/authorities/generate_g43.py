"""Random programs of the drilling cycles of ISO controls, with LinuxCNC's motion: writes g43.json.

    python3 tests/authorities/generate_g43.py

LinuxCNC returns to 0.01 inch above the last peck (G83) and lifts as much (G73): 0.254 mm here. Rows of no length, which
LinuxCNC makes where the tool is already, are left out. Every cycle begins above level R. With G98 LinuxCNC feeds out
of G89 up to the initial level, which others do not: this one always has G99.
"""

import random

from recording import KINDS, ask, decimal, mm, save

SEED = 43
CYCLES = (73, 81, 82, 83, 85, 86, 89)


def program(rng):
    """The text of a program: some holes of one or two cycles, absolute or incremental."""
    lines = ["G17 G90 G54 F120 S800 M3", f"G0 X{rng.randint(-9, 9)} Y{rng.randint(-9, 9)} Z{rng.randint(20, 30)}"]
    for code in rng.sample(CYCLES, 2):
        incremental = rng.random() < 0.4
        r, depth = rng.randint(1, 5), decimal(mm(rng.uniform(4, 25)))
        lines.append(f"G9{int(incremental)} G{99 if code == 89 else rng.choice((98, 99))}")
        words = {
            "X": decimal(mm(rng.uniform(-40, 40))),
            "Y": decimal(mm(rng.uniform(-40, 40))),
            "Z": f"-{depth}",
            "R": str(-r) if incremental else str(r),
        }
        if code in (73, 83):
            words["Q"] = decimal(mm(rng.uniform(1, 9)))
        if code in (82, 86, 89):
            words["P"] = "0"
        if rng.random() < 0.5:
            words["F"] = str(rng.randint(50, 300))
        lines.append(" ".join([f"G{code}", *(f"{address}{value}" for address, value in words.items())]))
        for _ in range(rng.randint(0, 3)):
            axes = rng.choice(("X", "Y", "XY"))
            lines.append(" ".join(f"{axis}{decimal(mm(rng.uniform(-30, 30)))}" for axis in axes))
        lines.append("G80")
        lines.append(f"G90 G0 Z{rng.randint(20, 30)}")
    return lines


def motion(answer):
    """LinuxCNC's rows without those of no length."""
    rows, at = [], [0.0, 0.0, 0.0]
    for move in answer["motion"]:
        if max(abs(a - b) for a, b in zip(move["to"], at)) > 1e-9:
            rows.append({"line": move["line"], "kind": KINDS[move["kind"]], "to": move["to"]})
            if "feed" in move:
                rows[-1]["feed"] = move["feed"]
        at = move["to"]
    return rows


def main():
    rng, records = random.Random(SEED), []
    for number in range(120):
        text = "\n".join(program(rng)) + "\n"
        answer = ask(text + "M2\n")
        if not answer["ok"]:
            raise SystemExit(f"LinuxCNC refuses program {number}: {answer['error']}\n{text}")
        records.append({"name": f"holes-{number}", "text": text, "motion": motion(answer)})
    save("g43.json", SEED, records)


if __name__ == "__main__":
    main()
