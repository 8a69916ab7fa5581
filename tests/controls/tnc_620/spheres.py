"""What tests of KinematicsOpt on the TNC 620 share: a machine with a sphere on its table, and the programs of its cycles."""

import json
import math
from pathlib import Path

import mnclab as mnc

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-kinematics.json"
CASES = json.loads(FILE.read_text(encoding="utf-8"))
TOOL, LENGTH, BALL, RADIUS = 5, 120.0, 2.0, 12.5
SPHERE = (150.0, 0.0, 50.0)
PRESET = 0


def case(title):
    """An example of the catalogue by how its title begins."""
    return next(each for each in CASES if each["title"].startswith(title))


def sphere_setup(kinematics, true=None, at=SPHERE, radius=RADIUS, preset=None, above=16.5, **more):
    """The probe above a sphere, whose middle is the preset; `above`: the middle of its ball over that of the sphere."""
    x, y, z = preset or at
    return mnc.Setup(**{
        "kinematics": kinematics, "true_kinematics": true, "part": mnc.part.ball(at, radius), "presets": {PRESET: (x, y, z)},
        "start": (at[0], at[1], at[2] + above - BALL + LENGTH),
        "tools": {TOOL: mnc.Tool(name="TCH PROBE", kind="probe", length=LENGTH, radius=BALL)},
        "probe": mnc.Probe(clearance=2, reach=10, feed=300, rapid=2000),
    } | more)  # fmt: skip


def cycle(code, positions=(), **words):
    """A program of 451 or 452: `positions` by axis are start, end, angle of incidence, and number."""
    found = dict(positions)
    values = {"Q406": 1} if code == 451 else {}
    values |= {"Q407": RADIUS, "Q320": 0, "Q408": 0, "Q253": 750, "Q380": 0}
    for k, axis in enumerate("ABC"):
        values |= {f"Q{411 + 4 * k + n}": value for n, value in enumerate(found.get(axis, (-90, 90, 0, 0)))}
    values |= {"Q423": 4, **({"Q431": 0} if code == 451 else {}), "Q432": 0}
    assert words.keys() <= values.keys()
    return definition(code, **(values | words))


def definition(code, **values):
    return f"TCH PROBE {code} X\n" + "".join(f"{name}={value}\n" for name, value in values.items())


def measured(text, setup, ok=True):
    """Run a text with the probe in the spindle."""
    call = "" if "TOOL CALL" in text else f"TOOL CALL {TOOL} Z\n"
    run = mnc.run(call + text, "tnc-620", setup)
    assert run.ok == ok, run.alarms
    return run


def results(run):
    """Q141 to Q149."""
    return [run.variables[f"Q{n}"] for n in range(141, 150)]


def stands(run):
    """A, B, C, degrees, at each touch of a pole, and how many touches there are at one measurement."""
    path = run.toolpath
    poles = [k for k in range(len(path)) if path.labels[path.label[k]].endswith("touch the pole")]
    count = len(run.touches) // len(poles)
    assert len(run.touches) == count * len(poles)
    return [tuple(round(math.degrees(angle), 9) for angle in path.rotary[k]) for k in poles], count


def logged(run, what, file="TCHPR451.TXT"):
    """What a line of the log says."""
    return next(line for line in run.files[file].splitlines() if line.strip().startswith(f"{what}:")).partition(": ")[2]
