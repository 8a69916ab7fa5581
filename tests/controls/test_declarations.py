"""Every declared cycle of every control against the tables of its manual, address by address.

The tables stand in tests/authorities/catalogue/parameters-CONTROL.json (how they were made: tests/authorities/README.md).
Every key of them must agree; where a declaration differs on purpose, `EXPLAINED` says what it has and why.
"""

import inspect
import json
import math
import re
from functools import cache
from html import escape
from pathlib import Path

import pytest
from tools.together import together

import mnclab
from mnclab.machine.cycle import Cycle, param

CATALOGUE = Path(__file__).parents[1] / "authorities" / "catalogue"


def tables(control):
    """The rows of each cycle by its code."""
    files = sorted(CATALOGUE.glob(f"parameters-{control}*.json"))  # with that of obsolete cycles
    entries = [entry for file in files for entry in json.loads(file.read_text(encoding="utf-8"))]
    found = {}
    for entry in entries:  # "CYCL DEF 7 (datum table)" is another form of CYCL DEF 7
        for code in (entry["code"].partition(" (")[0], *entry["aliases"]):
            found[code] = [*found.get(code, ()), *entry["parameters"]]
    return found


TABLES = {control: found for control in mnclab.controls if (found := tables(control))}  # the source of g43 has no cycles
CYCLES = [(control, code) for control, table in TABLES.items() for code in mnclab.controls[control].cycles if code in table]

