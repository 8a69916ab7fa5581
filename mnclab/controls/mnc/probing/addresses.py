"""Addresses of the measuring cycles that many share, each declared once (MNC, chapter 12); a cycle says what differs."""

from __future__ import annotations

from functools import partial

from mnclab.controls.mnc.cycles.addresses import choice, kind

PLANE_AXES: dict[float, str] = {1: "X", 2: "Y"}
SENSE: dict[float, str] = {-1: "negative", 1: "positive"}
BETWEEN: dict[float, str] = {0: "at the measuring height", 1: "at the safe height"}
SWITCH: dict[float, str] = {0: "no", 1: "yes"}

coordinate = kind()
length = kind(at_least=0, incremental=True)
angle = kind("deg", default=0, at_least=-360, at_most=360)
count = kind("count", type="integer", at_least=0, default=0)

clearance = partial(length, "Q", "extra clearance", 0, default=0, note="added to PR_CLR of the probe table")
level = partial(coordinate, "Z", "measuring height of the ball's centre", -8)
height = partial(coordinate, "H", "safe height", 20)
between = partial(choice, "P", meaning="height between measuring points", choices=BETWEEN, example=0, default=0)
axis = partial(choice, "L", meaning="measuring axis", choices=PLANE_AXES, example=1)
row = partial(count, "W", "row of the datum table", 0, note="0: it is not saved")
