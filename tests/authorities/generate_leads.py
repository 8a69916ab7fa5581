"""How LinuxCNC begins compensation with an arc and leaves a contour after G40: writes leads.json.

    python3 tests/authorities/generate_leads.py

Random entries by arcs on both sides, one or two lines, exits in all directions. Positions are mm. What LinuxCNC refuses is
drawn again, and so are joints of less than 3 degrees, which it rounds off. Behind the entry the contour goes straight on or
turns away from the tool: where it turns towards it, LinuxCNC shortens the arc of the entry, and the rows here lead on as at
any other inside corner.
"""

import math
import random

from recording import ask, motion, save

SEED = 41
COUNT = 120
BENT = math.radians(3)


def turned(angle, other):
    return abs(math.remainder(angle - other, math.tau))


def program(rng):
    """A text, or None where a joint is too flat or a way too short."""
    radius, code, side = rng.uniform(8, 30), rng.choice(("G2", "G3")), rng.choice(("G41.1", "G42.1"))
    begin, sweep = rng.uniform(0, math.tau), rng.uniform(0.4, 3.0)
    sense, outside = 1 if code == "G3" else -1, -1 if side == "G41.1" else 1
    centre = [round(-radius * math.cos(begin), 4), round(-radius * math.sin(begin), 4)]
    r = math.hypot(*centre)
    angle = math.atan2(-centre[1], -centre[0]) + sense * sweep
    at, heading = [centre[0] + r * math.cos(angle), centre[1] + r * math.sin(angle)], angle + sense * math.pi / 2
    lines = [f"{code} X{at[0]:.9f} Y{at[1]:.9f} I{centre[0]} J{centre[1]}"]
    for k in range(rng.randint(2, 3)):
        turn = rng.uniform(-2.6, 2.6) if k else rng.choice((0.0, outside * rng.uniform(BENT, 2.0)))
        if 0 < abs(turn) < BENT:
            return None
        heading += turn
        way = rng.uniform(20, 50)
        at = [at[0] + way * math.cos(heading), at[1] + way * math.sin(heading)]
        lines.append(f"{'G40 ' if k and rng.random() < 0.5 else ''}G1 X{at[0]:.9f} Y{at[1]:.9f}")
    if "G40" not in "".join(lines):
        lines.append("G40")
        lines.append(f"G1 X{at[0] + rng.uniform(-40, 40):.9f} Y{at[1] + rng.uniform(-40, 40):.9f}")
    head = ["G21 G17 G90 G54 G64", "F200", "G0 X0 Y0", f"{side} D{rng.choice((4, 6, 10))}"]
    return "\n".join([*head, *lines, "M2"]) + "\n"


def main():
    rng, records = random.Random(SEED), []
    while len(records) < COUNT:
        text = program(rng)
        answer = ask(text) if text else {"ok": False}
        if answer["ok"]:
            lines = {k: k for k in range(1, 99)}
            records.append({"name": f"leads-{len(records)}", "text": text, "motion": motion(answer, lines)})
    save("leads.json", SEED, records)


if __name__ == "__main__":
    main()
