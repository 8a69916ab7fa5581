"""The manual's examples and those worked out from its rules, move by move; see tests/authorities/README.md.

What an example expects is a list of moves, one a line; remarks behind `#` may give a length, a time, an angle. Those
that expect something else are named in `ELSEWHERE` with the test that holds their numbers.
"""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from tools.running import run

import mnclab
from mnclab import Kind

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"
EXAMPLES = {e["title"]: e for e in json.loads((CATALOGUE / "jnc-t01.json").read_text(encoding="utf-8"))}

NUMBER = r"(-?\d+(?:\.\d+)?)"
MOVE = re.compile(rf"(rapid|feed|cw|ccw|thread) X{NUMBER} Z{NUMBER}(?: centre X{NUMBER} Z{NUMBER} radius {NUMBER})?"
                  rf"(?: pitch {NUMBER})?$")  # fmt: skip
ELSEWHERE = {
    "Comment and missing separator (taken from examples 2 and 19)": "test_words_and_comments",
    "Parameter ownership": "test_parameter_ownership",
    "Example 1 of the manual": "test_example_1",
    "Example 10 of the manual": "test_example_10",
    "Too large (own example, start X20 Z0)": "test_a_fillet_that_is_too_large",
    "Example 31 of the manual (tool at base X30 Z20, offset 0)": "test_example_31",
    "Adding twice (own example, offset 0, then rapid)": "test_adding_twice",
    "Example 32 of the manual": "test_examples_32_to_34",
    "Example 33 of the manual": "test_examples_32_to_34",
    "Example 34 of the manual": "test_examples_32_to_34",
    "Example 35 of the manual": "test_examples_35_and_36",
    "Example 36 of the manual": "test_examples_35_and_36",
    "Adopted reading (own example; corrector 3: dX = 0.1, dZ = -0.2; start X30 Z10)": "test_correctors",
}
LISTED = [title for title in EXAMPLES if title not in ELSEWHERE]


def program_of(title):
    return EXAMPLES[title]["program"]


def obeyed(program, start=(0, 0), before="F20 S500 M3", **setup):
    """A program after one line that gives feed and speed; the tool stands at (X, Z)."""
    return run(program, "jnc-t01", ok=None, before=f"{before}\n", start=(start[0], 0, start[1]), **setup)


def listed(expected):
    """Start and moves of a listing, with the numbers of their remarks."""
    lines = [line.partition("#") for line in expected.splitlines()]
    lines = [(text.strip(), remark) for text, _, remark in lines if text.strip()]
    assert lines[0][0].startswith("start")
    return tuple(float(n) for n in re.findall(NUMBER, lines[0][0])), lines[1:]


@pytest.mark.parametrize("title", LISTED)
def test_example(title):
    start, moves = listed(EXAMPLES[title]["expected"])
    found = obeyed(program_of(title), start)
    assert found.ok and all("a cone is cut" in alarm.message for alarm in found.alarms)
    path = found.toolpath.motion
    assert path.lathe and len(path) == len(moves), str(path)
    for row, (text, remark) in zip(path, moves):
        kind, x, z, cx, cz, radius, pitch = MOVE.fullmatch(text).groups()
        assert row.end[[0, 2]] == pytest.approx(
            (float(x), float(z)), abs=1e-4 if "R11.18034" in program_of(title) else 1e-9
        )
        assert row.end[1] == 0
        assert row.kind == {"rapid": Kind.RAPID, "cw": Kind.ARC, "ccw": Kind.ARC}.get(kind, Kind.LINE)
        assert row.synchronous == (kind == "thread")
        if radius:
            assert math.copysign(1, row.sweep) == (1 if kind == "ccw" else -1)
            assert row.centre[[0, 2]] == pytest.approx((float(cx), float(cz)), abs=1e-4)
            assert math.dist(row.end, row.centre) == pytest.approx(float(radius), abs=1e-4)
        length = path.lengths[path.step == row.step].sum() if kind != "rapid" else None
        if pitch:
            turns = length / row.per_rev
            assert turns * float(pitch) == pytest.approx(np.abs(row.end - row.start).max(), abs=1e-9)
            if said := re.search(r"([\d.]+) revolutions", remark):
                assert turns == pytest.approx(float(said[1]), abs=1e-4)
        if said := re.match(r"\s*(?:length )?([\d.]+) mm", remark) or re.search(r"length ([\d.]+) mm", remark):
            if kind != "thread" or "pitch" not in remark:
                assert length == pytest.approx(float(said[1]), abs=1.1e-4)  # one ends in 67 for 66
        if said := re.search(r"([\d.]+) s\b", remark):
            assert length / row.feed * 60 == pytest.approx(float(said[1]), abs=1e-4)
        if said := re.search(r"sweep ([\d.]+) deg", remark):
            assert math.degrees(abs(row.sweep)) == pytest.approx(float(said[1]), abs=1e-4)
        if said := re.search(rf"(?:point|through) X{NUMBER} Z{NUMBER}", remark):
            points, _ = path[path.step == row.step].points(1e-4)
            assert np.linalg.norm(points[:, [0, 2]] - [float(said[1]), float(said[2])], axis=1).min() < 0.2


