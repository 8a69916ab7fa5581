"""Q parameters of touch probe cycles that many share, each declared once (chapters 14 to 16); a cycle says what differs."""

from __future__ import annotations

from functools import partial

from mnclab.controls.tnc_620.cycles.addresses import angle, choice, coordinate, count, distance, length

AXES: dict[float, str] = {1: "reference axis", 2: "minor axis", 3: "touch probe axis"}
PLANE_AXES: dict[float, str] = {1: "reference axis", 2: "minor axis"}
SENSE: dict[float, str] = {-1: "negative", 1: "positive"}
BETWEEN: dict[float, str] = {0: "at the measuring height", 1: "at the clearance height"}
TRANSFER: dict[float, str] = {-1: "do not use", 0: "datum table", 1: "preset table"}
TABLES: dict[float, str] = {0: "datum table", 1: "preset table"}
TRAVERSE: dict[float, str] = {0: "straight", 1: "on an arc through the starting points"}
POINTS: dict[float, str] = {4: "4 points", 3: "3 points"}
SWITCH: dict[float, str] = {0: "no", 1: "yes"}

first_x = partial(coordinate, "Q263", meaning="first touch point, reference axis", example=20)
first_y = partial(coordinate, "Q264", meaning="first touch point, minor axis", example=10)
second_x = partial(coordinate, "Q265", meaning="second touch point, reference axis", example=80)
second_y = partial(coordinate, "Q266", meaning="second touch point, minor axis", example=10)
center_x = partial(coordinate, "Q321", meaning="center, reference axis", example=50)
center_y = partial(coordinate, "Q322", meaning="center, minor axis", example=30)
diameter = partial(length, "Q262", meaning="nominal diameter", example=20)
starting_angle = partial(angle, "Q325", meaning="angle of the first touch point", example=0)
stepping_angle = partial(
    angle, "Q247", meaning="stepping angle", note="5 at least", at_least=-120, at_most=120, incremental=True, example=90
)
level = partial(coordinate, "Q261", meaning="measuring height of the ball's center", example=-5)
clearance = partial(distance, "Q320", meaning="set-up clearance", note="added to SET_UP of the probe table", example=0)
height = partial(coordinate, "Q260", meaning="clearance height", example=20)
move_to_clearance = partial(choice, "Q301", meaning="height between measuring points", choices=BETWEEN, example=0)
row = partial(count, "Q305", meaning="number in table", at_most=9999, example=0)
transfer = partial(choice, "Q303", meaning="measured value transfer", choices=TRANSFER, example=1)
datum_x = partial(coordinate, "Q331", meaning="new coordinate in the reference axis", default=0)
datum_y = partial(coordinate, "Q332", meaning="new coordinate in the minor axis", default=0)
datum_z = partial(coordinate, "Q333", meaning="new coordinate in the touch probe axis", default=0)
probe_z = partial(choice, "Q381", meaning="preset in the touch probe axis too", choices=SWITCH, example=0)
top_x = partial(coordinate, "Q382", meaning="touch point of the probe axis, reference axis", example=0)
top_y = partial(coordinate, "Q383", meaning="touch point of the probe axis, minor axis", example=0)
top_z = partial(coordinate, "Q384", meaning="touch point of the probe axis, probe axis", example=0)
axis = partial(choice, "Q272", meaning="measuring axis", choices=PLANE_AXES, example=1)
direction = partial(choice, "Q267", meaning="traverse direction", choices=SENSE, example=1)
points = partial(choice, "Q423", meaning="number of touch points", choices=POINTS, default=4)
traverse = partial(choice, "Q365", meaning="way between the touch points", choices=TRAVERSE, default=1)
basic_rotation = partial(choice, "Q304", meaning="basic rotation by the line of points 1 and 2", choices=SWITCH, example=0)
