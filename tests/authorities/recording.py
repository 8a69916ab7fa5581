"""What the two generators share: asking LinuxCNC, turning its answer into our terms, writing the file.

Lengths inside the generators are whole **ticks** of 0.0001 mm, so that texts and positions are exact and long
chains of increments gather no rounding.
"""

import gzip
import json
import math
import os
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
DEBIAN_PYTHON = "/usr/bin/python3"
TICKS = 10_000  # ticks in one mm
AXES = {"XY": (0, 1, 2), "ZX": (2, 0, 1), "YZ": (1, 2, 0)}  # first axis, second axis, normal
KINDS = {"rapid": "rapid", "feed": "line", "arc": "arc"}  # LinuxCNC's word: ours


def mm(length):
    """A length in mm as ticks."""
    return round(length * TICKS)


def decimal(ticks):
    """The shortest spelling in mm: -12.5, 0.0003, 40."""
    whole, rest = divmod(abs(ticks), TICKS)
    fraction = f"{rest:04d}".rstrip("0")
    return ("-" if ticks < 0 else "") + str(whole) + ("." + fraction if fraction else "")


def version():
    """Name and version of the Debian package that answers."""
    query = ["dpkg-query", "--show", "--showformat=${Package} ${Version}", "linuxcnc-uspace"]
    return subprocess.run(query, check=True, capture_output=True, text=True).stdout


def ask(text):
    """LinuxCNC's answer to an RS-274 program, as linuxcnc_oracle.py prints it."""
    with tempfile.TemporaryDirectory() as home:  # some versions write into HOME
        program = Path(home, "program.ngc")
        program.write_text(text)
        command = [DEBIAN_PYTHON, str(HERE / "linuxcnc_oracle.py"), str(program)]
        done = subprocess.run(command, check=True, capture_output=True, text=True, env=os.environ | {"HOME": home})
    return json.loads(done.stdout)


def sweep(start, end, centre, turns, plane):
    """Signed angle of an arc in rad, right-handed about the positive normal of its plane."""
    first, second, _ = AXES[plane]
    angle = [math.atan2(p[second] - centre[second], p[first] - centre[first]) for p in (start, end)]
    turned = (angle[1] - angle[0] if turns > 0 else angle[0] - angle[1]) % math.tau
    if min(turned, math.tau - turned) < 1e-9:  # back at the start: LinuxCNC means a whole turn
        turned = math.tau
    turned += (abs(turns) - 1) * math.tau
    return math.copysign(turned, turns)


def turned(point, angle):
    """A point turned about the Z axis by an angle in rad."""
    (x, y, z), c, s = point, math.cos(angle), math.sin(angle)
    return [x * c - y * s, x * s + y * c, z]


def motion(answer, line_of):
    """The rows of LinuxCNC's answer in our terms; `line_of` leads from its lines to those of the MNC text.

    The centre of an arc is start + I J K, so along the normal of the plane it has the start's coordinate. Under a
    rotation the plane is turned with it.
    """
    rows, start = [], [0.0, 0.0, 0.0]
    for move in answer["motion"]:
        row = {"line": line_of[move["line"]], "kind": KINDS[move["kind"]], "to": move["to"]}
        if "feed" in move:
            row["feed"] = move["feed"]
        if row["kind"] == "arc":
            normal, angle = AXES[move["plane"]][2], move.get("rotation", 0)
            begin, end, centre = start, move["to"], list(move["centre"])
            if angle:
                begin, end, centre = (turned(point, -angle) for point in (begin, end, centre))
            centre[normal] = begin[normal]
            axis = [int(k == normal) for k in range(3)]
            row["centre"] = turned(centre, angle) if angle else centre
            row["axis"] = turned(axis, angle) if angle and normal != 2 else axis
            row["sweep"] = sweep(begin, end, centre, move["turns"], move["plane"])
        rows.append(row)
        start = move["to"]
    return rows


def save(name, seed, records):
    """Write a file of records beside this one, a record a line."""
    head = {"authority": version(), "seed": seed}
    lines = ",\n".join(json.dumps(record, separators=(",", ":")) for record in records)
    text = json.dumps(head)[:-1] + ', "records": [\n' + lines + "\n]}\n"
    file = HERE / name
    file.write_bytes(gzip.compress(text.encode(), mtime=0)) if file.suffix == ".gz" else file.write_text(text)
    print(f"{name}: {len(records)} records, {len(text)} bytes")
