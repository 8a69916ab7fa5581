"""mnclab from a shell: check, run, renumber, plot, part, compare, prove, drawing, report, time, help, exercise, grade,
handout, site, send, lessons, lab.

`python -m mnclab` is the same.

Exit status: 0 clean, 1 alarms or a part that is not as drawn, 2 a command line that makes no sense, 130 stopped by
Ctrl-C. Alarms go to stderr, one line each, in the form that editors understand: `FILE:LINE:COLUMN: alarm: message (hint)`.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import mnclab
from mnclab.controls import ALSO
from mnclab.controls.choice import renumber_file
from mnclab.machine.setup_file import FORMAT, load
from mnclab.shell.checking import check
from mnclab.shell.grading import exercise, grade
from mnclab.shell.handout import handout
from mnclab.shell.lessons import lab, lessons
from mnclab.shell.saying import (
    ALARMS,
    CLEAN,
    INTERRUPTED,
    USAGE,
    describe,
    environment,
    program,
    refuse,
    say,
    sensible,
    with_blank,
)
from mnclab.shell.sending import send
from mnclab.shell.site import site
from mnclab.shell.timing import time
from mnclab.show.export import BODIES
from mnclab.text.alarm import Alarm

SUFFIXES = (
    "svg, pdf, png (pictures); html (the player); csv, json (the moves); dxf; ngc (plain blocks); stl, gltf, glb, vtk"
)

COMPARED = "svg, pdf, png (a map of where it is off); csv (the table); json, html (a record)"

DRAWN = "svg, pdf, png, dxf (the drawing); toml (the design)"

PARTS = "stl, gltf, glb, vtk (the body); svg, pdf, png (pictures); csv (heights, or the section of a lathe)"

EPILOG = f"""\
exit status: 0 clean, 1 alarms (or an unreadable file, or a part outside the tolerance), 2 a wrong command line,
130 Ctrl-C; warnings are shown too, but leave the status at 0

mnclab help design: what the file of a design (--design) looks like

a setup file (--setup) looks like this:

{FORMAT}"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Do what a command line says and return the exit status."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a Windows code page lacks letters that an alarm may quote
            stream.reconfigure(errors="replace")
    try:
        try:
            return obeyed(arguments)
        finally:  # what is printed is printed here, or the reason why not is said, even after --help
            if sys.stdout is not None:
                sys.stdout.flush()
    except BrokenPipeError:  # the reader (head, less) has seen enough
        give_up_printing()
        return CLEAN
    except OSError as error:  # a full disk, of the output or of the alarms
        give_up_printing()
        with suppress(OSError):
            print(f"mnclab: the output cannot be written: {error.strerror or error}", file=sys.stderr)
        return USAGE
    except KeyboardInterrupt:
        print("mnclab: interrupted", file=sys.stderr)
        return INTERRUPTED


def obeyed(arguments: Sequence[str] | None) -> int:
    """Do what a command line says."""
    commands = parser()
    chosen, rest = commands.parse_known_args(_own_tables(sys.argv[1:] if arguments is None else arguments))
    if rest and chosen.do is not lab:
        commands.error(f"unrecognized arguments: {' '.join(rest)}")
    chosen.rest = rest
    try:
        if getattr(chosen, "json", False) and getattr(chosen, "csv", None) in ("", "-"):
            refuse("only one of --csv and --json goes to stdout", "write the table to a file: --csv OUT.csv")
        return int(chosen.do(chosen))
    except Alarm as alarm:  # there is no program in the file
        say(alarm, getattr(chosen, "file", ""))
        return ALARMS


def _own_tables(words: Sequence[str]) -> list[str]:
    """A command line in which only a name of a table stands as one behind --csv: what follows may be a program."""
    after = [*words[1:], ""]
    return [f"{word}=" if word == "--csv" and then != "-" and not then.lower().endswith(".csv") else word
            for word, then in zip(words, after)]  # fmt: skip


def give_up_printing() -> None:
    """Send what is still to be printed nowhere, so that Python does not complain of it when it ends."""
    for stream in filter(None, (sys.stdout, sys.stderr)):
        try:
            stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


class Version(argparse.Action):
    """Print the version and what a report of a fault needs: Python, system, packages."""

    def __call__(self, top: argparse.ArgumentParser, *given: Any) -> None:
        print(f"mnclab {mnclab.__version__}, {environment()}")
        top.exit()


