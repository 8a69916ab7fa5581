"""G38.2 and G38.3 of LinuxCNC's interpreter, where nothing is touched: refused blocks, ends of moves; writes iso_probing.json.

    python3 tests/authorities/generate_iso_probing.py

A record has the text, and `error`, LinuxCNC's sentence, or the `motion`: line, kind, end (mm, machine coordinates) and feed.
The interpreter alone has no part: a probe goes to the end of its way, and #5061 and the next tell that place. The texts read
them by going there. G93 is left out: the interpreter keeps the feed per minute that was before it, and we refuse it; @ and ^
are not built.
"""

import random

from recording import ask, save

SEED = 38
HEAD = "G21 G17 G90 G94 F100\nG0 X1 Y2 Z10\n"
PLACE = "\nG21 G90 G0 X#5061 Y#5062 Z#5063\nX#5070 Y#5064"
BLOCKS = (
    *("G38.2", "G38.2 F50", "G38.2 Z10", "G38.3 Z10", "G94\nG38.3 Z3", "F0 G38.3 Z3", "G95 F.1 G38.3 Z3"),
    *("G41.1 D4\nG38.3 X9", "G95 F.1 S100 M3\nG38.3 Z3", "G41.1 D4\nG1 X20\nG38.3 X40", "G53 G38.3 Z3"),
    *("G1 X2\nG53 G38.3 Z3", "G38.3 Z3 R2", "G38.3 Z3 P2", "G38.3 Z3 I1", "G38.3 Z3 G1", "G38.3 Z3 G38.2", "G38 Z3"),
    *("G38.1 Z3", "G38.6 Z3", "G31 Z3", "G28 G38.3 Z3", "G30 G38.3 Z3", "G38.3 G92 Z3", "G38.3 G10 L2 P1 Z3", "G38.3 G52 Z3"),
    *("G36 Z3", "G38.3 Z3\nX7", "G38.3 Z3\nG0 X7\nX8", "G80 G38.3 Z3", "G81 X3 Z1 R2\nG38.3 Z3\nX9"),
    *("G38.3 Z3\nG81 X3 Z1 R2", "G18 G38.3 Y7", "S100 M3\nG38.3 Z3", "G38.3 Z3 S100 M3 M8", "G61\nG38.3 Z3", "G38.3 Z3 F60"),
    *("G91 G38.3 Z-3", "G91 G38.3 X1 Y1 Z-3\nX2", "G20 G38.3 Z.1", "G20 G38.3 Z.1\nG21", "G38.3 Z3\nG20"),
    *("G55 G38.3 Z3\nG54", "#5061=3", "#5070=3", "G38.3 Z3\n#5063=8", "G38.3 Z[#5063-4]"),
    *("G38.3 Z3\nG38.3 X5\nG38.3 Y6 Z#5063", "G38.3 X2\nG92 X8", "G92 X8\nG38.3 X2", "G92 X8\nG38.3 X2\nG92.1"),
    *("G43.1 Z4\nG38.3 Z3", "G10 L2 P1 R30\nG38.3 X5", "G10 L2 P2 X3 Y4 Z5 R30\nG55\nG38.3 X5"),
    *("O1 sub\nG38.3 Z#1\nO1 endsub\nO1 call [4]", "O1 while [#5063 LT 4]\nG91 G38.3 Z1\nO1 endwhile", "G38.3 Z3\nG40"),
    "G64 P.1\nG38.3 Z3",
)  # fmt: skip


def axes(rng, reach):
    chosen = [axis for axis in "XYZ" if rng.random() < 0.6] or ["Z"]
    return " ".join(f"{axis}{rng.uniform(-reach, reach):.4f}" for axis in chosen)


def program(rng):
    """Probing, and what changes where coordinates count from, and in what."""
    lines, reach = [], 40.0
    for _ in range(rng.randint(6, 14)):
        kind = rng.random()
        if kind < 0.45:
            lines.append(f"G38.3 {axes(rng, reach)}" + rng.choice(("", "", f" F{rng.randint(20, 300)}")))
        elif kind < 0.6:
            lines.append(f"G0 X[#5061+{rng.randint(1, 9)}] Y#5062 Z[#5063-1]")
        elif kind < 0.7:
            lines.append(f"G1 {axes(rng, reach)}")
        else:
            shift = f"G92 {axes(rng, 20)}"
            row = rng.randint(1, 6)
            turn = f"G92.1\nG10 L2 P{row} {axes(rng, 30)} R{rng.choice((0, 30, -77.5))}"
            lines.append(rng.choice((shift, "G92.1", turn, f"G{53 + row}", "G91", "G90", "G90")))
        if rng.random() < 0.1:
            inch = rng.random() < 0.5
            lines.append("G20" if inch else "G21")
            reach = 1.5 if inch else 40.0
    return "\n".join(lines)


def programs():
    for block in BLOCKS:
        yield f"block: {block}", f"{HEAD}{block}{PLACE}\nM2\n"
    rng = random.Random(SEED)
    for number in range(200):
        yield f"random: {number}", f"{HEAD}{program(rng)}{PLACE}\nM2\n"


def main():
    records = []
    for name, text in programs():
        answer = ask(text)
        said = {"motion": answer["motion"]} if answer["ok"] else {"error": answer["error"]}
        records.append({"name": name, "text": text} | said)
    save("iso_probing.json", SEED, records)


if __name__ == "__main__":
    main()
