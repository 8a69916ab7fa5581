"""The manual's example programs and those worked out from its rules, number by number; see tests/authorities/README.md.

`check` of an example holds the numbers. Coordinates are those of the program; what a block does not name must not move.
"""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from tools.running import run

import mnclab
from mnclab import Kind, Tool

CATALOGUE = Path(__file__).parents[2] / "authorities" / "catalogue"
EXAMPLES = [
    example
    for name in ("mnc-language", "mnc-drilling")
    for example in json.loads((CATALOGUE / f"{name}.json").read_text(encoding="utf-8"))
]

#: Examples that need a function still to be built, and the first one that is refused. This list can only get shorter.
NOT_BUILT: dict[str, str] = {}
#: Examples whose numbers are compared elsewhere, because they are not those of a path.
ELSEWHERE = {
    "G94 Feed per minute and per revolution": "test_feed_per_minute_and_per_revolution",
    "G147 Datum 2 (constructed)": "test_datum_of_the_table",
}
CORNERS = ("G160", "G161", "G162")

KINDS = {
    **{"rapid": Kind.RAPID, "line": Kind.LINE, "arc": Kind.ARC, "dwell": Kind.DWELL},
    **{"helix": Kind.ARC, "circle": Kind.ARC, "spindle": Kind.SPINDLE, "coolant": Kind.COOLANT},
}
SHOWN = (Kind.RAPID, Kind.LINE, Kind.ARC, Kind.DWELL, Kind.PROBE)
EVENTS = (Kind.SPINDLE, Kind.COOLANT)
PLANES = {"path": (0, 1), "path_zx": (2, 0), "path_yz": (1, 2)}
REMARKS = {"alpha", "AB", "I", "arc", "elements"}  # they say in words or angles what the path says in numbers
START = (3, -7, 11)  # away from zero, so that a first move to zero shows
NOTICES = {  # what a program is told about although it runs
    "N30 X40": "G83 K (depth of one peck) is not modal: this hole is drilled in one pass",
    "N20 G02 X10 Y5 F100": "G2 without R and without I J K is obeyed as a straight line",
}


def title(example):
    return f"{example['code']} {example['title']}"


def near(expected, exact=True):
    """An expected number: up to two decimals it is exact where the program is, with four it was rounded."""
    return pytest.approx(expected, abs=1e-9 if exact and round(expected, 2) == expected else 1e-3)


def obeyed(program, **setup):
    found = run(program, **setup)
    lines = program.splitlines()
    assert all((lines[a.span.line - 1], a.message) in NOTICES.items() for a in found.alarms), found.alarms
    return found


def line_of(program, block):
    """The line of a block by its label; None for a program without labels."""
    if block is None:
        return None
    return next(n for n, text in enumerate(program.splitlines(), 1) if re.match(rf"{block}\b", text))


def same_row(row, expected, plane=(0, 1), exact=True):
    """One row of a path against one expected move, every number of it."""
    expected = {key: value for key, value in expected.items() if key not in ("block", "coordinates")}
    assert row.kind == KINDS[expected.pop("move")]
    still = {0, 1, 2}
    for key, value in expected.items():
        if key in ("x", "y", "z"):
            axis = "xyz".index(key)
            assert row.end[axis] == near(value, exact), key
            still -= {axis}
        elif key in ("to", "start", "centre"):
            point = {"to": row.end, "start": row.start, "centre": row.centre}[key]
            assert [point[k] for k in plane] == [near(v, exact) for v in value], key
            still -= set(plane)
        elif key == "radius":
            assert math.dist(row.start[list(plane)], row.centre[list(plane)]) == near(value, exact)
        elif key == "sweep_deg":
            assert math.degrees(row.sweep) == near(value, exact)
        elif key == "turns":
            assert math.degrees(row.sweep) / 360 == near(value, exact)
        elif key == "z_from":
            assert row.start[2] == near(value, exact)
        elif key == "z_to":
            assert row.end[2] == near(value, exact)
            still -= {2}
        elif key == "label":
            assert row.label.endswith(value)
        elif key == "speed":
            assert row.spindle == value
        elif key == "feed":
            assert row.feed == value
        elif key == "seconds":
            assert row.time == value
        else:
            raise AssertionError(f"{key} was not compared")
    assert all(row.end[k] == row.start[k] for k in still)


def same_rows(rows, expected, plane=(0, 1), exact=True):
    assert len(rows) == len(expected), f"{len(rows)} rows instead of {len(expected)}:\n{rows}"
    for row, move in zip(rows, expected):
        same_row(row, move, plane, exact)


def shown(path, line=None, kinds=SHOWN):
    """Moves and dwells of a path, of one line or all."""
    rows = path[np.isin(path.kind, kinds)]
    return rows if line is None else rows[rows.line == line]