#: Our names where the table has a longer one: the word that the address does not say already.
NAMES = {
    "set_up_clearance": ("clearance", "set_up_clearance"),
    "feed_rate_for_plunging": ("feed", "plunge_feed", "plunging_feed"),
    "infeed_depth": "infeed",
    "workpiece_surface_coordinate": "surface",
    "second_set_up_clearance": "second_clearance",
    "dwell_at_top": "dwell_top",
    "dwell_at_depth": "dwell_bottom",
    "depth_reference": "reference",
    "label_numbers_for_the_contour": "labels",
    "milling_depth": "depth",
    "path_overlap_factor": "overlap",
    "finishing_allowance_for_side": "side_allowance",
    "finishing_allowance_for_floor": "floor_allowance",
    "surface_coordinate": "surface",
    "clearance_height": "height",
    "inside_corner_radius": "corner",
    "rotational_direction": "sense",
    "plunging_depth": "infeed",
    "feed_rate_for_roughing": ("feed", "roughing_feed"),
    "coarse_roughing_tool": "coarse_tool",
    "number_name_of_rough_out_tool": "rough_out_tool",
    "feed_rate_for_reciprocation": "swing_feed",
    "residual_material": "accepted",
    "connection_distance": "connected",
    "path_extension": "extended",
    "type_of_approach": "approach",
    "radius_compensation": "compensation",
    "center_angle": "angle",
    "retraction_feed_rate": "retract_feed",
    "feed_rate_factor": "factor",
    "fine_roughing_strategy": "fine_strategy",
    "datum_shift": ("x", "y", "z", "a", "b", "c"),  # one row for all axes
    "axis_factor": ("x", "y", "z"),
    "center": ("centre_x", "centre_y", "centre_z"),
    "finishing_feed_rate": "finishing_feed",
    "prepositioning_feed_rate": "prepositioning_feed",
    "clearance_to_side": "side_clearance",
    "feed_rate_for_milling": ("feed", "milling_feed"),
    "first_point_axis_1": "x",
    "first_point_axis_2": "y",
    "second_point_axis_1": "second_x",
    "second_point_axis_2": "second_y",
    "measuring_height": ("z", "level"),
    "first_point_axis_3": "z",
    "measuring_axis": "axis",
    "traverse_direction": "direction",
    "number_in_table": "row",
    "datum_ts_axis": ("datum", "datum_z"),
    "second_point_axis_3": "second_z",
    "third_point_axis_3": "third_z",
    "maximum_limit_size": "maximum_limit",
    "minimum_limit_size": "minimum_limit",
    "max_limit_1st_side": "first_maximum",
    "min_limit_1st_side": "first_minimum",
    "max_limit_2nd_side": "second_maximum",
    "min_limit_2nd_side": "second_minimum",
    "tolerance_center_1": "tolerance_x",
    "tolerance_center_2": "tolerance_y",
    "program_stop_if_tolerance_exceeded": "program_stop",
    "tool_for_monitoring": "monitored_tool",
    "starting_point_axis_1": "x",
    "starting_point_axis_2": "y",
    "offset_second_measurement": "offset",
    "probing_axis_and_direction": "probing",
    "pre_position": ("x", "y", "z"),
    "probing_axis": "axis",
    "probing_angle": "angle",
    "maximum_measuring_range": "reach",
    "measuring_feed_rate": "feed",
    "maximum_retraction_path": "back",
    "reference_system": "system",
    "vector_x": "direction_x",
    "vector_y": "direction_y",
    "vector_z": "direction_z",
    "angle_of_hole_1": "first_angle",
    "angle_of_hole_2": "second_angle",
    "angle_of_hole_3": "third_angle",
    "measured_value_transfer": "transfer",
    # presets (TNC 620, chapter 15)
    "slot_width": "width",
    "ridge_width": "width",
    "first_side_length": "length",
    "second_side_length": "width",
    "third_point_axis_1": "third_x",
    "third_point_axis_2": "third_y",
    "nominal_center_axis_1": "middle_x",
    "nominal_center_axis_2": "middle_y",
    "angle_hole_1": "first_angle",
    "angle_hole_2": "second_angle",
    "angle_hole_3": "third_angle",
    "datum_measuring_axis": "datum",
    "datum_reference_axis": "datum_x",
    "datum_minor_axis": "datum_y",
    "probe_in_ts_axis": "probe_z",
    "ts_axis_coordinate_1": "top_x",
    "ts_axis_coordinate_2": "top_y",
    "ts_axis_coordinate_3": "top_z",
    "number_of_probe_points": "points",
    "type_of_traverse": "traverse",
    # drilling (TNC 620, chapter 4)
    "select_diameter_or_depth": "mode",
    "centering_diameter": "diameter",
    "number_of_chip_breaks": "chip_breaks",
    "minimum_infeed_depth": "min_infeed",
    "chip_breaking_distance": "break_retract",
    "disengaging_direction": "disengage",
    "spindle_orientation_angle": "spindle_angle",
    "material_thickness": "thickness",
    "off_center_distance": "eccentricity",
    "tool_edge_height": "edge_height",
    "pre_positioning_feed_rate": "positioning_feed",
    "counterboring_feed_rate": "feed",
    "dwell_time": ("dwell_bottom", "dwell_time"),
    "infeed_per_helix": "pitch",
    "nominal_diameter": ("diameter", "nominal_diameter"),
    "climb_or_up_cut": ("climb", "milling_type", "sense"),
    "infeed_per_revolution": "advance",
    "infeed_for_finishing": "finishing_infeed",
    "feed_rate_reference": "feed_reference",
    "upper_advanced_stop_distance": ("first_stop", "upper_advanced_stop_distance"),
    "lower_advanced_stop_distance": "last_stop",
    "infeed_depth_for_chip_breaking": "break_every",
    "deepened_starting_point": "start_depth",
    "spindle_direction_entry_exit": "spindle_direction",
    "spindle_speed_entry_exit": "entry_speed",
    "spindle_speed_drilling": "drilling_speed",
    "coolant_on_m_function": "coolant_on",
    "coolant_off_m_function": "coolant_off",
    # pockets (chapter 6)
    "center_axis_1": ("centre_x", "middle_x"),
    "center_axis_2": ("centre_y", "middle_y"),
    "slot_position_reference": "slot_position",
    "start_tool_axis": "surface",
    # tool setters (TNC 620, chapter 19; MNC 12.27 to 12.32)
    "probing_the_teeth": "teeth",
    "status_parameter": "target",
    "stop_before_running": "stop",
    "laser_axis": "axis",
    "reference_length": "length",
    "reference_diameter": "diameter",
    # measuring cycles (MNC, chapter 12)
    "extra_clearance": "clearance",
    "safe_height": "height",
    "between_points": "between",
    "datum_row": "row",
    "ring_diameter": "diameter",
    "boss_diameter": "diameter",
    # calibration (TNC 620, chapter 17)
    "exact_calibration_sphere_radius": "radius",
    "ring_radius": "radius",
    "stud_radius": "radius",
    "positioning_feed_rate": "positioning",
    "select_feed_rate": "rapid",
    "angle_tracking": "track",
}

