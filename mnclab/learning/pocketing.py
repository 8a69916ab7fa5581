"""Choosing a strategy: a name and a stepover, tried on the pocket of the drawing."""

from __future__ import annotations

from collections.abc import Mapping

from mnclab.comparison.strategies import compare
from mnclab.geometry.regions import Region
from mnclab.learning.exercise import Exercise
from mnclab.learning.findings import ASKED, PART, Finding, hints_of
from mnclab.learning.grade import Grade
from mnclab.learning.grading import headings, score
from mnclab.machining.milling.strategies import STRATEGIES
from mnclab.runs.causes import Cause
from mnclab.text.alarm import Alarm
from mnclab.text.file import File, table_of
from mnclab.text.given import check_number, choice, shown, whole

KNOWN = ("strategy", "stepover", "tool", "feed")
CLEARED = 1e-3  # of the area that the tool can reach: more is left over
SAID = {"engagement": "on 95 % of the way the tool is engaged by up to", "time": "it takes", "lifts": "it lifts",
        "feed": "it is fed at"}  # fmt: skip
DECIDED_BY = {"engagement": "stepover", "time": "feed", "lifts": "strategy"}
UNITS = {"engagement": "degrees", "time": "s", "lifts": "times", "feed": "mm/min"}


def cleared(exercise: Exercise, text: str, tried: Mapping[str, int]) -> Grade:
    """The grade of a strategy, written `strategy = "rings"`, `stepover = 2.5`, `tool = 1`, `feed = 500`."""
    file = File(f"{exercise.id}.toml", text)
    table = table_of(text)
    for name in table:
        if name not in KNOWN:
            raise Alarm(f"an answer has no {shown(name)}", file.place_of(name), hint=f"it has {', '.join(KNOWN)}")
    with file.at("strategy"):
        strategy = choice(table.get("strategy"), "strategy", STRATEGIES)
    tools = exercise.setup.tools or {}
    with file.at("tool"):
        number = whole(table.get("tool", min(tools, default=0)), "tool")
        if number not in tools:
            raise Alarm(f"there is no tool {number}", hint=f"tools: {', '.join(map(str, tools))}")
    given = {"feed": 500.0, "stepover": tools[number].radius, **{name: table[name] for name in KNOWN[1::2] if name in table}}
    for name, value in given.items():
        with file.at(name):
            check_number(value, name, above=0)
    trial = compare(Region.of(exercise.design), tools[number], strategy, limits=exercise.setup.limits, **given).trials[0]
    findings = []
    row = trial.row
    if row["covered"] < 100 * (1 - CLEARED):
        findings.append(Finding(PART, "left over", 0, ("something is left that this tool could reach",)))
    have = {"engagement": row["p95"], "time": row["time"], "lifts": row["lifts"], "feed": given["feed"]}
    for name, most in exercise.asked.strategy.items():
        if have[name] > most * (1 + 1e-9):
            told = f"{SAID[name]} {have[name]:.5g} {UNITS[name]}, {most:g} at most are allowed"
            own = file.place_of(DECIDED_BY.get(name, name)) or file.place_of("strategy")
            causes = tuple(Cause(span.line, f"{key} decides it too") for key in KNOWN if (span := file.place_of(key)))
            findings.append(Finding(ASKED, name, own.line if own else 0, (told,), causes=causes))
    marks = {"part": float(not any(each.rank == PART for each in findings)),
             "asked": 1 - sum(each.rank == ASKED for each in findings) / max(1, len(exercise.asked.strategy))}  # fmt: skip
    points = {name: marks[name] for name in headings(exercise)}
    hints, faults = hints_of(findings, tried)
    return Grade(exercise.id, score(exercise, points), not findings, points, hints, faults)
