"""One part said to three controls in words of its own, and mutants of what is said: pairs whose motion is known beforehand.

A part is a list of moves in mm on a grid of a micrometre, made by a random number. Nothing of mnclab is used here.
"""

import math
import random

SPEED, FEEDS = 2400, (150, 300, 480)


def part(seed, count=24):
    """Moves: ("rapid", x, y, z), ("line", x, y, z, f) and ("arc", x, y, z, f, cx, cy, sense), each from where the last ended."""
    rng = random.Random(seed)
    x, y, z = 0.0, 0.0, 50.0
    moves = [("rapid", x, y, z)]
    for _ in range(count // 6 + 1):
        x, y = rng.randint(-40, 40), rng.randint(-30, 30)
        moves += [("rapid", x, y, 50), ("rapid", x, y, 2)]
        z, f = -rng.randint(1, 6), rng.choice(FEEDS)
        moves.append(("line", x, y, z, 100))
        for _ in range(4):
            if rng.random() < 0.4:
                r, sense = rng.choice((5, 8, 12.5)), rng.choice((1, -1))
                along = rng.choice(((1, 0), (0, 1), (-1, 0), (0, -1)))
                cx, cy = x + r * along[0], y + r * along[1]
                quarter = -sense * along[1] * r, sense * along[0] * r  # from the centre, a quarter turn on from the start
                x, y = cx - quarter[0], cy - quarter[1]
                moves.append(("arc", x, y, z, f, cx, cy, sense))
            else:
                x, y = x + rng.choice((-17, -9, 7, 13)), y + rng.choice((-11, -6, 5, 16))
                moves.append(("line", x, y, z, f))
        moves.append(("rapid", x, y, 50))
    return moves


def number(value, inches=False):
    text = f"{value / 25.4:.7f}" if inches else f"{value:.4f}"
    text = text.rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def iso(moves, control="g43", inches=False, frame="", back=lambda x, y: (x, y), by_radius=False):
    """The lines of a program in G words; `frame` turns or shifts it, `back` undoes that for its coordinates."""
    lines = [*(["G20"] if inches else []), "G17 G90 G40 G54", "T1 M6" if control == "g43" else "T1", f"S{SPEED} M3"]
    lines += ["G43 H1"] if control == "g43" else []
    lines += [frame] if frame else []
    feed, at = None, (0.0, 0.0)
    for kind, x, y, z, *more in moves:
        words = [{"rapid": "G0", "line": "G1", "arc": "G2" if more and more[-1] < 0 else "G3"}[kind]]
        (u, v), (a, b) = back(x, y), back(*at)
        words += [f"X{number(u, inches)}", f"Y{number(v, inches)}", f"Z{number(z, inches)}"]
        if kind == "arc":
            words.pop()
            cu, cv = back(more[1], more[2])
            radius = f"R{number(math.dist((cu, cv), (a, b)), inches)}"
            words += [radius] if by_radius else [f"I{number(cu - a, inches)}", f"J{number(cv - b, inches)}"]
        if more and more[0] != feed:
            feed = more[0]
            words.append(f"F{number(feed, inches)}")
        lines.append(" ".join(words))
        at = x, y
    return [*lines, "M5", "M30"]


def klartext(moves, inches=False, mirrored=False):
    """The same in Klartext, with circles about CC; `mirrored` at X0 by a cycle, so that it is written the other way round."""
    def word(axis, value):
        text = number(value, inches)
        return axis + (text if text.startswith("-") else "+" + text)

    lines = [f"BEGIN PGM TWIN {'INCH' if inches else 'MM'}", f"TOOL CALL 1 Z S{SPEED}", "M3"]
    lines += ["CYCL DEF 8.0 MIRRORING", "CYCL DEF 8.1 X"] if mirrored else []
    for kind, x, y, z, *more in moves:
        if mirrored:
            x, more = -x, [*more[:1], -more[1], more[2], -more[3]] if kind == "arc" else more
        feed = "FMAX" if kind == "rapid" else f"F{number(more[0] / (1 if not inches else 2.54), False)}"
        if kind == "arc":
            lines += [f"CC {word('X', more[1])} {word('Y', more[2])}",
                      f"C {word('X', x)} {word('Y', y)} DR{'+' if more[3] > 0 else '-'} {feed}"]
        else:
            lines.append(f"L {word('X', x)} {word('Y', y)} {word('Z', z)} R0 {feed}")
    return [*lines, "M5", "M30", f"END PGM TWIN {'INCH' if inches else 'MM'}"]


def turned(degrees):
    """What undoes a turn of the frame about zero."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda x, y: (c * x + s * y, c * y - s * x)


# Mutants of a Klartext program: another text, and the lines (from 1) at one of which the motion is another one.

def mutant(lines, kind, rng):
    """One fault of a kind; None where the program has no place for it."""
    lines = list(lines)

    def some(fits):
        found = [k for k, line in enumerate(lines) if fits(line)]
        return rng.choice(found) if found else None

    if kind == "coordinate":
        k = some(lambda line: line.startswith("L X"))
        words = lines[k].split(" ")
        axis = rng.choice((1, 2, 3))
        step = 0.01 if axis < 3 else -0.01  # lower
        words[axis] = f"{words[axis][0]}{float(words[axis][1:]) + step:+.4f}"
        lines[k] = " ".join(words)
    elif kind == "sense":
        if (k := some(lambda line: " DR" in line)) is None:
            return None
        lines[k] = lines[k].replace("DR+", "DR*").replace("DR-", "DR+").replace("DR*", "DR-")
    elif kind == "dropped":
        k = some(lambda line: line.startswith("L X"))
        del lines[k]
        return lines, {k, k + 1, k + 2}  # that which goes another way now (behind a CC), or the one before
    elif kind == "feed":
        k = some(lambda line: line.startswith(("L X", "C X")) and "FMAX" not in line)
        lines[k] += "0"
    elif kind == "depth":
        k = some(lambda line: "Z-" in line)
        lines[k] = lines[k].replace("Z-", "Z-1")
    elif kind == "rapid":
        k = some(lambda line: "Z+2 R0 FMAX" in line)
        lines[k] = lines[k].replace("Z+2", f"Z{rng.choice(('+0.5', '-1', '+5'))}")
    elif kind == "feed for rapid":
        k = some(lambda line: "FMAX" not in line and line.startswith("L X"))
        lines[k] = " ".join([*lines[k].split(" ")[:-1], "FMAX"])
    elif kind == "inches":
        lines[0] = lines[0].replace("MM", "INCH")
        lines[-1] = lines[-1].replace("MM", "INCH")
        k = next(k for k, line in enumerate(lines) if line.startswith("L"))
    elif kind == "spindle":
        k = lines.index("M3")
        lines[k] = rng.choice(("M4", "M5"))
        k = next(k for k, line in enumerate(lines) if line.startswith("L") and "FMAX" not in line)
    elif kind == "order":
        starts = [k for k, line in enumerate(lines) if "Z+50" in line][1:]
        a, b, c = starts[0], starts[2], starts[4]
        lines[a:c] = lines[b:c] + lines[a:b]
        return lines, set(range(a + 1, c + 1))
    else:
        raise ValueError(kind)
    return lines, {k + 1}


MUTANTS = (
    "coordinate", "sense", "dropped", "feed", "depth", "rapid", "feed for rapid", "inches", "spindle", "order",
)  # fmt: skip
