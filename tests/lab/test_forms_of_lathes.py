"""What a form shows of a cycle of turning: with a tool that suits the cycle, where it cuts, and without a collision."""

import pytest

import mnclab
from mnclab import Kind, Setup
from mnclab.lab.forms.example import Example, near
from mnclab.machine import trial
from mnclab.runs.material import cutting_of

#: The tool of each cycle, by its title in the catalogue; of a hole from the side there is no body of revolution.
KINDS = {
    "jnc-t01": {"G73": "drill", "G74": "face grooving", "G75": "grooving", "G77": "turning", "G78": "turning"},
    "nc-31": {
        "G70": "turning", "G71": "turning", "G77": "turning", "G78": "turning", "G72": "", "G73": "drill",
        "G74": "face grooving", "G75": "grooving", "G31": "thread", "G33": "tap",
    },
}  # fmt: skip
BARS = {"jnc-t01": 38, "nc-31": 19}  # just within the start points of the cycles, X40 and X4000 (a diameter)
TURNED_TO = {("nc-31", "G31"): 18}  # the crests of its thread
CORE_HOLES = {("nc-31", "G33"): 10.2 / 2}  # for the tap M12 (ISO 2306), which needs a hole
CASES = [(name, code) for name, kinds in KINDS.items() for code in kinds]
ON_THE_AXIS = [("jnc-t01", "G73"), ("nc-31", "G73"), ("nc-31", "G33")]


def shown(name, code):
    """What a form runs at first, in a bar."""
    control = mnclab.controls[name]
    cycle = control.cycles[code]
    values = {p.name: trial.first_value(p) for p in cycle.parameters() if p.required or trial.written_first(p)}
    text = trial.program(control, cycle, values)
    return mnclab.run(text, name, Setup(stock=bar(name, code)))


def bar(name, code):
    return mnclab.blank.cylinder(TURNED_TO.get((name, code), BARS[name]), -120, 0, bore=CORE_HOLES.get((name, code), 0.0))


def test_every_cycle_is_here():
    assert KINDS.keys() == {name for name in mnclab.controls if mnclab.controls[name].lathe}
    for name, kinds in KINDS.items():
        assert kinds.keys() == mnclab.controls[name].cycles.keys()


@pytest.mark.parametrize(("name", "code"), CASES)
def test_the_tool_suits_the_cycle(name, code):
    run = shown(name, code)
    path, cutting = run.toolpath, cutting_of(run)
    rows = [row for row, move in enumerate(path) if move.kind in (Kind.LINE, Kind.ARC)]
    assert rows and {cutting.tool(row).kind for row in rows} == {KINDS[name][code]}
    assert run.alarms == () and run.collisions() == ()
    assert code == "G72" or run.workpiece().removed > 0


@pytest.mark.parametrize(("name", "code"), ON_THE_AXIS)
def test_a_hole_in_the_face_stands_on_the_axis(name, code):
    path = shown(name, code).toolpath
    cuts = path.kind == Kind.LINE
    assert cuts.any() and (path.end[cuts, 0] == 0).all() and (path.start[cuts, 0] == 0).all()


def test_the_tap_of_a_form_has_the_pitch_of_its_thread():
    """M12 has a pitch of 1.75 mm (ISO 261)."""
    run = shown("nc-31", "G33")
    locked = run.toolpath.synchronous
    tap = next(tool for tool in cutting_of(run).tools if tool.kind == "tap")
    assert tap.name == "tap M12" and set(run.toolpath.per_rev[locked].tolist()) == {1.75} == {tap.pitch}


@pytest.mark.parametrize(
    ("name", "code", "field", "said"),
    [
        ("jnc-t01", "G75", "bottom", "X 25 mm radius"),
        ("jnc-t01", "G75", "last_z", "Z \N{MINUS SIGN}15 mm"),
        ("nc-31", "G75", "x", "X 30 mm ⌀"),
    ],
)
def test_a_dimension_across_says_where_it_is_a_radius(name, code, field, said):
    """The axis of the picture counts diameters."""
    live = mnclab.form(code, name)
    live.light(field)
    assert f"<title>{said}</title>" in live.lit.value


@pytest.mark.parametrize("code", ["G72", "G73", "G75"])
def test_no_end_is_marked_where_the_way_is_cut_off(code):
    """G73 leaves for X60 (diameter), far beside its hole: it goes out through the border, the drill stands before it."""
    live = mnclab.form(code, "nc-31")
    ends = [place for line in live.figure.axes[0].lines if line.get_label() == "end" for place in line.get_xydata().tolist()]
    assert ends == ([] if code == "G73" else [live.run.toolpath.end[-1, [2, 0]].tolist()])


@pytest.mark.parametrize(("name", "code"), CASES)
def test_the_picture_of_a_form_is_filled_by_its_bar_which_every_plunge_meets(name, code):
    live = mnclab.form(code, name)
    low, high = live.figure.axes[0].get_xlim()
    made = Example(mnclab.controls[name], mnclab.controls[name].cycles[code])
    path = near(live.run.toolpath[made.rows(live.run.toolpath)])
    (_, _, begin), (radius, _, end) = made.blank(path, {}).bounds
    assert end - begin > 0.6 * (high - low)
    cuts = path[path.kind == Kind.LINE]
    if code == "G75":
        assert (cuts.end[:, 2] < end).all() and cuts.start[:, 0].max() == pytest.approx(radius)
    if code == "G74":
        assert cuts.start[:, 0].max() < radius
