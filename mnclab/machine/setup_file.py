"""A setup written in a file (TOML), for the command line and for machines that several programs share."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mnclab.machine.probe import Probe, Setter
from mnclab.machine.setup import Datum, Setup
from mnclab.path.limits import Limits
from mnclab.path.machines import kinematics_in, kinematics_of, limits_of
from mnclab.path.tool import Tool, record
from mnclab.text.alarm import Alarm
from mnclab.text.file import File, as_table, as_tables, check_names, parse
from mnclab.text.given import check_number, shown
from mnclab.text.opening import opened
from mnclab.workpiece.blank import blank_of, point_of
from mnclab.workpiece.part import Part, box, mesh

#: The format, as the help of the command line shows it.
FORMAT = """\
start = [0, 0, 300]            # machine position of the spindle before the program, mm
part = "cut"                   # a probe touches what the program has cut; or a table [part] with box = [[…], […]],
                               # design = "part.toml" or mesh = "part.stl", turned (degrees about Z), at = [x, y, z]: its zero
                               # point in machine coordinates; errors = { taper, bow, bowed, roughness, grain, seed, burr }

[tools.1]                      # the row of the tool table; every key may be left out
radius = 5                     # mm; also length, name, corner, dl, dr, teeth, kind, cutting_length, pitch,
length = 80                    # and in degrees angle (of the point) and plunge_angle; of a lathe tool main_angle and
                               # auxiliary_angle, from the axis to the edges, and width of a blade in mm; for
                               # collisions centre_cutting (true, false), hand, shank = [radius, from],
                               # holder = [[radius, from], …], mm above the tip; locked (true, false); for measuring it
                               # wear = { length, radius, corner, break_length, break_radius, offset_length, offset_radius }

[datums]                       # work offsets: machine coordinates of the zero points, mm
1 = [100, 50, -200]
2 = { x = 300, y = 50, z = -200, rotation = 30 }

[stock]                        # the blank, machine coordinates: low and high, two corners; design = "part.toml", the part
                               # of a drawing, turned_over = true with its lower side up; or a cylinder about an axis:
radius = 25                    # mm; also bore (of a tube), axis "X", "Y" or "Z", at (a point on the axis)
low = -60
high = 2

[[fixtures]]                   # what holds the blank (on a lathe: the chuck), written like the stock, one table each
low = [-30, 0, -20]
high = [0, 40, 15]

[presets]                      # written like datums, where a control has them
[correctors]                   # offsets along the axes, written like datums, where words D or L name them
[limits]                       # rapid, acceleration, jerk, corner_speed, corner_tolerance, corner_jump, rapid_motion,
                               # spindle, spindle_acceleration, tool_change; a number, or [x, y, z] per axis;
                               # travel = [[0, 400], [0, 300], [-200, 0]]: how far the axes go, machine coordinates;
                               # or, above all tables, limits = "small-mill", a machine that has a name
[kinematics]                   # the rotary axes, from the machine on: head to the tool, table to the part; or, above all
table = [{ name = "A", centre = [0, 0, 50], limits = [-120, 120] }, { name = "C" }]  # tables, kinematics = "table-ac"
                               # of an axis also direction = [x, y, z] and home, degrees; shift = [x, y, z] of all;
                               # [true_kinematics] is written alike, its axes may have backlash, degrees
[probe]                        # clearance, reach, feed, rapid, positioning, track, angle, offset [x, y]: as its table has it;
                               # true_offset, deflection [x, y, z], spread, seed, stem, stem_length: as it is
[setter]                       # what measures tools, machine coordinates: x, y, z, diameter of a plate; or axis "X" or "Y" of a
                               # beam and its slope; off = [x, y, z], how far it truly stands from there
[true_tools]                   # tools as they truly are, written like tools, with runout = [x, y] of their axis and
                               # edges = [[length, radius], …], the deviations of single edges
