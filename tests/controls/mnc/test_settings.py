"""Every setting of the MNC, each of its values with a number worked out by hand; the defaults are in test_readings.py too."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tools.running import lines, run

import mnclab
from mnclab import Alarm, Kind, Limits, Tool
from mnclab.path.toolpath import COLUMNS, Rule
from mnclab.running import bulk as tiers

SETTINGS = {setting.name: setting for setting in mnclab.controls["mnc"].settings}
TOOLS = {0: Tool(), 1: Tool(radius=2, length=50), 2: Tool(radius=3, length=30, dl=1)}
DATUMS = {1: (3, 4, 0)}


def obeyed(program, settings, **setup):
    return run(lines(program), ok=None, settings=settings, **({"tools": TOOLS, "datums": DATUMS} | setup))


def ends(program, **settings):
    """Ends of the moves in machine coordinates; no alarms."""
    found = obeyed(program, settings)
    assert found.ok, found.alarms
    moves = found.toolpath.motion
    return np.round(moves.end + moves.origin, 9).tolist()


WHERE_IT_ENDS = [  # setting, value, program, last point
    ("power_on_dimension", "G90", "G0 X5|X1", (1, 0, 0)),
    ("power_on_dimension", "G91", "G0 X5|X1", (6, 0, 0)),
    ("transformation_order", "fixed", "G37 X2 Y2|G39 X10 A90|G51 Y3|G0 X1 Y1", (6, -8, 0)),  # 2 2 -> 2 4 -> 6 -8
    ("transformation_order", "nested", "G37 X2 Y2|G39 X10 A90|G51 Y3|G0 X1 Y1", (10, -18, 0)),  # 1 5 -> 5 -9 -> 10 -18
    ("transformation_order", "nested", "G51 X5|G37 X2|G51 X1|G0 X4", (-4, 0, 0)),  # the second G51 alone, inside G37
    ("transformation_order", "nested", "G39 A90|G37 X2|G38|G0 X4 Y1", (8, 1, 0)),
    ("switch_keeps", "programmed", "G0 X10|G39 A90|Y5", (-5, 10, 0)),
    ("switch_keeps", "tip", "G0 X10|G39 A90|Y5", (10 - 5 - 10, 0, 0)),  # the tip reads X0 Y-10
    ("switch_keeps", "tip", "G0 X10|G51 X0|G91|X1", (9, 0, 0)),
    ("g37_omitted", "one", "G37 X2 Y3|G37 X4|G0 X1 Y1", (4, 1, 0)),
    ("g37_omitted", "kept", "G37 X2 Y3|G37 X4|G0 X1 Y1", (4, 3, 0)),
    ("g37_omitted", "kept", "G37 X2 Y3|G36|G37 X4|G0 X1 Y1", (4, 1, 0)),
    ("g53_transformed", True, "G54|G39 A90|G37 X2 Y2|G53 G0 X10 Y5", (-10, 20, 0)),
    ("g53_transformed", False, "G54|G39 A90|G37 X2 Y2|G53 G0 X10 Y5", (10, 5, 0)),
    ("g53_transformed", False, "G54|G39 A90|G53 G0 X10 Y5|X0 Y1", (2, 4, 0)),  # afterwards as before: 3 - 1, 4 + 0
    ("g53_tool_length", True, "T1|G53 G0 Z0", (0, 0, 0)),
    ("g53_tool_length", False, "T1|G53 G0 Z10", (0, 0, -40)),
    ("g53_tool_length", False, "T2|G54|G53 G0 Z100|Z5", (0, 0, 5)),
    ("g92_increment", "subtract", "G0 X10|G92 U3|X0", (3, 0, 0)),
    ("g92_increment", "add", "G0 X10|G92 U3|X0", (-3, 0, 0)),
    ("g16_pole", "absolute", "G0 X10 Y20|G91|G16 X5|G90|G10 R2 A90", (5, 2, 0)),
    ("g16_pole", "incremental", "G0 X10 Y20|G91|G16 X5|G90|G10 R2 A90", (15, 22, 0)),
    ("g16_pole", "incremental", "G0 X10 Y20|G16 X5|G10 R2 A90", (5, 2, 0)),  # G90
    ("datum_rows", 6, "G147 Q6|G0 X1", (1, 0, 0)),
    ("datum_rows", 99, "G147 Q99|G0 X1", (1, 0, 0)),
    ("corrector_length", False, "T1 D2|G0 Z0", (0, 0, 0)),
    ("tool_change", "M6", "T2|M6|T1|G53 G0 Z0", (0, 0, 0)),
]


@pytest.mark.parametrize(("setting", "value", "program", "last"), WHERE_IT_ENDS)
def test_where_the_tool_ends(setting, value, program, last):
    assert ends(program, **{setting: value})[-1] == list(last)


ARCS = [  # setting, value, program, centre, degrees
    ("polar_arc", "pole", "G16|G10 R10 A0|G12 A90 K10 F60", (0, 0), -270),
    ("polar_arc", "sign", "G16|G10 R10 A0|G12 A90 K10 F60", (10, 10), -90),
    ("polar_arc", "sign", "G16|G10 R10 A0|G12 A90 K-10 F60", (0, 0), -270),
    ("polar_arc_without_k", "pole", "G16|G10 R10 A0|G12 A90 F60", (0, 0), -270),
    ("polar_arc_without_k", "pole", "G16|G10 R10 A0|G13 A90 K10 F60", (0, 0), 90),
    ("polar_arc_without_k", "pole", "G16|G10 R10 A0|G13 A360 F60", (0, 0), 360),
    ("arc_by_both", "radius", "G2 X10 R-13 I5 J12 F60", (5, 12), None),
    ("arc_by_both", "radius", "G2 X10 R13 I5 J12 F60", (5, -12), None),
    ("arc_by_both", "centre", "G2 X10 R13 I5 J12 F60", (5, 12), None),
]


@pytest.mark.parametrize(("setting", "value", "program", "centre", "degrees"), ARCS)
def test_arcs(setting, value, program, centre, degrees):
    row = obeyed(program, {setting: value}).toolpath[-1]
    assert row.kind == Kind.ARC and row.centre[:2].tolist() == pytest.approx(centre, abs=1e-9)
    assert degrees is None or math.degrees(row.sweep) == pytest.approx(degrees)


def test_power_on():
    """Planes by the axis of an arc, G1 by the kind of a move, G95 by its feed, G61 by exact stops, G99 by where Z stays."""
    arcs = {"G17": "G3 X5 I5", "G18": "G3 Z5 K5", "G19": "G3 Y5 J5"}
    for k, (plane, arc) in zip((2, 1, 0), arcs.items(), strict=True):
        row = obeyed(f"F60|{arc.replace('5', '0', 1)}", {"power_on_plane": plane}).toolpath[-1]
        assert row.axis.tolist() == [float(k == axis) for axis in range(3)] and row.sweep == math.tau
    assert [obeyed("F60|X5", {"power_on_motion": code}).toolpath[0].kind for code in ("G0", "G1")] == [
        Kind.RAPID,
        Kind.LINE,
    ]
    alarm = obeyed("X5", {"power_on_motion": "G1"}).alarms[0]
    assert alarm.message.startswith("no feed rate was programmed") and alarm.span[:2] == (1, 1)
    feeds = [obeyed("S50 M3 F2|G1 X5", {"power_on_feed": code}).toolpath[-1].feed for code in ("G94", "G95")]
    assert feeds == [2, 100]
    assert [obeyed("G0 X5", {"power_on_blending": code}).toolpath[-1].exact for code in ("G64", "G61")] == [False, True]
    heights = [obeyed("F60|G0 Z9|G83 Z-5 R1", {"power_on_return": code}).toolpath[-1].end[2] for code in ("G98", "G99")]
    assert heights == [9, 1]
    found = obeyed("G0 X1", {"power_on_plane": "G19", "power_on_dimension": "G91"}).at(1).state
    assert (found["plane"], found["dimension"], found["motion"]) == ("G19", "G91", "G0")


REMARKS = [
    ("helix", "G2 X10 Z1 I5 F60", "1:8", "helix"),
    ("helix", "G16|G10 R5 A0|G13 A90 K5 Z1 F60", "3:12", "helix"),
    *(
        ("unlisted_m", f"{code}|", "1:1", "the manual does not list it")
        for code in ("M0", "M1", "M2", "M6", "M7", "M9", "M30")
    ),
]


@pytest.mark.parametrize(("setting", "program", "place", "text"), REMARKS)
def test_what_the_manual_does_not_describe(setting, program, place, text):
    said = {choice: obeyed(program, {setting: choice}) for choice in ("warn", "accept", "refuse")}
    assert [alarm.severity for alarm in said["warn"].alarms] == ["warning"] and not said["accept"].alarms
    assert np.array_equal(said["warn"].toolpath.end, said["accept"].toolpath.end)
    (alarm,) = said["refuse"].alarms
    assert not said["refuse"].ok and text in alarm.message and "{}:{}".format(*alarm.span[:2]) == place


def test_r_beside_i_j_k_may_be_refused():
    (alarm,) = obeyed("G2 X10 R13 I5 J12 F60", {"arc_by_both": "refuse"}).alarms
    assert alarm.severity == "alarm" and alarm.span[:2] == (1, 8)
    assert [a.message for a in obeyed("G2 X10 R0 I5 F60", {"arc_by_both": "centre"}).alarms] == [
        "R and I J K stand in one block: I J K count"
    ]


def test_tolerance_of_arcs():
    """Radii 5 and 5.02; a chord of 10.02 for R5."""
    for program in ("G2 X10.02 I5 F60", "G2 X10.02 R5 F60"):
        assert obeyed(program, {"arc_tolerance": 0.021}).ok and not obeyed(program, {"arc_tolerance": 0.009}).ok


def test_a_full_circle_by_the_sign_of_k_is_refused():
    (alarm,) = obeyed("G16|G10 R5 A0|G13 K5 F60", {"polar_arc": "sign"}).alarms
    assert "a full circle needs G2 or G3" in alarm.message and alarm.span[:2] == (3, 5)


def test_a_row_beyond_the_table():
    (alarm,) = obeyed("G147 Q21", {"datum_rows": 20}).alarms
    assert alarm.message.startswith("G147 Q21 has no row")


def test_g53_without_corrections_under_compensation():
    text = "T1 F60|G41 G1 X5|X9|G53 X20|G40 X30"
    for setting in ("g53_transformed", "g53_tool_length"):
        alarm = obeyed(text, {setting: False}).alarms[0]
        assert alarm.message.startswith("G53 without the corrections") and alarm.span[:2] == (4, 1)


def test_axes_of_g18():
    """A quarter from (X5, Z0) to (X0, Z5): for XZ counter-clockwise, G3; for ZX it is three quarters."""
    text = "G18 G0 X5|G3 X0 Z5 I-5 F60"
    rows = [obeyed(text, {"g18_axes": axes}).toolpath[-1] for axes in ("ZX", "XZ")]
    assert [row.axis.tolist() for row in rows] == [[0, 1, 0], [0, -1, 0]]
    assert np.degrees([row.sweep for row in rows]).tolist() == pytest.approx([270, 90])
    polar = [ends("G18 G16|G10 R5 A30", g18_axes=axes)[-1] for axes in ("ZX", "XZ")]
    assert polar == [[2.5, 0, 4.330127019], [4.330127019, 0, 2.5]]
    turned = [ends("G18 G39 A90|G0 X5", g18_axes=axes)[-1] for axes in ("ZX", "XZ")]
    assert turned == [[0, 0, -5], [0, 0, 5]]


plane_point = st.tuples(st.integers(-40, 40), st.integers(-40, 40))
blocks = st.one_of(
    plane_point.map(lambda p: f"G1 X{p[0]} {{v}}{p[1]}"),
    st.tuples(st.sampled_from("23"), plane_point, st.sampled_from([60, -57])).map(
        lambda t: f"G{t[0]} X{t[1][0]} {{v}}{t[1][1]} R{t[2]}"
    ),
    st.tuples(st.sampled_from("23"), plane_point).map(lambda t: f"G{t[0]} I{t[1][0]} {{c}}{t[1][1]}"),
)


@pytest.mark.deep
@given(st.sampled_from(["G41", "G42", "G40"]), st.lists(blocks, min_size=1, max_size=6))
def test_xz_is_xy_seen_from_the_other_side(side, contour):
    """With the axes X, Z a contour of G17 in X, Y turns into the same one in X, Z: arcs, sides and corners as well."""
    text = f"T1 F60|G0 X-90 {{v}}-70|{side} G1 X0 {{v}}0|" + "|".join(contour) + "|G40 G1 X90 {v}-75"
    flat = obeyed("G17|" + text.format(v="Y", c="J"), {}, tools={1: Tool(radius=5)})
    upright = obeyed("G18|" + text.format(v="Z", c="K"), {"g18_axes": "XZ"}, tools={1: Tool(radius=5)})
    assert [alarm.span[:2] for alarm in upright.alarms] == [alarm.span[:2] for alarm in flat.alarms]
    assert np.allclose(upright.toolpath.end[:, [0, 2]], flat.toolpath.end[:, [0, 1]], rtol=0, atol=1e-9)
    assert np.allclose(upright.toolpath.sweep, flat.toolpath.sweep, rtol=0, atol=1e-9)
    assert np.array_equal(upright.toolpath.side, flat.toolpath.side)


# --- feed, tool, spindle ----------------------------------------------------------------------------------------------


def test_the_feed_when_its_meaning_changes():
    """S500: 200 mm/min are 0.4 mm/rev; read anew they would be 100 000 mm/min."""
    text = "S500 M3 F200|G1 X1|G95 X2|G94 X3"
    assert obeyed(text, {}).toolpath.feed[1:].tolist() == [200, 100_000, 200]
    assert obeyed(text, {"feed_mode_switch": "converted"}).toolpath.feed[1:].tolist() == pytest.approx([200] * 3)
    for standing, place in ((text, (3, 5)), (text.replace("G95", "F0.1 G95"), (4, 5))):
        alarm = obeyed(standing, {"feed_mode_switch": "cleared"}).alarms[0]
        assert alarm.message.startswith("no feed rate was programmed") and alarm.span[0] == place[0]
    path = obeyed("S500 M3 F200|G1 X1|G95 F0.1|X2|G94 F90 X3", {"feed_mode_switch": "cleared"}).toolpath
    assert path.feed[1:].tolist() == [200, 50, 90]
    assert not obeyed("F200|G95|S500 M3|G1 X1", {"feed_mode_switch": "converted"}).ok  # the spindle stood


def test_the_tool_waits_for_m6():
    text = "T1|X1|T2 X2|M6|X3|M6 X4"
    numbers = {choice: obeyed(text, {"tool_change": choice}).toolpath for choice in ("T", "M6")}
    assert [numbers["T"].tool[numbers["T"].line == k][-1] for k in (2, 3, 5, 6)] == [1, 2, 2, 2]
    assert [numbers["M6"].tool[numbers["M6"].line == k][-1] for k in (2, 3, 5, 6)] == [0, 0, 2, 2]
    found = obeyed("T1|T2 M6 D1|G0 Z0", {"tool_change": "M6"})
    assert not found.alarms and found.toolpath[-1].radius == 2  # D counts for the new tool
    assert found.at(1).state["next tool"] == 1
    (alarm,) = obeyed("M6", {"tool_change": "M6"}).alarms
    assert alarm.message == "M6 has no tool to put into the spindle" and alarm.span[:2] == (1, 1)
    (alarm,) = obeyed("T1 M6|F60 T2|G41 G1 X5|X9|M6", {"tool_change": "M6"}).alarms
    assert alarm.message.startswith("the tool cannot change") and alarm.span[:2] == (5, 1)
    assert obeyed("T1 M6 F60|G41 G1 X5|X9 T2|G40 X20|M6", {"tool_change": "M6"}).ok


def test_the_length_of_the_corrector():
    """T1 is 50 long, row 2 has 30 + 1; the reference stands at 0."""
    for setting, length in ((False, 51), (True, 31)):
        found = obeyed("T1|D2", {"corrector_length": setting})
        assert found.at(2).position[2] == -length


def test_waiting_for_the_spindle():
    """Once for each block that gives it another speed or sense, not under G25, not for M5."""
    text = "S500 M3|G1 X1 F60|S500|S800|M4|S900 M3|M5|S700|G25|M3|G26 S600"
    path = obeyed(text, {"spindle_run_up": 1.5}).toolpath
    waits = path.kind == Kind.DWELL
    assert path.line[waits].tolist() == [1, 4, 5, 6, 11] and (path.time[waits] == 1.5).all()
    assert not (obeyed(text, {}).toolpath.kind == Kind.DWELL).any()


def test_m5_acts_after_the_motion_or_before_it():
    text = "S500 M3|G0 X1 M5|X2"
    spindles = [obeyed(text, {"spindle_stop": when}).toolpath for when in ("before", "after")]
    assert [path.spindle[path.kind == Kind.RAPID].tolist() for path in spindles] == [[0, 0], [500, 0]]
    path = obeyed("S500 M3 F2|G95 G1 X1 M5", {}).toolpath
    assert [Kind(kind).name for kind in path.kind] == ["SPINDLE", "LINE", "SPINDLE"]
    assert not obeyed("S500 M3 F2|G95 G1 X1 M5", {"spindle_stop": "before"}).ok


def test_rapids_of_axes_that_do_not_wait():
    """X at 2000 and Y at 1000 mm/min, turned by 90 degrees: Y30 of the program is X-30. The cycle's rapids too."""
    limits = Limits(rapid=(2000, 1000, 500))
    settings = {"rapid_path": "broken"}
    path = obeyed("G39 A90|G0 X10 Y30|G1 X0 Y0 F60", settings, limits=limits).toolpath
    assert path.end == pytest.approx(np.array([[-20, 10, 0], [-30, 10, 0], [0, 0, 0]]))
    assert path.kind.tolist() == [Kind.RAPID, Kind.RAPID, Kind.LINE] and path.line.tolist() == [2, 2, 3]
    path = obeyed("F60 G0 Z1|G83 X10 Y10 Z-5 R1", settings, limits=limits).toolpath
    assert path.end[1:3].tolist() == [[10, 5, 1], [10, 10, 1]]
    assert len(obeyed("G0 X10 Y30", {}, limits=limits).toolpath) == 1
    assert len(obeyed("G0 X10 Y30", settings, limits=limits).programmed) == 1


