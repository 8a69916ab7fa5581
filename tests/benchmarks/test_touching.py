"""What probing costs: one touch on a part of twenty solids, and a program of 500 touches."""

import time

import numpy as np
import pytest

import mnclab as mnc

pytestmark = pytest.mark.benchmark
P = mnc.part
TOUCHES = 500


def plate():
    """Twenty solids: a box, ten holes, nine bosses."""
    found = P.box((0, 0, -30), (200, 100, 0))
    for k in range(10):
        found = found - P.hole((15 + 18 * k, 30, 0), 10, 12)
    for k in range(9):
        found = found | P.boss((15 + 18 * k, 70, 0), 8, diameter=10)
    return found


def test_touches(capsys):
    part, random = plate(), np.random.default_rng(1)
    starts = random.uniform((-9, 5, -20), (-3, 95, -3), (TOUCHES, 3))
    begin = time.process_time()
    for start in starts:
        P.contact(part, start, (1, 0, 0), 2, 20)
    alone = time.process_time() - begin
    words = "Q263=0\nQ261=-5\nQ320=0\nQ260=20\nQ272=1\nQ267=1\nQ305=5\nQ333=0\nQ303=1\n"
    cycles = "".join(f"TCH PROBE 419 X\nQ264={10 + 80 * k / TOUCHES:g}\n{words}" for k in range(TOUCHES))
    text = f"BEGIN PGM P MM\nTOOL CALL 7 Z\nL X-20 Y+20 Z+50 R0 FMAX\n{cycles}END PGM P MM\n"
    setup = mnc.Setup(tools={7: mnc.Tool(radius=2, length=50, kind="probe")}, part=part, start=(0, 0, 200))
    begin = time.process_time()
    run = mnc.run(text, "tnc-620", setup)
    whole = time.process_time() - begin
    assert run.ok and len(run.touches) == TOUCHES
    with capsys.disabled():
        print(f"\ncontact {alone / TOUCHES * 1e3:.2f} ms; a program of {TOUCHES} touches {whole:.2f} s, ", end="")
        print(f"{whole / alone:.1f} times the contacts alone (four guarded rows to each)")


@pytest.mark.parametrize("errors", [{}, {"taper": 0.5, "bow": 0.02, "roughness": 0.003}])
def test_ways(capsys, errors):
    """What one touch costs where it is not straight ahead, and a row of a ball with its stem."""
    part = plate().with_errors(**errors)
    ways = {
        "in a bore": lambda k: P.contact(part, (15 + 18 * (k % 10), 30, -5), (np.cos(k), np.sin(k), 0), 1.5, 30),
        "slanting": lambda k: P.contact(part, (-12, 5 + 0.1 * k, -15), (1, 0.1, 0.02), 1.5, 60),
        "from above": lambda k: P.contact(part, (0.4 * k, 50, 8), (0, 0, -1), 1.5, 30),
        "a row over it": lambda k: part.blocked((-20, 0.2 * k, 15), (220, 100 - 0.2 * k, 15), 1.5, 1.0, 50),
        "down a bore": lambda k: part.blocked((15 + 18 * (k % 10), 30, 50), (15 + 18 * (k % 10), 30, -5), 1.5, 1.0, 50),
    }
    told = []
    for name, way in ways.items():
        begin = time.process_time()
        for k in range(TOUCHES):
            way(k)
        told.append(f"{name} {(time.process_time() - begin) / TOUCHES * 1e3:.2f} ms")
    with capsys.disabled():
        print(f"\n{', '.join(errors) or 'no errors'}: {', '.join(told)}")
