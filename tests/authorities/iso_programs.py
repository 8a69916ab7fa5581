"""Random programs of an ISO mill, each said twice line by line: as the ISO mill reads it, and as LinuxCNC does.

`program(number)` is the same on every machine, so that only the answers of LinuxCNC are recorded. A program is a chain
of parts; each begins with a rapid to an absolute place, so that a part knows where it starts whatever stood before.
Numbers are whole ticks of 0.0001 mm or inch.
"""

from __future__ import annotations

import math
import random

import iso_macros
from spelling import spelled

TICKS = 10_000
PLANES = {"G17": "XYZ", "G18": "ZXY", "G19": "YZX"}  # first axis, second axis, normal
SYSTEMS = [f"G{code}" for code in (54, 55, 56, 57, 58, 59, 59.1, 59.2, 59.3)]
CENTRE = dict(zip("XYZ", "IJK", strict=True))


class Writer:
    """The two texts, and where the program stands in its own coordinates, in ticks of its own unit."""

    def __init__(self, seed: int) -> None:
        self.rng = random.Random(seed)
        self.ours: list[str] = []
        self.theirs: list[str] = []
        self.subs: list[tuple[str, str]] = []  # sub-programs, after the end
        self.at = dict.fromkeys("XYZ", 0)
        self.inch = False
        self.absolute = True
        self.numbers = self.rng.random() < 0.3
        self.shifted = False
        self.system = 0
        self.turned: set[int] = set()  # systems
        self.number = 0  # of the loop, jump or sub-program written last

    def both(self, *words: str, ours: str | None = None) -> None:
        """A line; `ours` where the ISO mill says it otherwise."""
        theirs = " ".join(words)
        self.say(theirs if ours is None else ours, theirs)

    def plain(self, ours: str, theirs: str) -> None:
        """A line as it is."""
        self.ours.append(ours)
        self.theirs.append(theirs)

    def say(self, ours: str, theirs: str) -> None:
        number = f"N{10 * len(self.ours) + 10} " if self.numbers else ""
        self.ours.append(number + spelled(ours, self.rng))
        self.theirs.append(theirs)

    # --- numbers -----------------------------------------------------------------------------------------------------

    def length(self, low: float, high: float) -> int:
        """A length between these, mm, in ticks of the unit of the program."""
        factor = 25.4 if self.inch else 1
        return round(self.rng.uniform(low, high) / factor * TICKS)

    def word(self, axis: str, to: int) -> str:
        """Where an axis goes, as a coordinate or an increment."""
        value = to if self.absolute else to - self.at[axis]
        return f"{axis}{number(value)}"

    def go(self, targets: dict[str, int]) -> list[str]:
        words = [self.word(axis, to) for axis, to in targets.items()]
        self.at |= targets
        return words

    def dimension(self) -> list[str]:
        """Perhaps the other kind of coordinates."""
        if self.rng.random() < 0.3:
            self.absolute = not self.absolute
            return ["G90" if self.absolute else "G91"]
        return []

    def feed(self) -> list[str]:
        return [f"F{number(self.length(60, 900))}"] if self.rng.random() < 0.3 else []

    def place(self) -> dict[str, int]:
        return {"X": self.length(-60, 60), "Y": self.length(-60, 60), "Z": self.length(5, 40)}

    def begin(self) -> None:
        """To a place, absolutely."""
        self.absolute = True
        targets = self.place()
        self.both("G90", "G0", *self.go(targets))


def number(ticks: int) -> str:
    """The shortest decimal spelling."""
    whole, rest = divmod(abs(ticks), TICKS)
    fraction = f"{rest:04d}".rstrip("0")
    return ("-" if ticks < 0 else "") + str(whole) + ("." + fraction if fraction else "")


# --- parts -----------------------------------------------------------------------------------------------------------


def lines(w: Writer) -> None:
    """Rapids and lines of any axes."""
    for _ in range(w.rng.randint(1, 5)):
        axes = w.rng.sample("XYZ", w.rng.randint(1, 3))
        targets = {axis: w.length(-80, 80) for axis in axes}
        w.both(*w.dimension(), w.rng.choice(("G0", "G1")), *w.go(targets), *w.feed())