# --- one declaration ---------------------------------------------------------------------------------------------------


def test_gouge():
    """A groove 3 mm wide for a tool of radius 2: its floor is lost, so the tool would turn back by 1 mm."""
    groove = "T1 G0 X-9|G41 G1 X0 F60|X10|Y-9|X13|Y0|X20|G40 X30"
    refused, marked = (obeyed(groove, {"gouge": value}) for value in ("refuse", "mark"))
    assert [(alarm.span.line, alarm.severity) for alarm in refused.alarms] == [(4, "alarm")]
    assert [gouge.largest for gouge in refused.gouges] == [1.5] and refused.toolpath.line.max() == 2
    assert marked.ok and {alarm.severity for alarm in marked.alarms} == {"warning"}
    assert set(marked.toolpath.line[marked.toolpath.gouge].tolist()) >= {4, 5}
    floor = marked.toolpath[marked.toolpath.line == 5]
    assert floor.start[0, :2].tolist() == [12, -7] and floor.end[0, :2].tolist() == [11, -7]
    assert {gouge.largest for gouge in marked.gouges} == {1.5}


def test_rapid_motion():
    limits = Limits(acceleration=(1000, 100, 1000))
    v = 10_000 / 60
    # X takes L/v + v/a for its 100 mm; Y never reaches v on 20 mm: 2 sqrt(L/a)
    times = {"axes": max(100 / v + v / 1000, 2 * math.sqrt(20 / 100))}
    # Y in the ratio of the distances: v/5, which it needs v/5/100 to reach
    times["proportional"] = 100 / v + v / 5 / 100
    # along the line of 101.98 mm, u = (100, 20)/101.98: v/u_x, and 100/u_y
    length = math.hypot(100, 20)
    times["line"] = length / (v * length / 100) + (v * length / 100) / (100 * length / 20)
    for motion, seconds in times.items():
        found = obeyed("G90 G54|G0 X100 Y20", {"rapid_motion": motion}, datums={}).profile(limits)
        assert found.time == pytest.approx(seconds)
    assert times["axes"] < times["line"] == pytest.approx(times["proportional"])


