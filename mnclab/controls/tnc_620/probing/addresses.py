"""Parameters of touch probe cycles that many share, each declared once (chapters 14 to 17); a cycle says what differs."""

from __future__ import annotations

from functools import partial

from mnclab.controls.tnc_620.cycles.addresses import (
    POSITIONING,
    angle,
    choice,
    coordinate,
    count,
    distance,
    feed,
    length,
)
from mnclab.machine.cycle import param

#: Names of parameters that follow each other in many cycles.
HEIGHTS = "level clearance height"
LINE = "x y second_x second_y axis direction"
TOP = "transfer probe_z top_x top_y top_z datum_z"
CENTRE = f"row datum_x datum_y {TOP}"
ROUND = f"diameter starting_angle stepping_angle {HEIGHTS} move_to_clearance"
CENTRES = "first_center_axis_1 first_center_axis_2 second_center_axis_1 second_center_axis_2"
INSPECTED = "tolerance_x tolerance_y measuring_log program_stop monitored_tool"

AXES: dict[float, str] = {1: "reference axis", 2: "minor axis", 3: "touch probe axis"}
PLANE_AXES: dict[float, str] = {1: "reference axis", 2: "minor axis"}
SENSE: dict[float, str] = {-1: "negative", 1: "positive"}
BETWEEN: dict[float, str] = {0: "at the measuring height", 1: "at the clearance height"}
TRANSFER: dict[float, str] = {-1: "do not use", 0: "datum table", 1: "preset table"}
TABLES: dict[float, str] = {0: "datum table", 1: "preset table"}
TRAVERSE: dict[float, str] = {0: "straight", 1: "on an arc through the starting points"}
POINTS: dict[float, str] = {4: "4 points", 3: "3 points"}
SWITCH: dict[float, str] = {0: "no", 1: "yes"}
LOGS: dict[float, str] = {0: "none", 1: "a file TCHPR….TXT", 2: "on the screen, the program waits"}
STOPS: dict[float, str] = {0: "the program goes on", 1: "an alarm"}
COMPENSATION: dict[float, str] = {0: "basic rotation", 1: "the rotary table turns"}

