"""A cell that is a part program.

    %%mnc --control tnc-620 --tools my_tools --name first
    BEGIN PGM FIRST MM
    …

The run is bound to `run` (or to another name), its card with the alarms and their carets stands under the cell, and
the picture below, if anything moved. What a name such as `my_tools` means is looked up in the notebook; `--setup` also
takes a file.
"""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NoReturn

from mnclab.controls import CONTROLS
from mnclab.controls.choice import run as run_text
from mnclab.machine.setup import Setup
from mnclab.machine.setup_file import load
from mnclab.path.tool import Tool
from mnclab.runs.run import Run
from mnclab.text.alarm import Alarm


class _Options(argparse.ArgumentParser):
    """Options whose faults are alarms."""

    def error(self, message: str) -> NoReturn:
        raise Alarm(f"%%mnc: {message}", hint=" ".join(self.format_usage().split()))


def options() -> argparse.ArgumentParser:
    """What may stand beside %%mnc."""
    parser = _Options(prog="%%mnc", add_help=False)
    parser.add_argument("--control", metavar="NAME", help=f"one of {', '.join(CONTROLS)}; default: the text says")
    parser.add_argument("--tools", metavar="NAME", help="a dict of the notebook: number -> Tool")
    parser.add_argument("--setup", metavar="NAME", help="a Setup of the notebook, or a setup file")
    parser.add_argument("--name", default="run", help="what the run is called in the notebook")
    parser.add_argument("--colour", default="kind", help="what the colour of the cuts shows")
    parser.add_argument("--quiet", action="store_true", help="show the alarms alone")
    return parser


def run_cell(line: str, cell: str, names: Mapping[str, Any]) -> tuple[str, Run, argparse.Namespace]:
    """Run a cell; the name for it, the run, and the options. An Alarm for options that make no sense."""
    try:
        words = shlex.split(line)
    except ValueError as fault:
        raise Alarm(f"%%mnc: {fault}") from None
    chosen = options().parse_args(words)
    if not chosen.name.isidentifier():
        raise Alarm(f"%%mnc: --name must be a name of Python, got {chosen.name!r}")
    text = cell if cell.endswith("\n") else cell + "\n"
    return chosen.name, run_text(text, chosen.control, _setup(chosen, names)), chosen


def _setup(chosen: argparse.Namespace, names: Mapping[str, Any]) -> Setup:
    setup = Setup()
    if chosen.setup:
        found = names.get(chosen.setup)
        if isinstance(found, Setup):
            setup = found
        elif chosen.setup.endswith(".toml") or Path(chosen.setup).is_file():
            setup = load(chosen.setup)
        else:
            raise Alarm(f"%%mnc: --setup {chosen.setup} is neither a Setup of this notebook nor a setup file")
    if chosen.tools:
        tools = names.get(chosen.tools)
        if not isinstance(tools, Mapping) or not all(isinstance(tool, Tool) for tool in tools.values()):
            what = f"%%mnc: --tools {chosen.tools} is no dict of tools in this notebook"
            raise Alarm(what, hint="t = {1: Tool(radius=5)}")
        setup = replace(setup, tools=tools)
    return setup