def by_block(moves):
    """Moves grouped by the block that begins each group; None before the first."""
    groups = {}
    for move in moves:
        label = move.get("block", next(reversed(groups), None))
        groups.setdefault(label, []).append(move)
    return groups


# --- one comparison for each shape of check ---------------------------------------------------------------------------


def check_words(program, check):
    expected = [(address, value) for word in check.pop("words") for address, value in word.items()]
    block = mnclab.read(program, "mnc")[0]
    assert [(word.address, word.value) for word in block.words] == expected


def check_path(program, check, shape):
    """A path in a plane, with the length, time and feed components of its last move and the radius at its end."""
    found = obeyed(program, start=START)
    path, plane, moves = found.toolpath, PLANES[shape], check.pop(shape)
    for block, expected in by_block(moves).items():
        same_rows(shown(path, line_of(program, block)), expected, plane)
    last = path[-1]
    feeding = path.kind != Kind.RAPID
    length = path.lengths[feeding].sum()
    if "feed_length" in check:
        assert length == near(check.pop("feed_length"), False)
    if "seconds" in check:
        assert length / last.feed * 60 == near(check.pop("seconds"), False)
    for name, value in check.pop("components", {}).items():
        axis = "xyz".index(name[1])
        assert last.feed * (last.end - last.start)[axis] / length == near(value, False)
    if "arc_length" in check:
        assert path.lengths[path.kind == Kind.ARC].sum() == near(check.pop("arc_length"), False)
    for expected in check.pop("programmed", []):  # the point of the program, before it is mirrored
        position = found.at(line_of(program, expected["block"])).position
        point = dict(zip("xy", expected["to"])) if "to" in expected else expected
        assert all(position["xyz".index(axis)] == near(point[axis]) for axis in "xyz" if axis in point)
    if "radius_at_end" in check:
        assert math.dist(last.end[list(plane)], last.centre[list(plane)]) == near(check.pop("radius_at_end"), False)


ACTIONS = {
    r"spindle M3 S(\d+)": lambda found: {"move": "spindle", "speed": float(found[1])},
    r"spindle M4 S(\d+)": lambda found: {"move": "spindle", "speed": -float(found[1])},
    r"spindle stop": lambda found: {"move": "spindle", "speed": 0, "label": "stop the spindle"},
    r"spindle on": lambda found: {"move": "spindle", "speed": 1000},  # of the line before the example
    r"orient spindle (\d+)": lambda found: {"move": "spindle", "speed": 0, "label": f"to {found[1]} degrees"},
    r"(coolant o\w+)": lambda found: {"move": "coolant", "label": found[1]},
}


def actions(moves):
    """The moves with their actions as one row each; and whether there is one."""
    rows = []
    for move in moves:
        for action in move["do"].split(", ") if move["move"] == "action" else [move]:
            found = isinstance(action, str) and [(make, hit) for p, make in ACTIONS.items() if (hit := re.match(p, action))]
            rows.append({**found[0][0](found[0][1]), **{k: move[k] for k in ("block",) if k in move}} if found else action)
    return rows, any(move["move"] == "action" for move in moves)


def hole(program, check):
    """The program with tool T1 of the example (and a turning spindle where it is switched on), and its start point."""
    head = "T1 " if "R" in check or "point_angle" in check else ""
    head += "S1000 M3" if "spindle on" in str(check) else ""
    tools = {1: Tool(radius=check.pop("R", 0), angle=check.pop("point_angle", 0))}
    place = re.search(r"X(\S+) Y(\S+) M99$", program) if "z0" in check else None
    start = (float(place[1]), float(place[2]), check.pop("z0")) if place else (0, 0, check.pop("z0", 0))
    return f"{head}\n{program}" if head else program, {"tools": tools, "start": start}


def check_moves(program, check):
    """What cycles do, from the blocks named on, or all that the last block does."""
    program, machine = hole(program, check)
    found = obeyed(program, **machine, settings={"peck_clearance": check.pop("c", 1)})
    moves, acting = actions(check.pop("moves"))
    groups, kinds = by_block(moves), SHOWN + EVENTS if acting else SHOWN
    for block, expected in groups.items():
        line = line_of(program, block) if block else len(program.splitlines())
        rows = shown(found.toolpath, line, kinds)
        restarted = rows[-1].label.endswith("spindle as before")
        same_rows(rows[:-1] if restarted else rows, expected)
    if None not in groups:
        first = min(line_of(program, block) for block in groups)
        later = set(shown(found.toolpath).line.tolist()) - set(range(first))
        assert later == {line_of(program, block) for block in groups}
    path = found.toolpath
    lengths = path.lengths[path.kind == Kind.ARC]
    if "helix_length" in check:
        assert lengths[0] == near(check.pop("helix_length"), False)
    if "circle_length" in check:
        assert lengths[1] == near(check.pop("circle_length"), False)
    if "pitch" in check:
        assert set(path.per_rev[path.kind == Kind.LINE].tolist()) == {check.pop("pitch")}
    if "other" in check:
        other = check.pop("other")
        found = obeyed(program, **machine | {"tools": {1: Tool(angle=other["point_angle"])}})
        assert found.toolpath.end[:, 2].min() == near(other["z_b"])


