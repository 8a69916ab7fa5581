"""What is repeated is what is written out: random bodies that change the state, in every way of repeating that the controls have.

Each program stands beside one that says the same without the repetition, block by block. Both must make the same rows and
leave the same state; only lines and steps differ, since the texts do.
"""

import random
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools import running

import mnclab as mnc
from mnclab.path.toolpath import COLUMNS

pytestmark = pytest.mark.deep

TEXTUAL = {
    "line",
    "step",
    "program",
    "label",
    "joint",
}  # where a row comes from: labels and joints are compared by name
HEAD = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nL X+3 Y+4 Z+30 R0 FMAX M3\nQ1 = 1\nQ2 = 0\nCC X+5 Y+6\n"
CYCLE_200 = (
    "CYCL DEF 200 D ~\n Q200=+2 ~\n Q201=-5 ~\n Q206=+90 ~\n Q202=+2 ~\n Q210=+0 ~\n Q203=+Q2 ~\n Q204=+9 ~\n Q211=+0\n"
)

#: Blocks that change the state: frames, variables, feeds, tools, planes, tolerance, labels; and moves that show it.
CHANGES = [
    "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 IX+1", "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+2\nCYCL DEF 7.2 IY-3",
    "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0\nCYCL DEF 7.3 IZ+0.5",
    "CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X", "CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1",
    "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 IROT+10", "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+33",
    "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 0.9", "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 1",
    "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.05", "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1",
    "Q1 = Q1 + 1", "Q1 = 0 - Q1", "Q2 = Q2 + 0.25", "FN 11: IF +Q1 GT +3 GOTO LBL 9\nL IY+0.5\nLBL 9",
    "TOOL CALL 2 Z S500", "TOOL CALL 1 Z S800 DR+0.5", "TOOL CALL S700", "M4", "M3", "M136", "M137", "M5",
    "CC X+2 Y+Q1", "CC IX+1 IY+0", "L IC+15 FMAX", "PLANE SPATIAL SPA+0 SPB+10 SPC+0 STAY", "PLANE RESET STAY",
    "CALL LBL 7",
]  # fmt: skip
MOVES = [
    "L IX+1 F250", "L X+Q1 Y+2 FMAX", "L IZ-1 F80", "L Z+10 FMAX", "C X+7 Y+8 DR+", "LP IPA+30 IPR+1 F120", "CP IPA+50 DR-",
    "L X+4 Y+0 F60 M8", "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 1", "L X+3 Y+9 F100\nRND R0.3\nL X+9 Y+9",
]  # fmt: skip
SUBPROGRAM = "M2\nLBL 7\nQ1 = Q1 + 1\nL IX-0.5 F90\nLBL 0\n"


def bodies(*more):
    one = st.sampled_from([*CHANGES, *MOVES, *more])
    return st.lists(one, min_size=2, max_size=6).map(lambda blocks: renamed("\n".join([*blocks, "L IX+1 F70"])) + "\n")


def renamed(body, counter=[10]):  # noqa: B006 -- labels of a program are each another one
    while "LBL 9" in body:
        counter[0] += 1
        number = counter[0] % 60000 + 10
        at = body.index("LBL 9")
        after = body.index("LBL 9", at + 1)
        body = f"{body[:at]}LBL {number}{body[at + 5 : after]}LBL {number}{body[after + 5 :]}"
    return body


def copies(body, count):
    """The body a number of times, each with labels of its own."""
    found, next_label = [], 30000
    for _ in range(count):
        copy = body
        for line in body.splitlines():
            if line.startswith("LBL ") and line != "LBL 7":
                next_label += 1
                copy = copy.replace(f"{line}\n", f"LBL {next_label}\n").replace(
                    f"GOTO {line}\n", f"GOTO LBL {next_label}\n"
                )
        found.append(copy)
    return "".join(found)


def real(path):
    """The rows but for ways of no length: whether a sum of floats comes out the same depends on the place."""
    return path[~path.is_motion | (path.lengths > 1e-9)]


def assert_same_rows(repeated, written, names):
    """The same alarms, each named once although a copy has it in each, and the same rows up to there."""
    told = [list(dict.fromkeys(a.message for a in run.alarms if a.severity == "alarm")) for run in (repeated, written)]
    assert told[0] == told[1]
    pair = [real(run.toolpath) for run in (repeated, written)]
    assert len(pair[0]) == len(pair[1])
    for name in names:
        assert np.allclose(*(getattr(path, name) for path in pair), rtol=0, atol=1e-8, equal_nan=True), name
    return pair


