"""The DIN/ISO names of cycles, which the manual prints in most of their headings; it prints no DIN/ISO program.

They find a cycle (`mnclab.help("G83" …)`) and explain a G word that strayed into a conversational program. Several are
other functions on other controls (G28, G54, G73, G80). Cycles 26, 200, 208 and some probing cycles have no such name.
"""

from __future__ import annotations

_OWN = {
    7: "G54", 8: "G28", 9: "G4", 10: "G73", 11: "G72", 12: "G39", 13: "G36", 14: "G37", 18: "G18", 19: "G80", 32: "G62",
    **{n: f"G1{n}" for n in (20, 21, 22, 23, 24, 25, 27, 28, 29, 39)},
}  # fmt: skip
_CYCLES = (
    201, 202, 203, 204, 205, 206, 207, 209, 220, 221, 225, 232, 233, 239, 240, 241, 247, 251, 252, 253, 254, 256, 257, 258,
    262, 263, 264, 265, 267, 270, 275, 276,
)  # fmt: skip
_PROBING = (
    *range(400, 406), *range(408, 428), 430, 431, 441, *range(450, 453), *range(460, 464), *range(480, 485), 1410, 1411, 1420,
)  # fmt: skip

#: DIN/ISO name -> the cycle in conversational programs.
ISO_NAMES: dict[str, str] = {
    **{name: f"CYCL DEF {number}" for number, name in _OWN.items()},
    "G53": "CYCL DEF 7",  # with a datum table
    "G55": "TCH PROBE 0",
    **{f"G{number}": f"CYCL DEF {number}" for number in _CYCLES},
    **{f"G{number}": f"TCH PROBE {number}" for number in _PROBING},
}
