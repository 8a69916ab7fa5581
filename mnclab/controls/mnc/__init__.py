"""The MNC milling control (Mechatronics, 2015): the namesake.

``language`` holds motion, offsets and words, ``polar`` polar motion, ``transforms`` scaling, mirror image, rotation and
datums, ``compensation`` the radius functions, ``drilling`` the cycles of chapter 9. Still to come are the other cycles and
probing; their codes are refused by name.
"""

from __future__ import annotations

import re

from mnclab.controls.mnc import compensation, drilling, language, polar, transforms
from mnclab.controls.word_address.reader import reader
from mnclab.machine.bulk import PlainWords
from mnclab.machine.control import Control
from mnclab.machine.setup import Setting
from mnclab.path.compensation import Compensation
from mnclab.path.limits import RAPIDS

#: Order inside a block (adopted reading MNC-BLOCK-ORDER).
PHASES = (
    *("plane", "feed", "spindle", "tool", "corrector", "auxiliary", "frames", "local", "compensation", "dwell"),
    *("motion", "call", "end"),
)

SETTINGS = (
    Setting("block_skip", False, "operator mode: blocks with / are passed over", "1.5"),
    Setting("arc_tolerance", 0.01, "mm between the radii at start and end of an arc", "MNC-ARC-TOL"),
    Setting("peck_clearance", 1.0, "mm above the last depth to which G83 returns at rapid", "MNC-G83-CLEARANCE"),
    Setting("rapid_motion", "axes", "how a rapid goes: axis by axis, or along the line", "3.1", tuple(RAPIDS)),
    Setting("bulk", True, "obey long runs of plain blocks at once", ""),
)

_LATER = "it is part of this control but not built yet"
REFUSED = (
    {f"G{n}": _LATER for n in (84, 85, 161, 162, *range(301, 308), 309, 320, 321, 343, 344)}
    | {f"G{n}": _LATER for n in (201, 202, 203, 204, 208, 241)}  # other names, table 1.2 and 2.5
    | {f"G{n}": _LATER for n in (400, 404, *range(408, 416), 417, *range(419, 427), *range(460, 463))}
    | {f"G{n}": _LATER for n in (470, 471, 472, 480, 481, 482, 490, 491, 492, 499)}
    | {f"G{n}": "this control has no such cycle, G83 does its work" for n in (81, 82)}
)

_G_BLOCK = re.compile(r"^[ \t/\ufeff]*(N[ \t]*\d+[ \t]*)?G[ \t]*\d", re.IGNORECASE | re.MULTILINE)


def looks_like(text: str) -> bool:
    """Blocks of G words, and none of the marks by which other languages are known."""
    return _G_BLOCK.search(text) is not None and re.search(r"[*~@;']|BEGIN[ \t]+PGM", text) is None


CONTROL = Control(
    name="mnc",
    title="Mechatronics MNC (2015)",
    suffixes=(".mnc",),
    read=reader("mnc"),
    functions=language.FUNCTIONS | polar.FUNCTIONS | transforms.FUNCTIONS | compensation.FUNCTIONS | drilling.FUNCTIONS,
    cycles=drilling.CYCLES,
    phases=PHASES,
    settings=SETTINGS,
    frames=("datum", "local", "rotation", "mirror", "scaling"),
    compensation=Compensation(approach="corner"),
    looks_like=looks_like,
    refused=REFUSED,
    together=language.together,
    bulk=PlainWords(
        motions={0.0: ("G0", 0), 1.0: ("G1", 1), 2.0: ("G2", -2), 3.0: ("G3", 2)},
        ready=lambda m: m.modal.get("motion") in ("G0", "G1", "G2", "G3"),
        absolute=language.absolute,
        tolerance=lambda m: float(m.settings["arc_tolerance"]),
    ),
)
