"""Parts of several tools, drilled and cut round, said to three controls, by compensation and as the way of the tool's centre.

A part is a list of operations in mm on a grid of a micrometre, made by a random number. Nothing of mnclab is used here: the way
of the centre is worked out by the geometry of offset lines and circles alone.
"""

import math
import random

from tools.twins import number

RADII, SPEEDS = {1: 3.0, 2: 4.0, 3: 5.0}, {1: 2400, 2: 900, 3: 1600}  # of the mills 1 and 3 and of drill 2
SAFE, CLEAR, ABOVE = 50, 20, 2  # heights: between operations, between holes, before feed


def shop(seed, count=4):
    """Operations: ("drill", tool, feed, depth, holes) and ("contour", tool, feed, depth, side, corners): x, y, fillet."""
    rng, made = random.Random(seed), []
    for k in range(count):
        x, y = rng.randint(-60, 60), rng.randint(-60, 60)
        if (k + seed) % 2:
            holes = sorted({(x + 7 * rng.randint(-6, 6), y + 7 * rng.randint(-6, 6)) for _ in range(5)})
            made.append(("drill", 2, rng.choice((80, 120)), -rng.randint(4, 15), holes))
            continue
        angles = [0.0]
        while (angle := angles[-1] + rng.uniform(50, 110)) < 310:
            angles.append(angle)
        spokes = [(math.radians(a + rng.uniform(0, 9)), rng.uniform(26, 36)) for a in angles[:: rng.choice((1, -1))]]
        corners = [(round(x + r * math.cos(a), 3), round(y + r * math.sin(a), 3), rng.choice((0, 0, 7.5))) for a, r in spokes]
        made.append(("contour", rng.choice((1, 3)), rng.choice((200, 350)), -rng.randint(1, 5), rng.choice((1, -1)), corners))
    return made


# The contour: from the middle of a side once round, and back to it.

def contour(corners, radius=0.0, side=0):
    """Moves (x, y) and (x, y, cx, cy, sense), from a first place (x, y): the contour, or beside it the centre of a tool."""
    n, moves = len(corners), []
    ways = []
    for k in range(n):
        (x, y, _), (u, v, _) = corners[k - 1], corners[k]
        long = math.dist((x, y), (u, v))
        ways.append(((u - x) / long, (v - y) / long))

    def beside(x, y, way):
        return x - side * radius * way[1], y + side * radius * way[0]

    middle = tuple((a + b) / 2 for a, b in zip(corners[-1][:2], corners[0][:2]))
    for k, (x, y, fillet) in enumerate(corners):
        before, behind = ways[k], ways[(k + 1) % n]
        cross = before[0] * behind[1] - before[1] * behind[0]
        fillet *= abs(cross) > 0.4  # an arc that is shorter than rounding may turn is none
        turn, along = (1 if cross > 0 else -1), before[0] * behind[0] + before[1] * behind[1]
        outside = turn * side < 0
        if fillet:
            cut = fillet * math.tan(math.atan2(abs(cross), along) / 2)
            first, last = (x - cut * before[0], y - cut * before[1]), (x + cut * behind[0], y + cut * behind[1])
            centre = first[0] - turn * fillet * before[1], first[1] + turn * fillet * before[0]
            moves += [beside(*first, before), (*beside(*last, behind), *centre, turn)]
        elif side and outside:
            moves += [beside(x, y, before), (*beside(x, y, behind), x, y, turn)]
        elif side:
            share = side * radius / (1 + along)
            moves.append((x - share * (before[1] + behind[1]), y + share * (before[0] + behind[0])))
        else:
            moves.append((x, y))
    return beside(*middle, ways[0]), [*moves, beside(*middle, ways[0])]


def far_from(corners, side):
    """A place on the side of the tool, 12 mm from the middle of the first side of the contour."""
    (x, y), _ = contour(corners)
    u, v = corners[0][0] - x, corners[0][1] - y
    long = math.hypot(u, v)
    return round(x - side * 12 * v / long, 3), round(y + side * 12 * u / long, 3)


# What is written. A block is an opening, places by their addresses, and what stands behind.

