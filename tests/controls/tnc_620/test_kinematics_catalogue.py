"""KinematicsOpt as the catalogue of the manual has it: its example programs, and every constructed number.

Numbers of the catalogue are rounded to six decimals; where it prints 0, less than 1e-9.
"""

import math

import numpy as np
import pytest
from controls.tnc_620.spheres import (
    BALL,
    CASES,
    LENGTH,
    SPHERE,
    case,
    cycle,
    definition,
    logged,
    measured,
    results,
    sphere_setup,
    stands,
)

import mnclab as mnc
from mnclab import Axis, Kind, Kinematics

NEAR = 1.5e-6
C_TABLE = Kinematics(table=(Axis("C"),))
C_TRUE = Kinematics(table=(Axis("C", centre=(0.02, -0.01, 0)),))
THREE = {"C": (90, 270, 0, 3)}
MACHINES = {
    "ABC": Kinematics(head=(Axis("B", centre=(0, 0, 180)),), table=(Axis("A", centre=(0, 0, 20)), Axis("C"))),
    "AC": Kinematics(head=(Axis("C", centre=(0, 0, 150)), Axis("A", centre=(0, 0, 150)))),
}


def near(found, expected):
    assert np.allclose(found, expected, rtol=0, atol=NEAR), (found, expected)


# The programs of the manual.

PRINTED = [each for each in CASES if each["program"] and "parameters" in each["check"]]


def test_the_programs_of_the_manual_are_here():
    assert len(PRINTED) == 11


@pytest.mark.parametrize("printed", PRINTED, ids=lambda each: each["title"][:40])
def test_a_program_of_the_manual(printed):
    check, code = printed["check"], printed["code"]
    axes = "".join(check.get("axes_present", "AC"))
    records = "".join(f'["{n}"]\ntitle = ""\nhead = [{{ name = "C" }}, {{ name = "A" }}]\n' for n in (948, 949, 950))
    text, files = printed["program"], {"DATA450.KD": records} if code == "TCH PROBE 450" else {}
    presets = {0: SPHERE, 1: SPHERE}
    run = measured(text, sphere_setup(MACHINES[axes], files=files, presets=presets))
    if "motion" in check:
        name = f"{check['parameters']['Q409']}"
        kept = name in run.files.get("DATA450.KD", "") if check["parameters"]["Q410"] in (0, 3) else None
        assert (run.variables["Q410"], kept) == (check["parameters"]["Q410"], {0: True, 3: False}.get(run.variables["Q410"]))
        assert not run.toolpath.is_motion.any() and not run.touches
        return
    assert all(run.variables[name] == value for name, value in check["parameters"].items())
    found, touches = stands(run)
    assert touches == check["touch_points_per_measurement"]
    before = 2 if check["parameters"].get("Q431") in (1, 3) else 0
    after = 1 if check["parameters"].get("Q431") in (2, 3) else 0
    assert before + after == check["preset_measurements"]
    assert len(found) == check["sphere_measurements"] + check["preset_measurements"]
    p, twice = check["parameters"], 2 if check["parameters"]["Q432"] else 1
    incidence = [p["Q413"], p["Q417"], p["Q421"]]
    wanted = []
    for k, axis in enumerate("ABC"):
        if check["positions"][axis]:
            for at in (0, *[each for each in check["positions"][axis] for _ in range(twice)]):
                place = [incidence[n] if "ABC"[n] in axes else 0 for n in range(3)]
                place[k] = at
                wanted.append(tuple(map(float, place)))
    assert found[before : len(found) - after] == wanted
    for k, axis in enumerate("ABC"):
        there = bool(check["positions"][axis])
        assert (run.variables[f"Q{141 + k}"] == -1) == (not there)
        assert (run.variables[f"Q{144 + k}"] == -1) == (not there or p.get("Q406") == 0)
    assert {name for name in run.files if name.startswith("TCHPR45")} >= {f"TCHPR{code.split()[-1]}.TXT"} or "Opt" in code
    preset = run.tables.presets[1 if "247" in text else 0]
    near(preset[:3], SPHERE)


# Limits of the machine parameters.

@pytest.mark.parametrize("row", case("limits")["check"]["max_modification_0_05"], ids=lambda row: str(row["change"]))
def test_a_great_change_is_to_be_confirmed(row):
    change = row["change"]
    axis, positions = ("A", {"A": (-90, 90, 0, 3)}) if change[2] else ("C", THREE)
    believed, true = Kinematics(table=(Axis(axis),)), Kinematics(table=(Axis(axis, centre=change),))
    run = measured(cycle(451, positions), sphere_setup(believed, true))
    assert any("NC start confirms it" in alarm.hint for alarm in run.alarms) == row["warning"]
    assert bool((run.toolpath.kind == Kind.STOP).sum() > (abs(np.array(change)).max() > 0)) == row["warning"]
    near(run.tables.kinematics.axis(axis).centre, change)