def check_helix(program, check):
    """The first arc is a helix of so many turns about the axis of the hole, and where it ends a full circle follows."""
    program, machine = hole(program, check)
    path = obeyed(program, **machine).toolpath
    helix, circle = path[path.kind == Kind.ARC]
    assert math.dist(helix.start[:2], helix.centre[:2]) == near(check.pop("rho"), False)
    assert helix.sweep / math.tau == near(check.pop("turns"), False)
    assert helix.end.tolist() == [near(value, False) for value in check.pop("end")]
    assert path.lengths[path.kind == Kind.ARC][0] == near(check.pop("helix_length"), False)
    assert circle.sweep == math.tau and circle.start.tolist() == circle.end.tolist() == helix.end.tolist()


def check_positions(program, check):
    """Where G54 and G92 put the tool, and what the program then reads."""
    found = obeyed(program)
    for expected in check.pop("g54_positions"):
        move = shown(found.toolpath, line_of(program, expected["block"]))[-1]
        assert tuple(move.end[:2]) == (expected["x"], expected["y"])
    for expected in check.pop("readings"):
        moment = found.at(line_of(program, expected["block"]))
        assert moment.position[:2] == (expected["x"], expected["y"])
        assert moment.rows.start == moment.rows.stop


def check_point(program, check):
    """Where the program ends."""
    end = obeyed(program, start=START).toolpath[-1].end
    for axis, value in check.pop("point").items():
        assert end["xyz".index(axis)] == near(value)


def check_machine(program, check):
    """Machine coordinates with a work offset."""
    found = obeyed(program, datums={1: (*check.pop("g54"), 0)})
    for expected in check.pop("machine"):
        move = shown(found.toolpath, line_of(program, expected["block"]))[-1]
        assert tuple(move.end[:2] + found.toolpath.origin[:2]) == (expected["x"], expected["y"])


def check_length(program, check):
    """The spindle reference stands above the tip by the length of the tool and its correction."""
    tools = {0: Tool(), 1: Tool(length=50, dl=0.2)}
    found = obeyed(program, tools=tools)
    for expected in check.pop("machine_z"):
        moment = found.at(line_of(program, expected["block"]))
        tool = tools[moment.state.get("tool", Tool()).number]
        assert moment.position[2] + tool.effective_length == pytest.approx(expected["z"], abs=1e-9)
    for expected in check.pop("tip_z"):
        assert found.at(line_of(program, expected["block"])).position[2] == pytest.approx(expected["z"], abs=1e-9)
    assert len(shown(found.toolpath)) == 2  # the T block moves no axis


SHAPES = {
    "words": check_words,
    "moves": check_moves,
    "g54_positions": check_positions,
    "point": check_point,
    "machine": check_machine,
    "machine_z": check_length,
    "helix_length": check_helix,
    **{shape: lambda program, check, shape=shape: check_path(program, check, shape) for shape in PLANES},
}


PLAIN = [e for e in EXAMPLES if "CRC" not in e["code"] and title(e) not in {*NOT_BUILT, *ELSEWHERE}]


@pytest.mark.parametrize("example", PLAIN, ids=title)
def test_example(example):
    check = dict(example["check"])
    shape = next(shape for shape in SHAPES if shape in check)
    SHAPES[shape](example["program"], check)
    assert not check, f"not compared: {check}"


def test_every_example_is_compared_or_listed():
    assert {*NOT_BUILT, *ELSEWHERE} <= {title(example) for example in EXAMPLES}
    assert all(name in globals() for name in ELSEWHERE.values())


def program_of(name):
    return next(e["program"] for e in EXAMPLES if title(e) == name)


def test_what_is_not_built_is_refused_by_name():
    for name, code in NOT_BUILT.items():
        found = mnclab.run(program_of(name), "mnc")
        assert re.match(f"{code} is refused: .*not built", found.alarms[0].message)


