"""The cutting data of a run, tool by tool, against the limits of its machine and of its tools; and its sheets."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mnclab.path.limits import Limits
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, fitting, shown
from mnclab.workpiece.cutting_data import CuttingData
from mnclab.workpiece.cutting_data import cutting_data as data_of

if TYPE_CHECKING:
    from mnclab.runs.run import Run

MOVES = 200_000  # beyond which what they take away is not worked out

Most = float | Mapping[int, float] | None


@fitting
def cutting_data(
    run: Run, limits: Limits | str | None = None, *, machine: Limits | str | None = None,
    vc: Most = None, fz: Most = None, kc: float | None = None,
) -> CuttingData:  # fmt: skip
    """Spindle and cutting speed, feed a tooth, depth and width of cut, mean chip thickness and removal rate of each tool.

    `limits` or `machine` as in `profile`; `vc` m/min and `fz` mm are the greatest that a tool bears, a number for all or a
    dict by tool number; with `kc` N/mm², the specific cutting force of the material, it has the power at the spindle. The
    formulas are in `mnclab.workpiece.cutting_data`.
    """
    (tools, numbers), profile = run.tools_that_cut, run.profile(limits, machine=machine)
    most = {name: _of_tools(given, name, tools) for name, given in (("vc", vc), ("fz", fz)) if given is not None}
    if kc is not None:
        check_number(kc, "the specific cutting force kc (N/mm²)", above=0)
    removal, unknown = None, "Without a blank"
    if run.stock is not None and run.stock.volume > 0:
        unknown = f"Of more than {MOVES:,} moves"
        if int(run.toolpath.is_motion.sum()) <= MOVES:
            try:
                removal = run.removal(profile.limits)
            except Alarm as alarm:  # such as of a blank that no lathe turns
                unknown = f"Of this blank ({alarm.message})"
    return data_of(
        run.toolpath, tools, numbers, profile.limits, removal, most=most, kc=kc, reach=run.reach, unknown=unknown
    )


def _of_tools(given: Any, name: str, tools: Mapping[int, Any]) -> dict[int, float]:
    """A limit by tool number; an Alarm for what is none."""
    what = f"the greatest {name} of a tool ({'m/min' if name == 'vc' else 'mm'})"
    if not isinstance(given, Mapping):
        check_number(given, what, above=0)
        return dict.fromkeys(tools, float(given))
    for number, value in given.items():
        if number not in tools:
            known = ", ".join(f"{each}" for each in sorted(tools) if each)
            raise Alarm(f"{name} is given for a tool that is not in the table, {shown(number)}", hint=f"tools: {known}")
        check_number(value, what, above=0)
    return {int(number): float(value) for number, value in given.items()}


@fitting
def setup_sheet(run: Run, path: str | Path, title: str | None = None) -> Path:
    """Write the set-up sheet, .html or .pdf: zero points, blank with a drawing, fixtures, tools."""
    from mnclab.show.report.gathering import save_sheet

    return save_sheet(run, "setup", path, title)


@fitting
def tool_sheet(run: Run, path: str | Path, title: str | None = None) -> Path:
    """Write the tool sheet, .html or .pdf: the tools with their sizes, and how they cut."""
    from mnclab.show.report.gathering import save_sheet

    return save_sheet(run, "tools", path, title)


@fitting
def measuring_sheet(run: Run, path: str | Path, title: str | None = None) -> Path:
    """Write the measuring record, .html or .pdf, with its pictures; an Alarm where nothing was measured."""
    from mnclab.show.report.gathering import save_sheet

    return save_sheet(run, "measuring", path, title)