@pytest.mark.parametrize("row", case("limits")["check"]["max_dev_cal_ball_0_02"], ids=lambda row: str(row["measured_radius"]))
def test_the_radius_of_the_sphere_is_watched(row):
    setup = sphere_setup(C_TABLE, radius=row["measured_radius"])
    run = measured(cycle(451, THREE, Q407=row["Q407"]), setup, ok=not row["error"])
    if row["error"]:
        assert f"and {row['measured_radius']:.4f} was measured: it may be off by 0.02" in run.alarms[0].message
        assert (run.alarms[0].span.line, run.alarms[0].span.column) == (2, 1)


def test_a_wrong_sphere():
    check = case("wrong sphere radius")["check"]
    for limit, error in ((0.02, check["error_at_0_02"]), (0.05, check["error_at_0_05"])):
        settings = {"max_dev_cal_ball": limit}
        run = measured(cycle(451, THREE), sphere_setup(C_TABLE, radius=check["measured_radius"], settings=settings), ok=not error)
        assert len(run.touches) == (5 if error else 20)


# Positions.

PLACES = [each for each in CASES if "measured" in each["check"] and "start" in each["check"]]


@pytest.mark.parametrize("place", PLACES, ids=lambda each: each["title"][:40])
def test_measuring_positions(place):
    check = place["check"]
    positions = {"C": (check["start"], check["end"], 0, check["count"])}
    hirth = check.get("hirth_grid", 0)
    words = {"Q408": 100} if hirth else {}
    run = measured(cycle(451, positions, **words), sphere_setup(C_TABLE, settings={"hirth_c": hirth}))
    assert [each[2] for each in stands(run)[0]] == [0, *map(float, check["measured"])]


# Backlash.

def test_backlash_of_a_table():
    check = case("table axis with 0.010")["check"]
    at = (check["radius"], 0, 50)
    true = Kinematics(table=(Axis("C", backlash=check["backlash_machine"]),))
    run = measured(cycle(451, THREE, Q432=check["Q432"]), sphere_setup(C_TABLE, true, at=at))
    assert float(logged(run, "Averaged backlash")) == pytest.approx(check["averaged_backlash"], abs=NEAR)
    path = run.toolpath
    ends = [path.labels[label].rpartition(" ")[2] for label in path.label if " C to " in path.labels[label]]
    order = [float(angle) for k, angle in enumerate(ends) if k == 0 or angle != ends[k - 1]]
    assert order[:4] == [at for arrival in check["arrivals_at_90"] for at in arrival]
    centres = [mnc.probing.sphere([each.programmed for each in run.touches[k : k + 5]]) for k in range(5, 35, 5)]
    places = np.array([(each.x, each.y, each.z) for each in centres])
    near(np.linalg.norm(places[::2] - places[1::2], axis=1), check["chord"])


@pytest.mark.parametrize("row", case("no backlash calculated")["check"]["rows"], ids=str)
def test_when_backlash_is_calculated(row):
    hirth, strobe = row.get("hirth", False), row.get("mStrobeRotAxPos", -1)
    true = Kinematics(table=(Axis("C", backlash=0.01),))
    settings = {"hirth_c": 1 if hirth else 0, "m_strobe_rot_ax_pos": strobe}
    setup = sphere_setup(C_TABLE, true, at=(row["radius"], 0, 50), settings=settings)
    run = measured(cycle(451, THREE, Q432=row["Q432"], Q408=100), setup)
    assert (logged(run, "Averaged backlash") != "not measured") == (row["result"] == "calculated")


# One measurement of the sphere.

@pytest.mark.parametrize("title", ["four equator points", "three equator points"])
def test_touches_of_a_sphere(title):
    check = case(title)["check"]
    at = tuple(np.add(SPHERE, check["center"]))
    run = measured(cycle(451, Q423=len(check["contacts"]) - 1, Q380=check["Q380"]), sphere_setup(C_TABLE, at=at, preset=SPHERE))
    near([each.programmed for each in run.touches], check["contacts"])
    starts = np.array([each.start for each in run.touches]) - SPHERE
    near(np.linalg.norm(starts, axis=1), check["Q407"] + check["tip_radius"] + check["set_up"] if "set_up" in check else 16.5)
    angles = check.get("angles", [0, 90, 180, 270])
    near(np.degrees(np.arctan2(starts[1:, 1], starts[1:, 0])) % 360, angles)
    near(logged_radius(run), check["measured_radius"])


def logged_radius(run):
    points = np.array([each.centre for each in run.touches])
    return mnc.probing.sphere(points).radius - BALL


