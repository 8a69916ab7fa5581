"""Addresses of the measuring cycles that many share, each declared once (MNC, chapter 12); a cycle says what differs."""

from __future__ import annotations

from functools import partial
from typing import Any

from mnclab.controls.mnc.cycles.addresses import choice, kind
from mnclab.machine.cycle import param

#: Names of parameters that follow each other in many cycles.
APPROACH = "clearance level height"
TOP = "apply probe_z z_probe_x z_probe_y z_probe_z z_new"
SIDE = f"x y x2 y2 axis direction {APPROACH} between"
SIZE = "max_size min_size"
CENTRE = "tol_center_x tol_center_y protocol stop_on_error"

PLANE_AXES: dict[float, str] = {1: "X", 2: "Y"}
SENSE: dict[float, str] = {-1: "negative", 1: "positive"}
BETWEEN: dict[float, str] = {0: "at the measuring height", 1: "at the safe height"}
SWITCH: dict[float, str] = {0: "no", 1: "yes"}
PROTOCOL: dict[float, str] = {0: "none", 1: "write a file into the folder meas_prot"}
STOP: dict[float, str] = {0: "no stop, no message", 1: "program interrupted, message"}

coordinate = kind()
length = kind(at_least=0, incremental=True)
size = kind(above=0)  # of a figure
spacing = kind(above=0, incremental=True)
gets = kind(default=0)  # coordinates in the new system
turn = kind("deg", at_least=-360, at_most=360)
angle = kind("deg", default=0, at_least=-360, at_most=360)
count = kind("count", type="integer", at_least=0, default=0)

x = partial(coordinate, "X", meaning="X of the centre", example=50)
y = partial(coordinate, "Y", meaning="Y of the centre", example=30)
x2 = partial(coordinate, "U", meaning="X of the second measuring point", example=80)
y2 = partial(coordinate, "V", meaning="Y of the second measuring point", example=0)
clearance = partial(length, "Q", "extra clearance", 0, default=0, note="added to PR_CLR of the probe table")
level = partial(coordinate, "Z", "measuring height of the ball's centre", -8)
height = partial(coordinate, "H", "safe height", 20)


def between(address: str | tuple[str, ...] = "P") -> Any:
    """How the probe goes from point to point."""
    return param(address, "height between measuring points", "choice", choices=BETWEEN, example=0, default=0)


axis = partial(choice, "L", meaning="measuring axis", choices=PLANE_AXES, example=1)
row = partial(count, "W", "row of the datum table", 0, note="0: it is not saved")
direction = partial(choice, "K", meaning="direction of measuring", choices=SENSE, example=1)
width = partial(kind(at_least=0), "D", meaning="nominal width", example=20)
diameter = partial(size, "D", "nominal diameter", 30)
length_x = partial(size, "A", "nominal length along X", 80)
length_y = partial(size, "B", "nominal length along Y", 50)
new_coordinate = partial(gets, "U", meaning="coordinate of the centre in the new system", example=0)
x_new = partial(gets, "U", "X of the point in the new system", 0)
y_new = partial(gets, "V", "Y of the point in the new system", 0)
apply = partial(choice, "S", meaning="apply the new coordinate system", choices=SWITCH, example=1, default=0)
rotate = partial(choice, "E", meaning="compensate the turn of the part", choices=SWITCH, example=0, default=0, note="with S1")
probe_z = partial(choice, "F", meaning="measure the datum along Z too", choices=SWITCH, example=0, default=0)
_with_f = kind(default=None, default_means="needed with F1")
z_probe_x = partial(_with_f, "I", "X of the point measured along Z", 30)
z_probe_y = partial(_with_f, "J", "Y of the point measured along Z", 20)
z_probe_z = partial(_with_f, "K", "nominal Z of the point measured along Z", 0)
z_new = partial(gets, "R", meaning="Z in the new system of the point measured along Z", example=0)
limit = kind(default=None, default_means="not checked", note="0: not checked")
_deviation = kind(default=None, default_means="not checked", at_least=0, note="both ways; 0: not checked")
max_size = partial(limit, "R", meaning="greatest permissible size", example=30.05)
min_size = partial(limit, "T", meaning="least permissible size", example=29.95)
max_size_x = partial(limit, "R", "greatest permissible length along X", 80.05)
min_size_x = partial(limit, "T", "least permissible length along X", 79.95)
max_size_y = partial(limit, "J", "greatest permissible length along Y", 50.05)
min_size_y = partial(limit, "K", "least permissible length along Y", 49.95)
tol_center_x = partial(_deviation, "U", "permissible deviation of the centre along X", 0.05)
tol_center_y = partial(_deviation, "V", "permissible deviation of the centre along Y", 0.05)
stop_on_error = partial(choice, "E", "what happens beyond a limit", STOP, 1, default=0)


def protocol(address: str = "L") -> Any:
    return choice(address, "measuring protocol", PROTOCOL, 1, default=0)
