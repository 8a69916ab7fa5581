"""How long a program takes, as text for people and as a document for programs."""

from __future__ import annotations

from typing import Any

from mnclab.path.profile import Profile

MOST = 10  # lines of the program that a report names


def clock(seconds: float) -> str:
    """A time as people say it: `1:02:03`, `2:03` or `3.21 s`."""
    if seconds < 60:
        return f"{seconds:.2f} s"
    if not seconds < 1e12:  # without an end, such as a feed of almost nothing
        return f"{seconds:g} s"
    whole = round(seconds)
    hours, minutes = divmod(whole // 60, 60)
    return f"{hours}:{minutes:02d}:{whole % 60:02d}" if hours else f"{minutes}:{whole % 60:02d}"


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
        lines += [f"{_share(_line(line), seconds, profile.time)}{_text(profile, line)}" for line, seconds in slowest]
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


def _text(profile: Profile, line: int | tuple[int, int]) -> str:
    source = profile.source
    return f"   {source.line_text(line)}" if source is not None and not isinstance(line, tuple) else ""
