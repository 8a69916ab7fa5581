"""`mnclab.steps`: every cycle of every control looked at without a program."""

import math

import pytest
from tools.together import together

import mnclab as mnc
from mnclab.controls.cycle_steps import written
from mnclab.machining.steps import Call, Go, Touch, Wait, Write

CYCLES = [(name, cycle.code) for name, control in mnc.controls.items() for cycle in dict.fromkeys(control.cycles.values())]
#: What cycles ask for that only a program has, or a user: the piece of the alarm that says so.
NEEDS = {
    "CYCL DEF 12": "PGM (name of the program) is missing",
    "CYCL DEF 14": "names label 1, which does not exist",
    **{f"CYCL DEF {number}": "CYCL DEF 14 comes before it" for number in (21, 22, 23, 24, 25, 27, 28, 29, 39, 275, 276)},
    "CYCL DEF 225": "Q500 (text) is missing",
}


@together("control code", CYCLES, lambda control, code: control)
def test_every_cycle_shows_its_steps(control: str, code: str) -> None:
    if code in NEEDS:
        with pytest.raises(mnc.Alarm) as refused:
            mnc.steps(code, control)
        assert NEEDS[code] in refused.value.message and refused.value.span is None
        return
    found = mnc.steps(code, control)
    lines = str(found).splitlines()
    rows = found.cells()
    assert 0 < len(rows) <= len(found) and len(lines) == len(rows) + 3 and lines[0].startswith(code)
    assert found._repr_html_().count("<tr>") == len(rows) + 1
    assert sum(step != "write" for step, *_ in rows) == sum(not isinstance(step, Write) for step in found)
    assert {len(row) for row in rows} == {len(found.head)} and ":," not in found.title
    assert not any(mark in row[-1] for row in rows for mark in ("{", "array(", "Data(", "Datum(", "nan", "None", "'"))


def test_the_steps_of_drilling() -> None:
    """From the set-up plane 2 above the surface: pecks of 6 to -6 and -10, and between them up and back to 2 above the last."""
    found = mnc.steps("CYCL DEF 200", "tnc-620", Q201=-10, infeed=6, Q211=0, Q210=0, Q204=20)
    assert [(step.z, step.feed) for step in found if isinstance(step, Go)] == [
        (2, math.inf), (-6, 150), (2, math.inf), (-4, math.inf), (-10, 150), (20, math.inf)
    ]  # fmt: skip
    assert found[0].label == "to the set-up clearance" and not any(isinstance(step, Wait) for step in found)
    assert "go peck 2 of 2 20 10 -10 150" in " ".join(str(found).split())


def test_a_number_alone_finds_its_cycle_and_values_go_by_address_or_name() -> None:
    assert list(mnc.steps("200", "tnc-620", Q202=3)) == list(mnc.steps("CYCL DEF 200", "tnc-620", infeed=3))


def test_a_touch_finds_what_it_is_aimed_at() -> None:
    """A ball of 2, 2 + 3 of clearance and 10 of reach: from X 27 to X 17; the ball's side lies at 15, which becomes 1."""
    setup = mnc.Setup(tools={1: mnc.Tool(radius=2, kind="probe")}, probe=mnc.Probe(clearance=3, reach=10))
    found = mnc.steps("419", "tnc-620", setup, Q263=20, Q320=2, Q272=1, Q267=-1, Q303=1, Q305=4, Q333=1)
    assert [(step.x, step.z) for step in found if isinstance(step, Touch)] == [(17, -7)]
    assert [(step.what, step.key, step.value[0]) for step in found if isinstance(step, Write)] == [("presets", 4, 14)]


def test_a_pattern_calls_the_cycle_at_each_of_its_points() -> None:
    found = mnc.steps("220", "tnc-620", Q241=3)
    assert sum(isinstance(step, Call) for step in found) == 3
    said = [row[-1] for row in found.cells() if row[0] == "call"]
    assert said[0] == "the cycle defined before, with second clearance 2" and said[-1].endswith("second clearance 20")
    centres = [row.end[:2] for row in found.rows if row.end and row.step.label.endswith("point")]
    assert centres[0] == pytest.approx((90, 50)) and centres[1] == pytest.approx((30, 50 + 40 * math.sin(math.tau / 3)))


@pytest.mark.parametrize(
    ("code", "values", "said"),
    [
        ("CYCL DEF 8", {"axes": ()}, ["frame mirror: none"]),
        ("CYCL DEF 8", {}, ["frame mirror: X"]),
        ("CYCL DEF 11", {}, ["frame scale: 0.5 0.5 0.5"]),
        ("CYCL DEF 10", {}, ["radius compensation: off", "frame rotation: turn by 30°"]),
        ("CYCL DEF 13", {}, ["orientation: 90"]),
        ("CYCL DEF 20", {}, ["kept for later blocks: contour data"]),
        ("CYCL DEF 32", {}, ["tolerance: as the limits have it", "filter: finishing: more exact", "tolerance of rotary axes: 0"]),
        ("CYCL DEF 32", {"T": 0.05}, ["tolerance: 0.05", "filter: finishing: more exact", "tolerance of rotary axes: 0"]),
        ("GLOBAL DEF 110", {}, ["default Q370: 1", "default Q351: 1", "default Q366: 0"]),
        # from X 20 - 2 - 2 by the reach of 10, and the ball's side
        ("TCH PROBE 419", {}, ["presets row 0: X28", "preset: 0", "datum: X28 Y0 Z0"]),
    ],
)
def test_what_stays_is_said_in_words(code: str, values: dict[str, float], said: list[str]) -> None:
    assert [row[-1] for row in mnc.steps(code, "tnc-620", **values).cells() if row[-1]] == said