def iso(made, control="g43", compensated=True, cycles=True):
    """In G words: by G41 and G42 or along the way of the centre, holes by G81 or block by block."""
    lines = ["G17 G90 G40 G54"]

    def go(code, behind="", **places):
        words = [f"{axis}{number(value)}" for axis, value in places.items()]
        lines.append(" ".join(filter(None, [code, *words, behind])))

    for kind, tool, feed, depth, *more in made:
        lines += [f"T{tool} M6" if control == "g43" else f"T{tool}", f"S{SPEEDS[tool]} M3"]
        lines += [f"G43 H{tool}"] if control == "g43" else []
        if kind == "drill":
            holes = more[0]
            go("G0", X=holes[0][0], Y=holes[0][1], Z=SAFE)
            go("", Z=CLEAR)
            for k, (x, y) in enumerate(holes):
                if cycles:
                    go("G98 G81" if not k else "", "" if k else f"Z{depth} R{ABOVE} F{feed}", X=x, Y=y)
                else:
                    go("G0", X=x, Y=y)
                    go("", Z=ABOVE)
                    go("G1", f"F{feed}", Z=depth)
                    go("G0", Z=CLEAR)
            lines += ["G80"] if cycles else []
            go("G0", Z=SAFE)
            continue
        side, corners = more
        start, round_ = contour(corners, *(() if compensated else (RADII[tool], side)))
        x, y = far_from(corners, side)
        go("G0", X=x, Y=y, Z=SAFE)
        go("", Z=ABOVE)
        go("G1", "F100", Z=depth)
        go(f"G{42 if side < 0 else 41}{f' D{tool}' if control == 'g43' else ''} G1" if compensated else "", f"F{feed}",
           X=start[0], Y=start[1])  # fmt: skip
        at = start
        for u, v, *arc in round_:
            if arc:
                go("G3" if arc[2] > 0 else "G2", X=u, Y=v, I=arc[0] - at[0], J=arc[1] - at[1])
            else:
                go("G1", X=u, Y=v)
            at = u, v
        go("G40 G1" if compensated else "G1", X=x, Y=y)
        go("G0", Z=SAFE)
    return [*lines, "M5", "M30"]


def klartext(made, compensated=True):
    """In Klartext: by RL and RR or along the way of the centre, holes by cycle 200."""
    lines = ["BEGIN PGM SHOP MM"]

    def go(code, behind="", **places):
        words = [f"{axis}{'' if number(value).startswith('-') else '+'}{number(value)}" for axis, value in places.items()]
        lines.append(" ".join(filter(None, [code, *words, behind])))

    for kind, tool, feed, depth, *more in made:
        lines += [f"TOOL CALL {tool} Z S{SPEEDS[tool]}", "M3"]
        if kind == "drill":
            go("L", "R0 FMAX", X=more[0][0][0], Y=more[0][0][1], Z=SAFE)
            go("L", "FMAX", Z=CLEAR)
            cycle = {"Q200": ABOVE, "Q201": depth, "Q206": feed, "Q202": 20, "Q210": 0, "Q203": 0, "Q204": CLEAR, "Q211": 0}
            lines += ["CYCL DEF 200 DRILLING ~", *(f"{name}={value} ~" for name, value in cycle.items()), "Q395=0"]
            for x, y in more[0]:
                go("L", "R0 FMAX M99", X=x, Y=y)
            go("L", "FMAX", Z=SAFE)
            continue
        side, corners = more
        start, round_ = contour(corners, *(() if compensated else (RADII[tool], side)))
        x, y = far_from(corners, side)
        go("L", "R0 FMAX", X=x, Y=y, Z=SAFE)
        go("L", "FMAX", Z=ABOVE)
        go("L", "F100", Z=depth)
        go("L", f"{'RL' if side > 0 else 'RR'} F{feed}" if compensated else f"F{feed}", X=start[0], Y=start[1])
        for u, v, *arc in round_:
            if arc:
                go("CC", X=arc[0], Y=arc[1])
                go("C", f"DR{'+' if arc[2] > 0 else '-'}", X=u, Y=v)
            else:
                go("L", X=u, Y=v)
        go("L", "R0", X=x, Y=y)
        go("L", "FMAX", Z=SAFE)
    return [*lines, "M5", "M30", "END PGM SHOP MM"]