def test_feed_per_minute_and_per_revolution():
    """4.2: F100 is 100 mm/min; F0.25 at S400 is 0.25 * 400 = 100 mm/min too. The second line goes on to X30 here."""
    printed = program_of("G94 Feed per minute and per revolution")
    program = "S400 M3\n" + printed.replace("N21 G95 G01 X20", "N21 G95 G01 X30")
    first, second = obeyed(program).toolpath[1:]
    assert (first.feed, second.feed, second.per_rev) == (100, 100, 0.25) and np.isnan(first.per_rev)
    assert first.end.tolist() == [20, 0, 45.5] and second.end.tolist() == [30, 0, 45.5]


def test_datum_of_the_table():
    """2.10: rows 1 to 6 are G54 to G59, so G147 Q2 is G55."""
    datums = {1: (1, 2, 3), 2: (40, 50, 60)}
    path, same = (
        obeyed(text, datums=datums).toolpath
        for text in (program_of("G147 Datum 2 (constructed)"), "N10 G55\nN20 G90 G00 X0 Y0\n")
    )
    assert path.origin.tolist() == same.origin.tolist() == [40, 50, 60]
    assert path.end.tolist() == same.end.tolist() == [[0, 0, -60]]


#: "... is the same": what an example says in words about another spelling of itself.
@pytest.mark.parametrize(
    ("code", "written", "instead"),
    [("G18", "I0 K-10", "R10"), ("G83", "Z-28", "W28"), ("G83", "X20 Y30", "U20 V30")],
)
def test_the_same_in_other_words(code, written, instead):
    program = next(e["program"] for e in EXAMPLES if e["code"] == code and written in e["program"])
    first, second = (obeyed(text).toolpath for text in (program, program.replace(written, instead)))
    assert len(first) == len(second)
    assert np.allclose(first.end, second.end, rtol=0, atol=1e-12)
    assert np.allclose(first.centre, second.centre, rtol=0, atol=1e-12, equal_nan=True)
    assert np.allclose(first.sweep, second.sweep, rtol=0, atol=1e-12)


# --- radius compensation ----------------------------------------------------------------------------------------------


def cases(example):
    """The contours of an example; what all share stands outside `cases`."""
    check = dict(example["check"])
    for number, case in enumerate(check.pop("cases", [{}]), 1):
        name = f"{title(example).removesuffix(' (constructed)')} {number}"
        yield pytest.param(example, {**check, **case}, id=name)


COMPENSATED = [case for e in EXAMPLES if "CRC" in e["code"] for case in cases(e)]


def contour_program(case, corner):
    """A case as a program: start, entry, contour, exit."""
    (x, y), place = case["start"], case["entry_to"]
    lines = [f"G17 G90 {corner} T1", f"G0 X{x} Y{y}", f"{case['side']} G1 X{place[0]} Y{place[1]} F200"]
    for element in case["contour"]:
        x, y = element["to"]
        if element["type"] == "arc":
            i, j = (c - p for c, p in zip(element["centre"], place))
            lines.append(f"{'G2' if element['direction'] == 'cw' else 'G3'} X{x} Y{y} I{i:.4f} J{j:.4f}")
        else:
            lines.append(f"G1 X{x} Y{y}")
        place = element["to"]
    if "exit_to" in case:
        lines.append(f"G40 G1 X{case['exit_to'][0]} Y{case['exit_to'][1]}")
    return "\n".join(lines) + "\n"


def setup(case):
    return {"tools": {1: Tool(radius=case["R"])}, "start": START}


def exact(case):
    """Whether the contour is written without rounding."""
    return not re.search(r"\.\d{4}", json.dumps([case["start"], case["contour"]]))


@pytest.mark.parametrize("corner", CORNERS)
@pytest.mark.parametrize(("example", "case"), COMPENSATED)
def test_tool_centre_path(example, case, corner):
    """Every corner of tables 7.1, 7.2 and 7.3, by each of the corner functions that an example speaks of."""
    known = {"R", "side", "start", "entry_to", "contour", "exit_to", "tool_centre_path"} | REMARKS
    assert case.keys() <= known, case.keys() - known
    if corner not in case["tool_centre_path"]:
        pytest.skip("the example says nothing about it")
    found = obeyed(contour_program(case, corner), **setup(case))
    same_rows(shown(found.toolpath)[1:], case["tool_centre_path"][corner], exact=exact(case))
    assert found.programmed[-1].end[:2].tolist() == case.get("exit_to", case["contour"][-1]["to"])


@pytest.mark.parametrize("example", [e for e in EXAMPLES if "CRC" in e["code"]], ids=title)
def test_the_program_as_printed_is_one_of_its_cases(example):
    fitting = []
    for case in (case.values[1] for case in cases(example)):
        path = obeyed("T1\n" + example["program"], **setup({"R": 5} | case)).toolpath
        try:
            same_rows(shown(path)[1:], case["tool_centre_path"].get("G160", []), exact=False)
        except AssertionError:
            continue
        fitting.append(case)
    assert fitting
