"""The special cycles 9, 13, 18, 32 and 239, and face milling, 232, in the examples of chapter 12; what they refuse."""

from __future__ import annotations

import json
import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools import running

import mnclab as mnc

EXAMPLES = json.loads(
    (Path(__file__).parents[2] / "authorities/catalogue/tnc620-special.json").read_text(encoding="utf-8")
)
HEAD = "TOOL CALL 1 Z S200 F100\n"


def example(code: str, number: int = 0) -> dict:
    return [e for e in EXAMPLES if e["code"] == f"CYCL DEF {code}"][number]

run = partial(running.run, control="tnc-620", before=HEAD)


def test_a_dwell() -> None:
    path = run(example("9")["program"]).toolpath
    assert path.time[path.kind == mnc.Kind.DWELL].tolist() == [example("9")["check"]["dwell_s"]] and not path.length


@pytest.mark.parametrize("stop", ["M19", "M20"])
def test_the_angle_of_the_spindle(stop: str) -> None:
    """Stored by the cycle, obeyed by M19 and M20; a cycle that orients overwrites it."""
    found = run(example("13")["program"] + f"\nL X+1 F100 {stop}")
    assert found.history.at(len(found.steps.block) - 1)["spindle angle"] == example("13")["check"]["angle"]
    tap = "CYCL DEF 209 T\nQ200=2\nQ201=-5\nQ239=1\nQ203=0\nQ204=9\nQ257=0\nQ256=1\nQ336=50\nQ403=1\nCYCL CALL\n"
    other = run(example("13")["program"] + f"\n{tap}L X+1 F100 {stop}")
    assert other.history.at(len(other.steps.block) - 1)["spindle angle"] == 50


def test_a_thread() -> None:
    """From Z2: 20 revolutions at S200 are 6 s, with M3; back with the depth reversed, with M4."""
    check, program = example("18")["check"], example("18")["program"] + "\nCYCL CALL\n"
    there = run("L Z+2 FMAX\n" + program).toolpath
    cut = there[there.synchronous & there.is_motion]
    assert cut.start[0, 2] == check["start_z"] and cut.end[:, 2].tolist() == [check["end_z"]]
    assert cut.spindle.tolist() == [200] and cut.feed.tolist() == [check["feed_at_S200"]]
    assert cut.length / cut.per_rev[0] == check["revolutions"]
    assert cut.length / cut.feed[0] * 60 == pytest.approx(check["time_s_at_S200"])
    assert there.spindle[-1] == 0
    back = run("L Z-18 FMAX\n" + program.replace("-20", "+20")).toolpath
    assert back.spindle[back.synchronous].tolist() == [-200] and back.end[-1, 2] == 2
    left = run("L Z+2 FMAX\n" + program.replace("+1", "-1")).toolpath
    assert left.spindle[left.synchronous].tolist() == [-200]
    none = run("L Z+2 FMAX\n" + program.replace("= -20", "0")).toolpath
    assert none.end[-1, 2] == 2


def test_a_thread_in_inches() -> None:
    program = "0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z S200 F10\n"
    program += "2 CYCL DEF 18.0 T\n3 CYCL DEF 18.1 DEPTH = -1\n4 CYCL DEF 18.2 PITCH +0.1\n"
    path = mnc.run(program + "5 CYCL CALL\n", "tnc-620").toolpath
    assert path.end[-1, 2] == pytest.approx(-25.4) and path.per_rev[path.synchronous][0] == pytest.approx(2.54)


CORNER = "L X+50 F3000\nL Y+50\n"


def test_a_tolerance_makes_corners_faster() -> None:
    """32.1 T0.05 counts as the corner tolerance of the limits does, until it is reset; the path stays as it is."""
    limits = mnc.Limits(acceleration=1000, corner_tolerance=0.05)
    program = example("32")["program"]
    with_cycle, with_limits, without = run(program + "\n" + CORNER), run(CORNER, limits=limits), run(CORNER)
    assert np.array_equal(with_cycle.toolpath.end, without.toolpath.end)
    assert (
        with_cycle.profile().time == pytest.approx(with_limits.profile().time)
        and with_cycle.profile().time < without.profile().time
    )
    history = with_cycle.history.at(len(with_cycle.steps.block) - 1)
    assert (history["tolerance"], history["tolerance of rotary axes"]) == (0.05, 5) and "roughing" in history["filter"]
    reset = run(program + "\nCYCL DEF 32.0 T\nCYCL DEF 32.1\n" + CORNER)
    assert reset.profile().time == pytest.approx(without.profile().time)
    zero = run("CYCL DEF 32.0 T\nCYCL DEF 32.1 T0\n" + CORNER)
    assert np.isnan(zero.toolpath.tolerance).all()