@pytest.mark.parametrize(("value", "arcs"), [("programmed", {6}), ("G160", {5, 6, 7}), ("G161", set()), ("G162", {6})])
def test_outside_corners_follow_the_setting_or_the_program(value, arcs):
    # turns of 90, 135 and 45 degrees, the second acute; the program says straight, then an arc at acute corners; an
    # inserted arc carries the line of the element after it
    text = "T1 F60|G0 X-20 Y0|G1 G161 G41 X0 Y0|Y20|X30|G162 X10 Y0|G40 X-20"
    path = obeyed(text, {"outside_corners": value}, tools={1: Tool(radius=2)}).toolpath
    made = path.line[path.rule == Rule.OUTSIDE_ARC]
    assert set(made.tolist()) == arcs


def test_every_setting_is_tested_here_or_with_its_cycle():
    text = open(__file__, encoding="utf-8").read()
    for setting in SETTINGS.values():
        elsewhere = ("block_skip", "peck_clearance", "bulk", "rapid_motion", "stopped_spindle", "most_rows", "most_blocks",
                     "most_megabytes", "corner_spacing", "measurements_per_point", "g491_l2_plane", "raw_z", "lint")
        of_tools = setting.name.startswith("laser_") or setting.name == "spindle_max"  # test_tool_setting.py
        assert setting.name in text or setting.name in elsewhere or of_tools
        assert setting.check(setting.default) == setting.default and setting.meaning
        assert setting.source or setting.name == "bulk"


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"arc_tolerence": 1}, "mnc has no setting 'arc_tolerence' (near: arc_tolerance)"),
        ({"quite different": 1}, "mnc has no setting 'quite different' (mnclab.help('settings', 'mnc') lists them)"),
        ({"helix": "warm"}, "setting helix (a word of the third axis in an arc block) must be one of warn, accept, refuse"),
        ({"helix": "warm"}, "got 'warm' (near: warn)"),
        ({"arc_tolerance": -1}, "must be a number from 0, got -1"),
        ({"arc_tolerance": math.nan}, "must be a number from 0, got nan"),
        ({"arc_tolerance": True}, "must be a number from 0, got True"),
        ({"block_skip": 1}, "must be true or false, got 1"),
        ({"power_on_plane": ["G17"]}, "must be one of G17, G18, G19, got ['G17']"),
    ],
)  # fmt: skip
def test_a_setup_that_is_not_understood(settings, message):
    with pytest.raises(Alarm) as caught:
        obeyed("G0 X1", settings)
    assert message in str(caught.value)