ONCE = "only what L chooses is used: the example writes H0 beside L1, so the limit is checked where it counts"
FEED = "the range of the word F (4.1)"
MILLING = ("G320", "G321", "G343", "G344")
TIME = "the table has no range; a time is not negative"
LATHE = ("G70", "G71", "G77", "G78", "G72", "G73", "G74", "G75", "G31", "G33")
JNC = [("G73", "Z"), *((c, a) for c in ("G74", "G75") for a in "XZ"), *((c, a) for c in ("G77", "G78") for a in "XZUW")]
AS_IN_CYCLES = "the table has none: that of the parameter in the cycles"
LENGTH, SIGNED, TIMES = {">=": 0, "<=": 99999.9999}, {">=": -99999.9999, "<=": 99999.9999}, {">=": 0, "<=": 3600}
FEEDS, OVERLAP = {">=": 0, "<=": 99999.999}, {">=": 0.0001, "<=": 1.9999}
GLOBAL_LIMITS = [
    *((100, q, LENGTH) for q in ("Q200", "Q204")), *((100, q, FEEDS) for q in ("Q253", "Q208")), (105, "Q256", LENGTH),
    *((105, q, TIMES) for q in ("Q210", "Q211")), (110, "Q370", OVERLAP), (111, "Q2", OVERLAP), (111, "Q6", LENGTH),
    (111, "Q7", SIGNED), (120, "Q320", LENGTH), (120, "Q260", SIGNED),
]  # fmt: skip
PLACES = [*((n, 1100 + k) for n, count in ((1410, 6), (1411, 6), (1420, 9)) for k in range(count)), (1411, 1116), (1411, 1117)]
AIMED = [(n, q) for n in (1410, 1411, 1420) for q in ("Q1125", "Q309", "Q1126")]
DEFAULTED = [("CYCL DEF 256", "Q437"), ("CYCL DEF 257", "Q376"), ("CYCL DEF 233", "Q348"), ("CYCL DEF 233", "Q349")]
#: (control, code, address, key) -> what the declaration has, and why.
EXPLAINED = {
    **{("mnc", code, "P", "limits"): ({">=": 0}, TIME) for code in ("G83", "G84", "G85")},
    **{("mnc", code, "F", "limits"): ({">": 0}, FEED) for code in ("G83", "G84", "G85")},
    **{("mnc", code, address, "limits"): ({">": 0}, FEED) for code in MILLING for address in "FV"},
    **{("mnc", code, "T", "limits"): ({">=": 0}, "an example writes T0: then it is F") for code in MILLING},
    **{("mnc", code, "L", "choices"): ({1, -1, 0}, "L0 is L1 (MNC-POCKET-L)") for code in ("G343", "G344")},
    **{("mnc", "G305", address, "limits"): ({}, ONCE) for address in "HD"},
    ("mnc", "G480", "Q", "required"): (False, "P1 needs none: a check"),
    ("mnc", "G306", "L", "choices"): ({1, -1, 0}, "L0 is L1 (MNC-G306-L)"),
    ("mnc", "G307", "K", "limits"): ({">=": 0}, "its other limit is H: a check"),
    ("mnc", "G309", "P", "limits"): ({}, "not 0: a check"),
    ("mnc", "G415", "C", "limits"): ({}, "its choices"),
    **{("mnc", f"G{n}", letter, "required"): (False, "with F1: a check") for n in range(408, 416) for letter in "IJK"},
    **{
        ("tnc-620", f"CYCL DEF {n}", "Q208", "limits"): ({">=": 0}, "FMAX is infinite; the upper limit is a check")
        for n in (22, 23)
    },
    **{("tnc-620", f"CYCL DEF {n}", "Q208", "default"): (math.inf, "FMAX") for n in (22, 23)},
    **{
        ("tnc-620", f"CYCL DEF {code}", "Q385", "required"): (False, "it came later than the cycle: then Q207 counts")
        for code in (251, 252, 253, 254)
    },
    ("tnc-620", "CYCL DEF 28", "Q21", "limits"): ({">=": 0, "<=": 9.9999}, "0 makes it inactive, the lower limit is a check"),
    ("tnc-620", "CYCL DEF 28", "Q21", "default"): (0, "inactive; the table says it with a remark"),
    ("tnc-620", "CYCL DEF 205", "Q208", "required"): (False, "it came later than the cycle, whose way out was at rapid"),
    **{
        ("tnc-620", f"CYCL DEF {code}", address, key): (value, "it came later than the cycle: older programs lack it")
        for code, address in ((200, "Q211"), (210, "Q338"), (211, "Q338"), (220, "Q365"))
        for key, value in (("required", False), ("default", 0))
    },
    **{
        ("tnc-620", f"TCH PROBE {code}", "Q365", key): (value, "it came later than the cycle: older programs lack it")
        for code in (412, 413)
        for key, value in (("required", False), ("default", 1))
    },
    ("tnc-620", "TCH PROBE 460", "Q455", "limits"): ({">=": 0, "<=": 30}, "0 is allowed too"),
    ("tnc-620", "TCH PROBE 460", "Q455", "default"): (0, "none, as where the option is missing"),
    ("tnc-620", "TCH PROBE 462", "Q407", "limits"): ({">=": 0, "<=": 99.9999}, "the first 9 was lost in print"),
    **{
        ("tnc-620", "TCH PROBE 441", q, "required"): (False, "left out (NO ENT) the touch probe table counts")
        for q in ("Q396", "Q397", "Q399", "Q400")
    },
    **{("tnc-620", f"TCH PROBE {n}", f"Q{q}", "also"): (set(), "a text, under QS and the same number") for n, q in PLACES},
    **{
        ("tnc-620", f"TCH PROBE {n}", q, "limits"): ({}, "its choices")
        for n, q in (*AIMED, (1410, "Q372"), (1420, "Q372"), (1411, "Q1115"))
    },
    ("tnc-620", "TCH PROBE 405", "Q337", "limits"): ({">=": 0, "<=": 99999}, "0, or a row"),
    ("tnc-620", "TCH PROBE 405", "Q337", "choices"): (set(), "0, or a row"),
    ("tnc-620", "CYCL DEF 21", "Q13", "limits"): ({">=": 0, "<=": 99999}, "a number, or a name"),
    **{("tnc-620", f"CYCL DEF {n}", "Q401", "unit"): ("%", "100 is all of the feed rate") for n in (22, 241)},
    ("tnc-620", "CYCL DEF 24", "Q438", "default"): (-1, "in a sentence there"),
    **{("tnc-620", f"CYCL DEF {n}", "Q18", "limits"): ({">=": 0, "<=": 99999}, "a number, or a name") for n in (22, 25, 276)},
    **{
        ("tnc-620", f"CYCL DEF {n}", q, "default"): (value, "the value of its example: in words there")
        for n in (25, 276)
        for q, value in (("Q446", 0.01), ("Q447", 10), ("Q448", 2))
    },
    **{("tnc-620", f"TCH PROBE {n}", "Q341", "limits"): ({}, "its choices") for n in (481, 482, 483)},
    **{("tnc-620", f"TCH PROBE {n}", "PROBING THE TEETH", "limits"): ({}, "its choices") for n in (31, 32, 33)},
    **{("tnc-620", f"TCH PROBE {n}", "status parameter", "limits"): ({}, "which parameter, the reader") for n in (31, 32, 33)},
    ("tnc-620", "TCH PROBE 484", "Q536", "limits"): ({}, "its choices"),
    ("tnc-620", "CYCL DEF 275", "Q439", "limits"): ({}, "its choices"),
    ("tnc-620", "TCH PROBE 415", "Q308", "limits"): ({}, "its choices"),
    ("tnc-620", "CYCL DEF 8", "axes", "limits"): ({}, "at most three, and which ones, are a check"),
    ("tnc-620", "CYCL DEF 19", "F", "unit"): ("deg/min", "the rotary axes turn alone"),
    **{("tnc-620", "CYCL DEF 7", axis, "unit"): ("deg", "one row for all axes; these turn") for axis in "ABC"},
    ("tnc-620", "CYCL DEF 7", "#", "required"): (False, "the form of cycle 7 with a table"),
    **{("tnc-620", "CYCL DEF 26", axis, "default"): (1, "in words there") for axis in "XYZ"},
    **{("tnc-620", "CYCL DEF 26", axis, "required"): (False, "one of them") for axis in "XYZ"},
    ("tnc-620", "CYCL DEF 19", "ABST", "default"): (None, "both F and ABST, or the axes are not moved"),
    ("tnc-620", "CYCL DEF 225", "Q500", "limits"): ({}, "of characters, a check"),
    ("tnc-620", "CYCL DEF 225", "Q201", "limits"): ({">=": -99999.9999, "<=": 99999.9999}, "its reading has them"),
    ("tnc-620", "CYCL DEF 225", "Q574", "limits"): ({">=": 0, "<=": 99999.9999}, "a length"),
    ("tnc-620", "CYCL DEF 14", "LBL", "limits"): ({">=": 1, "<=": 65535}, "of each; twelve at most are a check"),
    **{("tnc-620", f"GLOBAL DEF {n}", q, "limits"): (limits, AS_IN_CYCLES) for n, q, limits in GLOBAL_LIMITS},
    **{("tnc-620", "GLOBAL DEF 100", q, "also"): ({"FMAX", "FAUTO"}, AS_IN_CYCLES) for q in ("Q253", "Q208")},
    **{("tnc-620", f"CYCL DEF {n}", "Q355", "choices"): (set(), "2, 3, … too: any whole number") for n in (262, 267)},
    **{("tnc-620", f"CYCL DEF {n}", "Q355", "type"): ("integer", "of a pitch per step") for n in (262, 267)},
    ("tnc-620", "CYCL DEF 201", "Q203", "limits"): ({">=": -99999.9999, "<=": 99999.9999}, "a misprint: as everywhere"),
    # inspection (TNC 620, chapters 16 and 17)
    **{
        ("tnc-620", f"TCH PROBE {n}", "axis", key): (value, "a text, which the reader checks")
        for n in (0, 1, 3)
        for key, value in (("limits", {}), *((("type", "text"),) if n else ()))
    },
    **{
        ("tnc-620", f"TCH PROBE {n}", "Q330", key): (value, "0 is none, any other one a number or a name")
        for n in (421, 422, 423, 424, 425, 426, 427, 430)
        for key, value in (("choices", set()), ("type", "text"), ("also", set()))
    },
    **{("tnc-620", f"TCH PROBE {n}", "Q423", "default"): (4, "in words there") for n in (421, 422)},
    **{("tnc-620", f"TCH PROBE {n}", "Q365", "default"): (1, "in words there") for n in (421, 422)},
    # KinematicsOpt (TNC 620, chapter 18)
    **{("tnc-620", f"TCH PROBE {n}", q, "limits"): ({}, "its choices") for n, q in ((450, "Q410"), (451, "Q406"), (451, "Q431"))},
    ("tnc-620", "TCH PROBE 450", "Q409", "limits"): ({}, "of a number and of a text: a check"),
    **{("tnc-620", f"TCH PROBE {n}", "Q408", "limits"): (LENGTH, "0, or a height") for n in (451, 452)},
    **{
        ("tnc-620", f"TCH PROBE {n}", q, "required"): (False, "the table names a value for it")
        for n in (451, 452) for q in ("Q408", "Q432")
    },
    # studs and face milling (TNC 620, chapter 6)
    ("tnc-620", "CYCL DEF 257", "Q376", "limits"): ({">=": -1, "<=": 360}, "-1 lets the control choose; 360 is named too"),
    **{("tnc-620", code, q, "required"): (False, "the table names a value for it") for code, q in DEFAULTED},
    **{("nc-31", code, axis, "limits"): ({}, "any whole number of its unit") for code in LATHE for axis in "XZ"},
    **{("nc-31", code, axis, "type"): ("number", "the reader refuses what is not whole") for code in LATHE for axis in "XZ"},
    ("nc-31", "G31", "P", "default"): (0, "the taper of a cylinder"),
    **{("nc-31", f"G{n}", "P", "limits"): ({">": 0}, "its upper limit is a check") for n in (72, 73, 74, 75)},
    **{("jnc-t01", code, axis, "limits"): ({}, "any number; between which is a check") for code, axis in JNC},
}