def test_the_tolerance_of_a_part_of_the_path() -> None:
    """Two corners, one before the cycle: the time lies between those of none and of both."""
    both = "CYCL DEF 32.0 T\nCYCL DEF 32.1 T0.1\n" + CORNER + "L X+0\nL Y+0\n"
    part = CORNER + "CYCL DEF 32.0 T\nCYCL DEF 32.1 T0.1\nL X+0\nL Y+0\n"
    none = CORNER + "L X+0\nL Y+0\n"
    fast, some, slow = (run(blocks).profile().time for blocks in (both, part, none))
    assert fast < some < slow
    jerky = [run(blocks, limits=mnc.Limits(jerk=20000)).profile().time for blocks in (both, part, none)]
    assert jerky[0] < jerky[1] < jerky[2]


def test_the_tolerance_in_inches() -> None:
    path = mnc.run("0 BEGIN PGM A INCH\nCYCL DEF 32.0 T\nCYCL DEF 32.1 T0.01\nL X+1 F10\n", "tnc-620").toolpath
    assert path.tolerance[-1] == pytest.approx(0.254)


def test_the_load() -> None:
    found = run(example("239")["program"])
    assert not found.toolpath.length and not found.alarms
    weighed = run(example("239")["program"].replace("+0", "1"))
    assert not weighed.toolpath.length and "weigh the load" in weighed.alarms[0].message


# --- face milling ------------------------------------------------------------------------------------------------------

FACE = dict(re.findall(r"(Q\d+)=(\S+)", example("232")["program"]))


def faced(tool: mnc.Tool, start: float = 100, **changed: object) -> mnc.Run:
    values = FACE | {key: str(value) for key, value in changed.items()}
    blocks = "\n".join(f"{key}={value}" for key, value in values.items())
    program = f"TOOL CALL 1 Z S1000\nL Z{start:+g} FMAX M3\nCYCL DEF 232 F\n{blocks}\nCYCL CALL\n"
    return mnc.run(program, "tnc-620", mnc.Setup(tools={1: tool}))


def rows(found: mnc.Run) -> mnc.Toolpath:
    assert found.ok, found.alarms
    path = found.toolpath
    return path[[path.labels[k].startswith("CYCL DEF 232") for k in path.label]]


def moves(path: mnc.Toolpath) -> list[str]:
    """In the notation of the catalogue."""
    found = []
    for row in path:
        words = [
            f"{a}{round(float(e), 3):g}" for a, s, e in zip("XYZ", row.start, row.end, strict=True) if abs(s - e) > 1e-9
        ]
        found.append(" ".join([*words, "FMAX" if row.kind == mnc.Kind.RAPID else f"F{row.feed:g}"]))
    return found


@pytest.mark.parametrize("number", [0, 1, 2])
def test_facing_move_by_move(number: int) -> None:
    check, strategy = example("232", number)["check"], example("232", number)["program"].split("Q389=")[1][0]
    found = rows(faced(mnc.Tool(radius=10), Q389=strategy))
    assert moves(found) == check["moves_R10"]
    if "cut_length_in_lines" in check:
        along = found[(found.feed < 1000) & (np.abs(found.end - found.start)[:, 0] > 0)]
        assert along.length == pytest.approx(check["cut_length_in_lines"])


@pytest.mark.parametrize(
    ("key", "tool", "changed"),
    [
        ("R10_R2_0", mnc.Tool(radius=10), {}), ("R20_R2_0", mnc.Tool(radius=20), {}),
        ("R31.5_R2_6", mnc.Tool(radius=31.5, corner=6), {}), ("R10_Q370_1.5", mnc.Tool(radius=10), {"Q370": 1.5}),
    ],
)  # fmt: skip
def test_facing_with_other_tools(key: str, tool: mnc.Tool, changed: dict) -> None:
    check, path = example("232")["check"][key], rows(faced(tool, **changed))
    cut = path[path.feed < 1000]
    assert sorted(set(cut.end[:, 2].round(4)), reverse=True) == check["levels"]
    assert [set(cut.feed[cut.end[:, 2].round(4) == level]) for level in check["levels"]] == [
        {f} for f in check["feeds"]
    ]
    assert sorted(set(cut.end[:, 1].round(3))) == check["lines_y"] and len(cut) == check["lines_total"]
    assert sorted(set(cut.end[:, 0])) == check["x_outside"] and cut.length == pytest.approx(check["cut_length"])