def test_what_stays_of_other_cycles() -> None:
    assert "coolant M9" in [row[-1] for row in mnc.steps("G307", "mnc").cells()]
    assert written(Write("variable", 5.0, "Q1")) == "variable Q1 = 5"
    assert written(Write("rotary", (0.0, math.pi / 6, 0.0))) == "rotary: A0 B30 C0"


def test_the_title_has_every_value_of_an_address() -> None:
    title = mnc.steps("G77", "nc-31", stock_per_pass=300).title
    assert "X=3000 Z=-2000 F=2000 P=300 P=500 ~=1, called at X20 Z2, X as radius" in title
    assert "P=92 P=25 P=0" in mnc.steps("G31", "nc-31").title


def test_the_title_is_written_as_the_table_is() -> None:
    assert "Q201=-13.3333 " in mnc.steps("200", "tnc-620", Q201=-40 / 3).title
    assert mnc.steps("CYCL DEF 8", "tnc-620").title == "CYCL DEF 8 Mirroring: axes=X, called at X20 Y10 Z20"
    assert "Q500=&lt;b&gt;A &amp; B" in mnc.steps("CYCL DEF 225", "tnc-620", Q500="<b>A & B")._repr_html_()


def test_the_table_has_the_decimals_of_a_control() -> None:
    """No number of the table has more than three."""
    for code, control in (("G343", "mnc"), ("CYCL DEF 254", "tnc-620"), ("TCH PROBE 481", "tnc-620")):
        cells = [cell for row in mnc.steps(code, control).cells() for cell in row[2:-1]]
        assert not [cell for cell in cells if len(cell.partition(".")[2]) > 3]
    assert "-13.333" in {row[4] for row in mnc.steps("200", "tnc-620", Q201=-40 / 3).cells()}


def test_a_lathe_has_no_y_and_feeds_per_revolution() -> None:
    """From the diameter of 40 to the one of 30, 2 a pass: five passes, which end at the radius 15."""
    found = mnc.steps("G77", "nc-31")
    assert found.head == ("step", "label", "x (radius)", "z", "feed, mm/rev", "detail")
    assert found.cells()[0] == ("go", "pass 1 of 5, infeed", "19", "2", "rapid", "")
    assert mnc.steps("G77", "jnc-t01").head[4] == "feed, mm/min"
    diameters = mnc.Setup(settings={"diameter": True})
    assert mnc.steps("G77", "jnc-t01", diameters).title.endswith("called at X20 Z5, X as radius")


def test_a_thread_says_its_pitch_as_its_feed() -> None:
    assert [row[4] for row in mnc.steps("G31", "nc-31").cells() if row[0] == "thread"] == ["1.5"] * 4
    assert {row[5] for row in mnc.steps("207", "tnc-620").cells() if row[0] == "thread"} == {"1.5 mm/rev"}


@pytest.mark.parametrize(
    ("code", "values", "message"),
    [
        ("CYCL DEF 200", {"Q2O1": -5}, "has no parameter Q2O1"),
        ("CYCL DEF 200", {"Q201": -5, "depth": -6}, "Q201 is given twice"),
        ("CYCL DEF 200", {"Q202": -5}, "Q202 (infeed depth) must be at least 0 and at most 99999.9999, got -5"),
        ("CYCL DEF 200", {"Q202": "deep"}, "Q202 (infeed depth) must be a number"),
        ("L", {}, "'L' is no cycle"),
        ("CYCL DEF 999", {}, "has no code"),
    ],
)
def test_what_is_wrong_is_said(code: str, values: dict[str, float], message: str) -> None:
    with pytest.raises(mnc.Alarm) as refused:
        mnc.steps(code, "tnc-620", **values)
    assert message in refused.value.message


def test_a_lathe_says_whether_x_is_a_radius_or_a_diameter() -> None:
    """NC-31 counts on the diameter; JNC-T01 on the radius, unless its setting says otherwise: each parameter says it."""
    for code in ("G75", "G77", "G78"):
        across = [p for p in mnc.controls["jnc-t01"].cycles[code].parameters() if p.address in ("X", "U")]
        assert across and all(p.note.startswith("a radius, under the setting diameter a diameter") for p in across)
    assert mnc.controls["nc-31"].cycles["G77"].parameters()[0].unit == "0.01 mm on diameter"