side = length
x = partial(coordinate, "Q263", meaning="first touch point, reference axis", example=20)
y = partial(coordinate, "Q264", meaning="first touch point, minor axis", example=10)
z = partial(coordinate, "Q294", meaning="first touch point, touch probe axis", example=0)
second_x = partial(coordinate, "Q265", meaning="second touch point, reference axis", example=80)
second_y = partial(coordinate, "Q266", meaning="second touch point, minor axis", example=10)
third_x = partial(coordinate, "Q296", meaning="third touch point, reference axis", example=50)
third_y = partial(coordinate, "Q297", meaning="third touch point, minor axis", example=50)
centre_x = partial(coordinate, "Q321", meaning="center, reference axis", example=50)
centre_y = partial(coordinate, "Q322", meaning="center, minor axis", example=30)
middle_x = partial(coordinate, "Q273", meaning="center, reference axis", example=50)
middle_y = partial(coordinate, "Q274", meaning="center, minor axis", example=30)
first_center_axis_1 = partial(coordinate, "Q268", meaning="first center, reference axis", example=20)
first_center_axis_2 = partial(coordinate, "Q269", meaning="first center, minor axis", example=20)
second_center_axis_1 = partial(coordinate, "Q270", meaning="second center, reference axis", example=80)
second_center_axis_2 = partial(coordinate, "Q271", meaning="second center, minor axis", example=20)
diameter = partial(length, "Q262", meaning="nominal diameter", example=20)
nominal_length = partial(length, "Q311", meaning="nominal length", example=10)
starting_angle = partial(angle, "Q325", meaning="angle of the first touch point", example=0)
stepping_angle = partial(
    angle, "Q247", meaning="stepping angle", note="5 at least", at_least=-120, at_most=120, incremental=True, example=90
)
first_angle = partial(angle, "Q291", meaning="angle of the first hole", example=0)
second_angle = partial(angle, "Q292", meaning="angle of the second hole", example=90)
third_angle = partial(angle, "Q293", meaning="angle of the third hole", example=180)
reference_angle = partial(angle, "Q380", meaning="reference angle", example=0)
preset_rotation_angle = partial(angle, "Q307", meaning="angle of the line that is 0", example=0)
level = partial(coordinate, "Q261", meaning="measuring height of the ball's center", example=-5)
clearance = partial(distance, "Q320", meaning="set-up clearance", note="added to SET_UP of the probe table", example=0)
height = partial(coordinate, "Q260", meaning="clearance height", example=20)
move_to_clearance = partial(choice, "Q301", meaning="height between measuring points", choices=BETWEEN, example=0)
row = partial(count, "Q305", meaning="number in table", at_most=9999, example=0)
transfer = partial(choice, "Q303", meaning="measured value transfer", choices=TRANSFER, example=1)
datum = partial(coordinate, "Q405", meaning="new coordinate in the measuring axis", default=0)
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
spacing_axis_1 = partial(distance, "Q326", meaning="from point 1 to point 2 along X", example=30)
spacing_axis_2 = partial(distance, "Q327", meaning="from point 3 to point 4 along Y", example=20)
compensation = partial(choice, "Q402", meaning="compensation", choices=COMPENSATION, example=0)
set_to_zero = partial(choice, "Q337", meaning="set the rotary axis to zero", choices=SWITCH, example=0)
measuring_log = partial(choice, "Q281", meaning="measuring log", choices=LOGS, example=0)
program_stop = partial(choice, "Q309", meaning="where a tolerance is exceeded", choices=STOPS, example=0)
tolerance_x = partial(length, "Q279", meaning="tolerance of the center, reference axis", note="0: not monitored", example=0)
tolerance_y = partial(length, "Q280", meaning="tolerance of the center, minor axis", note="0: not monitored", example=0)
maximum = partial(length, meaning="maximum limit", note="0 with a minimum of 0: not monitored", example=0)
minimum = partial(length, meaning="minimum limit", example=0)
maximum_limit = partial(maximum, "Q288")
minimum_limit = partial(minimum, "Q289")
first_maximum = partial(maximum, "Q284", meaning="maximum limit of the first side")
first_minimum = partial(minimum, "Q285", meaning="minimum limit of the first side")
second_maximum = partial(maximum, "Q286", meaning="maximum limit of the second side")
second_minimum = partial(minimum, "Q287", meaning="minimum limit of the second side")
monitored_tool = partial(
    count, "Q330", meaning="tool that is monitored, number or name", type="text", at_most=32767.9, note="0: none", example=0
)  # fmt: skip
_without_effect = partial(param, default=None, default_means="without effect", modal=True)  # of programs of other controls
reverse_tool = partial(_without_effect, "Q498", "reverse tool", "choice", type="choice")
angle_of_incidence = partial(_without_effect, "Q531", "angle of incidence", "deg")

# --- the cycles 14xx (14.2): places, and what becomes of them ---------------------------------------------------------
DIRECTIONS: dict[float, str] = {
    sense * (k + 1): f"{'+' if sense > 0 else '-'}{axis}" for k, axis in enumerate("XYZ") for sense in (1, -1)
}
MODES: dict[float, str] = {
    -1: "never", 0: "before and after the cycle", 1: "before and after every object", 2: "before and after every touch",
}  # fmt: skip
REACTIONS: dict[float, str] = {0: "none", 1: "an alarm for rework and scrap", 2: "an alarm for scrap"}
ALIGNING: dict[float, str] = {0: "not at all", 1: "they turn about the tip (MOVE)", 2: "they turn (TURN)"}
TRANSFERS: dict[float, str] = {0: "none", 1: "point 1", 2: "point 2", 3: "the mean of the points"}
ROTATIONS: dict[float, str] = {0: "none", 1: "basic rotation", 2: "the rotary table turns"}
TEXT = "or a text QS… with tolerances, @ or ?"
FIRST = "first_point_ref_axis first_point_minor_axis first_point_tool_axis"
SECOND = "second_point_ref_axis second_point_minor_axis second_point_tool_axis"
TAKEN = "clearance height clearance_height_mode error_reaction align_rotary_axis transfer_position confirm_rotation"

