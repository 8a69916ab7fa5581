"""What a teacher says of programs that run: one warning for one cause, at its word, on every control; none that is false.

The programs are written by hand; what is wrong with each, and at which line and column, is read off its text.
"""

from pathlib import Path

import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab import Setup, Tool
from mnclab.workpiece.blank import cylinder

pytestmark = pytest.mark.lint

ROOT = Path(__file__).parents[2]
SAMPLES = sorted(path for path in ROOT.glob("data/programs/*/*") if path.is_file())
OF_SHOPS = sorted(path for path in ROOT.glob("tests/programs_of_shops/*/*") if path.is_file())
BLANK = ((0, 0, -20), (100, 60, 0))  # its top at Z0
BAR = cylinder(20, -80, 0)
SPINDLE = "the tool moves at feed while the spindle stands"
LINE = "is obeyed as a straight line"
RAPID = "a rapid goes through the blank, where nothing has been cut before"
AIR = "no move at feed"
SIDE = "radius compensation is still on where the program ends"
CYCLE = "a cycle is defined here and never called"
TOOL = "a tool is changed again before it is used"
EVERY = (SPINDLE, LINE, RAPID, AIR, SIDE, CYCLE, TOOL)


def run(text, control, stock=None, **settings):
    return mnclab.run(text.replace("|", "\n") + "\n", control, Setup(stock=stock, settings=settings))


def told(found):
    """Which remark stands where, and how many blocks it counts."""
    return [
        (each, alarm.span.line, alarm.span.column, alarm.count)
        for alarm in found.alarms for each in EVERY if each in alarm.message
    ]  # fmt: skip


def klartext(blocks, blank=True):
    """A program around blocks, of which the first is in line 5 (without a blank line 3)."""
    form = "BLK FORM 0.1 Z X+0 Y+0 Z-20|BLK FORM 0.2 X+100 Y+60 Z+0|" if blank else ""
    return f"BEGIN PGM A MM|{form}TOOL CALL 1 Z S1000|{blocks}|END PGM A MM"


MNC, G43, TNC, JNC, NC = "mnc", "g43", "tnc-620", "jnc-t01", "nc-31"
HOLE = "CYCL DEF 200 DRILLING Q200=2 Q201=-5 Q206=150 Q202=5 Q210=0 Q203=0 Q204=50 Q211=0"
FAULTS = [
    # an arc without radius and centre: only the MNC obeys it, also where G2 holds from the block before
    (MNC, "T1 S500 M3|G1 X5 F100|G2 X20 Y0|X30 R5|X40", None, (LINE, 3, 1, 2)),
    (MNC, "T1 S500 M3 F100|G16|G10 R5 A0|G12 A90", None, (LINE, 4, 1, 1)),
    # a cut with the spindle still
    (MNC, "T1|G1 X5 F100|X9", None, (SPINDLE, 2, 1, 1)),
    (G43, "T1 M6|G1 X5 F100", None, (SPINDLE, 2, 1, 1)),
    (JNC, "G94 F100|G0 X50 Z5|G1 Z-5", None, (SPINDLE, 3, 1, 1)),
    (TNC, klartext("L X+10 FMAX|L Z-5 F100"), None, (SPINDLE, 6, 1, 1)),
    # a rapid down into the blank, one across it, one back through what was not cut
    (MNC, "T1 S500 M3|G0 X50 Y30 Z5|G0 Z-4|G1 X60 F100", BLANK, (RAPID, 3, 1, 1)),
    (MNC, "T1 S500 M3|G0 X-20 Y30 Z-4|G0 X50|G1 Y40 F100", BLANK, (RAPID, 3, 1, 1)),
    (G43, "T1 M6|S500 M3|G0 X10 Y10 Z5|G1 Z-4 F100|X20|G0 X60 Y40|Z5|X10 Y50|Z-2", BLANK, (RAPID, 6, 1, 2)),
    (MNC, "T1 S500 M3|G0 X50 Y30 Z-4|G1 X60 F100", BLANK, (RAPID, 2, 1, 1)),  # wherever it came from, it ends there
    (TNC, klartext("L X+50 Y+30 Z+5 R0 FMAX M3|L Z-4 FMAX|L X+60 F100"), None, (RAPID, 6, 1, 1)),
    (JNC, "G94 F100|T1 S500 M3|G0 X30 Z5|G0 X15 Z-10|G1 Z-20", BAR, (RAPID, 4, 1, 1)),
    (JNC, "G94 F100|T1 S500 M3|G0 X18 Z5|G1 Z-20|G0 X10|G0 Z5", BAR, (RAPID, 5, 1, 1)),
    (NC, "S500|F20|X6000 ~|Z500 ~|X3600 ~|Z-2000|X2000 ~|X6000 ~", BAR, (RAPID, 7, 1, 1)),
    # everything above the blank
    (MNC, "T1 S500 M3|G0 X10 Y10 Z5|G1 Z4 F100|X50", BLANK, (AIR, 3, 1, 1)),
    (G43, "T1 M6|S500 M3|G0 X10 Y10 Z5|G1 Z0 F100|X50", BLANK, (AIR, 4, 1, 1)),
    (TNC, klartext("L X+10 Y+10 Z+50 R0 FMAX M3|L Z+4 F100|L X+60"), None, (AIR, 6, 1, 1)),
    (JNC, "G94 F100|T1 S500 M3|G0 X40 Z5|G1 X25|Z-20", BAR, (AIR, 4, 1, 1)),
    (NC, "S500|F20|X6000 ~|Z500 ~|X5000|Z-2000", BAR, (AIR, 5, 1, 1)),
    # compensation that nobody cancels
    (MNC, "T1 S500 M3|G0 Z5|G1 G41 X10 F100|Y20|M30", None, (SIDE, 2 + 1, 4, 1)),
    (G43, "T1 M6|S500 M3|G0 Z5|G1 G42 D1 X10 F100|Y20|M30", None, (SIDE, 4, 4, 1)),
    (TNC, klartext("L X+0 Y+0 Z+5 R0 FMAX M3|L Z-4 F100|L X+10 RL F100|L Y+20"), None, (SIDE, 7, 8, 1)),
    # a cycle that nobody calls
    (MNC, "T2 S500 M3|G0 X5 Y5 Z20|G302 Z0 Q2 H-10 D1|G0 X9|G302 Z0 Q2 H-5 D1 F100|G0 X20 M99", None, (CYCLE, 3, 1, 1)),
    (TNC, klartext(f"L X+9 R0 FMAX M3|{HOLE}|L X+20 R0 FMAX"), None, (CYCLE, 6, 1, 1)),
    # a tool that is put away unused
    (MNC, "T1 S500 M3|G0 Z5|T3|G1 X9 F100", None, (TOOL, 1, 1, 1)),
    (G43, "T1 M6|S500 M3|G0 Z5|T3 M6|G1 X9 F100", None, (TOOL, 1, 1, 1)),
    (TNC, klartext("L Z+50 R0 FMAX M3|TOOL CALL 3 Z S1000|L Z-3 F100"), None, (TOOL, 4, 1, 1)),
    (JNC, "G94 F100|T1 S500 M3|G0 X30 Z5|T2|G1 Z-4", None, (TOOL, 2, 1, 1)),
]