def test_help_lists_the_settings():
    table = str(mnclab.help("settings", "mnc"))
    html = mnclab.help("settings", "mnc")._repr_html_()
    for setting in SETTINGS.values():
        assert f"\n{setting.name} " in table and setting.meaning in table and f"<code>{setting.name}</code>" in html
        assert all(choice in table and meaning in table for choice, meaning in setting.choices.items())
        assert setting.meaning in str(mnclab.help(setting.name, "mnc"))
    assert "Settings" in mnclab.controls["mnc"]._repr_html_()
    with pytest.raises(Alarm, match="near: helix"):
        mnclab.help("helx", "mnc")


# --- both tiers --------------------------------------------------------------------------------------------------------

OTHERS = [
    (setting.name, value)
    for setting in SETTINGS.values()
    if setting.name not in ("bulk", "peck_clearance")
    for value in (
        [c for c in setting.choices if c != setting.default]
        or (
            [not setting.default]
            if isinstance(setting.default, bool)
            else [(setting.default or setting.at_least or 0) + (1 if setting.whole else 0.5)]
        )
    )
]
number = st.integers(-20_000, 20_000).map(lambda n: f"{n / 1000:g}")
axes = st.lists(st.tuples(st.sampled_from("XYZ"), number), max_size=3, unique_by=lambda w: w[0])
plain = st.tuples(st.sampled_from(["", "", "G0 ", "G1 "]), axes, st.sampled_from(["", "", " F75"])).map(
    lambda t: t[0] + " ".join(a + v for a, v in t[1]) + t[2]
)
arc = st.tuples(
    st.sampled_from(["G2", "G3"]), number, st.sampled_from(["R25", "R-40 I3", "I5 K2", "J4", "I3 K4 R30", "Z3 I2"])
).map(lambda t: f"{t[0]} X{t[1]} {t[2]}")
odd = st.sampled_from(
    ["G91", "G90", "G54", "G92 U1", "M3 S100", "M5 X3", "G95", "G94", "T1 M6", "G39 A20", "G37 X2 Y2", "G37 X3", "G51 X3",
     "G36", "G53 X4", "G18", "G17", "D2", "/ X5", "G9 X3", "M8"]
)  # fmt: skip