#: Parameters without a row: marks of the word that calls the cycle.
MARKS = {
    **{("nc-31", code): ["~"] for code in ("G70", "G71", "G74", "G75")},
    **{("nc-31", code): ["~", "@"] for code in ("G77", "G78")},
    ("nc-31", "G33"): ["@"],
}


#: Rows that name an address in words; others say in brackets in which sub-block it stands.
ADDRESSED = {"axis and sign": "axis", "X Y Z ...": "X|Y|Z", "X Y Z": "X|Y|Z", "REFERENCE SYSTEM": "SYSTEM", "Q409/QS409": "Q409"}


def addressed(row):
    """The addresses of a row."""
    address = re.sub(r" \(\d\.\d\)$", "", row["address"])
    return ADDRESSED.get(address, address).split("|")


def rows(control, code):
    """Parameters of a cycle with their rows; a repeated address takes the rows in their order."""
    taken = []
    for parameter in mnclab.controls[control].cycles[code].parameters():
        if not parameter.mark:
            fitting = [row for row in TABLES[control][code] if parameter.address in addressed(row)]
            alike = [row for row in fitting if row not in taken or len(addressed(row)) > 1]
            assert alike, f"{code} {parameter.address} has no row"
            taken.append(alike[0])
            yield parameter, alike[0]


