"""Every parameter, mark and machine parameter changes what the source says it changes, and nothing else.

Each case: a cycle as the form begins it, one thing changed, and a number that follows from the change by hand. X of a
path is the radius.
"""

import math

import numpy as np
import pytest
from tools.running import run

import mnclab
from mnclab import Kind, Setup
from mnclab.machine import trial

CONTROL = mnclab.controls["nc-31"]
CASES = [(code, parameter) for code, cycle in CONTROL.cycles.items() for parameter in cycle.parameters()]


def beginning(code):
    values = {p.name: p.example for p in CONTROL.cycles[code].parameters() if p.example is not None}
    return values | ({"taper": 10} if code == "G31" else {})


def motion_of(code, values, **settings):
    found = run(trial.program(mnclab.controls["nc-31"], CONTROL.cycles[code], values), "nc-31", start=(30, 0, 20), **settings)
    return found.toolpath[2:].motion  # after the spindle and the move to the start


def geometry(path):
    return path.end.round(9).tolist()


def kinds(path):
    return path.kind.tolist(), path.label.tolist()


@pytest.mark.parametrize(("code", "parameter"), CASES, ids=lambda case: getattr(case, "name", case))
def test_a_parameter_acts(code, parameter):
    values = beginning(code)
    before = motion_of(code, values)
    other = {"feed": 1.5 * (parameter.example or 0), "depth_per_pass": 46, "taper": 40, "to_contour": 1}
    other |= {"z": -2250} if code == "G75" else {}  # half as far would leave no room for the pitch
    changed = other.get(parameter.name, 0 if parameter.mark else (parameter.example or 0) / 2)
    after = motion_of(code, values | {parameter.name: changed})
    if parameter.name == "feed":
        assert geometry(before) == geometry(after)
        own = np.isfinite(before.per_rev)
        clean_up = ["clean-up" in before.labels[k] for k in before.label]
        ratio = (after.per_rev / before.per_rev)[own]
        assert np.allclose(ratio, np.where(np.array(clean_up)[own], 1, 1.5))
    elif parameter.address == "~":
        assert geometry(before) == geometry(after) and kinds(before) != kinds(after)
    elif parameter.name == "zero_mark":
        assert geometry(before) == geometry(after)
        assert [any("synchronised" in path.labels[k] for k in path.label) for path in (before, after)] == [True, False]
    else:
        assert geometry(before) != geometry(after)


@pytest.mark.parametrize(("code", "parameter"), CASES, ids=lambda case: getattr(case, "name", case))
def test_left_out_it_is_its_default_or_missing(code, parameter):
    if code == "G31" and parameter.name.startswith(("thread", "depth")):
        return  # all P or none: some are in tests/refused/nc-31
    values = {name: value for name, value in beginning(code).items() if name != parameter.name}
    if parameter.address == "P":  # a P can only be left out if all after it are
        names = [p.name for p in CONTROL.cycles[code].parameters() if p.address == "P"]
        values = {n: v for n, v in values.items() if n not in names[names.index(parameter.name) :]}
    if not parameter.required:
        assert len(motion_of(code, values))
        if parameter.default is not None:
            assert geometry(motion_of(code, values)) == geometry(motion_of(code, values | {parameter.name: parameter.default}))
        return
    found = mnclab.run(trial.program(CONTROL, CONTROL.cycles[code], values), "nc-31")
    assert f"{code} {parameter.address} ({parameter.meaning}) is missing" in found.alarms[0].message
    assert found.alarms[0].span[:2] == (6, 1)


def test_x_and_z_are_ends():
    """G70 to X30 Z-20 with a bevel of 5 and 5 from X40 Z2: (15, -15), (17.5, -20), out to 20, back to Z2."""
    path = motion_of("G70", beginning("G70"))
    assert path.end[:, [0, 2]].tolist() == [[15, 2], [15, -15], [17.5, -20], [20, -20], [20, 2]]


def test_the_infeed_angle():
    """Parameter 6: each pass begins depth * tan(angle) nearer to the end; 30 degrees and 0.92 mm are 0.5312 mm."""
    path = motion_of("G31", beginning("G31"), parameter_6=30)
    begins = path.start[path.synchronous, 2]
    assert begins == pytest.approx([2 - d * math.tan(math.pi / 6) for d in (0.25, 0.5, 0.75, 0.92)], abs=1e-12)


def test_the_run_out():
    """Parameter 7 in tenths: 8 of a pitch of 1.5 are 1.2 mm before the end; then out to the start radius at the end."""
    path = motion_of("G31", beginning("G31") | {"taper": 0}, parameter_7=8)
    ends = path.end[path.synchronous][:, [0, 2]]
    assert ends[0] == pytest.approx([17.75, -28.8]) and ends[1] == pytest.approx([20, -30])