# Mutants of the Klartext: another text, and the lines (from 1) at one of which the motion is another one.

def mutant(lines, kind, rng):
    """One fault of a kind; None where the program has no place for it."""
    lines = list(lines)
    found = [k for k, line in enumerate(lines) if FAULTS[kind][0](line)]
    if not found:
        return None
    k = rng.choice(found)
    if kind == "dropped":
        del lines[k]
        return lines, {k, k + 1, k + 2}
    if kind == "order":
        calls = [k for k, line in enumerate(lines) if line.startswith("TOOL CALL")]
        if len(calls) < 3:
            return None
        a, b, c = calls[:3]
        lines[a:c] = lines[b:c] + lines[a:b]
        return lines, set(range(a + 1, c + 1))
    lines[k] = FAULTS[kind][1](lines[k], rng)
    first = {k + 1}
    if kind in ("radius", "length", "tool", "speed"):  # the first cut with it, and what stands before
        first |= set(range(k + 1, next(j for j in range(k, len(lines)) if "F100" in lines[j] or "M99" in lines[j]) + 3))
    if lines[k].startswith("Q"):  # a cycle works where it is called
        first |= set(range(k + 1, next(j for j in range(k, len(lines)) if "M99" in lines[j]) + 2))
    if lines[k].startswith("CC"):
        first.add(k + 2)
    return lines, first


def _moved(line, rng):
    words = line.split(" ")
    k = rng.choice((1, 2))
    words[k] = f"{words[k][0]}{float(words[k][1:]) + rng.choice((-0.01, 0.01)):+.4f}"
    return " ".join(words)


def _swapped(one, other):
    return lambda line, rng: line.replace(one, "*").replace(other, one).replace("*", other)


FAULTS = {
    "coordinate": (lambda line: line.startswith(("L X", "C X")) and "FMAX" not in line and "R0" not in line, _moved),
    "hole": (lambda line: "M99" in line, _moved),
    "sense": (lambda line: line.startswith("C X"), _swapped("DR+", "DR-")),
    "side": (lambda line: " RL " in line or " RR " in line, _swapped("RL", "RR")),
    "no side": (lambda line: " RL " in line or " RR " in line, lambda line, rng: line.replace("RL", "R0").replace("RR", "R0")),
    "dropped": (lambda line: line.startswith(("L X", "C X")) and "FMAX" not in line and "R" not in line, None),
    "depth": (lambda line: line.startswith("L Z-"), lambda line, rng: line.replace("Z-", "Z-1")),
    "depth of a hole": (lambda line: line.startswith("Q201"), lambda line, rng: line.replace("-", "-1")),
    "depth from R": (lambda line: line.startswith("Q201"), lambda line, rng: f"Q201={int(line.split('=')[1][:-2]) - ABOVE} ~"),
    "surface": (lambda line: line.startswith("Q203"), lambda line, rng: f"Q203={rng.choice((-ABOVE, ABOVE))} ~"),
    "return": (lambda line: line.startswith("Q204"), lambda line, rng: f"Q204={CLEAR - ABOVE} ~"),
    "feed": (lambda line: line.startswith("L X") and " F" in line and "FMAX" not in line, lambda line, rng: line + "0"),
    "feed of a hole": (lambda line: line.startswith("Q206"), lambda line, rng: line.replace(" ~", "0 ~")),
    "radius": (lambda line: line.startswith("TOOL CALL"), lambda line, rng: f"{line} DR+0.1"),
    "length": (lambda line: line.startswith("TOOL CALL"), lambda line, rng: f"{line} DL{rng.choice('+-')}0.1"),
    "tool": (lambda line: line.startswith("TOOL CALL"), lambda line, rng: line.replace(" 1 ", " 2 ") if " 1 " in line
             else line.replace(" 3 ", " 1 ").replace(" 2 ", " 1 ")),
    "speed": (lambda line: line.startswith("TOOL CALL"), lambda line, rng: line.replace("00", "50")),
    "order": (lambda line: True, None),
}  # fmt: skip