@pytest.mark.parametrize("control", mnclab.controls)
def test_every_cycle_is_whole(control):
    """What a shared class asks of each cycle, each cycle has."""
    assert [code for code, cycle in mnclab.controls[control].cycles.items() if inspect.isabstract(cycle)] == []


def test_every_cycle_has_rows_of_its_manual():
    """A cycle without any is compared with nothing: its rows go into tests/authorities/catalogue/parameters-CONTROL.json."""
    every = [(control, code) for control in TABLES for code in mnclab.controls[control].cycles]
    assert [case for case in every if case not in CYCLES] == []


CASES = [(control, code, parameter, row) for control, code in CYCLES for parameter, row in rows(control, code)]


def each_cycle(test):
    """A test of control and code: a case a control, which lists every cycle that fails."""
    return together("control code", CYCLES, lambda control, code: control)(test)


def each_parameter(test):
    """A test of a parameter and its row: a case a cycle, which lists every parameter that fails."""
    return together(
        "control code parameter row", CASES,
        lambda control, code, parameter, row: f"{control} {code}", lambda control, code, parameter, row: parameter.name,
    )(test)  # fmt: skip


NUMBER = r"[-+]?\d+(?:\.\d+)?"


def limits(text):
    """The limits in a range as it is written: `0 to 9`, `-3 .. 3`, `> 0`; what a reading adopts counts."""
    text = (text or "").rpartition("adopt ")[2]
    if found := re.match(rf"({NUMBER})(?: to | \.\. )({NUMBER})(?!.*excluded)", text):
        return {">=": float(found[1]), "<=": float(found[2])}
    if found := re.fullmatch(rf"(>=?|<=?) ({NUMBER})", text):
        return {found[1]: float(found[2])}
    if not text or re.fullmatch(rf"{NUMBER}(, (or )?({NUMBER}|PREDEF))*", text):  # a list of choices
        return {}
    return text