@pytest.mark.parametrize(("control", "text", "stock", "expected"), FAULTS)
def test_a_fault_of_a_learner_is_told_once_where_it_stands(control, text, stock, expected):
    found = run(text, control, stock)
    assert found.ok, found.alarms
    assert expected in told(found), found.alarms
    (alarm,) = (alarm for alarm in found.alarms if expected[0] in alarm.message)
    assert alarm.severity == "warning" and alarm.hint
    assert not told(run(text, control, stock, lint="off"))


CLEAN = [
    # the rapid stands where it was cut before: in the pocket, in the slot, above the blank, beside it, in the hole
    (MNC, "T1 S500 M3|G0 X10 Y10 Z5|G1 Z-4 F100|X50|Y40|X10|G0 X50|Z5", BLANK),
    (MNC, "T1 S500 M3|G0 X10 Y10 Z5|G1 Z-4 F100|X50|G0 X30|Z5|X50|Z-4|G1 Y20", BLANK),
    (MNC, "T1 S500 M3|G0 X-20 Y-10 Z-4|X120|G1 Y70 F100", BLANK),
    (MNC, "T1 S500 M3|G0 Z-4|G1 X60 F100", BLANK),
    (MNC, "T1 S500 M3|G0 X20 Y20 Z5|X80|Z0|G1 Z-2 F100", BLANK),
    (MNC, "T2 S500 M3|G0 X20 Y20 Z5|G83 X20 Y20 Z-15 R2 K4 F100|G80|G0 Z30", BLANK),
    # a drilled hole whose thread is milled: the rapid goes into the middle of the circle
    (MNC, "T3 S500 M3|G0 X50 Y30 Z5|Z-10|G1 X54 F100|G3 X54 Y30 Z-8 I-4|G1 X50|G0 Z5", BLANK),
    # nobody knows the tool T0, nor where a machine comes from
    (MNC, "S500 M3|G0 X50 Y30 Z5|G0 Z-4|G1 X60 F100", BLANK),
    (G43, "T1 M6|S500 M3|G0 X-20 Y-10|Z-4|G1 X50 F100", BLANK),
    (G43, "T1 M6|S500 M3|G0 X10 Y10 Z5|G1 Z-1 F100|G42 D1 X20|Y40|G40 X10|G0 Z5|M30", BLANK),
    (JNC, "G94 F100|T1 S500 M3|G0 X30 Z5|X18|G1 Z-20|X21|G0 Z5|X15|G1 Z-10|X19|G0 Z5", BAR),
    (NC, "S500|F20|X6000 ~|Z500 ~|X3600 ~|Z-2000|X4400|Z500 ~", BAR),
    (TNC, klartext(f"L X+9 R0 FMAX M3|{HOLE}|L X+20 R0 FMAX M99"), None),
    (TNC, klartext(f"L X+9 R0 FMAX M3|{HOLE}|L X+20 R0 FMAX M89|L X+30 R0 FMAX|{HOLE}|CYCL CALL"), None),
    (TNC, klartext("L X+0 Y-10 Z+5 R0 FMAX M3|L Z-4 F100|L Y+10 RL F100|L Y+20|L X-20 R0 FMAX"), None),
    (MNC, "T1 S500 M3|G0 Z5|G1 X9 F100|T3|G0 Z9", None),
]