def assert_same(repeated, written):
    """The same rows, and at the end the same variables, place and frames."""
    pair = assert_same_rows(repeated, written, sorted(set(COLUMNS) - TEXTUAL))
    labels = [[path.labels[k] for k in path.label] for path in pair]
    assert labels[0] == labels[1]
    if repeated.ok:
        assert repeated.variables == written.variables
        assert np.allclose(repeated.frames.matrix, written.frames.matrix, rtol=0, atol=1e-9)
    last = [run.history.at(len(run.steps.block) - 1) for run in (repeated, written)]
    for name in ("feed", "speed", "turning", "tool", "plane", "tolerance", "rotary", "spindle", "cycle", "per_rev"):
        assert last[0].get(name) == last[1].get(name) or np.isnan(last[0][name]), name

run = partial(running.run, control="tnc-620", ok=None)


def whole(text, tail=SUBPROGRAM):
    return f"{HEAD}{text}{tail}END PGM A MM\n"


# --- the TNC 620 ------------------------------------------------------------------------------------------------------


@given(bodies(CYCLE_200.strip() + "\nCYCL CALL", "CYCL DEF 200 D Q200=+2 Q201=-3"), st.integers(1, 4))
def test_repeat_of_a_section(body, times):
    repeated = whole(f"LBL 1\n{body}CALL LBL 1 REP {times}\n")
    assert_same(run(repeated), run(whole(copies(body, times + 1))))


@given(bodies(CYCLE_200.strip() + "\nCYCL CALL"), st.integers(2, 4))
def test_subprogram(body, times):
    repeated = whole("CALL LBL 5\n" * times, f"M2\nLBL 5\n{body}LBL 0\n{SUBPROGRAM}")
    assert_same(run(repeated), run(whole(copies(body, times))))


@given(bodies(), st.integers(2, 4))
def test_program_call(body, times):
    called = {"B.H": f"BEGIN PGM B MM\n{body}{SUBPROGRAM.replace('M2', '')}END PGM B MM\n"}
    called["B.H"] = f"BEGIN PGM B MM\n{body}FN 9: IF +0 EQU +0 GOTO LBL 8\n{SUBPROGRAM[3:]}LBL 8\nEND PGM B MM\n"
    assert_same(run(whole("CALL PGM B.H\n" * times), files=called), run(whole(copies(body, times))))


@given(bodies(), st.integers(2, 4))
def test_a_loop_of_jumps(body, times):
    counted = f"Q9 = 0\nLBL 1\n{body}Q9 = Q9 + 1\nFN 12: IF +Q9 LT +{times} GOTO LBL 1\n"
    written = f"Q9 = 0\n{copies(body, times)}Q9 = {times}\n"
    assert_same(run(whole(counted)), run(whole(written)))


CALLED = "CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM B.H\n"
PATTERNS = {
    "row": ("ROW1 (X+10 Y+0 D+10 NUM12 ROT+20 Z+0)", [(10, 0, 10, 20)]),
    "grid": ("PAT1 (X+10 Y+0 DX+7 DY+11 NUMX4 NUMY3 ROT+15 ROTX+0 ROTY+10 Z+1)", None),
    "circle": ("CIRC1 (X+30 Y+20 D+50 START+12 NUM11 Z+2)", None),
}


def as_program(body):
    return {"B.H": f"BEGIN PGM B MM\n{body}FN 9: IF +0 EQU +0 GOTO LBL 8\n{SUBPROGRAM[3:]}LBL 8\nEND PGM B MM\n"}


def points_of(pattern):
    """The points of a pattern in mm: where a probing run drills them."""
    text = f"{HEAD}{CYCLE_200.replace('+Q2', '+0')}PATTERN DEF {pattern}\nCYCL CALL PAT FMAX\nEND PGM A MM\n"
    path = run(text).toolpath
    cuts = path.end[path.kind == mnc.Kind.LINE]
    _, first = np.unique(cuts[:, :2].round(9), axis=0, return_index=True)
    return cuts[np.sort(first), :2]


POINTS = {name: points_of(text) for name, (text, _) in PATTERNS.items()}
LEVEL = {"row": 0, "grid": 1, "circle": 2}


def point(x, y, z):
    return f"PATTERN DEF POS1 (X{x:+.10f} Y{y:+.10f} Z{z:+g})\nCYCL CALL PAT FMAX\n"


@given(bodies(), st.sampled_from(list(PATTERNS)), st.sampled_from(CHANGES))
def test_program_as_a_cycle_at_a_pattern(body, which, before):
    before = renamed(before) + "\n"
    repeated = f"{before}{CALLED}PATTERN DEF {PATTERNS[which][0]}\nCYCL CALL PAT FMAX\n"
    written = before + CALLED + "".join(point(x, y, LEVEL[which]) for x, y in POINTS[which])
    assert_same(run(whole(repeated), files=as_program(body)), run(whole(written), files=as_program(body)))