def arcs(w: Writer) -> None:
    """Arcs and helices in the three planes, by centre or by radius."""
    plane = w.rng.choice(list(PLANES))
    first, second, normal = PLANES[plane]
    w.both(plane)
    for _ in range(w.rng.randint(1, 4)):
        code = w.rng.choice(("G2", "G3"))
        words = [*w.dimension(), code]
        if w.rng.random() < 0.5:
            by_centre(w, words, (first, second, normal))
        else:
            by_radius(w, words, (first, second, normal))
    w.both("G17")


def by_centre(w: Writer, words: list[str], axes: tuple[str, str, str]) -> None:
    first, second, normal = axes
    to_centre = [w.length(-20, 20), w.length(-20, 20)]
    if math.hypot(*to_centre) < w.length(1, 1):
        to_centre[0] = w.length(5, 5)
    centre = [w.at[first] + to_centre[0], w.at[second] + to_centre[1]]
    radius, angle = math.hypot(*to_centre), w.rng.uniform(0, math.tau)
    targets = {
        first: round(centre[0] + radius * math.cos(angle)),
        second: round(centre[1] + radius * math.sin(angle)),
    }
    if w.rng.random() < 0.15:
        targets = {first: w.at[first], second: w.at[second]}  # a whole circle
    if w.rng.random() < 0.3:
        targets[normal] = w.at[normal] + w.length(-10, 10)
    words += w.go(targets)
    words += [f"{CENTRE[axis]}{number(value)}" for axis, value in zip(axes[:2], to_centre)]
    w.both(*words, *w.feed())


def by_radius(w: Writer, words: list[str], axes: tuple[str, str, str]) -> None:
    first, second, normal = axes
    way = w.length(4, 30), w.rng.uniform(0, math.tau)
    targets = {
        first: w.at[first] + round(way[0] * math.cos(way[1])),
        second: w.at[second] + round(way[0] * math.sin(way[1])),
    }
    chord = math.hypot(targets[first] - w.at[first], targets[second] - w.at[second])
    radius = math.ceil(chord / 2 * w.rng.uniform(1.001, 3))
    if w.rng.random() < 0.3:
        targets[normal] = w.at[normal] + w.length(-10, 10)
    words += w.go(targets)
    w.both(*words, f"R{number(radius if w.rng.random() < 0.6 else -radius)}", *w.feed())


HOLES = ("G73", "G81", "G82", "G83", "G85", "G86", "G89")


def holes(w: Writer) -> None:
    """Fixed cycles, repeated, at further places and under both kinds of coordinates."""
    w.absolute = w.rng.random() < 0.6
    back = w.rng.choice(("G98", "G99"))
    for code in w.rng.sample(HOLES, w.rng.randint(1, 2)):
        if code == "G89":
            back = "G99"  # LinuxCNC feeds out of it up to the initial level
        hole(w, code, back)
        for _ in range(w.rng.randint(0, 3)):
            axes = w.rng.choice(("X", "Y", "XY"))
            more = [f"{axis}{number(w.length(-30, 30))}" for axis in axes]
            w.both(*more, *repeats(w))
    w.both(w.rng.choice(("G80", "G0 Z30")) if w.absolute else "G80")


def hole(w: Writer, code: str, back: str) -> None:
    r_level, depth = w.length(1, 30), w.length(4, 25)
    words = [f"X{number(w.length(-40, 40))}", f"Y{number(w.length(-40, 40))}"]
    if w.absolute:
        words += [f"Z{number(r_level - depth)}", f"R{number(r_level)}"]
    else:
        words += [f"Z-{number(depth)}", f"R{number(-w.length(1, 20))}"]
    if code in ("G73", "G83"):
        words.append(f"Q{number(w.length(1.5, 9))}")
    if code in ("G82", "G86", "G89"):
        words.append(f"P{w.rng.choice(('0', '.5', '2'))}")
    w.both("G90" if w.absolute else "G91", back, code, *words, *w.feed(), *repeats(w))


def repeats(w: Writer) -> list[str]:
    return [f"L{w.rng.randint(1, 4)}"] if w.rng.random() < 0.25 else []