@pytest.mark.parametrize(("control", "text", "stock"), CLEAN)
def test_what_is_right_is_not_remarked(control, text, stock):
    found = run(text, control, stock)
    assert found.ok and not told(found), found.alarms


@pytest.mark.parametrize("control", [MNC, G43, JNC, NC, TNC])
def test_a_move_without_any_feed_is_an_alarm_on_every_control(control):
    text = {
        MNC: "T1 S500 M3|G1 X9", G43: "T1 M6|S500 M3|G1 X9", JNC: "G94|S500 M3|G1 Z-9", NC: "S500|Z-900",
        TNC: klartext("L X+10 M3"),
    }[control]  # fmt: skip
    assert "no feed rate was programmed before this move" in run(text, control).alarms[0].message


@pytest.mark.parametrize("control", [MNC, G43, JNC, NC, TNC])
def test_every_control_has_the_setting(control):
    assert {setting.name: setting.default for setting in mnclab.controls[control].settings}["lint"] == "on"
    with pytest.raises(mnclab.Alarm, match="setting lint .* must be one of on, off, got 'of' "):
        run("", control, lint="of")


def test_both_tiers_remark_the_same_arcs():
    text = "S500 M3|F100|" + "|".join(f"G{1 + (k % 50 == 7)} X{k} Y{k % 7}" for k in range(200))
    assert [told(run(text, MNC, bulk=bulk)) for bulk in (True, False)] == [[(LINE, 10, 1, 4)]] * 2


def test_a_rapid_that_is_remarked_is_a_collision_of_the_part():
    """The part knows the true shape of what was cut: whatever is remarked here, it finds too."""
    rapids = [(control, text, stock) for control, text, stock, (what, *_) in FAULTS if what == RAPID]
    for control, text, stock in rapids:
        found = run(text, control, stock)
        lines = {place.line for alarm in found.alarms if alarm.message == RAPID for place in alarm.places}
        assert lines <= {each.line for each in found.collisions() if each.kind in ("rapid", "insert")}


def test_what_is_known_of_the_tool_counts():
    """A wide tool has cut more: beside the groove of the narrow one the rapid is in material, in that of the wide one not."""
    text = "T1 S500 M3|G0 X10 Y10 Z5|G1 Z-4 F100|X50|G0 X40 Y18|Z5"
    for radius, expected in ((5, [(RAPID, 5, 1, 1)]), (12, [])):
        tools = {1: Tool(radius=radius, kind="mill")}
        assert told(mnclab.run(text.replace("|", "\n") + "\n", MNC, Setup(tools=tools, stock=BLANK))) == expected


def test_a_long_program_is_not_judged_to_its_end():
    """Ten thousand rows are: what comes later is for `run.collisions()`."""
    cut = "".join(f"G1 X{20 + k % 3} Y20\n" for k in range(12_000))
    text = f"T1 S500 M3\nG0 X20 Y20 Z5\nG1 Z-4 F100\n{cut}G0 X80 Y50\nZ5\n"
    assert not told(mnclab.run(text, MNC, Setup(stock=BLANK)))
    assert told(mnclab.run(text.replace(cut, cut[:1100]), MNC, Setup(stock=BLANK)))


def test_the_end_of_the_program_in_a_subprogram():
    """A label of the TNC 620 ends with LBL 0: M30 there ends everything, and what stands below the call is not obeyed."""
    text = klartext("CALL LBL 1|L X+9 R0 FMAX|M30|LBL 1|L X+5 R0 FMAX M30|LBL 0", blank=False)
    (alarm,) = run(text, TNC).alarms
    assert (alarm.severity, alarm.span.line, alarm.span.column) == ("warning", 7, 15) and "in a subprogram" in alarm.message
    assert not run(text.replace("FMAX M30", "FMAX"), TNC).alarms