[settings]                     # choices of the control: mnclab help settings --control NAME lists them
[files]                        # names that programs call -> files, seen from this one
[variables]                    # values that are there before the program: QR1 = 2.5, QS1 = "text"
"""

ROWS = {"tools": Tool, "datums": Datum, "presets": Datum, "correctors": Datum, "true_tools": Tool}
RECORDS = {"limits": Limits, "probe": Probe, "setter": Setter}
TURNING = ("kinematics", "true_kinematics")
KNOWN = ("start", "stock", "part", "fixtures", *ROWS, *RECORDS, *TURNING, "settings", "files", "variables")


def load(path: str | Path) -> Setup:
    """The setup of a file; an Alarm names what is wrong in it."""
    return parse(path, setup_of, "setup")


def setup_of(table: Mapping[str, Any], file: File) -> Setup:
    """The setup that a table writes."""
    check_names(table, KNOWN, "a setup", file)
    found: dict[str, Any] = {}
    for name, value in table.items():
        with file.at(name):
            if name == "start":
                found[name] = point_of(value, name)
            elif name == "part":
                found[name] = part_of(value, name, file)
            elif name == "fixtures":
                each = enumerate(as_tables(value, name))
                found[name] = tuple(blank_of(as_table(table, name), name, file, name, str(k)) for k, table in each)
            elif name == "limits" and isinstance(value, str):
                found[name] = limits_of(value)
            elif name in RECORDS:
                found[name] = _record(RECORDS[name], value, file, name)
            elif name in TURNING:
                found[name] = kinematics_of(value) if isinstance(value, str) else kinematics_in(value, file, name=name)
            else:
                found[name] = TABLES[name](as_table(value, name), name, file)
            Setup(**{name: found[name]})  # what is wrong with this part alone is shown at its place
    return Setup(**found, source=file)


def _rows(table: Mapping[str, Any], name: str, file: File) -> dict[int, Any]:
    """The rows of a table of tools or datums; an Alarm for one that is written twice, as 1 and as 01."""
    found: dict[int, Any] = {}
    for key, value in table.items():
        with file.at(name, key):
            if not (key.isascii() and key.isdigit() and len(key) < 10):
                raise Alarm(f"a row of {name} must be a whole number, got {shown(key)}")
            row = int(key)
            if row in found:
                raise Alarm(f"{name} has the row {row} twice")
        found[row] = _record(ROWS[name], value, file, name, key)
        if isinstance(found[row], Tool) and "number" in value and found[row].number != row:
            with file.at(name, key, "number"):
                told = f"{name}.{key}.number must be {row}, that of its row, got {found[row].number:g}"
                raise Alarm(told, hint="a tool has the number of its row; leave it out")
    return found


def _record(kind: Any, value: Any, file: File, *keys: str) -> Any:
    """What `record` reads, and a datum from a list."""
    if kind is Datum and isinstance(value, list):
        with file.at(*keys):
            return Datum(*point_of(value, ".".join(keys)))
    return record(kind, value, file, *keys)


def _stock(table: Mapping[str, Any], stock: str, file: File) -> Any:
    """The blank, or the finished part of a design as the next one; its file is seen from the one that names it."""
    if "design" not in table:
        return blank_of(table, stock, file, stock)
    check_names(table, ("design", "turned_over"), f"{stock} of a design", file, stock)
    name, over = table["design"], table.get("turned_over", False)
    with file.at(stock, "design"):
        if not isinstance(name, str):
            raise Alarm(f"{stock}.design must be the name of a file, got {shown(name)}")
        try:
            found = opened("mnclab.design.model", "Design").load(Path(file.name).parent / name)
        except Alarm as fault:
            line = f"{name}:{fault.span.line}" if fault.span else name
            raise Alarm(f"{stock}.design: {line}: {fault.message}", hint=fault.hint) from None
    with file.at(stock, "turned_over"):
        if not isinstance(over, bool):
            raise Alarm(f"{stock}.turned_over must be true or false, got {shown(over)}")
    return found.turned_over() if over else found


def _files(table: Mapping[str, Any], files: str, file: File) -> dict[str, Path]:
    """Files by name, seen from the one that names them."""
    for key, name in table.items():
        with file.at(files, key):
            if not isinstance(name, str):
                raise Alarm(f"files.{key} must be a text, got {shown(name)}")
    return {key: Path(file.name).parent / name for key, name in table.items()}


#: What reads a part of a setup that is a table in the file.
TABLES: dict[str, Callable[[Mapping[str, Any], str, File], Any]] = {
    **dict.fromkeys(ROWS, _rows), "files": _files, "stock": _stock,
    **dict.fromkeys(("settings", "variables"), lambda table, name, file: table),
}  # fmt: skip


# The part that a probe touches, as a setup file says it: a box, the part of a design, or a mesh, put somewhere with errors.

BODIES = ("box", "design", "mesh")
ERRORS = ("taper", "bow", "bowed", "roughness", "grain", "seed", "burr")


def part_of(given: Any, name: str, file: File) -> Any:
    """`"cut"` as it is; a table as a Part: its body, `turned` about Z by degrees, then with its zero point `at` a place, mm."""
    if isinstance(given, str):
        return given
    table = as_table(given, name)
    check_names(table, (*BODIES, "turned", "at", "errors"), name, file, name)
    bodies = [each for each in BODIES if each in table]
    if len(bodies) != 1:
        raise Alarm(f"{name} needs one of {', '.join(BODIES)}, got {' and '.join(bodies) or 'none'}")
    with file.at(name, bodies[0]):
        found = _body(table[bodies[0]], bodies[0], file)
    if "errors" in table:
        found = _with_errors(found, table["errors"], file, name)
    with file.at(name, "turned" if "turned" in table else bodies[0]):
        check_number(table.get("turned", 0.0), f"{name}.turned")
        found = found.turned(table.get("turned", 0.0))
    if "at" in table:
        with file.at(name, "at"):
            found = found.shifted(*point_of(table["at"], f"{name}.at"))
    return found


def _body(given: Any, kind: str, file: File) -> Part:
    if kind == "box":
        if not isinstance(given, list) or len(given) != 2:
            raise Alarm(f"part.box must be two corners, got {shown(given)}", hint="box = [[0, 0, -20], [100, 60, 0]]")
        low, high = (point_of(each, "a corner of part.box") for each in given)
        return box(low, high)
    if not isinstance(given, str):
        raise Alarm(f"part.{kind} must be the name of a file, got {shown(given)}")
    path = Path(file.name).parent / given
    if kind == "mesh":
        return mesh(path)
    return opened("mnclab.design.model", "Design").load(path).part


def _with_errors(part: Part, given: Any, file: File, name: str) -> Part:
    with file.at(name, "errors"):
        errors: Mapping[str, Any] = as_table(given, f"{name}.errors")
        check_names(errors, ERRORS, f"{name}.errors", file, name, "errors")
        return part.with_errors(**{key: tuple(each) if isinstance(each, list) else each for key, each in errors.items()})
