"""The command `time`: how long a program takes and where the time goes, or how long all programs of folders take."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterator
from typing import Any

from mnclab.controls.choice import run
from mnclab.controls.survey import files_of
from mnclab.machine.setup import Setup
from mnclab.machine.setup_file import load
from mnclab.path.limits import Limits
from mnclab.path.machines import load as load_machine
from mnclab.path.profile import Profile
from mnclab.runs.run import Run
from mnclab.shell.saying import ALARMS, CLEAN, INTERRUPTED, nothing_in, program, refuse, say, sensible, write_table
from mnclab.text.alarm import ALARM, Alarm, several
from mnclab.text.opening import progress
from mnclab.text.tables import clock, csv_text, text_table

MOST = 10  # lines of the program that are named
HEAD = ("file", "control", "complete", "time, s", "at feed, s", "rapid, s", "cutting, mm", "rapid, mm", "stopped in line", "why")


def time(chosen: argparse.Namespace) -> int:
    """Print how long a program takes: in all, by cause, by tool, and the lines that cost most; of several, a table."""
    machine = None if chosen.machine is None else sensible(load_machine, chosen.machine)
    setup = None if chosen.setup is None else sensible(load, chosen.setup)
    if chosen.csv is not None or len(chosen.files) > 1 or any(map(os.path.isdir, filter(None, chosen.files))):
        return _many(chosen, setup, machine.limits if machine else None)
    chosen.file = chosen.files[0]
    result = run(program(chosen.file), chosen.control, setup)
    result = result if chosen.start_at is None else sensible(result.start_at, chosen.start_at)
    limits = machine.limits if machine else result.setup.limits
    profile = sensible(lambda: result.profile(limits, override=chosen.override / 100))
    stop = _stop(result)
    if chosen.json:
        print(json.dumps({"complete": stop is None} | document(profile, machine), indent=1))
    else:
        said = f" in line {stop.span.line}" if stop and stop.span else ""
        print(f"not complete: the program stopped{said}; the times are those until then\n" if stop else "", end="")
        print(report(profile, machine))
        for alarm in result.alarms:
            say(alarm)
    return ALARMS if stop else CLEAN


def _many(chosen: argparse.Namespace, setup: Setup | None, limits: Limits | None) -> int:
    """A row for each program of files and folders."""
    if chosen.start_at is not None:
        refuse("--start-at is for one program")
    rows, status = [], CLEAN
    try:
        for row in _rows(chosen, setup, limits):
            rows.append(row)
    except KeyboardInterrupt:
        status = INTERRUPTED
    status = status or (CLEAN if all(row["complete"] for row in rows) else ALARMS)
    cells = [tuple(_text(row[name]) for name in HEAD) for row in rows]
    done = f"{several(len(rows), 'program')}, {sum(row['complete'] for row in rows)} complete"
    if chosen.csv is not None:
        if sensible(write_table, chosen.csv, csv_text(HEAD, *cells)):
            print(f"{chosen.csv}: {done}", file=sys.stderr)
    if chosen.json:
        print(json.dumps(rows, indent=1))
    elif chosen.csv is None:
        print(text_table(HEAD, cells))
        whole = sum(row["time, s"] or 0.0 for row in rows)
        print(f"\n{done}, {clock(whole)} in all")
    return status


def _rows(chosen: argparse.Namespace, setup: Setup | None, limits: Limits | None) -> Iterator[dict[str, Any]]:
    places = list(map(program, chosen.files))
    found = list(dict.fromkeys(file for place in places for file in sensible(files_of, place)))
    if not found:
        sensible(nothing_in, chosen.files)
    with progress("timing", len(found), "files") as at:
        for number, file in enumerate(found):
            at(number)
            try:
                yield _row(str(file), run(file, chosen.control, setup), limits, chosen.override / 100)
            except Alarm as alarm:  # what cannot be read, or planned
                yield dict.fromkeys(HEAD) | {"file": str(file), "complete": False, "why": alarm.message}


def _row(file: str, result: Run, limits: Limits | None, override: float) -> dict[str, Any]:
    profile, path, stop = result.profile(limits, override=override), result.toolpath, _stop(result)
    rapid = float(profile.time_by("kind").get("rapid", 0.0))
    lengths = result.summary()
    return dict(zip(HEAD, (
        file, result.control.name, stop is None, profile.time, float(profile.seconds[path.is_motion].sum()) - rapid, rapid,
        lengths["cutting length"], lengths["rapid length"], stop.span.line if stop and stop.span else None,
        stop.message if stop else None,
    ), strict=True))  # fmt: skip


def _stop(result: Run) -> Alarm | None:
    """The alarm that stopped a program."""
    return next((alarm for alarm in result.alarms if alarm.severity == ALARM), None)


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.3f}" if isinstance(value, float) else "" if value is None else " ".join(str(value).split())




def report(profile: Profile, machine: Any = None) -> str:
    """Total, causes, tools and the lines that take longest; `machine` (a MachineFile) is named with its assumptions."""
    lines = [f"time  {clock(profile.time)}   ({profile.time:.3f} s)"]
    if machine is not None:
        lines += [f"on    {machine.title} ({machine.name})", *(f"      {sentence}" for sentence in machine.assumes)]
    lines += ["", "cause"]
    lines += [_share(cause, seconds, profile.time) for cause, seconds in profile.time_by("cause").items()]
    tools = profile.time_by("tool")
    if len(tools) > 1:
        lines += ["", "tool", *(_share(f"T{tool}", seconds, profile.time) for tool, seconds in tools.items())]
    slowest = sorted(profile.time_by("line").items(), key=lambda item: -item[1])[:MOST]
    if slowest:
        lines += ["", "lines that take longest"]
        lines += [f"{_share(_line(line), seconds, profile.time)}{_source(profile, line)}" for line, seconds in slowest]
    return "\n".join(lines)


def document(profile: Profile, machine: Any = None) -> dict[str, Any]:
    """Seconds in all and by cause, tool, kind and line (`line`, or `program:line` of a program that was called)."""
    found: dict[str, Any] = {"time": profile.time}
    if machine is not None:
        found["machine"] = {"name": machine.name, "title": machine.title, "assumes": list(machine.assumes)}
    for key in ("cause", "tool", "kind"):
        found[key] = {str(name): seconds for name, seconds in profile.time_by(key).items()}
    found["line"] = {_line(line).removeprefix("line "): seconds for line, seconds in profile.time_by("line").items()}
    return found


def _share(name: str, seconds: float, total: float) -> str:
    return f"  {name:14s}{seconds:12.3f} s{100 * seconds / total if total else 0.0:7.1f} %"


def _line(line: int | tuple[int, int]) -> str:
    return f"line {line[0]}:{line[1]}" if isinstance(line, tuple) else f"line {line}"


def _source(profile: Profile, line: int | tuple[int, int]) -> str:
    source = profile.source
    return f"   {source.line_text(line)}" if source is not None and not isinstance(line, tuple) else ""