def test_a_true_tool_without_a_row_in_the_table():
    setup = {"true_tools": {1: Tool(radius=4.9), 77: Tool(radius=3)}}
    (alarm,) = mnclab.run("T1 S500 M3\nG1 X5 F100\n", MNC, Setup(**setup)).alarms
    assert alarm.severity == "warning" and "T77 as true tools" in alarm.message and "T1 " not in alarm.message


def test_help_names_the_code_that_was_asked_for():
    with pytest.raises(mnclab.Alarm) as raised:
        mnclab.help("G412")
    assert 'help("G412", "mnc")' in raised.value.hint and "G83" not in raised.value.hint


def test_a_run_of_letters_is_no_word():
    (alarm,) = run("SETVN|G0 X5", MNC).alarms
    assert (alarm.span.line, alarm.span.column) == (1, 1) and "SETVN is no word of this control" in alarm.hint


#: Programs that truly have the fault, and why.
TRUE = {
    "secondary_m91.h": (AIR, "the arc runs on the top of the blank, Z+0, to show where M91 leads"),
    "tnc407_slot.h": (CYCLE, "the cycle stands there to be read: the program moves beside the slot"),
}


@pytest.mark.parametrize("path", deep_but_one_in(4, [*SAMPLES, *OF_SHOPS]), ids=lambda path: "/".join(path.parts[-2:]))
def test_no_program_of_the_house_or_of_a_shop_is_blamed(path):
    found = mnclab.run(path, path.parent.name)
    expected = {TRUE[path.name][0]} if path.name in TRUE else set()
    assert {what for what, *_ in told(found) if what != SPINDLE or path in SAMPLES} == expected


RL = "BEGIN PGM A MM|TOOL CALL {} Z S100 F100|L X+0 Y+0 R0 FMAX M3|L X+10 RL|L Y+10|L X+0 R0|END PGM A MM"
G41 = "G17 G90 G54{} S800 M3|G41 G1 X10 F100|Y10|G40 X0"


@pytest.mark.parametrize(("control", "text", "line", "said"), [
    ("mnc", G41.format(""), 2, "T0"),
    ("mnc", G41.format(" T9"), 2, "T9"),
    ("mnc", G41.format(" T1"), None, ""),
    ("tnc-620", RL.format(9), 4, "T9"),
    ("tnc-620", RL.format(1), None, ""),
])  # fmt: skip
def test_a_compensation_of_no_radius(control, text, line, said):
    """The tool then cuts on the contour, its middle on the line that was to be its edge."""
    tools = {1: Tool(radius=2), 9: Tool()}
    found = mnclab.run(text.replace("|", "\n") + "\n", control, Setup(tools=tools))
    of_it = [(alarm.span.line, alarm.message) for alarm in found.alarms if "compensates nothing" in alarm.message]
    assert found.ok and of_it == (
        [(line, f"the radius compensation compensates nothing: the radius of {said} is 0")] if line else []
    )


def test_a_tool_that_waits_for_its_change():
    """T chooses a tool, and M6 puts it into the spindle."""
    text = "G21 G17 G90 G54\n{}\nS1000 M3\nG0 X-10 Y10 Z5\nG0 Z-4\nG1 X80 F300\nG0 Z20\nM30\n"
    setup = Setup(tools={1: Tool(diameter=10, number=1), 2: Tool(diameter=6, number=2)})
    ready = [(words, []) for words in ("T1 M6", "M6 T1", "", "T0", "T1 M6\nT2")]
    for words, says in (("T1", ["T1"]), ("T1\nT2", ["T2"]), *ready):
        alarms = mnclab.run(text.format(words), "g43", setup).alarms
        assert [alarm.message for alarm in alarms] == [
            f"the program works without a tool: {tool} is chosen, but not in the spindle" for tool in says
        ], words


@pytest.mark.parametrize("program, control, blank", [
    ("M3 S900 G97 G94 F80 T1\nG00 X17 Z1\nG01 X21 Z-4\nG00 X30\n", "jnc-t01", BAR),  # a chamfer, cut outwards
    ("G17 G90 G54 T1 M6 S900 M3\nG0 X-20 Y30 Z-5\nG1 X120 Z1 F100\n", "g43", BLANK),
])  # fmt: skip
def test_a_cut_that_rises_out_of_the_blank_is_in_it(program, control, blank):
    run = mnclab.run(program, control, mnclab.Setup(stock=blank, start=(60, 0, 20)))
    assert run.ok and not [alarm for alarm in run.alarms if AIR in alarm.message] and run.workpiece().removed > 1
