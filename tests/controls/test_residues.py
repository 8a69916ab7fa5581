"""What a cycle leaves or leaves out is said: the area of a face, of a pocket, a cone that is too wide, a depth of 0."""

import math

import numpy as np
import pytest
import shapely

import mnclab
from mnclab import Kind, Setup, Tool
from mnclab.machine import trial

TNC = mnclab.controls["tnc-620"].cycles


def warnings(found):
    assert found.ok, found.alarms
    return [alarm.message for alarm in found.alarms]


def swept_at(path, level, radius):
    """What a disc sweeps along the lines of one level, as a shapely area."""
    flat = path[
        (path.kind != Kind.RAPID) & (np.abs(path.end[:, 2] - level) < 1e-9) & (np.abs(path.start[:, 2] - level) < 1e-9)
    ]
    ways = [shapely.LineString([a[:2], b[:2]]) for a, b in zip(flat.start, flat.end, strict=True)]
    return shapely.union_all(shapely.buffer(ways, radius, quad_segs=512))


# --- G321 with L1 -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("radius", [3.0, 10.0])
@pytest.mark.parametrize(
    ("length", "width", "factor", "infeed"),
    [(100, 50, 1.5, 2), (100, 50, 1.5, 9), (60, 33, 1.9, 2), (12, 40, 1, 2), (100, 5, 1, 2)],
)  # fmt: skip
def test_g321_within_the_surface_names_what_it_leaves(length, width, factor, infeed, radius):
    """The area is that of the surface less what the disc sweeps on the last level of the path itself."""
    block = f"G321 L1 X5 Y-7 Z0 W-5 A{length} B{width} Q2 P{infeed} K{factor} F500 V2000 I3 U0 T800"
    found = mnclab.run(f"T1 S1000 M3\nG0 X0 Y0 Z20\n{block}\n", "mnc", Setup(tools={1: Tool(radius=radius)}))
    (sentence,) = warnings(found)
    rest = shapely.box(5, -7, 5 + length, width - 7).difference(swept_at(found.toolpath.motion, -5, radius)).area
    said = sentence.removeprefix("G321 L1 leaves ").split()[0]
    assert float(said) == pytest.approx(rest, abs=0.02) and "of the surface uncut" in sentence


@pytest.mark.parametrize("strategy", [0, 2])
def test_g321_beyond_the_surface_leaves_nothing(strategy):
    block = f"G321 L{strategy} X0 Y0 Z0 W-5 A100 B50 Q2 P2 K1.5 F500 V2000 I3 U0 T800"
    found = mnclab.run(f"T1 S1000 M3\nG0 X0 Y0 Z20\n{block}\n", "mnc", Setup(tools={1: Tool(radius=10)}))
    assert not warnings(found)
    assert shapely.box(0, 0, 100, 50).difference(swept_at(found.toolpath.motion, -5, 10)).area < 1e-6


# --- 22 with Q2 -------------------------------------------------------------------------------------------------------


def rough_out(factor, corners="L X+80 Y+0\nL X+80 Y+60\nL X+0 Y+60"):
    contour = f"LBL 1\nL X+0 Y+0 RL F100\n{corners}\nL X+0 Y+0\nLBL 0\n"
    data = f"CYCL DEF 20 C\nQ1=-5\nQ2={factor}\nQ3=0\nQ4=0\nQ5=0\nQ6=2\nQ7=30\nQ8=0\nQ9=1\n"
    rough = "CYCL DEF 22 R\nQ10=5\nQ11=100\nQ12=200\nQ18=0\nQ19=0\nQ208=FMAX\n"
    text = f"TOOL CALL 1 Z S1000\nL Z+50 FMAX M3\nCYCL DEF 14.0 C\nCYCL DEF 14.1 LBL1\n{data}{rough}CYCL CALL\nM2\n{contour}"
    return mnclab.run(text, "tnc-620", Setup(tools={1: Tool(radius=5)}))


@pytest.mark.parametrize("factor", [0.5, 1, 1.5])
def test_rough_out_that_leaves_nothing_is_silent(factor):
    assert not warnings(rough_out(factor))