@given(bodies(), st.sampled_from(list(PATTERNS)))
def test_program_as_a_cycle_at_a_point_table(body, which):
    def table(points):
        rows = "".join(f"{k} {x:+.10f} {y:+.10f} +0\n" for k, (x, y) in enumerate(points))
        return f"T.PNT MM\nNR X Y Z\n{rows}[END]\n"

    points = POINTS[which]
    files = as_program(body) | {"T.PNT": table(points)} | {f"T{k}.PNT": table([p]) for k, p in enumerate(points)}
    select = 'SEL PATTERN "{}"\nCYCL CALL PAT FMAX\n'.format
    written = "".join(select(f"T{k}.PNT") for k in range(len(points)))
    assert_same(run(whole(CALLED + select("T.PNT")), files=files), run(whole(CALLED + written), files=files))


STILL = [c for c in CHANGES if "\nL " not in c and not c.startswith(("L ", "CALL"))]


@given(st.lists(st.sampled_from(STILL), min_size=1, max_size=6))
def test_modal_call_of_a_cycle(changes):
    """M89: at every positioning block, whatever stands between."""
    places = [f"L X+{10 * k} Y+{k * k} FMAX" for k in range(len(changes) + 1)]
    ends = ["M89", *[""] * (len(changes) - 1), "M99"]
    modal, single = (
        "\n".join(
            part
            for place, end, change in zip(places, words, ["Q1 = 0", *changes], strict=True)
            for part in (change, f"{place} {end}")
        )
        for words in (ends, ["M99"] * len(ends))
    )
    assert_same(*(run(whole(f"{CYCLE_200}L Z+30 FMAX\n{text}\n")) for text in (modal, single)))


FRAMES = st.lists(
    st.sampled_from([c for c in CHANGES if c.startswith(("CYCL DEF", "PLANE", "TOOL", "M13"))]), max_size=4
)
DRILLING = st.sampled_from([200, 201, 203, 204, 205, 207, 208, 209, 240, 251, 252, 253, 256, 257])


def parameters(number):
    from mnclab.machine import trial

    cycle = mnc.controls["tnc-620"].cycles[f"CYCL DEF {number}"]
    text = trial.program(mnc.controls["tnc-620"], cycle, {p.name: trial.first_value(p) for p in cycle.parameters()})
    return text[text.index("CYCL DEF") : text.index("L X+20")]


@settings(max_examples=30)
@given(FRAMES, DRILLING, st.sampled_from(list(PATTERNS)), st.integers(0, 50))
def test_cycles_at_patterns(changes, number, which, height):
    """No body to change the state, but many cycles, in many frames, at many heights."""
    before = "\n".join([*changes, f"L Z+{height} FMAX"]) + "\n" + parameters(number)
    repeated = f"{before}PATTERN DEF {PATTERNS[which][0]}\nCYCL CALL PAT FMAX\n"
    written = before + "".join(point(x, y, LEVEL[which]) for x, y in POINTS[which])
    assert_same(run(whole(repeated)), run(whole(written)))


@settings(max_examples=30)
@given(FRAMES, DRILLING, st.integers(0, 1), st.integers(0, 1), st.integers(9, 14))
def test_cycles_220_and_221(changes, number, level, which, count):
    """Q301 0 travels at the set-up clearance, where the cycle ends at all points but the last.

    Written out: the cycle called by M99 at each of the points, which cycle 220 or 221 also gives.
    """
    clearance, high, surface = 2, 40, 0
    angles = [np.radians(360 * k / count) for k in range(count)]
    places = [(50 + 40 * np.cos(a), 50 + 40 * np.sin(a)) for a in angles]
    pattern = "220 P ~\n Q216=+50 ~\n Q217=+50 ~\n Q244=+80 ~\n Q245=+0 ~\n Q246=+360 ~\n Q247=+0 ~\n Q241=+" + str(
        count
    )
    if which:
        places = [(5 + 9 * k, 7) for k in range(5)] + [(5 + 9 * k, 20) for k in range(4, -1, -1)]
        pattern = "221 P ~\n Q225=+5 ~\n Q226=+7 ~\n Q237=+9 ~\n Q238=+13 ~\n Q242=+5 ~\n Q243=+2 ~\n Q224=+0"
    own = f" ~\n Q200=+{clearance} ~\n Q203=+{surface} ~\n Q204=+{high} ~\n Q301=+{level}" + (
        "" if which else " ~\n Q365=+0"
    )
    before = "\n".join(changes) + "\n" + parameters(number)
    assigned = f"Q200 = {clearance}\nQ203 = {surface}\n" + ("Q224 = 0\n" if which else "")
    between = clearance if level == 0 else high
    way = "".join(
        f"L Z+{between if k else high} FMAX\nL X{x:+.10f} Y{y:+.10f} FMAX\nL Z+{clearance} FMAX\n"
        f"Q204 = {between if k + 1 < len(places) else high}\nCYCL CALL\n"
        for k, (x, y) in enumerate(places)
    )

    repeated, written = run(whole(f"{before}CYCL DEF {pattern}{own}\n")), run(whole(before + assigned + way))
    assert_same_rows(repeated, written, ("start", "end", "centre", "sweep", "feed", "kind", "tool", "tolerance"))


