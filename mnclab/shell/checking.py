"""The command `check`: the alarms of files, or what became of all programs of a folder."""

from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
from typing import Any

from mnclab.controls.choice import run
from mnclab.controls.survey import Survey
from mnclab.controls.survey import check as survey
from mnclab.machine.setup import Setup
from mnclab.machine.setup_file import load
from mnclab.shell import saying
from mnclab.shell.saying import ALARMS, CLEAN, INTERRUPTED, describe, program, say, sensible
from mnclab.text.alarm import ALARM, Alarm
from mnclab.workpiece.collision import Collisions

NARROWEST = 60  # letters of a row that a terminal is given in any case


def check(chosen: argparse.Namespace) -> int:
    """Report the alarms of several programs, or what became of those of a folder."""
    status, report = CLEAN, []
    setup = None if chosen.setup is None else sensible(load, chosen.setup)
    if chosen.csv is not None or chosen.suffixes or chosen.jobs > 1 or any(map(os.path.isdir, filter(None, chosen.files))):
        found = sensible(survey_of, chosen, setup)
        if not (found.rows or found.interrupted):
            sensible(saying.nothing_in, chosen.files)
        width = max(shutil.get_terminal_size().columns, NARROWEST) if sys.stdout.isatty() else None  # a pipe gets all of it
        if chosen.csv is not None:
            sensible(saying.write_table, chosen.csv, found.csv())
        if chosen.json or chosen.csv is None:
            print(json.dumps(found.as_dict(), indent=1) if chosen.json else found.text(width))
        return INTERRUPTED if found.interrupted else CLEAN if found.ok else ALARMS
    for file in chosen.files:
        alarms: tuple[Alarm, ...] = ()
        met: Collisions | None = None  # not looked for
        try:
            result = run(program(file), chosen.control, setup)
            alarms = result.alarms
            met = saying.with_blank(result).collisions() if chosen.material else None
        except Alarm as fault:  # no program, or no blank
            alarms = (*alarms, fault)
        if met or any(alarm.severity == ALARM for alarm in alarms):
            status = ALARMS
        said: dict[str, Any] = {"file": file, "alarms": [describe(alarm, file) for alarm in alarms]}
        if chosen.material:
            said |= {"collisions": None if met is None else [each.as_dict() for each in met]}
            said |= {"reach": met.reach} if met is not None and met.reach else {}
        report.append(said | ({"notes": met.notes} if met is not None and met.notes else {}))
        if chosen.json:
            continue
        for alarm in alarms:
            say(alarm, file)
        if met is not None:
            notes = [f"{file}: note: {note}" for note in ([met.sentence] if met.reach else []) + list(met.notes)]
            print(*met, *notes, sep="\n", end="\n" if met else "", file=sys.stderr)
    if chosen.json:
        print(json.dumps(report, indent=1))
    return status


def survey_of(chosen: argparse.Namespace, setup: Setup | None) -> Survey:
    """What became of the programs of folders; an Alarm where that was not meant."""
    if chosen.material:
        raise Alarm("--material is for files, not for folders and tables")
    return survey(map(program, chosen.files), chosen.control, setup, suffixes=chosen.suffixes, jobs=chosen.jobs)