@pytest.mark.parametrize(
    ("factor", "corners"), [(1.95, "L X+80 Y+0\nL X+80 Y+60\nL X+0 Y+60"), (1.5, "L X+90 Y+0\nL X+0 Y+60")]
)
def test_rough_out_names_what_it_leaves(factor, corners):
    """The area is what the disc reaches in the contour (its inset, grown again) less what it sweeps on the level."""
    found = rough_out(factor, corners)
    (sentence,) = warnings(found)
    points = [(0, 0)] + [tuple(float(w[1:]) for w in line.split()[1:]) for line in corners.splitlines()]
    reach = shapely.Polygon(points).buffer(-5, join_style="mitre").buffer(5, quad_segs=512)
    rest = reach.difference(swept_at(found.toolpath.motion, -5, 5)).area
    assert rest > 0.01 and float(sentence.split("leaves ")[1].split()[0]) == pytest.approx(rest, abs=0.02)
    assert sentence.startswith(f"CYCL DEF 22 Q2={factor} leaves") and "of each level uncut" in sentence


# --- 240 on a diameter ------------------------------------------------------------------------------------------------


def centred(diameter):
    values = {p.name: trial.first_value(p) for p in TNC["CYCL DEF 240"].parameters()} | {
        "mode": 1,
        "diameter": diameter,
    }
    text = trial.program(mnclab.controls["tnc-620"], TNC["CYCL DEF 240"], values)
    return mnclab.run(text, "tnc-620", Setup(tools={2: Tool(radius=4, angle=90)}))


def test_a_cone_is_not_wider_than_the_tool():
    assert not warnings(centred(-8)) and centred(-8).toolpath.end[:, 2].min() == pytest.approx(-4)
    assert warnings(centred(-9)) == [
        "CYCL DEF 240 Q344=-9 is wider than the tool, 8: the cone ends at the tool's diameter"
    ]
    assert centred(-9).toolpath.end[:, 2].min() == pytest.approx(-4.5 / math.tan(math.pi / 4))


@pytest.mark.parametrize("diameter", [-8, -12.5])
def test_a_cone_of_g305_is_not_wider_than_the_tool(diameter):
    found = mnclab.run(
        f"T1 S500 M3\nG0 Z20\nG305 Q2 L1 D{diameter} Z0 F90\nX5 M99\n",
        "mnc",
        Setup(tools={1: Tool(radius=4, angle=90)}),
    )
    wide = "G305 D-12.5 is wider than the tool, 8: the cone ends at the tool's diameter"
    assert warnings(found) == [wide][: diameter < -8]


# --- a depth of 0 -----------------------------------------------------------------------------------------------------

DEEP = {code: [p for p in cycle.parameters() if p.name in ("depth", "thread_depth", "end_tool_axis", "end_3rd_axis")]
        for code, cycle in TNC.items() if cycle.runs == "call"}  # fmt: skip
SEVERAL = ("CYCL DEF 263", "CYCL DEF 264", "CYCL DEF 265", "CYCL DEF 267")  # which still have another depth
ALONG = ("CYCL DEF 276",)  # which then goes along its contour


@pytest.mark.parametrize("code", [c for c, p in DEEP.items() if p and c not in (*SEVERAL, *ALONG) and "CYCL DEF 18" not in c])
def test_a_depth_of_0_is_said(code):
    """The cycle does nothing, as its notes say, and is not silent about it; in a pattern it is said once."""
    cycle, (depth,) = TNC[code], DEEP[code]
    values = {p.name: trial.first_value(p) for p in cycle.parameters() if p.required or trial.written_first(p)}
    values[depth.name] = values.get("start_3rd_axis", 0)
    text = trial.program(mnclab.controls["tnc-620"], cycle, values)
    many = "PATTERN DEF ROW1 (X+0 Y+0 D+30 NUM12 ROT+0 Z+0)\nCYCL CALL PAT FMAX"
    at_points = [text.replace("L X+20 Y+10 R0 FMAX M99", many)] if depth.address == "Q201" or "Q227" in text else []
    for called in (text, *at_points):
        found = mnclab.run(called, "tnc-620")
        assert warnings(found) == [f"{code} {depth.address} makes a depth of 0: the cycle is not executed"]
        assert not any(label.startswith(f"{code} ") for label in found.toolpath.labels)