# --- the controls with G words ----------------------------------------------------------------------------------------

HOLES = {
    "mnc": (
        ["G99 G83 X1 Y1 Z-9 R2 F100", "G98 G83 X1 Y1 Z-9 R2 K2.5 F100", "G98 G85 X1 W8 R1.7 F80", "G99 G84 X3 Z-5 R2 F500"],
        ["G39 A30", "G39 A0", "G51 X0", "G37 X2 Y2 Z2", "G92 X5", "G55", "G54", "G98", "G99", "S900", "M4", "M3", "F60",
         "G80\nG0 Z30", "X5 F60", "X3 Z-6", "Y2 R3", "X7 K2", "T2", "G95 F0.1", "G94 F100"],
        "G17 G90 G54\nT2 S800 M3\nG0 X0 Y0 Z20 F100\n",
    ),
    "g43": (
        ["G99 G81 X1 Y1 Z-9 R2 F100", "G98 G83 X1 Y1 Z-9 R2 Q2.5 F100", "G99 G73 X1 Z-9 R2 Q3 F80", "G99 G82 X1 Z-5 R2 P0.5 F90",
         "G98 G85 X1 Z-5 R2 F80", "G99 G89 X2 Z-5 R2 P1 F80", "G98 G86 X2 Z-5 R2 F80", "G99 G84 X2 Z-5 R2 F500"],
        ["G55", "G54", "G92 X5", "G98", "G99", "S900", "M4", "M3", "F60", "G80\nG0 Z30", "X5 F60", "X3 Z-6", "Y2 R3",
         "G91", "G90"],
        "G17 G90 G54\nT2 M6\nG43 H2 G0 X0 Y0 Z20 S800 M3\nF100\n",
    ),
}  # fmt: skip


@settings(max_examples=40)
@given(st.sampled_from(list(HOLES)), st.integers(0, 10**9))
def test_modal_cycles_at_positions(control, seed):
    """Runs of holes with changes of the state between them: in bulk, and each block by itself."""
    chance = random.Random(seed)
    cycles, changes, head = HOLES[control]
    blocks = [chance.choice(cycles)]
    for _ in range(chance.randint(1, 3)):
        tail = chance.choice(["", "", " Z-8", " F120", " R2.5"])
        x, y = chance.choice([("X{}", "Y{}"), ("X{}", ""), ("", "Y{}")])
        blocks += [
            f"{x.format(chance.randint(-900, 900) / 10)} {y.format(chance.randint(-900, 900) / 10)}{tail}"
            for _ in range(chance.randint(33, 60))
        ]
        blocks += [chance.choice(changes), chance.choice(cycles)] if chance.random() < 0.5 else [chance.choice(changes)]
    text = head + "\n".join(blocks) + "\nG80\n"
    assert_same(run(text, control=control, bulk=True), run(text, control=control, bulk=False))


FRAMES_31 = ["X{}", "X{} ~", "X@{}", "Z@-{}", "Z@{} ~", "F{}", "S{}", "M8", "M9", "M3", "M4"]


@given(st.lists(st.tuples(st.sampled_from(FRAMES_31), st.integers(1, 3000)), min_size=1, max_size=6), st.integers(1, 4))
def test_repetition_of_frames(frames, times):
    """NC-31: G25 and the frames written so often."""
    body = [frame.format(number) for frame, number in frames]
    head = ["S800", "M3", "F20", "X4000 ~"]
    first, last = len(head), len(head) + len(body) - 1
    repeated = [*head, *body, "G25 *", f"P{first * 1000 + last} *", f"P{times}"]
    numbered = [
        "\n".join(f"N{k} {line}" for k, line in enumerate(lines)) + "\n"
        for lines in (repeated, [*head, *(body * (times + 1))])
    ]
    assert_same(*(run(text, control="nc-31") for text in numbered))