# Whole cycles.

def test_a_table_is_optimized():
    example = case("C table optimized")
    check = example["check"]
    run = measured(example["program"], sphere_setup(C_TABLE, C_TRUE))
    near(results(run), [check[f"Q{n}"] for n in range(141, 150)])
    assert abs(run.variables["Q146"]) < 1e-9
    near(run.tables.kinematics.axis("C").centre, check["new_axis_position"])
    assert len(run.touches) == check["touch_points"] and len(stands(run)[0]) == check["sphere_measurements"]
    again = example["program"] + "\n" + example["program"].partition("\n")[2].replace("Q406=1", "Q406=0")
    assert abs(measured(again, sphere_setup(C_TABLE, C_TRUE)).variables["Q143"]) < 1e-9
    for limit, warned in ((0.021, False), (0.019, True)):  # from 0.02 on
        setup = sphere_setup(C_TABLE, C_TRUE, settings={"max_modification": limit})
        assert bool(measured(example["program"], setup).alarms) == warned


def test_a_table_is_checked():
    check = case("same machine, check mode")["check"]
    run = measured(cycle(451, THREE, Q406=0, Q408=100), sphere_setup(C_TABLE, C_TRUE))
    names = ("Q143", "Q146", "Q147", "Q148", "Q149")
    near([run.variables[name] for name in names], [check[name] for name in names])
    near(run.tables.kinematics.axis("C").centre, check["axis_position_after"])


def test_the_moves_of_a_position():
    """From C90 to C180, the sphere on the axis of C; places are those of the ball's middle in the sphere's."""
    wanted = [each.partition(" (")[0] for each in case("moves for one measuring position")["check"]["moves"]]
    at = (0.0, 0.0, 50.0)
    run = measured(cycle(451, {"C": (90, 180, 0, 2)}, Q408=100), sphere_setup(C_TABLE, at=at))
    path, axes = run.toolpath, run.axes()
    places = np.column_stack([axes.X, axes.Y, axes.Z - LENGTH + BALL]) - at
    last = max(k for k in range(len(path)) if axes.C[k] == 90)
    first = next(k for k in range(last, 0, -1) if path.labels[path.label[k]].endswith("to the retraction height"))
    told, turned = [], 0.0
    for k in range(first, len(path)):
        row, here, before = path[k], places[k].round(9) + 0.0, places[k - 1].round(9) + 0.0
        feed = "FMAX" if row.feed == 2000 else f"F{row.feed:g}"
        moved = " ".join(f"{name}{here[n]:g}" for n, name in enumerate("XYZ") if here[n] != before[n])
        if axes.C[k] != axes.C[k - 1]:
            turned += path.time[k]
            if axes.C[k] == 180:
                assert turned == pytest.approx(60 * 90 / 750)  # at Q253
                told.append("C180 F750")
        elif row.kind == Kind.PROBE:
            axis = int(np.argmax(np.abs(here - before)))
            sign = "-" if here[axis] < before[axis] else "+"
            told.append(f"probe {'XYZ'[axis]}{sign} {feed}, contact at {moved}")
        elif row.kind == Kind.ARC:
            x, y = here[:2]
            told.append(f"arc X{x:g} Y{y:g} {feed}")
            assert math.hypot(x, y) == pytest.approx(16.5)
        else:
            told.append(f"{moved} {feed}")
    # the list names coordinates also where they stay, and what is not moved is no row: the sphere lies on the axis of C
    here, rows = {"X": 0.0, "Y": 0.0, "Z": 100.0, "C": 90.0}, []
    for each in wanted:
        words = [word for word in each.split() if word[0] in here and word[1:].lstrip("-").replace(".", "").isdigit()]
        to = {word[0]: float(word[1:]) for word in words}
        if each.startswith("arc"):
            rows.append(f"arc X{to['X']:g} Y{to['Y']:g} FMAX")
        elif each.startswith("probe"):
            rows.append(each)
        elif changed := {axis: value for axis, value in to.items() if value != here[axis] or axis == "Z" and not rows}:
            rows.append(" ".join([*(f"{axis}{value:g}" for axis, value in changed.items()), each.split()[-1]]))
        here |= to
    assert told == rows