@pytest.mark.parametrize(("code", "axis", "wanted"), [("G73", 2, [2, -8 + 0.7, 2]), ("G72", 0, [20, 17.7, 20])])
def test_the_gap_of_a_drill(code, axis, wanted):
    """Parameter 8: back to 0.7 mm before the depth of the first peck: 10 mm from Z2, or 6 on the diameter from X40."""
    path = motion_of(code, beginning(code), parameter_8=70)
    rapids = path.end[path.kind == Kind.RAPID][:3, axis]
    assert rapids == pytest.approx(wanted)


@pytest.mark.parametrize(("code", "axis", "wanted"), [("G77", 2, [-3, -2.6, -8]), ("G78", 0, [18, 18.4, 16])])
def test_chips(code, axis, wanted):
    """Parameters 10 and 11: a rapid of 0.4 mm back after 5 mm (G77, from Z2), after 2 mm on the radius (G78, from X40)."""
    length = 500 if code == "G77" else 200
    path = motion_of(code, beginning(code), parameter_10=length, parameter_11=40)
    first = path[np.array(["pass 1 of" in path.labels[k] for k in path.label])]
    assert first.end[1:4, axis] == pytest.approx(wanted)
    assert first.kind[1:4].tolist() == [Kind.LINE, Kind.RAPID, Kind.LINE]


def test_p1_on_radius():
    """The setting doubles the stock of a pass of G77 and the peck of G72; G78 has its P1 along Z."""
    for code, twice in (("G77", True), ("G72", True), ("G78", False)):
        name = "peck" if code == "G72" else "stock_per_pass"
        values = beginning(code)
        on_radius = motion_of(code, values, p1_on_radius=True)
        same = motion_of(code, values | {name: values[name] * (2 if twice else 1)})
        assert geometry(on_radius) == geometry(same)


def test_the_bevel_of_g78():
    """Along Z as the table says: (X40, Z-5) to (X30, Z-1). Along X, the mirror of G77: to X34 at Z-5, then to (X30, Z2)."""
    along_z, along_x = (motion_of("G78", beginning("G78"), g78_bevel=way) for way in ("along_z", "along_x"))
    ends = [path.end[path.kind == Kind.LINE][:, [0, 2]].round(9).tolist() for path in (along_z, along_x)]
    assert ends[0][-2:] == [[15, -1], [15, 2]] and ends[1][-2:] == [[17, -5], [15, 2]]


def test_a_threading_move():
    """G32: the pitch counts along the longer travel: 15 mm in X (radius) against 4 in Z, 2 mm/rev there."""
    frames = ["S300", "F20", "X4000~*", "Z200~", "G32@*", "X1000*", "Z-200*", "F20000", "G32*", "Z@-1000"]
    found = mnclab.run("\n".join(frames) + "\n", "nc-31", Setup(start=(30, 0, 20)))
    assert not found.alarms
    taper, straight = found.toolpath.motion[1:]
    assert taper.end.tolist() == [5, 0, -2] and taper.synchronous and straight.synchronous
    assert taper.per_rev * 15 / math.hypot(15, 4) == pytest.approx(2)
    assert straight.end.tolist() == [5, 0, -12] and straight.per_rev == pytest.approx(0.2)
    assert [taper.label, straight.label] == ["G32 synchronised start", "G32"]


def test_tapping_turns_the_spindle_back():
    """G33 under M4: in at -, out at +, and - again; 1.25 mm a turn both ways."""
    frames = ["M4", "S300", "G33*", "Z-2000*", "F12500"]
    found = mnclab.run("\n".join(frames) + "\n", "nc-31", Setup(start=(0, 0, 5)))
    assert not found.alarms
    path = found.toolpath
    assert path.spindle[path.kind == Kind.SPINDLE].tolist() == [-300, 300, -300]
    cut = path[path.kind == Kind.LINE]
    assert cut.end[:, 2].tolist() == [-20, 5] and cut.per_rev.tolist() == [1.25, 1.25] and cut.synchronous.all()


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"parameter_6": 90}, "machine parameter 6 (infeed angle) to be less than 90 degrees, it is 90"),
        ({"parameter_6": 89}, "of 32 mm the infeed angle takes 52.707 mm and the run-out 0.000 mm"),
        ({"parameter_7": 214}, "of 32 mm the infeed angle takes 0.000 mm and the run-out 32.100 mm"),
    ],
)
def test_machine_parameters_that_leave_no_thread(settings, sentence):
    """0.92 tan 89 degrees is 52.707; 21.4 pitches of 1.5 mm are 32.1; the thread goes from Z2 to Z-30."""
    program = trial.program(CONTROL, CONTROL.cycles["G31"], beginning("G31"))
    found = mnclab.run(program, "nc-31", Setup(start=(30, 0, 20), settings=settings))
    assert sentence in found.alarms[0].message and found.alarms[0].span[:2] == (6, 1)