_place = partial(coordinate, note=TEXT)
first_point_ref_axis = partial(_place, ("Q1100", "QS1100"), meaning="first point, reference axis", example=20)
first_point_minor_axis = partial(_place, ("Q1101", "QS1101"), meaning="first point, minor axis", example=10)
first_point_tool_axis = partial(_place, ("Q1102", "QS1102"), meaning="first point, tool axis", example=-5)
second_point_ref_axis = partial(_place, ("Q1103", "QS1103"), meaning="second point, reference axis", example=80)
second_point_minor_axis = partial(_place, ("Q1104", "QS1104"), meaning="second point, minor axis", example=10)
second_point_tool_axis = partial(_place, ("Q1105", "QS1105"), meaning="second point, tool axis", example=-5)
third_point_ref_axis = partial(_place, ("Q1106", "QS1106"), meaning="third point, reference axis", example=20)
third_point_minor_axis = partial(_place, ("Q1107", "QS1107"), meaning="third point, minor axis", example=50)
third_point_tool_axis = partial(_place, ("Q1108", "QS1108"), meaning="third point, tool axis", example=0)
diameter_1 = partial(length, ("Q1116", "QS1116"), "first diameter", at_most=9999.9999, note=TEXT, example=20)
diameter_2 = partial(length, ("Q1117", "QS1117"), "second diameter", at_most=9999.9999, note=TEXT, example=20)
probing_direction = partial(choice, "Q372", "probing direction", DIRECTIONS, example=2)
clearance_height_mode = partial(choice, "Q1125", "when it goes to the clearance height", MODES, example=1)
error_reaction = partial(choice, "Q309", "reaction to a violated tolerance", REACTIONS, example=0)
align_rotary_axis = partial(choice, "Q1126", "how rotary axes are aligned", ALIGNING, example=0)
transfer_position = partial(choice, "Q1120", "position that corrects the preset", choices=TRANSFERS, example=0)
confirm_rotation = partial(choice, "Q1121", "rotation that is taken over", choices=ROTATIONS, example=0)

# --- the cycles of KinematicsOpt (18.4, 18.5): a sphere, and each rotary axis ------------------------------------------
OPTIMIZING: dict[float, str] = {
    0: "check: nothing is changed", 1: "optimize the position", 2: "optimize angle and position",
    3: "correct the machine datum, optimize angle and position",
}  # fmt: skip
SPHERE_PRESETS: dict[float, str] = {
    0: "it was set by hand", 1: "before the measurement", 2: "after the measurement", 3: "before and after the measurement",
}  # fmt: skip
MEASURED_BY = "sphere_radius clearance retraction_height feed_pre_positioning reference_angle"
OF_AXES = " ".join(f"start_angle_{k} end_angle_{k} incidence_angle_{k} measuring_points_{k}" for k in "abc")

_start = partial(angle, at_least=-359.999, at_most=359.999, example=-90)
_end = partial(_start, example=90)
_incidence = partial(_start, note="while the other rotary axes are measured", example=0)
_points = partial(count, at_most=12, note="0: it is not measured", example=0)
mode = partial(choice, "Q406", meaning="mode", choices=OPTIMIZING, example=1)
sphere_radius = partial(length, "Q407", "exact radius of the calibration sphere", at_least=0.0001, at_most=99.9999, example=12.5)
retraction_height = partial(
    length, "Q408", meaning="retraction height", default=0, example=0,
    note="untilted, before rotary axes turn; 0: none, the probe goes round the sphere",
)  # fmt: skip
feed_pre_positioning = partial(
    feed, "Q253", meaning="feed rate for pre-positioning", at_least=0.0001, at_most=99999.9999, also=POSITIONING, predef=True,
    example=750,
)  # fmt: skip
start_angle_a = partial(_start, "Q411", meaning="start angle of the A axis")
end_angle_a = partial(_end, "Q412", meaning="end angle of the A axis")
incidence_angle_a = partial(_incidence, "Q413", meaning="angle of incidence of the A axis")
measuring_points_a = partial(_points, "Q414", meaning="measuring points of the A axis")
start_angle_b = partial(_start, "Q415", meaning="start angle of the B axis")
end_angle_b = partial(_end, "Q416", meaning="end angle of the B axis")
incidence_angle_b = partial(_incidence, "Q417", meaning="angle of incidence of the B axis")
measuring_points_b = partial(_points, "Q418", meaning="measuring points of the B axis")
start_angle_c = partial(_start, "Q419", meaning="start angle of the C axis", example=90)
end_angle_c = partial(_end, "Q420", meaning="end angle of the C axis", example=270)
incidence_angle_c = partial(_incidence, "Q421", meaning="angle of incidence of the C axis")
measuring_points_c = partial(_points, "Q422", meaning="measuring points of the C axis", example=3)
number_of_touch_points = partial(count, "Q423", meaning="number of touch points on the equator", at_least=3, at_most=8, example=4)
preset = partial(choice, "Q431", meaning="preset in the middle of the sphere", choices=SPHERE_PRESETS, example=0)
backlash_angular_range = partial(
    angle, "Q432", meaning="angle to measure the backlash by", at_least=-3, at_most=3, default=0, note="0: it is not measured",
    example=0,
)  # fmt: skip