def changing_holes(w: Writer) -> None:
    """Fixed cycles within which coordinates, return level, R, Z, unit of place and system change."""
    for code in w.rng.sample(HOLES, 2):
        w.absolute = w.rng.random() < 0.5
        hole(w, code, w.rng.choice(("G98", "G99")))
        for _ in range(w.rng.randint(1, 5)):
            words = [*w.dimension(), *w.rng.choice(((), (), ("G98",), ("G99",)))]
            axes = w.rng.choice(("X", "Y", "XY"))
            words += [f"{axis}{number(w.length(-30, 30))}" for axis in axes]
            if w.rng.random() < 0.25:
                r_level = w.length(2, 20)
                if w.absolute:
                    words += [f"Z{number(r_level - w.length(21, 40))}", f"R{number(r_level)}"]
                else:
                    words += [f"Z{number(-w.length(5, 20))}", f"R{number(w.length(-8, 8))}"]
            w.both(*words, *w.feed(), *repeats(w))
        w.both("G80")
        w.begin()


def systems(w: Writer) -> None:
    """Another work offset, written anew or not, and turned."""
    system = w.rng.randrange(9)
    if w.rng.random() < 0.6:
        shift = [f"{axis}{number(w.length(-50, 50))}" for axis in w.rng.sample("XYZ", w.rng.randint(1, 3))]
        turn = [f"R{number(w.rng.randint(-1_800_000, 1_800_000))}"] if w.rng.random() < 0.4 else []
        w.turned |= {system} if turn else set()
        w.both("G90", "G10", "L2", f"P{system + 1}", *shift, *turn)
    w.both(SYSTEMS[system])
    w.system = system


def shifts(w: Writer) -> None:
    """The present place gets other coordinates, or the origin another place."""
    axes = w.rng.sample("XYZ", w.rng.randint(1, 3))
    words = [f"{axis}{number(w.length(-30, 30))}" for axis in axes]
    if w.shifted:
        w.both(w.rng.choice(("G92.1", "G92.2")))
        w.shifted = False
        return
    w.both("G92", *words)
    w.shifted = True


def local(w: Writer) -> None:
    """A local shift, lines in it, and its end."""
    if w.shifted:
        return
    words = [f"{axis}{number(w.length(-30, 30))}" for axis in "XYZ"]
    w.both("G52", *words)
    w.begin()
    lines(w)
    w.both("G52", "X0", "Y0", "Z0")


def unit(w: Writer) -> None:
    """Inches, or millimetres again."""
    w.inch = not w.inch
    w.both("G20" if w.inch else "G21")


def machine(w: Writer) -> None:
    """A move in machine coordinates."""
    axes = w.rng.sample("XYZ", w.rng.randint(1, 3))
    w.both("G90", "G53", w.rng.choice(("G0", "G1")), *(f"{axis}{number(w.length(-50, 50))}" for axis in axes))


def reference(w: Writer) -> None:
    """Home, over a place or at once; a turned axis has no home of its own."""
    if w.system in w.turned:
        return
    axes = w.rng.sample("XYZ", w.rng.randint(0, 3))
    w.absolute = w.rng.random() < 0.5
    words = [f"{axis}{number(w.length(-30, 30))}" if w.absolute else f"{axis}0" for axis in axes]
    w.both("G90" if w.absolute else "G91", w.rng.choice(("G28", "G30")), *words)


PARTS = (
    *(lines, arcs, arcs, holes, holes, systems, shifts, local, unit, machine, reference),
    *iso_macros.PARTS,
)  # fmt: skip


def program(seed: int, parts: tuple = PARTS) -> tuple[str, str]:
    """The text of the ISO mill and that of LinuxCNC, line by line the same."""
    w = Writer(seed)
    w.both("G21 G17 G90 G94 G40 G49 G54 G80 G98")
    w.both("F200 S800 M3")
    for _ in range(w.rng.randint(2, 6)):
        w.begin()
        w.rng.choice(parts)(w)
    w.begin()
    w.both("M2" if w.subs else w.rng.choice(("M2", "M30")))
    for ours, theirs in w.subs:
        w.plain(ours, theirs)
    return "\n".join(w.ours) + "\n", "\n".join(w.theirs) + "\n"
