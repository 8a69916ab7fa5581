"""Parts of several tools, each said in six ways of equal motion, and their mutants: whether the proof says so, and where.

What is written, and the way of the tool's centre beside a contour, come from `tools.shops`, which knows nothing of mnclab.
"""

import random

import pytest
from tools import shops

import mnclab as mnc

MILLS = {1: mnc.Tool(radius=3, length=60), 3: mnc.Tool(radius=5, length=45)}
SETUP = mnc.Setup(tools=MILLS | {2: mnc.Tool(radius=4, kind="drill", angle=118, length=70)})


def run(lines, control):
    found = mnc.run("\n".join(lines) + "\n", control, SETUP)
    assert found.ok or control == "tnc-620", found.alarms
    return found


def said(made):
    """Six ways to say one part: name -> run; the first is the one that is trusted."""
    return {
        "G41": run(shops.iso(made), "g43"), "centre": run(shops.iso(made, compensated=False), "g43"),
        "block by block": run(shops.iso(made, cycles=False), "g43"), "RL": run(shops.klartext(made), "tnc-620"),
        "centre in Klartext": run(shops.klartext(made, compensated=False), "tnc-620"),
        "MNC": run(shops.iso(made, "mnc", cycles=False), "mnc"),
    }  # fmt: skip


def some_pairs(seeds):
    many = 0
    for seed in seeds:
        first, *others = said(shops.shop(seed)).values()
        for other in others:
            for pair in ((first, other), (other, first)):
                found = mnc.prove(*pair)
                assert found.verdict == "same motion" and {*found.counts} <= {"centre"}, (seed, found.sentence)
                many += 1
    return many


def some_mutants(seeds):
    """How many there were, and those that were not told at their line."""
    many, missed = 0, []
    for seed in seeds:
        made = shops.shop(seed)
        lines, ways = shops.klartext(made), said(made)
        for trusted, kind in ((trusted, kind) for trusted in ("G41", "centre") for kind in shops.FAULTS):
            other, places = shops.mutant(lines, kind, random.Random(f"{kind} {seed}")) or (lines, None)
            if places is None:
                continue
            found = mnc.prove(ways[trusted], run(other, "tnc-620"))
            many += 1
            assert found.verdict == "different", (seed, trusted, kind)
            slack = 3 if found.first.kind == "stops" else trusted == "centre"  # the block of an alarm; of the entry across a side
            if not any(abs(found.first.lines[1] - place) <= slack for place in places):
                missed.append((seed, trusted, kind, places, found.first.sentence))
    return many, missed


def test_parts_of_several_tools_are_the_same_in_six_ways():
    assert some_pairs(range(3)) == 30


def test_what_a_post_gets_wrong_is_told_at_its_line():
    many, missed = some_mutants(range(2))
    assert many > 60 and not missed


@pytest.mark.deep
def test_hundreds_of_parts_of_several_tools():
    assert some_pairs(range(100, 150)) == 500
    many, missed = some_mutants(range(100, 115))
    assert many > 500 and len(missed) < 0.01 * many, missed
