"""What tests of presets on the TNC 620 share: the examples of the manual, the parts that they measure, the probe.

The numbers are in authorities/catalogue/tnc620-probing-presets.json; the parts are those of its `expected`, their surfaces at Z 0
where it names none.
"""

import json
import re
from pathlib import Path

import mnclab as mnc
from mnclab.workpiece.part import box, cylinder, hole, plane, pocket, slot

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-probing-presets.json"
CASES = json.loads(FILE.read_text(encoding="utf-8"))
PRESET = (100, 200, -300)
BALL = 2


def block(top):
    return box((-60, -60, -30), (220, 220, top))


def holes(top, diameter, centres):
    part = block(top)
    for x, y in centres:
        part = part - hole((x, y, top), diameter, 20)
    return part


STUD = box((50.12 - 30.02, 49.91 - 10.01, -30), (50.12 + 30.02, 49.91 + 10.01, 0))
PARTS = {
    "TCH PROBE 408": lambda check: block(0.03) - slot((50.12, -20, 0.03), (50.12, 120, 0.03), 25.06, 20),
    "TCH PROBE 409": lambda check: box((50.12 - 12.53, -20, -30), (50.12 + 12.53, 120, 0)),
    "TCH PROBE 410": lambda check: block(0.03) - pocket((50.12, 49.91, 0.03), 60.04, 20.02, 20),
    "TCH PROBE 411": lambda check: STUD,
    "TCH PROBE 412": lambda check: block(0) - hole((50.08, 49.93, 0), 75.05, 20),
    "TCH PROBE 413": lambda check: cylinder((50.08, 49.93, -30), (50.08, 49.93, 0.03), 74.96 / 2),
    "TCH PROBE 414": lambda check: box((-104.8, 6.8, -30), (95.2, 206.8, 0.03)).turned(1.5, (95.2, 6.8)),
    "TCH PROBE 415": lambda check: block(0) - box((36.7, 7.3, -20), (236.7, 207.3, 20)).turned(1.5, (36.7, 7.3)),
    "TCH PROBE 416": lambda check: holes(0.03, 12.02, check["holes"]),
    "TCH PROBE 417": lambda check: plane((0, 0, 25.07), (0, 0, 1)),
    "TCH PROBE 418": lambda check: holes(0.03, 10.03, check["holes"]),
    "TCH PROBE 419": lambda check: box((25.06, -50, -30), (90, 90, 40)),
    "example 15.14": lambda check: cylinder((25.03, 24.98, -30), (25.03, 24.98, 25.04), 15.01),
    "example 15.15": lambda check: holes(25.03, 8.02, check["hole_centers_measured"]),
}
#: Examples that are another one with other values.
VARIED = {
    "narrow slot (arithmetic): Q311=7, other data as above": {"Q311": 7},
    "three points (arithmetic): Q423=3, Q247=+120": {"Q423": 3, "Q247": 120},
    "Q272=3, Q267=-1 (arithmetic), other data as above": {"Q272": 3, "Q267": -1},
}


def example(case, **values):
    """The text of an example, with other values of parameters."""
    text = case["program"] or next(each["program"] for each in CASES if each["code"] == case["code"])
    for name, value in (VARIED.get(case["title"], {}) | values).items():
        text = re.sub(rf"(?m)^{name}=\S+", f"{name}={value:+g}", text)
    return text


def part_of(case):
    if case["title"].startswith("narrow"):
        return block(0) - slot((50.12, -20, 0), (50.12, 120, 0), 7.06, 20)
    if case["title"].startswith("Q272=3"):
        return plane((0, 0, 25.07), (0, 0, 1))
    return PARTS[case["code"]](case["check"])


def probing(text, part, active=1, **setup):
    """Run a text; the part is in coordinates of the preset."""
    begin = "" if "TOOL CALL" in text else "TOOL CALL 69 Z\n"
    lines = re.sub(r"(?m)^(1 TOOL CALL 69 Z)$", r"\1\nL Z+100 R0 FMAX", begin + text)
    lines = lines if begin == "" else lines.replace("TOOL CALL 69 Z\n", "TOOL CALL 69 Z\nL Z+100 R0 FMAX\n", 1)
    given = {
        "tools": {69: mnc.Tool(radius=BALL, kind="probe")}, "presets": {active: PRESET}, "settings": {"preset": active},
        "part": part.shifted(*PRESET), "probe": mnc.Probe(clearance=2, reach=10),
        "files": {"35K47.H": "BEGIN PGM 35K47 MM\nL X+0 Y+0 FMAX\nEND PGM 35K47 MM\n",
                  "35KLZ.H": "BEGIN PGM 35KLZ MM\nL X+0 Y+0 FMAX\nEND PGM 35KLZ MM\n"},
    }  # fmt: skip
    return mnc.run(lines, "tnc-620", mnc.Setup(**(given | setup)))