def parser() -> argparse.ArgumentParser:
    """The commands and their options."""
    top = argparse.ArgumentParser(
        prog="mnclab",
        description="Reads CNC part programs of real controls and shows what the machine would do.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action=Version, nargs=0, help="that of mnclab, and what it runs with")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, do: Any, does: str, file: str = "file", **more: Any) -> argparse.ArgumentParser:
        sub = commands.add_parser(name, help=does, description=f"{does[0].upper()}{does[1:]}.")
        sub.set_defaults(do=do)
        if file:
            sub.add_argument(file, metavar="FILE", **more)
        return sub

    def output(sub: argparse.ArgumentParser, says: str) -> None:
        sub.add_argument("-o", "--output", required=True, metavar="OUT", help=says)

    def table(sub: argparse.ArgumentParser, says: str) -> None:
        sub.add_argument("--csv", nargs="?", const="", metavar="OUT.csv", help=f"{says}, to a file or to stdout")

    def options(sub: argparse.ArgumentParser, json_says: str = "", starts: bool = False) -> None:
        sub.add_argument("--control", choices=[*mnclab.controls, *ALSO], help="default: from the file's suffix or its text")
        says = "tools, datums, blank, start, settings (mnclab --help shows one)"
        sub.add_argument("--setup", metavar="S.toml", help=says)
        if json_says:
            sub.add_argument("--json", action="store_true", help=json_says)
        if starts:
            says = "begin at line N, as a block search does: what comes before is computed and does not move"
            sub.add_argument("--start-at", type=int, metavar="N", help=says)

    does = "run programs and report their alarms; of a folder, a table of what ran, what was refused, and why"
    sub = command("check", check, does, "files", nargs="+")
    options(sub, "a list of files with their alarms on stdout instead; of a folder, the table and the reasons")
    table(sub, "the table as comma-separated values instead")
    says = "of a folder, the files with these suffixes (default: those that part programs usually have; * for all)"
    sub.add_argument("--suffixes", type=words, metavar=".nc,.h", help=says)
    sub.add_argument("-j", "--jobs", type=int, default=1, metavar="N", help="how many processes share the files (default: 1)")
    says = "find the collisions with the blank too (of the setup, or of the program); status 1 if there is one"
    sub.add_argument("--material", action="store_true", help=says)
    sub = command("run", run, "run a program and print its moves, one a line, and what it measured")
    options(sub, "summary, alarms and columns of the path on stdout instead", starts=True)
    does = "write the numbers of blocks anew, and the jumps that name them, and print the program"
    sub = command("renumber", renumber, does)
    sub.add_argument("-o", "--output", metavar="OUT", help="write it to this file instead, in the bytes of the old one")
    sub.add_argument("--start", type=int, metavar="N", help="the first number (default: 10; Klartext 0, NC-31 1)")
    sub.add_argument("--step", type=int, metavar="N", help="what is added each time (default: 10; Klartext and NC-31 1)")
    sub.add_argument("--control", choices=[*mnclab.controls, *ALSO], help="default: from the file's suffix or its text")
    kinds = "a picture, a page to play it, a file for other programs"
    sub = command("plot", plot, f"run a program and save what it does: {kinds}")
    output(sub, f"the suffix says what: {SUFFIXES}")
    says = "contour, tool-centre path and how its corners were found"
    sub.add_argument("--compensation", action="store_true", help=says)
    says = "what was measured: contours, touches, deviations magnified, the measuring record"
    sub.add_argument("--measured", action="store_true", help=says)
    sub.add_argument("--rules", type=words, metavar="G160,G161", help="with --compensation: a picture for each rule")
    sub.add_argument("--radii", type=numbers, metavar="2,5", help="with --compensation: a picture for each radius, mm")
    options(sub, starts=True)
    sub = command("part", part, "run a program and save what it leaves of the blank (of the setup, or of the program)")
    output(sub, f"the suffix says what: {PARTS}")
    sub.add_argument("--line", type=int, metavar="N", help="as it is after line N (default: at the end)")
    options(sub)
    sub = command("compare", compare, "run a program and compare what it leaves with a design; status 1 if it is not as drawn")
    sub.add_argument("--design", required=True, metavar="D.toml", help="the part as drawn (mnclab help design shows one)")
    says = "mm that a face may be off where the drawing says nothing else (default: 0.05)"
    sub.add_argument("--tolerance", type=float, default=0.05, metavar="MM", help=says)
    sub.add_argument("-o", "--output", metavar="OUT", help=f"the suffix says what: {COMPARED}")
    options(sub, "verdict, worst places and table on stdout as one object instead")
    sub = command("prove", prove, "say whether two programs make the same motion, or the same part; status 1 if they do not: if "
                  "more than lifts, chords or order differs; 2 if one cannot be read")
    sub.add_argument("other", metavar="OTHER", help="the program that is compared with the first one, which is trusted")
    sub.add_argument("--tolerance", type=float, default=0.001, metavar="MM", help="(default: 0.001)")
    says = "what may differ: lifts (between cuts, nowhere lower), chords (for arcs, within the tolerance), order (of the cuts)"
    sub.add_argument("--allow", type=words, default=(), metavar="lifts,chords,order", help=says)
    sub.add_argument("--same-motion", action="store_true", help="status 1 for the same part made another way, too")
    sub.add_argument("--html", metavar="OUT.html", help="a page with the differences, and a picture of the first")
    sub.add_argument("--controls", type=words, metavar="A,B", help="of both (default: from their suffixes or texts)")
    sub.add_argument("--setup", metavar="S.toml", help="of both: tools, datums, blank, start, settings")
    sub.add_argument("--json", action="store_true", help="verdict and differences on stdout as one object instead")
    sub = command("drawing", drawing, "save the dimensioned drawing of a design (.toml), or of the part that a program makes")
    output(sub, f"the suffix says what: {DRAWN}")
    sub.add_argument("--size", metavar="SIZE", help='A4, "A4 landscape", A3 or A2 (default: the smallest that will do)')
    options(sub)
    sub = command("report", report, "run a program and write a report: figures, tools, times, picture, alarms, listing")
    output(sub, "an .html or a .pdf file")
    sub.add_argument("--title", help="default: the name of the file")
    says = "one sheet alone: the set-up (zero points, blank, fixtures, tools), the tools, or the measuring record"
    sub.add_argument("--machine", "--limits", metavar="M", help="a named machine, or a .toml file (default: limits of the setup)")
    sub.add_argument("--sheet", choices=("setup", "tools", "measuring"), help=says)
    options(sub, starts=True)
    does = "say how long a program takes on a machine, and where the time goes; of several or a folder, a table"
    sub = command("time", time, does, "files", nargs="+")
    options(sub, "the times on stdout as one object instead, of several programs a list", starts=True)
    says = "a named machine, or a .toml file (default: limits of the setup)"
    sub.add_argument("--machine", "--limits", metavar="M", help=says)
    table(sub, "the table as comma-separated values, with a column that says which are complete")
    sub.add_argument("--override", type=float, default=100.0, metavar="PERCENT", help="feed override (default: 100)")
    sub = command("help", explain, "show the parameters of a cycle or the meaning of a function", "")
    codes = "such as G83, CYCL DEF 200, or words; the name of a control: all its codes; glossary; design, exercise: such a file"
    sub.add_argument("code", nargs="+", metavar="CODE", help=codes)
    sub.add_argument("--control", choices=[*mnclab.controls, *ALSO], help="default: the only one that has the code")
    sub.add_argument("-o", "--output", metavar="OUT.html", help="a page to print instead, the glossary with its pictures")
    sub = command("exercise", exercise, "list exercises, show them, check a teacher's file, or write the folder for pupils", "")
    sub.add_argument("what", choices=("list", "show", "check", "give"))
    says = "ids such as mnc-03, or mnc-03..mnc-09; of give, lessons too (05, 12-19); of check and give, files of exercises"
    sub.add_argument("names", nargs="*", metavar="EXERCISE", help=says)
    sub.add_argument("--control", choices=list(mnclab.controls), help="of list: those of one control")
    sub.add_argument("-o", "--output", metavar="DIR", help="of give: the folder (default: exercises)")
    sub.add_argument("--answers", action="store_true", help="of show: the model too, and why")
    table(sub, "of list: the table as comma-separated values instead")
    sub.add_argument("--pupil", metavar="NAME", help="of give: with the dimensions that this name draws")
    says = "of give: a text file with a name a line; each gets a folder, with the dimensions of the name"
    sub.add_argument("--pupils", metavar="NAMES.txt", help=says)
    sub = command("grade", grade, "grade a program that answers an exercise, or a folder a pupil; status 1 if one has not passed")
    sub.add_argument("--exercise", metavar="ID", help="default: the name of the file, mnc-03 of mnc-03.mnc")
    sub.add_argument("--json", action="store_true", help="score, passed, points and hints on stdout, of a folder a list")
    table(sub, "of a folder: the table")
    sub.add_argument("--exercises", metavar="PATH", help="a file of an exercise of your own, or a folder of such")
    says = "of a folder: the drawing of each pupil has the dimensions that the name of the folder draws"
    sub.add_argument("--neighbours", action="store_true", help=says)
    sub.add_argument("--html", metavar="OUT.html", help="of a folder: the page of the class")
    sub = command("handout", handout, "run lessons and write them as pages to print, with ruled room below the exercises", "")
    sub.add_argument("lesson", nargs="+", metavar="LESSON", help="numbers such as 05 or 5, or names of files")
    says = "an .html or a .pdf file (default: handout_05.html where the lesson is 05)"
    sub.add_argument("-o", "--output", metavar="OUT", help=says)
    sub.add_argument("--pdf", action="store_true", help="a PDF too, printed by Chromium")
    sub.add_argument("--answers", action="store_true", help="for the teacher: answers of the graded exercises too")
    does = "write pages that need no network: the reference, the tables of every control, the glossary, the lessons as they ran"
    sub = command("site", site, does, "")
    output(sub, "a folder: a new or an empty one, or that of a site, whose pages are written anew")
    sub.add_argument("--no-lessons", action="store_true", help="without running lessons; those that the folder has stay")
    sub.add_argument("-j", "--jobs", type=int, default=1, metavar="N", help="how many lessons run at a time (default: 1)")
    sub = command("send", send, "write a program as its control takes it, with the sheets that the first run needs")
    sub.add_argument("-o", "--output", metavar="DIR", help="the folder (default: this one)")
    sub.add_argument("--name", help="of the program on the control (default: that of the file)")
    sub.add_argument("--exercise", metavar="ID", help="with tools, blank and fixtures of an exercise, of which it is the answer")
    options(sub)
    sub = command("lessons", lessons, "copy the lessons, with their programs and setups, to a folder", "")
    sub.add_argument("folder", nargs="?", default="mnclab-lessons", help="a new or an empty one (default: %(default)s)")
    command("lab", lab, "open the lessons in JupyterLab, which gets all options that follow", "")
    return top


def obey(chosen: argparse.Namespace) -> mnclab.Run:
    """Run a file as the command line says; an Alarm if there is no program in it."""
    setup = None if chosen.setup is None else sensible(load, chosen.setup)
    result = mnclab.run(program(chosen.file), chosen.control, setup)
    return result if getattr(chosen, "start_at", None) is None else sensible(result.start_at, chosen.start_at)


def run(chosen: argparse.Namespace) -> int:
    """Print the moves of a program."""
    result = obey(chosen)
    if chosen.json:
        from mnclab.show.export import document

        sys.stdout.writelines(document(result))
        print()
    elif len(result.toolpath):
        print(result.toolpath)
    if result.measurements and not chosen.json:
        print(f"\n{result.measurements}\n{result.measurements.verdict}")
    return verdict(result, quiet=chosen.json)


def renumber(chosen: argparse.Namespace) -> int:
    """Print a program with new block numbers, or write it."""
    out = Path(chosen.output) if chosen.output else None
    text = renumber_file(program(chosen.file), chosen.control, start=chosen.start, step=chosen.step, out=out)
    if out is None:
        sys.stdout.write(text)
    return CLEAN


def plot(chosen: argparse.Namespace) -> int:
    """Save a picture of what a program does, or its table of moves."""
    result = obey(chosen)
    if chosen.compensation or chosen.rules or chosen.radii:
        drawn: Any = sensible(partial(result.plot_compensation, rules=chosen.rules, radii=chosen.radii))
        sensible(drawn.save, chosen.output)
    elif chosen.measured:
        drawn = sensible(result.plot_measured)
        sensible(drawn.save, chosen.output)
    else:
        of_path: Any = {"of": "path"} if Path(chosen.output).suffix.lower() in BODIES else {}
        sensible(partial(result.save, **of_path), chosen.output)
    return verdict(result)


def part(chosen: argparse.Namespace) -> int:
    """Save what a program leaves of its blank."""
    result = with_blank(obey(chosen))
    left = result.workpiece() if chosen.line is None else sensible(result.workpiece, chosen.line)
    sensible(left.save, chosen.output)
    return verdict(result)


def compare(chosen: argparse.Namespace) -> int:
    """Compare what a program leaves of its blank with a design."""
    drawn = sensible(mnclab.Design.load, chosen.design)
    result = with_blank(obey(chosen))
    found = sensible(result.workpiece().compare, drawn, chosen.tolerance)
    if chosen.output:
        sensible(found.save, chosen.output)
    if chosen.json:
        alarms = [describe(alarm, chosen.file) for alarm in result.alarms]
        print(json.dumps(found.as_dict() | {"alarms": alarms}, allow_nan=False))
    else:
        print(found)
        worst = () if found.ok else (("gouge", found.worst_gouge), ("rest", found.worst_rest))
        for kind, place in worst:
            if place.value > 0:
                told = str(place).removesuffix(f": {place.where}") if place.line else str(place)
                print(f"{place.where if place.line else chosen.file}: {kind}: {told}", file=sys.stderr)
    return verdict(result, quiet=chosen.json) or (CLEAN if found.ok else ALARMS)


def prove(chosen: argparse.Namespace) -> int:
    """Compare the motion of two programs."""
    setup = None if chosen.setup is None else sensible(load, chosen.setup)
    controls = chosen.controls or [None]
    files = chosen.file, chosen.other
    runs = []
    for file, control in zip(files, (controls[0], controls[-1])):
        try:
            runs.append(mnclab.run(program(file), control, setup))
        except Alarm as alarm:  # no file, or none of a control
            say(alarm, file)
            return USAGE
    found = sensible(partial(mnclab.prove, tolerance=chosen.tolerance, allow=chosen.allow), *runs)
    if chosen.html:
        sensible(found.save, chosen.html)
    print(json.dumps(found.as_dict(), allow_nan=False) if chosen.json else found)
    return CLEAN if (found.verdict == "same motion" if chosen.same_motion else found.harmless) else ALARMS


def drawing(chosen: argparse.Namespace) -> int:
    """Save the drawing of a design, or of the part that a program makes."""
    options = {"size": chosen.size} if chosen.size is not None else {}
    if program(chosen.file).suffix.lower() == ".toml":
        sensible(partial(mnclab.Design.load(chosen.file).save, **options), chosen.output)
        return CLEAN
    result = with_blank(obey(chosen))
    found = result.design()
    for note in found.notes:
        print(f"{chosen.file}: note: {note}", file=sys.stderr)
    sensible(partial(found.save, **options), chosen.output)
    return verdict(result)


def report(chosen: argparse.Namespace) -> int:
    """Write a report of a run, or one of its sheets."""
    result = obey(chosen)
    if chosen.sheet:
        sensible(getattr(result, f"{chosen.sheet.removesuffix('s')}_sheet"), chosen.output, chosen.title)
    else:
        sensible(partial(result.report, machine=chosen.machine), chosen.output, chosen.title)
    return verdict(result)


def words(text: str) -> list[str]:
    """Words between commas, one at least."""
    found = [word.strip() for word in text.split(",") if word.strip()]
    if not found:
        raise argparse.ArgumentTypeError(f"nothing stands between the commas of {text!r}")
    return found


def numbers(text: str) -> list[float]:
    """Numbers between commas."""
    return [float(word) for word in words(text)]


def verdict(result: mnclab.Run, quiet: bool = False) -> int:
    """Report the alarms of a run and return the exit status."""
    for alarm in () if quiet else result.alarms:
        say(alarm)
    return CLEAN if result.ok else ALARMS


def explain(chosen: argparse.Namespace) -> int:
    """Print what a code or a term means, or what the file of an exercise or of a design looks like."""
    found = sensible(mnclab.help, " ".join(chosen.code), chosen.control)
    sensible(found.save, chosen.output) if chosen.output else print(found)
    return CLEAN


if __name__ == "__main__":
    sys.exit(main())