def test_where_facing_begins() -> None:
    """From below the second set-up clearance the tool first goes up to it; then the plane, then Q200."""
    found = moves(rows(faced(mnc.Tool(radius=10), start=3, Q204=20)))
    assert found[:4] == ["Z22.5 FMAX", "X-2 Y12 FMAX", "Z4.5 FMAX", "Z0.833 F2000"] and found[-1] == "Z22.5 FMAX"
    assert rows(faced(mnc.Tool(radius=10), Q227=-3)).length == 0  # nothing to take off: not executed
    assert sorted(set(rows(faced(mnc.Tool(radius=10), Q369=9)).end[:, 2])) == [-3, -1, 4.5, 100]  # one infeed


@settings(max_examples=25, deadline=None)
@given(
    a=st.floats(5, 150), b=st.floats(5, 120), sa=st.sampled_from([-1, 1]), sb=st.sampled_from([-1, 1]),
    k=st.floats(0.1, 1.99), strategy=st.sampled_from([0, 1, 2]), radius=st.floats(3, 25),
)  # fmt: skip
def test_facing_leaves_nothing_of_the_surface(
    a: float, b: float, sa: int, sb: int, k: float, strategy: int, radius: float
) -> None:
    """On every level the lines lie close enough to meet, reach over both sides, and are as long as the surface."""
    radius = round(radius, 6)  # as exact as the other numbers of the program
    found = faced(
        mnc.Tool(radius=radius), Q389=strategy, Q218=sa * round(a, 6), Q219=sb * round(b, 6), Q370=round(k, 4)
    )
    path = rows(found)
    cut = path[(path.feed < 1000) & (path.start[:, 1] == path.end[:, 1])]
    x0, x1 = sorted((10, 10 + sa * round(a, 6)))
    y0, y1 = sorted((12, 12 + sb * round(b, 6)))
    assert cut.end[-1, 2] == -3
    for level in {float(z) for z in cut.end[:, 2]}:
        on = cut[cut.end[:, 2] == level]
        ys = np.sort(on.end[:, 1])
        assert (np.diff(ys) <= round(k, 4) * radius + 1e-9).all()
        assert ys[0] - radius <= y0 + 1e-9 and ys[-1] + radius >= y1 - 1e-9
        ends = np.sort(np.stack([on.start[:, 0], on.end[:, 0]]), axis=0)
        assert (ends[0] <= x0 + 1e-9).all() and (ends[1] >= x1 - 1e-9).all()


FLAT = mnc.Tool(radius=10)
REFUSED_FACES = [
    (FLAT, {"Q386": 3}, "Q386", "must not lie above Q227 = 2.5, got 3"),
    (FLAT, {"Q202": 0}, "Q202", "must be greater than 0, got 0"),
    (FLAT, {"Q202": 0.0001}, "Q202", "into more than 10000"),
    (FLAT, {"Q370": 2}, "Q370", "must be at least 0.1 and at most 1.9999, got 2"),
    (FLAT, {"Q389": 3}, "Q389", "must be one of 0, 1, 2, got 3"),
    (FLAT, {"Q207": 0}, "Q207", "must be greater than 0, got 0"),
    (FLAT, {"Q357": -1}, "Q357", "must be at least 0"),
    (mnc.Tool(radius=0), {}, "", "needs a tool with a radius, got 0"),
    (mnc.Tool(radius=5, corner=5), {}, "", "needs a tool that is flat below, got R 5 and R2 5"),
]


@pytest.mark.parametrize(("tool", "changed", "address", "message"), REFUSED_FACES, ids=[r[3] for r in REFUSED_FACES])
def test_refused_faces(tool: mnc.Tool, changed: dict, address: str, message: str) -> None:
    alarm = next(a for a in faced(tool, **changed).alarms if a.severity == "alarm")
    line = 4 + len(FACE) if not address else 4 + list(FACE).index(address)
    assert message in alarm.message and alarm.span[:2] == (line, 1)
