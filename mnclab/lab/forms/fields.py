"""A field of a form or a panel: a box to type in, the tick of a word that may be left out, the fault that stands below.

The fields of a cycle stand in groups that fold: what it makes, how deep it goes, how fast, and how it is done. The group
follows from the unit of a parameter and the words of its meaning; a cycle says nothing of it, so that one that is added
tomorrow has groups, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any, NamedTuple

from mnclab.machine import trial
from mnclab.machine.cycle import Parameter, left_out, limits
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown

ROWS = 17  # of fields and heads that the first screen of a small laptop has room for
LINE = 46  # letters of a name that stand in one line of a form


class Field:
    """One row of a form or a panel: what is typed into, with its fault below."""

    def __init__(self, box: Any, *beside: Any, tick: Any = None, number: int = 0, parameter: Any = None) -> None:
        import ipywidgets

        self.box, self.tick, self.facts = box, tick, box.tooltip
        self.parts = (*([] if tick is None else [tick]), box, *beside)
        self.row, self.parameter = ipywidgets.HBox(self.parts), parameter
        self.fault: Any = None
        self.head: Any = None  # of its group
        self.row.add_class("mnclab-row")
        self.row.add_class(f"mnclab-p{number}")

    def tell(self, sentence: str) -> None:
        """Say what is wrong with the value, or with no sentence that nothing is; what was folded is opened for it."""
        import ipywidgets

        told = f'<div role="alert" class="mnclab-fault">{escape(sentence)}</div>' if sentence else ""
        if self.fault is None and not sentence:
            return
        if self.fault is None:
            self.fault = ipywidgets.HTML()
        self.fault.value = told
        wanted = (*self.parts, self.fault) if sentence else self.parts
        if self.row.children != wanted:  # the box stays where it is, and keeps the cursor
            self.row.children = wanted
        (self.row.add_class if sentence else self.row.remove_class)("mnclab-wrong")
        self.box.tooltip = "; ".join(filter(None, [sentence, self.facts or ""])) or None
        if sentence and self.head is not None:
            self.head.value = True


def fold(name: str, opened: bool) -> Any:
    """The head of what folds: a button, whose state the style sheet shows and obeys."""
    import ipywidgets

    head = ipywidgets.ToggleButton(opened, description=name, tooltip=f"show or hide {name}")
    head.add_class("mnclab-fold")
    return head


def folded(name: str, body: Any, opened: bool) -> list[Any]:
    """A head and what it shows and hides."""
    body.add_class("mnclab-folded")
    return [fold(name, opened), body]


def grouped(parameters: Iterable[Any], fields: dict[str, Field]) -> list[Any]:
    """The rows of a form in groups; as many groups are open from the first on as have room on a small screen."""
    import ipywidgets

    found = groups(list(parameters))
    if list(found) == [""]:
        return [fields[p.name].row for p in found[""]]
    parts: list[Any] = []
    free = float(ROWS - len(found))
    for place, (name, those) in enumerate(found.items()):
        high = sum(1 if len(fields[p.name].box.description) <= LINE else 1.5 for p in those)
        opened = place == 0 or high <= free
        free -= high if opened else free
        body = ipywidgets.VBox([fields[p.name].row for p in those])
        parts += folded(f"{name} ({len(those)})", body, opened)
        for p in those:
            fields[p.name].head = parts[-2]
    for place, head in enumerate(parts[::2]):  # heads stay in sight where the fields are scrolled
        head.add_class(f"mnclab-above{place}")
        head.add_class(f"mnclab-below{len(found) - 1 - place}")
    return parts


# Boxes to type in: of a number, of a parameter of a cycle, and the tick of a word that may be left out.

LONG = 50  # letters of a choice that have no room in a form in letters of the usual size
STEPS = 100  # of a slider that was given none
NO_UNITS = ("choice", "count", "text")
ORDERS = "(least, greatest), (value, least, greatest) or (least, greatest, step)"

Number = float | tuple[float, float] | tuple[float, float, float]


class NumberField(NamedTuple):
    """A number that may be changed: its first value, its limits and the step of its slider, where there are any."""

    value: float
    limits: tuple[float, float] | None = None
    step: float | None = None


def place_of(name: str, number: Any) -> NumberField:
    """A number, `(value, least, greatest)`, or `(least, greatest, step)`, which begins on a step in the middle; or, as in
    ipywidgets, `(least, greatest)`, which begins in the middle, of whole numbers on a whole one.

    Which of the two orders of three is meant is never in doubt: the first of (40, 10, 60) lies between the others, that of
    (-10, -1, 0.5) does not.
    """
    parts = number if isinstance(number, tuple) else (number,)
    if not 1 <= len(parts) <= 3:
        raise Alarm(f"{name} takes a number, {ORDERS}, got {shown(number)}")
    for part in parts:
        check_number(part, name)
    if len(parts) == 1:
        return NumberField(parts[0])
    first, second, third = (*parts, 0)[:3]
    if len(parts) == 2 and first < second:
        half = (second - first) // 2 if isinstance(second - first, int) else (second - first) / 2
        return NumberField(round(first + half, 9), (first, second))
    if len(parts) == 3 and second <= first <= third:
        return NumberField(first, (second, third))
    if first < second and 0 < third <= second - first:
        return NumberField(on_step(first + (second - first) / 2, first, second, third), (first, second), third)
    hint = f"{name}=(5, 0, 10) is 5 between 0 and 10; {name}=(0, 10, 0.5) is 0 to 10 in steps of 0.5"
    raise Alarm(f"{name} must be {ORDERS}, and the value must lie between its limits, got {shown(number)}", hint=hint)


def on_step(value: float, least: float, greatest: float, step: float) -> float:
    """The nearest value that lies whole steps above the least one, not beyond the greatest, without a rest of digits."""
    steps = min(round((value - least) / step), int((greatest - least) / step + 1e-9))
    found = least + max(steps, 0) * step
    return found if isinstance(found, int) else round(found, 9)


def number_box(name: str, place: NumberField) -> Any:
    """A box for a number; whole numbers stay whole."""
    whole = all(isinstance(each, int) for each in (place.value, place.step or 0))
    looks = {"description": name} | ({} if place.step is None else {"step": place.step})
    return box_of(int if whole else float, place.value, place.limits or (), looks)


def slider_of(box: Any, place: NumberField) -> Any:
    """A slider for a box with limits, which follow each other.

    It has no name for a screen reader: the box has, and is the one that the keyboard goes to. A slider says
    10.000000000000002 for 10 when it appears; only another step than that of the box is a change.
    """
    import ipywidgets

    low, high = place.limits or (0.0, 1.0)
    whole = isinstance(box.value, int)
    step = place.step or (1 if whole else (high - low) / STEPS or 1.0)
    kind = ipywidgets.IntSlider if whole else ipywidgets.FloatSlider
    slider = kind(value=box.value, min=low, max=high, step=step, readout=False, tabbable=False)
    slider.add_class("mnclab-slider")

    def slid(change: Any) -> None:
        wanted = on_step(change["new"], low, high, step)
        if wanted != on_step(box.value, low, high, step):
            box.value = wanted

    slider.observe(slid, "value")
    box.observe(lambda change: setattr(slider, "value", change["new"]), "value")
    return slider


def box_of(kind: type, value: Any, limits: Sequence[float], looks: Mapping[str, Any]) -> Any:
    """A box for whole or other numbers, between limits if there are any."""
    import ipywidgets

    whole = ipywidgets.IntText, ipywidgets.BoundedIntText
    free, bounded = whole if kind is int else (ipywidgets.FloatText, ipywidgets.BoundedFloatText)
    if not limits:
        return free(value=kind(value), **looks)
    return bounded(value=kind(value), min=kind(limits[0]), max=kind(limits[1]), **looks)


def name_of(p: Parameter) -> str:
    """What is written beside a box: `K depth of one peck [mm]`; a meaning that begins with its word says it once."""
    said = p.meaning if p.meaning.split(" ")[0] == p.address else f"{p.address} {p.meaning}"
    return said + (f" [{p.unit}]" if p.unit and p.unit not in NO_UNITS and not p.mark else "")


def parameter_box(p: Parameter) -> Any:
    """The box that fits the kind of a parameter; the tooltip says the rest.

    It takes any number: one outside the limits is not pushed back in silence but refused at its field.
    """
    import ipywidgets

    value = trial.first_value(p)
    otherwise = left_out(p)
    facts = [p.meaning, limits(p), p.note, f"left out: {otherwise}" if otherwise else ""]
    looks = {"description": name_of(p), "tooltip": "; ".join(fact for fact in facts if fact)}
    if trial.is_text(p) or p.several:
        return ipywidgets.Text(value=value, **looks)
    if p.choices:
        options = [(f"{choice:g} {meaning}", choice) for choice, meaning in p.choices.items()]
        box = ipywidgets.Dropdown(options=options, value=value, **looks)
        if max(len(name) for name, _ in options) > LONG:
            box.add_class("mnclab-long")
        return box
    return box_of(int if p.type == "integer" else float, value, (), looks)


def tick_of(p: Parameter, box: Any) -> Any:
    """The tick that writes a word which may be left out; its name is heard, and seen where the mouse rests."""
    import ipywidgets

    written = trial.written_first(p)
    tick = ipywidgets.Checkbox(written, description=f"write {p.address}", indent=False, tooltip=f"write {p.address}")
    tick.add_class("mnclab-tick")
    box.disabled = not written
    tick.observe(lambda change: setattr(box, "disabled", not change["new"]), "value")
    return tick


# The parameters of a cycle in groups that fold.

FEW = 8  # parameters that need no groups
SHAPE, DEPTH, FEED, STRATEGY, RESULT = (
    "Shape and place", "Depths and heights", "Feeds, speed, dwell", "Strategy", "Tolerances and results",
)  # fmt: skip
#: What a meaning says -> its group; the first that fits counts, and of what fits none the unit decides.
WORDS = (
    (RESULT, r"toleranc|limit|permissible|greatest size|least size|monitored|log\b|protocol|result|new (system|coordinate)"
             r"|datum (table|along)|preset|measured values|in table|taken over|Q parameter|beyond"),
    (FEED, r"\b(feed|feeds|dwell|speed)\b(?! reference)"),
    (DEPTH, r"depth|infeed|surface|clearance|height|level|bottom|peck|floor|retract|distance back|chip|tool axis|probe axis"
            r"|stop distance|thickness|way back|depth of cut|per pass"),
    (STRATEGY, r"strateg|operation|scope|climb|overlap|machining direction|direction of machining|kind of|sense"),
    (SHAPE, r"position|corner|angle|slot|axis|direction along|factor along|number of"),
)  # fmt: skip
BY_UNIT = {
    "choice": STRATEGY, "mark": STRATEGY, "ratio": STRATEGY, "%": STRATEGY, "count": STRATEGY, "": STRATEGY,
    "mm/min": FEED, "s": FEED, "ms": FEED, "rev/min": FEED, "0.0001 mm/rev": FEED,
}  # fmt: skip


def group_of(parameter: Parameter) -> str:
    """The group that a parameter belongs to."""
    found = (group for group, words in WORDS if re.search(words, parameter.meaning))
    return next(found, BY_UNIT.get(parameter.unit, SHAPE))


def groups(parameters: Sequence[Parameter]) -> dict[str, list[Parameter]]:
    """Parameters by the name of their group, in the order of the manual; a few of them stand in one without a name."""
    if len(parameters) <= FEW:
        return {"": list(parameters)}
    found: dict[str, list[Parameter]] = {name: [] for name in (SHAPE, DEPTH, FEED, STRATEGY, RESULT)}
    for parameter in parameters:
        found[group_of(parameter)].append(parameter)
    return {name: those for name, those in found.items() if those}


# Which field an alarm speaks of: by the word that it points at, else by the address and meaning that it quotes.

WORD = re.compile(r"[^\s~;]+")


def field_of(alarm: Alarm, parameters: Sequence[Parameter], code: str = "") -> str:
    """The name of the parameter that an alarm is about, empty where it is about none."""
    quoted = [p for p in parameters if f"{p.address} ({p.meaning})" in alarm.message]
    if quoted:
        return min(quoted, key=lambda p: alarm.message.index(f"{p.address} ({p.meaning})")).name
    word = pointed_at(alarm)
    for p in sorted(parameters, key=lambda p: -len(p.address)):
        if any(re.match(rf"{re.escape(each)}(?![A-Za-z])", word) for each in (p.address, *p.aliases)):
            return p.name
    named = [p for p in parameters if re.search(rf"\b{re.escape(code)} {re.escape(p.address)}\b", alarm.message)]
    return named[0].name if named else ""


def pointed_at(alarm: Alarm) -> str:
    """The word of the program that an alarm points at, or into."""
    if alarm.span is None or alarm.source is None or alarm.span.program:
        return ""
    words, at = WORD.finditer(alarm.source.line_text(alarm.span.line)), alarm.span.column - 1
    return next((word[0] for word in words if word.start() <= at < word.end()), "")


def at_field(alarm: Alarm, p: Parameter | None = None) -> str:
    """The sentence of an alarm where its field stands above it: what must be, not whose."""
    head, quoted, rest = alarm.message.partition(f"{p.address} ({p.meaning}) " if p else "\n")
    said = rest if quoted and len(head.split()) <= 3 else alarm.message
    return f"{said} ({alarm.hint})" if alarm.hint else said
