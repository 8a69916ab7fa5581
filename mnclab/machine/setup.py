"""What is on the machine before a program starts: tools, datums, blank, part, limits, and choices of the control."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, fields, is_dataclass, replace
from pathlib import Path
from types import MappingProxyType, UnionType
from typing import TYPE_CHECKING, Any, NamedTuple

from mnclab.geometry.kinematics import Kinematics
from mnclab.machine.probe import Probe, Setter
from mnclab.path.limits import Limits
from mnclab.path.listing import figure
from mnclab.path.machines import MachineFile, kinematics_of, limits_of
from mnclab.path.tool import Tool, Wear
from mnclab.text.alarm import Alarm, several
from mnclab.text.given import LARGEST, check_number, check_point, fitting_class, of_python, shown
from mnclab.text.tables import html_table, written
from mnclab.workpiece.blank import Box, Revolved, Sized, blank
from mnclab.workpiece.part import Part

# The tools of a machine that was given none, so that a first program needs no table.
# Lengths are 0: the tip is the spindle reference. A control says which magazine is its own (`Control.magazine`).

Magazine = Mapping[int, Tool]


def _end_mill(number: int, radius: float, edges: float, teeth: int) -> Tool:
    return Tool(
        radius, number=number, name=f"end mill {2 * radius:g}", plunge_angle=3, cutting_length=edges, teeth=teeth,
        kind="mill", centre_cutting=True,
    )  # fmt: skip


#: Of a mill.
MILLS: Magazine = MappingProxyType({
    0: Tool(number=0, name="none"),
    1: _end_mill(1, 5, edges=25, teeth=3),
    2: Tool(radius=4, number=2, name="drill 8", angle=118, cutting_length=60, teeth=2, kind="drill"),
    3: _end_mill(3, 3, edges=20, teeth=3),
    4: _end_mill(4, 2, edges=12, teeth=2),
    5: _end_mill(5, 8, edges=40, teeth=4),
    6: Tool(radius=2, number=6, name="probe 4", kind="probe"),
})  # fmt: skip

#: Of a lathe: a tip is the imaginary sharp point, the corner the radius of the nose. Main edges stand square to the axis:
#: the walls that a cycle runs along at rapid are cut then.
LATHES: Magazine = MappingProxyType({
    0: Tool(number=0, name="none"),
    1: Tool(number=1, name="roughing insert 80°", corner=0.8, main_angle=90, auxiliary_angle=10, kind="turning"),
    2: Tool(number=2, name="finishing insert 35°", corner=0.4, main_angle=90, auxiliary_angle=55, kind="turning"),
    3: Tool(number=3, name="grooving blade 3", width=3, kind="grooving"),
    4: Tool(number=4, name="threading insert 60°", main_angle=60, auxiliary_angle=60, cutting_length=2, kind="thread"),
    5: Tool(number=5, name="boring bar", corner=0.4, main_angle=90, auxiliary_angle=30, kind="boring"),
    6: Tool(number=6, name="drill 10", radius=5, angle=118, kind="drill"),
    7: Tool(number=7, name="face grooving blade 3", width=3, kind="face grooving"),
    8: Tool(radius=6, number=8, name="tap M12", pitch=1.75, kind="tap"),
})  # fmt: skip


class _Datum(NamedTuple):
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    a: float = 0.0
    b: float = 0.0
    c: float = 0.0
    rotation: float = 0.0
    tilt_x: float = 0.0
    tilt_y: float = 0.0

    def __repr__(self) -> str:
        return written(self)


class Datum(_Datum):
    """A zero point: machine coordinates in mm, angles in degrees; an Alarm if it is none.

    `a`, `b`, `c` are where the rotary axes count from, `rotation` turns the plane; `tilt_x` and `tilt_y` are turns about the
    fixed axes X and Y before that, of a workpiece that does not lie level (SPA, SPB and SPC of a preset table).

    >>> mnc.Datum(100, 50, 20)
    Datum(x=100, y=50, z=20)
    """

    __slots__ = ()

    def __new__(cls, *values: float, **named: float) -> Datum:
        found = super().__new__(cls, *map(of_python, values), **{name: of_python(value) for name, value in named.items()})
        for name, value in zip(cls._fields, found):
            check_number(value, f"{name} of a datum", at_least=-LARGEST, at_most=LARGEST)
        return found

    def __str__(self) -> str:
        """In few words: what is not zero, as `X50.1 Y29.9 rotation 2`."""
        names = (name.upper() if len(name) == 1 else f"{name} " for name in self._fields)
        said = [f"{name}{figure(value, 6)}" for name, value in zip(names, self) if value]
        return " ".join(said) or "X0 Y0 Z0"


ROWS = ("tools", "datums", "presets", "correctors", "true_tools")
NAMED = ("files", "settings", "variables")

NAMED_BY: dict[str, Callable[[Any], Any]] = {"limits": limits_of, "kinematics": kinematics_of}

Check = Callable[[str, Any], None]  # an Alarm unless what is given for a part, or for a piece of it, is right


def _must(good: bool, what: str, be: str, given: Any) -> None:
    if not good:
        raise Alarm(f"{what} must be {be}, got {shown(given)}")


def _a(kind: type | UnionType, be: str) -> Check:
    return lambda what, given: _must(isinstance(given, kind), what, be, given)


def _by_number(check: Check) -> Check:
    """Of a table: its rows are numbers, and what stands in them is right."""

    def rows(what: str, given: Any) -> None:
        _must(isinstance(given, Mapping), what, "a dict", given)
        for row in given:
            check_number(row, f"a row of {what}", at_least=0)
        for row, each in given.items():
            check(f"{what}[{row}]", each)

    return rows


def _names(check: Check) -> Check:
    """Of values by name."""

    def names(what: str, given: Any) -> None:
        named = isinstance(given, Mapping) and all(isinstance(name, str) for name in given)
        _must(named, what, "a dict with names", given)
        for name, each in given.items():
            check(f"{what}[{name!r}]", each)

    return names


def _datum(what: str, given: Any) -> None:
    given = of_python(given)
    few = isinstance(given, tuple | list) and len(given) <= len(Datum._fields)
    _must(few, what, "a Datum or its numbers", given)
    Datum(*given)


def _start(what: str, given: Any) -> None:
    check_point(given, what)
    for value in given:
        check_number(value, f"a coordinate of {what}", at_least=-LARGEST, at_most=LARGEST)


def _variable(what: str, given: Any) -> None:
    if not isinstance(given, str):
        check_number(given, what)


def _stock(what: str, given: Any) -> None:
    _must(given is None or blank(given) is not None, what, "three sizes, two corners (x, y, z), or a blank", given)


def _part(what: str, given: Any) -> None:
    cut = isinstance(given, str) and given == "cut"
    _must(given is None or cut or isinstance(given, Part), what, 'a part, or "cut" for what the program cuts', given)


def _fixtures(what: str, given: Any) -> None:
    listed = isinstance(given, tuple | list) and not isinstance(given, Box | Revolved)
    _must(listed, what, "a list, fixtures=[…], of boxes and parts", given)
    for number, each in enumerate(given):
        if not isinstance(each, Part):
            _stock(f"{what}[{number}]", each)
            placed = each is not None and not isinstance(blank(each), Sized)
            _must(placed, f"{what}[{number}]", "two corners, a blank that has a place, or a part", each)


def _tools(what: str, given: Any) -> None:
    if given is not None:
        _by_number(_tool)(what, given)


def _tool(what: str, given: Any) -> None:
    bare = isinstance(given, int | float)
    hint = f"{shown(given)} may be a radius or a diameter: mnclab.Tool(radius=…) or mnclab.Tool(diameter=…)" if bare else ""
    if not isinstance(given, Tool):
        raise Alarm(f"{what} must be a Tool, got {shown(given)}", hint=hint)


TURNS = 'the rotary axes of the machine, or the name of one that has some: Setup(kinematics="table-ac")'

#: What each part of a setup is: what checks it, and the hint of an alarm about it.
MEANT: Mapping[str, tuple[Check, str]] = {
    "tools": (_tools,
              "a tool is its radius and length in mm, and what else is known of it: "
              'Setup(tools={1: mnclab.Tool(diameter=8, length=80, kind="drill")})'),
    "datums": (_by_number(_datum), "a datum is a zero point in machine coordinates, mm: Setup(datums={1: (100, 50, -200)})"),
    "presets": (_by_number(_datum), "a preset is a zero point in machine coordinates, mm: Setup(presets={1: (100, 50, -200)})"),
    "correctors": (_by_number(_datum), "a corrector is an offset along the axes, mm: Setup(correctors={1: (0, 0, 80)})"),
    "stock": (_stock, "the blank is two corners, or mnclab.cylinder(diameter=50, length=60), or three sizes, with its corner at "
              "the datum and its top at Z0: Setup(stock=(60, 40, 20))"),
    "part": (_part, "a part is what a probe touches: Setup(part=mnclab.part.box((0, 0, -20), (60, 40, 0)))"),
    "fixtures": (_fixtures, "fixtures hold the blank, on a lathe the chuck: Setup(fixtures=(((0, 0, -20), (10, 40, 15)),))"),
    "probe": (_a(Probe, "a Probe"), "how a touch probe moves: Setup(probe=mnclab.Probe(clearance=2, reach=10, feed=100))"),
    "setter": (_a(Setter | None, "a Setter"),
               "a plate or a beam that measures tools: Setup(setter=mnclab.Setter(x=300, y=200, z=-400, diameter=40))"),
    "limits": (_a(Limits, "a Limits, or the name of a machine"),
               'what the axes can do: Setup(limits="small-mill") or Setup(limits=mnclab.Limits(rapid=10000, acceleration=1000))'),
    "start": (_start,
              "where the spindle stands before the program, machine coordinates, mm: Setup(start=(0, 0, 300))"),
    "files": (_names(_a(str | Path, "a text or a Path")),
              "other programs and tables by name, each a text or a path: "
              'Setup(files={"SUB.H": pathlib.Path("sub.h")})'),
    "settings": (_names(_a(object, "anything")),
                 "choices of the control, listed by mnclab.help(\"settings\", control): "
                 'Setup(settings={"block_skip": True})'),
    "variables": (_names(_variable), 'values that are there before the program: Setup(variables={"QR1": 2.5})'),
    "kinematics": (_a(Kinematics | None, "a Kinematics, or the name of a machine that has one"), TURNS),
    "true_kinematics": (_a(Kinematics | None, "a Kinematics"), "where the rotary axes truly are: Setup(true_kinematics=…)"),
    "true_tools": (_by_number(_a(Tool, "a Tool")),
                   "what a tool truly is, beside its row of the table: Setup(true_tools={1: mnclab.Tool(radius=3.98)})"),
}  # fmt: skip


if TYPE_CHECKING:

    class LimitsOf:
        """Limits, also where the name of a machine was given."""

        def __get__(self, setup: Any, kind: Any = None) -> Limits: ...
        def __set__(self, setup: Any, given: Limits | str) -> None: ...


@fitting_class
@dataclass(frozen=True)
class Setup:
    """Everything a program finds on the machine; never changed by a run, which keeps a copy that nobody can write to.

    `tools` None: those of the magazine of the control. `start` is the spindle reference, mm; it, `part`, `stock` and
    `fixtures` are in machine coordinates. `part` "cut" is what the program itself has cut so far. `fixtures` are pairs of
    corners, blanks and parts; on a lathe, the chuck. `stock` is the blank:
    three sizes, with its corner at the datum from which the path counts and its top at Z0, two corners, or a body of
    revolution (`mnclab.cylinder`). `limits` may be the name of a machine (`mnclab.machines()`). `files` maps names to texts or
    paths of other programs and tables. `settings` overrides the declared choices of the control
    (`mnclab.help("settings", control)`).
    `correctors` are offsets along the axes, mm, of the controls whose words D or L name them. Tools given without a
    number get the one they are listed under. `variables` have values before the program begins: what another left
    (`run.variables`). `source` is the file that the setup was read from: an alarm about a setting shows its line.
    `true_tools` are the tools as they truly are, by the number of their row in the table, where they differ from it (what is
    not said of one is as the table has it): what cuts, and what probing and measuring find. `setter` is the tool setter that
    measures them, if there is one. `kinematics` are the rotary axes of the machine, or the name of one that has some; None:
    three axes, and A B C are positions of their own. `true_kinematics` is where they truly are, which is what cuts
    and probes; None: as the control has it. An Alarm names what cannot be.

    >>> mnc.Setup(tools={1: mnc.Tool(diameter=10)}, stock=(80, 60, 20))
    Setup
      T1: tool, radius 5 mm
      stock: 80 x 60 x 20 mm, its corner at the datum, its top at Z0
      probe: as usual
      limits: as usual
      start: X0 Y0 Z0
    """

    tools: Magazine | None = None
    datums: Mapping[int, Datum | tuple[float, ...]] = field(default_factory=dict)
    presets: Mapping[int, Datum | tuple[float, ...]] = field(default_factory=dict)
    correctors: Mapping[int, Datum | tuple[float, ...]] = field(default_factory=dict)
    stock: Any = None
    part: Any = None
    fixtures: Sequence[Any] = ()
    probe: Probe = Probe()
    if TYPE_CHECKING:
        limits: LimitsOf = LimitsOf()
    else:
        limits: Limits = field(default_factory=Limits)
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)
    files: Mapping[str, str | Path] = field(default_factory=dict)
    settings: Mapping[str, Any] = field(default_factory=dict)
    kinematics: Any = None
    true_kinematics: Kinematics | None = None
    true_tools: Mapping[int, Tool] = field(default_factory=dict)
    setter: Setter | None = None
    variables: Mapping[str, float | str] = field(default_factory=dict)
    source: Any = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if isinstance(own := getattr(self.part, "part", None), Part):  # of a workpiece or a design
            object.__setattr__(self, "part", own)
        for name, named in NAMED_BY.items():
            if isinstance(given := getattr(self, name), str | MachineFile):
                try:
                    object.__setattr__(self, name, named(given))
                except Alarm as alarm:
                    raise Alarm(f"{name}: {alarm.message}", hint=alarm.hint) from None
        for name, (check, means) in MEANT.items():
            try:
                check(name, getattr(self, name))
            except Alarm as alarm:
                alarm.hint = alarm.hint or means
                raise
        for name in ROWS if self.tools is not None else ROWS[1:]:
            rows = [(row, of_python(each)) for row, each in getattr(self, name).items()]
            object.__setattr__(self, name, {row: tuple(v) if isinstance(v, list) else v for row, v in rows})
        for name in NAMED:
            object.__setattr__(self, name, dict(getattr(self, name)))
        object.__setattr__(self, "start", tuple(map(float, self.start)))

    def __repr__(self) -> str:
        return "\n".join(["Setup", *(f"  {title}: {said}" for title, said in page(self))])

    def _repr_html_(self) -> str:
        return f"<h4>Setup</h4>{html_table((), page(self))}"

    def kept(self, magazine: Magazine = MILLS) -> Setup:
        """A copy, checked again, whose tables nobody can write to: what a run was made with, the tools of a magazine if
        it had none."""
        if (moves := self.true_kinematics) is not None:
            there = "none" if self.kinematics is None else self.kinematics.names
            if there != moves.names:
                what = f"true_kinematics has the axes {moves.names}, and kinematics has {there}"
                raise Alarm(what, hint="both name the same axes: kinematics as the control has them, true_kinematics as they are")
        tools = magazine if self.tools is None else self.tools
        found = replace(self, tools=tools, stock=deepcopy(self.stock), fixtures=deepcopy(tuple(self.fixtures)))
        true = {n: _truly(each, tools[n]) if n in tools else each for n, each in self.true_tools.items()}
        object.__setattr__(found, "true_tools", true)
        for name in (*ROWS, *NAMED):
            object.__setattr__(found, name, MappingProxyType(getattr(found, name)))
        return found

    def __reduce__(self) -> tuple[Any, ...]:
        """For copies and pickles, which take no mapping that is only read."""
        values = {each.name: getattr(self, each.name) for each in fields(self)}
        tables = {name: dict(values[name]) for name in (*ROWS, *NAMED) if values[name] is not None}
        return _again, (values | tables, isinstance(self.datums, MappingProxyType))

    def with_radius(self, radius: float) -> Setup:
        """The same machine with another radius, mm, in all its tools but the probes."""
        given = MILLS if self.tools is None else self.tools
        tools = {n: t if t.kind == "probe" else t.of_radius(radius) for n, t in given.items()}
        return replace(self, tools=tools)

    def with_settings(self, **settings: Any) -> Setup:
        """The same machine with some settings changed."""
        return replace(self, settings={**self.settings, **settings}, source=None)


def _truly(tool: Tool, row: Tool) -> Tool:
    """A tool as it is, of which only some is said: the rest is as its row of the table has it."""
    usual = Tool()
    said = {name: getattr(tool, name) for name in vars(usual) if getattr(tool, name) != getattr(usual, name)}
    for size, delta in (("length", "dl"), ("radius", "dr")):
        if size in said:
            said[delta] = getattr(tool, delta)
    return replace(row.of_radius(tool.radius) if "radius" in said else row, **said | {"number": row.number})


def _again(values: Mapping[str, Any], kept: bool) -> Setup:
    """A setup of a copy or a pickle."""
    found = Setup(**values)
    return found.kept() if kept else found


def check_rows(setup: Setup) -> None:
    """An Alarm where datums bear the numbers of G54 to G59: their rows in a table are 1 to 6. A long table may have others."""
    for row in setup.datums:
        if 54 <= row <= 59 and not any(6 < other < 54 for other in setup.datums):
            place = setup.source and setup.source.place_of("datums", str(row))
            what = f"row {row} of datums is that of no work offset: G54 to G59 are the rows 1 to 6"
            raise Alarm(what, place, hint=f"for G{row}: Setup(datums={{{row - 53}: …}})", source=setup.source)


class Tables:
    """The tables of one run: copies that the program may write to."""

    def __init__(self, setup: Setup, magazine: Magazine = MILLS) -> None:
        self.tools: dict[int, Tool] = {0: magazine[0]}
        for number, tool in (magazine if setup.tools is None else setup.tools).items():
            self.tools[number] = tool if tool.number == number else replace(tool, number=number)
        self.datums, self.presets, self.correctors = (
            {row: Datum(*datum) for row, datum in table.items()}
            for table in (setup.datums, setup.presets, setup.correctors)
        )
        self.probe = setup.probe
        self.kinematics: Kinematics | None = setup.kinematics

    def __repr__(self) -> str:
        rows = (several(len(getattr(self, name)), name[:-1]) for name in ("tools", "datums", "presets"))
        return f"<Tables: {', '.join(rows)}>"


# A setup as people read it: one row for each thing on the machine, in words with units.

AXES = ("X", "Y", "Z", "A", "B", "C", "rotation ", "tilt about X ", "tilt about Y ")  # of a datum
TITLES = {"datums": "datum", "presets": "preset", "correctors": "corrector"}
NAMED_TITLES = {"files": "file", "settings": "setting", "variables": "variable"}
UNITS = {
    "angle": "°", "plunge_angle": "°", "main_angle": "°", "auxiliary_angle": "°", "teeth": "",
    "feed": " mm/min", "rapid": " mm/min", "acceleration": " mm/s²", "jerk": " mm/s³", "corner_jump": " mm/min",
    "corner_speed": "", "rapid_motion": "", "spindle": " rev/min", "spindle_acceleration": " rev/min in a second",
    "tool_change": " s", "centre_cutting": "", "hand": "", "shank": " mm", "holder": " mm", "positioning": "", "track": "",
    "seed": "", "locked": "", "edges": " mm", "axis": "", "slope": "", "runout": " mm",
}  # fmt: skip
MM = " mm"  # of all others


def page(setup: Setup) -> list[tuple[str, str]]:
    """What there is and how it is, in the order of declaration."""
    return list(_told(setup))


def _told(setup: Setup) -> Iterator[tuple[str, str]]:
    usual = next((each for each in (MILLS, LATHES) if setup.tools == each), None)
    if setup.tools is None:
        yield "tools", "those of the control"
    elif usual is not None:
        yield "tools", f"the usual ones: {', '.join(tool.name for tool in usual.values() if tool.kind)}"
    else:
        yield from ((f"T{number}", tool_line(tool)) for number, tool in setup.tools.items())
    for name, title in TITLES.items():
        yield from ((f"{title} {row}", place(each)) for row, each in getattr(setup, name).items())
    if setup.stock is not None:
        stock = blank(setup.stock)
        if isinstance(stock, Sized):
            wide, deep, high = (figure(float(size)) for size in stock.bounds[1] - stock.bounds[0])
            yield "stock", f"{wide} x {deep} x {high} mm, its corner at the datum, its top at Z0"
        else:
            yield "stock", f"{place(stock.low)} to {place(stock.high)}" if isinstance(stock, Box) else str(stock)
    if setup.part is not None:
        cut = "what the program has cut so far" if setup.part == "cut" else None
        yield "part", cut or repr(setup.part)
    yield from (("fixture", str(each)) for each in setup.fixtures)
    yield from ((f"true T{number}", tool_line(tool)) for number, tool in setup.true_tools.items())
    yield "probe", ", ".join(_different(setup.probe, type(setup.probe)())) or "as usual"
    if setup.setter is not None:
        yield "setter", ", ".join(_different(setup.setter, type(setup.setter)())) or "as usual"
    yield "limits", ", ".join(_different(setup.limits, Limits())) or "as usual"
    if setup.kinematics is not None:
        yield "rotary axes", str(setup.kinematics)
    yield "start", place(setup.start)
    for name, title in NAMED_TITLES.items():
        yield from ((f"{title} {key}", shown(each)) for key, each in getattr(setup, name).items())


def tool_line(tool: Tool) -> str:
    """`end mill 10, radius 5 mm, plunge angle 3°`: what is known of a tool, but for its number."""
    sizes = _different(tool, Tool(), leave=("number", "name", "kind"))
    return ", ".join([tool.name or tool.kind or "tool", *sizes])


def place(values: Any) -> str:
    """A point or datum: X, Y and Z in mm, then the angles that are not 0, in degrees."""
    told = zip(AXES, (*values, 0.0, 0.0, 0.0)[: max(len(values), 3)])
    return " ".join(f"{axis}{figure(float(value))}" for k, (axis, value) in enumerate(told) if k < 3 or value)


def _different(record: Any, usual: Any, leave: tuple[str, ...] = ()) -> Iterator[str]:
    """The values of a record that differ from the usual ones, each with its name and unit."""
    names = [each.name for each in fields(record)] if is_dataclass(record) else record._fields
    for name in names:
        value = getattr(record, name)
        if name in leave or value == getattr(usual, name):
            continue
        if isinstance(value, Wear):
            yield from (f"{name} {said}" for said in _different(value, Wear()))
        else:
            yield f"{name.replace('_', ' ')} {_value(value, name == 'travel')}{UNITS.get(name, MM) if value is not None else ''}"


def _value(value: Any, travel: bool = False) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, tuple):  # of each axis; of travel from and to
        if travel:
            return ", ".join(f"{axis} {_value(low)} to {_value(high)}" for axis, (low, high) in zip("XYZ", value))
        return (", " if value and isinstance(value[0], tuple) else " ").join(map(_value, value))
    if value is None:
        return "none"
    return value if isinstance(value, str) else figure(float(value))
