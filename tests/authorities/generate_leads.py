"""How LinuxCNC begins compensation with an arc and leaves a contour after G40: writes leads.json.

    python3 tests/authorities/generate_leads.py

Random entries by arcs on both sides, one or two lines, exits in all directions. Positions are mm. What LinuxCNC refuses is
drawn again, and so are joints of less than 3 degrees, which it rounds off. Behind the entry the contour goes straight on or
turns away from the tool. leads_inside.json has those where it turns towards the tool, into a line or an arc: LinuxCNC
shortens the arc of the entry there. What it refuses of them is kept with its sentence. leads_lines.json has entries by a
line, before corners of both kinds, and after some of the contours G40 and a move along Z.
"""

import math
import random

from recording import ask, motion, save

SEED = 41
COUNT, INSIDE, LINES = 120, 80, 80
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


def inside(rng):
    """A text whose contour turns towards the tool behind the arc of its entry."""
    radius, code, side = rng.uniform(8, 30), rng.choice(("G2", "G3")), rng.choice(("G41.1", "G42.1"))
    begin, sweep = rng.uniform(0, math.tau), rng.uniform(0.5, 3.0)
    sense = 1 if code == "G3" else -1
    centre = [round(-radius * math.cos(begin), 4), round(-radius * math.sin(begin), 4)]
    at, heading, lines = [0.0, 0.0], begin + sense * math.pi / 2, []

    def arc(code, sense, centre, sweep):
        nonlocal at, heading
        x, y, c, s = at[0] - centre[0], at[1] - centre[1], math.cos(sense * sweep), math.sin(sense * sweep)
        way = f"I{-x:.9f} J{-y:.9f}"
        at, heading = [centre[0] + x * c - y * s, centre[1] + x * s + y * c], heading + sense * sweep
        lines.append(f"{code} X{at[0]:.9f} Y{at[1]:.9f} {way}")

    arc(code, sense, centre, sweep)
    heading += (1 if side == "G41.1" else -1) * rng.uniform(BENT, 2.4)
    if rng.random() < 0.5:
        bow, code, sense = rng.uniform(15, 60), *rng.choice((("G2", -1), ("G3", 1)))
        arc(code, sense, [at[0] - sense * bow * math.sin(heading), at[1] + sense * bow * math.cos(heading)], rng.uniform(0.5, 2))
    way = rng.uniform(30, 60)
    lines.append(f"G1 X{at[0] + way * math.cos(heading):.9f} Y{at[1] + way * math.sin(heading):.9f}")
    head = ["G21 G17 G90 G54 G64", "F200", "G0 X0 Y0", f"{side} D{rng.choice((4, 6, 10))}"]
    return "\n".join([*head, *lines, "G40", "M2"]) + "\n"


def straight(rng):
    """A text whose entry is a line; joints that LinuxCNC rounds off, and such as all but turn back, are left out."""
    at, heading = [0.0, 0.0], rng.uniform(0, math.tau)
    lines = []
    for k in range(rng.randint(2, 4)):
        heading += rng.choice((-1, 1)) * rng.uniform(BENT, math.pi - 2 * BENT) if k else 0.0
        way = rng.uniform(15, 50)
        at = [at[0] + way * math.cos(heading), at[1] + way * math.sin(heading)]
        lines.append(f"G1 X{at[0]:.9f} Y{at[1]:.9f}")
    lines += ["G40", rng.choice(("G0 Z9", "G1 Z-1", "G1 X0 Y0")), "G1 X100 Y100"]
    head = ["G21 G17 G90 G54 G64", "F200", "G0 X0 Y0", f"{rng.choice(('G41.1', 'G42.1'))} D{rng.choice((2, 4, 6))}"]
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
    rng, records = random.Random(SEED + 1), []
    for k in range(INSIDE):
        text = inside(rng)
        answer = ask(text)
        said = {} if answer["ok"] else {"error": answer["error"]}
        records.append({"name": f"inside-{k}", "text": text, "motion": motion(answer, {k: k for k in range(1, 99)})} | said)
    save("leads_inside.json", SEED + 1, records)
    rng, records = random.Random(SEED + 2), []
    for k in range(LINES):
        text = straight(rng)
        answer = ask(text)
        said = {} if answer["ok"] else {"error": answer["error"]}
        records.append({"name": f"lines-{k}", "text": text, "motion": motion(answer, {k: k for k in range(1, 99)})} | said)
    save("leads_lines.json", SEED + 2, records)


if __name__ == "__main__":
    main()