def declared(parameter):
    """A declaration in the keys of the tables."""
    signs = {">": parameter.above, ">=": parameter.at_least, "<": parameter.below, "<=": parameter.at_most}
    return {
        "limits": {sign: limit for sign, limit in signs.items() if limit is not None},
        "choices": {float(choice) for choice in parameter.choices or ()},
        "default": parameter.default,
        "also": {*parameter.also} | ({"PREDEF"} if parameter.predef else set()),
        **{key: getattr(parameter, key) for key in ("unit", "type", "required", "modal", "incremental")},
    }


def tabled(row):
    """A row in the same keys; None is what it does not say."""
    default = row.get("default")
    adopted = re.fullmatch(rf".*adopt ({NUMBER})", str(default))
    return {
        "limits": limits(row.get("range")),
        "choices": {float(choice) for choice in row.get("choices") or () if re.fullmatch(NUMBER, str(choice))},
        "default": float(adopted[1]) if adopted else default if isinstance(default, int | float) else None,
        "also": {*re.findall(r"\b(F[A-Z]+|PREDEF)\b", row.get("range", "")), *row.get("alternatives", ())}
        | {"PREDEF"}.intersection(row.get("choices") or ()),
        **{key: row.get(key) for key in ("unit", "type", "required", "modal", "incremental")},
    }


def differences(control, code, parameter, row):
    """What differs from the table: key, ours, theirs."""
    ours, theirs = declared(parameter), tabled(row)
    if theirs["incremental"] is None:
        del theirs["incremental"]
    return [(key, ours[key], value) for key, value in theirs.items() if ours[key] != value]


@each_cycle
def test_a_cycle_declares_the_addresses_of_its_table(control, code):
    parameters = mnclab.controls[control].cycles[code].parameters()
    marks = [parameter.address for parameter in parameters if parameter.mark]
    assert marks == MARKS.get((control, code), [])
    found = [row for _, row in rows(control, code)]
    assert [row["address"] for row in TABLES[control][code] if row not in found] == []
    assert mnclab.controls[control].cycles[code].source


