"""Parts of random programs with variables, loops, jumps and sub-programs; see `iso_programs`."""

from __future__ import annotations

import math

NEGATED = {"EQ": "NE", "NE": "EQ", "GT": "LE", "LE": "GT", "LT": "GE", "GE": "LT"}


def expression(rng, values, depth=0):
    """A text and its value: whole numbers, decimals, variables, operators, functions."""
    choice = rng.random()
    if depth > 3 or choice < 0.25:
        if values and rng.random() < 0.5:
            name = rng.choice(sorted(values))
            return name, values[name]
        number = rng.choice((rng.randint(0, 40), round(rng.uniform(0, 40), rng.randint(1, 3))))
        return str(number), float(number)
    if choice < 0.7:
        left, right = expression(rng, values, depth + 1), expression(rng, values, depth + 1)
        sign = rng.choice("+-*/")
        if sign == "/" and abs(right[1]) < 1e-3:
            sign = "+"
        value = {
            "+": lambda: left[1] + right[1],
            "-": lambda: left[1] - right[1],
            "*": lambda: left[1] * right[1],
            "/": lambda: left[1] / right[1],
        }[sign]()
        return f"[{left[0]} {sign} {right[0]}]", value
    if choice < 0.78:
        return chain(rng, values)
    if choice < 0.84:
        (y, up), (x, along) = expression(rng, values, depth + 1), expression(rng, values, depth + 1)
        if max(abs(up), abs(along)) > 1e-3:
            return f"ATAN[{y}]/[{x}]", math.degrees(math.atan2(up, along))
    inside, value = expression(rng, values, depth + 1)
    name, function = rng.choice(FUNCTIONS)
    if ill(name, value):
        name, function = "ABS", abs
    if name in ("ROUND", "FIX", "FUP") and abs(2 * value - round(2 * value)) < 1e-6:
        name, function = "ABS", abs
    return f"{name}[{inside}]", function(value)


def chain(rng, values):
    """Operators without brackets, which say by themselves what is worked out first."""
    signs = [rng.choice(("+", "-", "*", "/", "MOD", "**")) for _ in range(rng.randint(2, 4))]
    parts, shown = [], []
    for k in range(len(signs) + 1):
        power = k and signs[k - 1] == "**"
        number = rng.randint(1, 3) if power else rng.randint(1, 9)
        parts.append(float(number))
        shown.append(str(number))
    text = f"[{shown[0]}{''.join(f' {sign} {number}' for sign, number in zip(signs, shown[1:]))}]"
    for level in (("**",), ("*", "/", "MOD"), ("+", "-")):
        k = 0
        while k < len(signs):
            if signs[k] in level:
                parts[k : k + 2] = [joined(parts[k], signs.pop(k), parts[k + 1])]
            else:
                k += 1
    return text, parts[0]


def joined(a, sign, b):
    match sign:
        case "**":
            return a**b
        case "*":
            return a * b
        case "/":
            return a / b
        case "MOD":
            return math.fmod(a, b)
        case "+":
            return a + b
    return a - b


def ill(name, value):
    """Whether a function has no value there, or one that the last digits of its argument decide."""
    match name:
        case "SQRT":
            return value < 1e-6
        case "ASIN" | "ACOS":
            return abs(value) > 1 - 1e-6
        case "SIN" | "COS":
            return abs(value) > 1e4
        case "TAN":
            return abs(value) > 1e4 or abs(math.cos(math.radians(value))) < 0.05
    return False


FUNCTIONS = (
    ("SIN", lambda a: math.sin(math.radians(a))),
    ("COS", lambda a: math.cos(math.radians(a))),
    ("TAN", lambda a: math.tan(math.radians(a))),
    ("ASIN", lambda a: math.degrees(math.asin(a))),
    ("ACOS", lambda a: math.degrees(math.acos(a))),
    ("SQRT", math.sqrt),
    ("ABS", abs),
    ("ROUND", lambda a: float(math.floor(abs(a) + 0.5)) * math.copysign(1, a)),
    ("FIX", lambda a: float(math.floor(a))),
    ("FUP", lambda a: float(math.ceil(a))),
)


def arithmetic(w):
    """Variables, and positions from them."""
    values = {}
    for _ in range(w.rng.randint(1, 5)):
        name = f"#{w.rng.choice((*range(1, 8), *range(100, 105)))}"
        text, value = expression(w.rng, values)
        if not abs(value) < 1e5:
            continue
        values[name] = value
        w.both(f"{name}={text}")
    for _ in range(w.rng.randint(1, 3)):
        words = []
        for axis in w.rng.sample("XYZ", w.rng.randint(1, 3)):
            text, value = expression(w.rng, values)
            if abs(value) < 300:
                words.append(f"{axis}{text}" if text[0] in "#[" else f"{axis}[{text}]")
        if words:
            w.both("G90", w.rng.choice(("G0", "G1")), *words)


def loop(w):
    """A counted loop of moves."""
    name, times = f"#{w.rng.randint(10, 20)}", w.rng.randint(1, 6)
    w.number += 1
    label = 100 + w.number
    w.both(f"{name}=0")
    which = w.rng.randint(1, 3)
    w.say(f"WHILE [{name} LT {times}] DO {which}", f"o{label} while [{name} LT {times}]")
    w.both("G91", "G1", f"X[{name} * 2]", f"Y-{w.rng.randint(1, 5)}")
    w.both(f"{name}=[{name} + 1]")
    w.say(f"END {which}", f"o{label} endwhile")
    w.both("G90")


def jump(w):
    """Over a move, or not."""
    name = f"#{w.rng.randint(10, 20)}"
    w.number += 1
    label, test = 100 + w.number, w.rng.choice(sorted(NEGATED))
    left, right = w.rng.randint(0, 4), w.rng.randint(0, 4)
    w.both(f"{name}={left}")
    w.plain(f"IF [{name} {test} {right}] GOTO {90000 + label}", f"o{label} if [{name} {NEGATED[test]} {right}]")
    w.both("G90", "G1", f"X{w.rng.randint(-20, 20)}", f"Z{w.rng.randint(1, 20)}")
    w.plain(f"N{90000 + label}", f"o{label} endif")


def calls(w):
    """A sub-program, called some times."""
    w.number += 1
    label, times = 1000 + w.number, w.rng.randint(1, 4)
    w.both("M98", f"P{label}", *([f"L{times}"] if times > 1 or w.rng.random() < 0.3 else []))
    main = w.ours, w.theirs
    w.ours, w.theirs = [], []
    w.plain(f"O{label}", f"O{label}")
    w.both("G91")
    for _ in range(w.rng.randint(1, 3)):
        w.both(w.rng.choice(("G0", "G1")), f"X{w.rng.randint(-9, 9)}", f"Y{w.rng.randint(-9, 9)}")
    w.both("G90")
    w.both("M99")
    w.subs += zip(w.ours, w.theirs, strict=True)
    w.ours, w.theirs = main


PARTS = (arithmetic, arithmetic, loop, jump, calls)