@given(
    st.lists(st.sampled_from(OTHERS), min_size=1, max_size=6).map(dict),
    st.lists(st.one_of(*[plain] * 8, arc, odd), min_size=6, max_size=40),
    st.booleans(),
)
def test_both_tiers_obey_a_setting_alike(settings, todo, fed):
    text = ("F100|" if fed else "") + "|".join(todo)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tiers, "SHORTEST", 2)
        bulk, single = (obeyed(text, {**settings, "bulk": tier}) for tier in (True, False))
    assert [str(alarm) for alarm in bulk.alarms] == [str(alarm) for alarm in single.alarms]
    for name in COLUMNS:
        assert np.allclose(
            getattr(bulk.toolpath, name), getattr(single.toolpath, name), rtol=0, atol=1e-12, equal_nan=True
        ), name
    assert np.array_equal(bulk.steps.block, single.steps.block) and set(bulk.history) == set(single.history)


@pytest.mark.parametrize(("name", "wrong"), [("datum_rows", 6.5), ("measurements_per_point", 1.5), ("laser_axis", 1.5)])
def test_what_counts_is_whole(name, wrong):
    with pytest.raises(mnclab.Alarm, match=rf"setting {name} .* must be a whole number from \d.*, got {wrong}"):
        mnclab.run("", "mnc", mnclab.Setup(settings={name: wrong}))