@each_cycle
def test_parameters_stand_in_the_order_of_the_table(control, code):
    """In the declaration, also of what it inherits, and therefore in help and form."""
    found = [TABLES[control][code].index(row) for _, row in rows(control, code)]
    assert found == sorted(found)
    text = str(mnclab.help(code, control)).partition("\n---")[2].splitlines()[1:]
    told = [line.partition("  ")[0] for line in text if line[:1].strip() and not line.startswith("DIN/ISO")]
    assert told == [parameter.address for parameter in mnclab.controls[control].cycles[code].parameters()]


@each_parameter
def test_a_parameter_is_that_of_the_table(control, code, parameter, row):
    for key, ours, theirs in differences(control, code, parameter, row):
        first = mnclab.controls[control].cycles[code].code
        allowed, _ = EXPLAINED.get((control, first, parameter.address, key), (theirs, ""))
        assert ours == allowed, key
    names = NAMES.get(row["name"], row["name"])
    assert parameter.name in (row["name"], *(names if isinstance(names, tuple) else (names,)))
    default = row.get("default")
    if isinstance(default, str) and parameter.default is None:  # said in words: then in ours too
        assert parameter.default_means or parameter.note or parameter.instead


def test_the_explanations_are_needed():
    """No entry for what agrees, and none of a longer name that no table has."""
    differ = {
        (control, mnclab.controls[control].cycles[code].code, parameter.address, key)
        for control, code, parameter, row in CASES
        for key, _, _ in differences(control, code, parameter, row)
    }
    assert set(EXPLAINED) - differ == set()
    assert set(NAMES) - {row["name"] for *_, row in CASES} == set()


@each_parameter
def test_a_limit_refuses_its_neighbour_and_takes_what_is_allowed(control, code, parameter, row):
    whole = parameter.type == "integer"
    for limit, itself, direction in (
        (parameter.above, False, 1), (parameter.at_least, True, 1),
        (parameter.below, False, -1), (parameter.at_most, True, -1),
    ):  # fmt: skip
        if limit is not None:
            assert parameter.refuses(limit) != itself
            assert parameter.refuses(math.nextafter(limit, -direction * math.inf))
            assert not parameter.refuses(limit + direction if whole else math.nextafter(limit, direction * math.inf))
    if parameter.default is not None:
        assert not parameter.refuses(parameter.default)
    for example in parameter.example if isinstance(parameter.example, tuple) else (parameter.example,):
        assert not isinstance(example, int | float) or not parameter.refuses(example)


def test_an_example_must_obey_its_own_limits():
    with pytest.raises(ValueError, match="the example of K must be greater than 0, got 0"):
        param("K", "depth of one peck", above=0, example=0)
    with pytest.raises(ValueError, match="one of 1, 2"):
        param("D", "direction", choices={1: "x", 2: "y"}, example=3)


@together("code", mnclab.controls["mnc"].cycles, lambda code: "mnc")
def test_every_parameter_of_a_drilling_cycle_has_an_example(code):
    assert all(parameter.example is not None for parameter in mnclab.controls["mnc"].cycles[code].parameters())


@cache
def help_of(control, code):
    """As text and as a page."""
    found = mnclab.help(code, control)
    return str(found), found._repr_html_()


@each_parameter
def test_a_parameter_can_be_explained(control, code, parameter, row):
    """A meaning short enough for an alarm, and a line in the help table."""
    assert parameter.meaning and parameter.unit and len(parameter.meaning) <= 50
    text, page = help_of(control, code)
    assert parameter.address in [line.partition("  ")[0] for line in text.splitlines()]
    assert f"<code>{parameter.address}</code>" in page
    for choice, meaning in (parameter.choices or {}).items():
        assert f"{choice:g} {meaning}" in text and escape(f"{choice:g} {meaning}") in page


@pytest.mark.parametrize("name", sorted(mnclab.controls))
def test_no_family_of_cycles_is_deeper_than_three_classes(name):
    """A cycle, what the cycles of its chapter share, and what all cycles at a surface share: nobody looks farther for a rule."""
    for cycle in mnclab.controls[name].cycles.values():
        family = [each.__name__ for each in cycle.__mro__ if issubclass(each, Cycle) and each is not Cycle]
        assert len(family) <= 3, family