def test_every_example_is_compared():
    assert set(ELSEWHERE) <= set(EXAMPLES) and all(name in globals() for name in ELSEWHERE.values())
    assert len(LISTED) + len(ELSEWHERE) == len(EXAMPLES)


def test_words_and_comments():
    first, second = mnclab.read(program_of(next(iter(ELSEWHERE))), "jnc-t01")
    assert [(w.address, w.value) for w in first.words] == [("X", 10), ("Z", 10)]
    assert first.comment == "two words without a separator"
    assert "".join(f"{w} " for w in second.words) == "G77 X20 Z-75 U30 W-60 D6 " and second.comment == ""


def test_parameter_ownership():
    found = obeyed(program_of("Parameter ownership"), (30, 5), before="S500")
    assert found.ok and all("a cone is cut" in alarm.message for alarm in found.alarms)
    path = found.toolpath
    assert [row.kind for row in path if row.line in (3, 5, 7)] == [Kind.LINE] * 3
    assert [row.feed for row in path if row.line in (3, 5, 7)] == [100] * 3
    assert [(row.kind, row.time) for row in path if row.line == 4] == [(Kind.DWELL, 2)]
    assert path.labels[path.label[path.line == 6][0]].startswith("G77") and path[-1].end[0] == 30


def test_example_1():
    found = obeyed(program_of("Example 1 of the manual"), (20, 0), before="")
    speeds = [(row.line - 1, row.spindle, row.surface) for row in found.toolpath]
    right, left, turned, stopped = speeds
    assert right[:2] == (2, 500) and left[:2] == (3, -500) and stopped[:2] == (5, 0)
    assert turned[0] == 4 and turned[2] == 50 and turned[1] == pytest.approx(-397.8874, abs=1e-4)
    assert found.history.value("turning", 1) == 1  # on, but without a speed yet
    assert found.history.value("spindle", 5) == "M5"


def test_example_10():
    row = obeyed(program_of("Example 10 of the manual")).toolpath[-1]
    assert (row.kind, row.time) == (Kind.DWELL, 2.5)


def test_a_fillet_that_is_too_large():
    found = obeyed(program_of("Too large (own example, start X20 Z0)"), (20, 0))
    assert "G12 R (fillet radius) must be at most the way along Z, 8 mm, got 10" in str(found.alarms[0])


def test_example_31():
    found = obeyed(program_of("Example 31 of the manual (tool at base X30 Z20, offset 0)"), (30, 20))
    assert not found.toolpath.is_motion.any()
    assert [found.at(line).position[::2] for line in (1, 2, 3, 4)] == [(30, 20), (25, 10), (25, 10), (30, 20)]


def test_adding_twice():
    found = obeyed(program_of("Adding twice (own example, offset 0, then rapid)"), (30, 20))
    assert found.toolpath.end[-1].tolist() == [10, 0, 10] and found.at(4).position[::2] == (0, 0)


def test_examples_32_to_34():
    """A way of 10 mm: 120 mm/min in 5 s; 50 mm/min; 0.5 mm/rev at 500 rev/min are 250 mm/min."""
    for number, feed, per_rev, time in ((32, 120, None, 5), (33, 50, None, None), (34, 250, 0.5, None)):
        row = obeyed(program_of(f"Example {number} of the manual") + "G01 X10").toolpath[-1]
        assert row.feed == feed
        assert row.per_rev == per_rev or np.isnan(row.per_rev)
        assert row.time == time or np.isnan(row.time)


def test_examples_35_and_36():
    rows = obeyed(program_of("Example 35 of the manual") + "X20\nX10\nX0", (30, 0)).toolpath.motion
    assert rows.spindle == pytest.approx([238.7324, 477.4648, 3000], abs=1e-4)
    assert obeyed(program_of("Example 36 of the manual"), before="M3").toolpath.spindle[-1] == 500


def test_correctors():
    """Slide positions are those of the path; what the program reads are the programmed points."""
    found = obeyed(program_of(list(ELSEWHERE)[-1]), (30, 10), correctors={3: (0.1, 0, -0.2)})
    assert found.ok and all("a cone is cut" in alarm.message for alarm in found.alarms)
    assert np.allclose(found.toolpath.motion.end, [(20.1, 0, 1.8), (20, 0, 5)], rtol=0, atol=1e-12)
    assert found.toolpath.motion.kind.tolist() == [Kind.RAPID] * 2
    assert [found.at(line).position[::2] for line in (4, 6)] == [(20, 2), (20, 5)]