def test_drift_without_rotary_axes():
    """Of a machine that has some, of which none is measured."""
    check = case("drift of a machine without rotary axes")["check"]
    shift = tuple(np.negative(check["measured_center"]))
    setup = sphere_setup(C_TABLE, Kinematics(table=C_TABLE.table, shift=shift))
    run = measured(cycle(452), setup)
    near(results(run), [check[f"Q{n}"] for n in range(141, 150)])
    assert len(stands(run)[0]) == check["sphere_measurements"]
    near(run.tables.kinematics.shift, np.negative(check["compensation"]))
    assert run.tables.presets[0][:3] == SPHERE  # the table stays
    again = measured(cycle(452) + cycle(452), setup)
    near(results(again)[6:], check["center_after"])
    x, y, z = check["point_before"]
    before = f"L X{x} Y{y} Z{z} R0 FMAX\n"
    there = measured(f"{cycle(452)}{before}", setup)  # the same place of the program is elsewhere on the machine now
    here = measured(f"{before}", setup)
    way = [there.axes()[axis][-1] - here.axes()[axis][-1] for axis in "XYZ"]
    near(np.subtract(check["point_before"], way), check["point_after"])


def test_drift_of_a_table():
    check = case("drift with C table")["check"]
    true = Kinematics(table=C_TRUE.table, shift=tuple(np.negative(check["compensation"])))
    run = measured(cycle(452, THREE), sphere_setup(C_TABLE, true))
    names = ("Q143", "Q146", "Q147", "Q148", "Q149")
    near([run.variables[name] for name in names], [check[name] for name in names])
    near(run.tables.kinematics.axis("C").centre, check["new_axis_position"])
    near(run.tables.kinematics.shift, np.negative(check["compensation"]))


# Saved kinematics.

def record(name, z, x=0, y=0):
    return f'["{name}"]\ntable = [{{ name = "C", centre = [{x}, {y}, {z}] }}]\n'


def head(z, x=0, y=0):
    return Kinematics(table=(Axis("C", centre=(x, y, z)),))


@pytest.mark.parametrize("row", case("wildcards")["check"]["rows"], ids=lambda row: row["pattern"])
def test_wildcards(row):
    records = case("wildcards")["check"]["records"]
    files = {"DATA450.KD": "".join(record(name, z) for name, z in records.items())}
    for mode in (1, 3):
        text = definition(450, Q410=mode, QS409=f'"{row["pattern"]}"')
        run = measured(text, sphere_setup(head(0), files=files), ok=bool(row["matches"]))
        if not row["matches"]:
            assert run.alarms[0].message.startswith(f"TCH PROBE 450 Q409 (memory designation) {row['pattern']} matches no record")
            assert run.alarms[0].span[:2] == (4, 1)
        elif mode == 1:
            near(run.tables.kinematics.axis("C").centre[2], row["mode_1_z"])
        else:
            left = run.files["DATA450.KD"].count("[\"") if "DATA450.KD" in run.files else 0
            assert left == row["mode_3_left"]
            assert all(f"  {name}: " in run.files["TCHPR450.TXT"] for name in row["matches"])


def test_only_differences_are_restored():
    check = case("restore writes differences only")["check"]
    files = {"DATA450.KD": record("5", **check["saved"])}
    run = measured(definition(450, Q410=1, Q409=5), sphere_setup(head(**check["present"]), files=files))
    saved, present = check["saved"], check["present"]
    centre = run.tables.kinematics.axis("C").centre
    assert dict(zip("xyz", centre, strict=True)) == saved
    assert {axis: saved[axis] for axis in "xyz" if saved[axis] != present[axis]} == check["written"]
    log = run.files["TCHPR450.TXT"]
    before, _, after = log.partition("After restoring:")
    assert "centre 0.000000 0.020000 350.000000" in before and "centre 0.000000 0.012000 350.000000" in after


@pytest.mark.parametrize("row", case("file states")["check"]["rows"], ids=lambda row: row["file"])
def test_states_of_the_table(row):
    rows = {"missing": None, "exists, no row": 0, "exists, 3 rows": 3}.get(row["file"], 16)
    files = {} if rows is None else {"DATA450.KD": "".join(record(n, 0) for n in range(100, 100 + rows))}
    run = measured(definition(450, Q410=0, Q409=5), sphere_setup(head(0), files=files), ok="error" not in row["result"])
    if run.ok:
        assert run.files["DATA450.KD"].count('["') == (rows or 0) + 1
    else:
        words = "it has no row: delete it" if rows == 0 else "would be record 17: there is room for 16"
        assert words in run.alarms[0].message


def test_at_the_retraction_height_the_linear_axes_stand_while_a_rotary_axis_turns():
    """Q408 above 0: the spindle axis goes up first, and the rotary axis turns alone; with 0 the probe goes round the sphere."""
    for height, alone in ((100, True), (0, False)):
        run = measured(cycle(451, THREE, Q406=0, Q408=height), sphere_setup(C_TABLE, C_TRUE))
        axes = np.asarray(run.axes())
        turning = np.flatnonzero(np.abs(np.diff(axes[:, 3:], axis=0)).max(axis=1) > 1e-9)
        assert len(turning) and bool(np.abs(np.diff(axes[:, :3], axis=0)[turning]).max() < 1e-9) is alone
