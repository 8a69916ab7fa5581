"""Settings: what a control leaves to its parameters, to the operator, or to the reader of its manual.

A setting is declared once, in the `settings` of its control; from there come the check of what a Setup says, the table
of `mnclab.help("settings", control)` and the values that functions and cycles find in `Machine.settings`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from numbers import Real
from textwrap import wrap
from types import MappingProxyType
from typing import Any, NamedTuple

from mnclab.text.alarm import Alarm
from mnclab.text.given import shown
from mnclab.text.nearest import hint
from mnclab.text.records import written
from mnclab.text.tables import html_table, text_table


class Setting(NamedTuple):
    """One choice. Its kind is that of the default: true or false, a number (None: unknown), a mapping, or one of `choices`
    (value -> meaning).

    `source` is the section of the manual, or the name of the reading where the manual leaves it open. `chooses`: what a
    choice makes of other settings, as long as nobody gives them (choice -> name -> value).
    """

    name: str
    default: Any
    meaning: str
    source: str = ""
    choices: Mapping[str, str] = MappingProxyType({})
    unit: str = ""
    at_least: float | None = None
    at_most: float | None = None
    chooses: Mapping[str, Mapping[str, Any]] = MappingProxyType({})

    def __repr__(self) -> str:
        return written(self)

    @property
    def allowed(self) -> str:
        if self.choices:
            return "one of " + ", ".join(self.choices)
        if isinstance(self.default, bool):
            return "true or false"
        if isinstance(self.default, Mapping):
            return "a mapping"
        least = "" if self.at_least is None else f" from {self.at_least:g}"
        most = "" if self.at_most is None else f" to {self.at_most:.10g}"
        return f"a {'whole ' if self.whole else ''}number{least}{most}"

    @property
    def whole(self) -> bool:
        """Whether it counts something: its default, or its least, is whole and has no unit."""
        return not self.unit and isinstance(self.at_least if self.default is None else self.default, int)

    def check(self, value: Any) -> Any:
        """The value as functions read it; an Alarm when it is not allowed."""
        if self.choices:
            good = isinstance(value, str) and value in self.choices
        elif isinstance(self.default, bool):
            good = isinstance(value, bool)
        elif value is None:
            good = self.default is None
        elif isinstance(self.default, Mapping):
            good = isinstance(value, Mapping)
        else:
            good = isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)
            good = good and not (self.whole and float(value) % 1)
            good = good and (self.at_least is None or float(value) >= self.at_least)
            good = good and (self.at_most is None or float(value) <= self.at_most)
        if not good:
            near = hint(value, self.choices, 1) if isinstance(value, str) else ""
            raise Alarm(f"setting {self.name} ({self.meaning}) must be {self.allowed}, got {shown(value)}", hint=near)
        return value


def one_of(name: str, meaning: str, source: str = "", /, **choices: str) -> Setting:
    """A setting with choices, of which the first is the default."""
    return Setting(name, next(iter(choices)), meaning, source, choices)


#: What every control has, unless it declares the same name itself.
EVERY = (
    Setting(
        "lint", "on", "what a teacher would say of a program that runs", "every control",
        {"on": "warnings, none of which stops a run", "off": "no word"},
    ),
    Setting(
        "stopped_spindle", "warn", "moves at feed while the spindle stands", "every control",
        {"warn": "one warning, at the first of them", "accept": "no word"},
    ),
    Setting(
        "most_blocks", 200_000, "blocks that jumps, repeats and calls may add to those of the text, one by one",
        "the patience of a reader", unit="blocks", at_least=1000, at_most=1_000_000_000,
    ),
    Setting(
        "most_rows", 500_000, "rows of the path beyond which a run ends, with 20 more for each block of the text",
        "the memory of the computer", unit="rows", at_least=1000, at_most=1_000_000_000,
    ),
)  # fmt: skip


def with_every(declared: Iterable[Setting]) -> tuple[Setting, ...]:
    """The settings of a control, and those that every control has."""
    own = tuple(declared)
    names = {setting.name for setting in own}
    return own + tuple(setting for setting in EVERY if setting.name not in names)


def chosen(declared: Iterable[Setting], given: Mapping[str, Any], control: str, source: Any = None) -> dict[str, Any]:
    """Values by name: the defaults, and what a Setup gives instead. An Alarm names what is unknown or not allowed.

    `source` is the file of the setup, if there is one: the alarm shows the line of the setting in it.
    """
    known = {setting.name: setting for setting in declared}
    for name in given:
        if name not in known:
            listed = f"mnclab.help('settings', {control!r}) lists them" if known else "it has none"
            told = hint(str(name)[:40], known, 1) or listed
            place = source and source.place_of("settings", name)
            raise Alarm(f"{control} has no setting {shown(name)}", place, hint=told, source=source)
    found: dict[str, Any] = {}
    by_others: dict[str, Any] = {}
    for name, setting in sorted(known.items(), key=lambda item: not item[1].chooses):  # the choosing ones first
        try:
            found[name] = setting.check(given.get(name, by_others.get(name, setting.default)))
            by_others |= setting.chooses.get(found[name], {}) if setting.chooses else {}
        except Alarm as alarm:
            alarm.source, alarm.span = source, source and source.place_of("settings", name)
            raise
    return found


def rows(settings: Iterable[Setting]) -> list[tuple[str, str, str, str, str]]:
    """Name, default, allowed, meaning and source, a row for each setting and one below it for each of its choices."""
    table = []
    for one in settings:
        default = str(one.default).lower() if isinstance(one.default, bool) else str(one.default)
        default = "unknown" if one.default is None else default
        counted = one.unit[:1].isdigit()  # a unit such as 0.01 mm would be read as a second number
        unit = f" × {one.unit}" if counted else f" {one.unit}" if one.unit else ""
        table.append((one.name, default + unit, "" if one.choices else one.allowed, one.meaning, one.source))
        for choice, meaning in one.choices.items():
            others = ", ".join(f"{name}={value}" for name, value in one.chooses.get(choice, {}).items())
            table.append(("", "", choice, f"{meaning}:" if others else meaning, ""))
            table += [("", "", "", line, "") for line in wrap(others, WIDE)]
    return table


def switches(settings: Mapping[str, Any]) -> frozenset[int]:
    """The switches of block skip that are on: where the setting `block_skip` is, those among the digits of `skip_switches`."""
    on = settings.get("block_skip") and str(int(settings.get("skip_switches", 1)))
    return frozenset(map(int, on or ""))


WIDE = 70  # characters of a line of what a choice makes of other settings
HEAD = ("setting", "default", "allowed", "meaning", "source")


def settings_text(settings: Iterable[Setting]) -> str:
    """The settings as text."""
    return text_table(HEAD, rows(settings))


def settings_html(settings: Iterable[Setting]) -> str:
    """The settings as HTML."""
    return html_table(HEAD, rows(settings), code=(0, 1, 2))
