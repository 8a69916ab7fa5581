"""The command `handout`: lessons as pages to print, with what their cells showed and ruled room below the exercises;
for the teacher with the answers of the graded ones.

A lesson is run first, in the folder where it lies, by the Python that runs this. The page stands alone: style sheet and
pictures are in it, and it has no scripts. Chromium makes the PDF: it sets running heads and page numbers by the same sheet.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path
from typing import Any

from mnclab.shell.lessons import home
from mnclab.shell.saying import CLEAN, refuse, sensible
from mnclab.show.report.document import POLICY
from mnclab.text.alarm import Alarm, hint
from mnclab.text.file import replaced
from mnclab.text.given import shown
from mnclab.text.opening import opened, require

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge")
LINES = 8  # ruled ones below an exercise
HALF = 45  # minutes, of a double lesson
LONGEST = 300  # s that a cell of a lesson may take
WIDGET = "application/vnd.jupyter.widget-view+json"
PACKAGES = ("nbformat", "nbclient", "nbconvert")


def handout(chosen: argparse.Namespace) -> int:
    """Write lessons as one set of pages, .html or .pdf or both."""
    found = sensible(lessons, chosen.lesson)
    out = Path(chosen.output or f"handout_{'_'.join([*found, *['answers'] * chosen.answers])}.html")
    suffix = out.suffix.lower()
    if suffix not in (".html", ".pdf"):
        refuse(f"a handout is an .html or a .pdf file, got {shown(out.name)}")
    printer = sensible(browser) if chosen.pdf or suffix == ".pdf" else ""
    for package in PACKAGES:
        sensible(require, package, "handouts")
    text = page(found, chosen.answers)
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "handout.html")
        source.write_text(text, "utf-8")
        if suffix == ".html":
            sensible(_put, source, out)
        if printer:
            printed = print_pdf(printer, source)
            sensible(_put, printed, out.with_suffix(".pdf"))
    return CLEAN


def lessons(names: list[str] | None = None) -> dict[str, Path]:
    """The files of lessons by their two digits, without names of all; a name is a number, with or without noughts, or that of
    the file."""
    place = home()
    if place is None:
        raise Alarm("the lessons are not here", hint="start this in the folder of notebooks/; mnclab lessons DIR makes one")
    known = {path.stem[:2]: path for path in sorted((place / "notebooks").glob("[0-9][0-9]_*.ipynb"))}
    if names is None:
        return known
    stems = {path.stem: number for number, path in known.items()}
    found = {}
    for name in names:
        number = stems.get(Path(name).stem, name.zfill(2) if name.isdecimal() else "")
        if number not in known:
            there = f"there are {', '.join(known)}"
            raise Alarm(f"there is no lesson {shown(name)}; {there}", hint=hint(name, stems, slips=8))
        found[number] = known[number]
    return found


def page(found: Mapping[str, Path], answers: bool = False) -> str:
    """All lessons, run, as one HTML document; with `answers` the teacher's pages follow each."""
    from pygments.formatters import HtmlFormatter

    sheet = Path(__file__).with_suffix(".css").read_text("utf-8") + HtmlFormatter(style="bw").get_style_defs(".highlight")
    parts, titles = [], []
    for number, path in found.items():
        notebook = ran(path)
        title = notebook.cells[0].source.splitlines()[0].lstrip("# ")
        head = f"{number} · {title}"
        titles.append(head)
        sheet += f"\n@page lesson{number} {{ @top-left {{ content: {json.dumps(head, ensure_ascii=False)}; }} }}"
        parts.append(f'<main style="page: lesson{number}">{WHO}\n{body(notebook)}\n</main>')
        if answers:
            parts.append(f'<main style="page: lesson{number}">{teachers(number)}</main>')
    head = f'<meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="{POLICY}">'
    head += f"<title>{escape('; '.join(titles))}</title><style>{sheet}</style>"
    return f'<!doctype html><html lang="en"><head>{head}</head><body>\n{"".join(parts)}\n</body></html>\n'


def teachers(lesson: str) -> str:
    """Aim, time and what to show of a lesson; then its graded exercises, each with its card, its answers and what usually goes
    wrong."""
    from nbconvert.filters import markdown2html

    card = opened("mnclab.learning.card", "card")
    each = opened("mnclab.learning.exercise", "exercises")(lesson=lesson)
    head = markdown2html("\n\n".join(plan(json.loads(lessons([lesson])[lesson].read_text("utf-8")))))
    graded = "".join(f"<section>{card(one)}{answers(one)}</section>" for one in each)
    return f'<h2>For the teacher</h2><div class="plan">{head}</div>{graded}'


def plan(notebook: Mapping[str, Any]) -> Iterator[str]:
    """What a teacher reads first, as Markdown: what the head of a lesson says of aim and time, its metadata of what to show."""
    told = "\n".join("".join(cell["source"]) for cell in notebook["cells"][:3])
    head = dict(re.findall(r"^\*\*What you (.*?)\.\*\* *(.*)", told, re.M))
    yield f"**Aim.** {head.get('will do', '')}\n\n**They learn.** {head.get('will learn', '')}"
    minutes = re.search(r"(?<!\d)(\d+) minutes", head.get("need", ""))
    yield f"**Time.** The lesson {minutes[1] if minutes else HALF} minutes, the exercises {HALF} minutes: a double lesson."
    if show := notebook["metadata"].get("teacher"):
        yield "**What to show.**\n\n" + "\n".join(f"- {each}" for each in show)


def answers(exercise: Any) -> str:
    """What only a teacher reads: a right answer or two, why, and what usually goes wrong. An Alarm for a pupils' copy."""
    found = opened("mnclab.learning.answers", "answers_of")(exercise.file)
    lines = found.model.split("\n")
    right = (("A right answer", found.model), ("Another one", found.other))
    model = "".join(f"<h4>{head}</h4><pre>{escape(each.strip())}</pre>" for head, each in right if each)
    why = f"<h4>{escape(exercise.why)}</h4><p>{escape(found.why)}</p>" if exercise.why else ""
    wrong = "".join(
        f"<li><code>{escape(lines[k - 1])}</code> becomes <code>{escape(new) or '(left out)'}</code>; "
        f"the hint says: {escape(fault.hint)}</li>"
        for fault in found.faults for k, new in fault.edits.items()
    )  # fmt: skip
    return f"{model}{why}<h4>What usually goes wrong</h4><ul>{wrong}</ul>"


WHO = '<p class="who"><span>name</span><span>group</span><span>date</span></p>'


def ran(path: Path) -> Any:
    """A lesson with the outputs of its cells."""
    import nbformat
    from nbclient import NotebookClient
    from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError

    notebook = nbformat.read(path, as_version=4)
    environment = dict(os.environ)
    environment.pop("MPLBACKEND", None)  # the kernel chooses its own, as it does for people
    here = str(Path(__file__).resolve().parents[2])  # the mnclab that runs this, installed or not
    environment["PYTHONPATH"] = os.pathsep.join(filter(None, [here, environment.get("PYTHONPATH")]))
    print(f"running {path.name}", file=sys.stderr)
    client = NotebookClient(
        notebook, timeout=LONGEST, kernel_name="python3", resources={"metadata": {"path": path.parent}},
        extra_arguments=["--log-level=40"],
    )  # fmt: skip
    try:
        client.execute(env=environment)
    except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
        raise Alarm(f"lesson {path.stem} does not run to its end: {str(error).strip().splitlines()[-1]}") from None
    return notebook


def body(notebook: Any) -> str:
    """A lesson that ran, as HTML: text, code and pictures, then the exercises, each with room to write."""
    last = max((k for k, cell in enumerate(notebook.cells) if cell.source.startswith("## Exercises")), default=None)
    if last is not None:
        del notebook.cells[last + 1 :]  # the empty cells for the reader's programs
        notebook.cells[last].source = "\n\n".join(exercises(notebook.cells[last].source))
    return as_html(notebook)


def as_html(notebook: Any, players: bool = False) -> str:
    """What its cells say and have shown, without a head; with `players`, where their scripts may run."""
    from nbconvert import HTMLExporter

    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            still(output, players)
    exporter = HTMLExporter(template_name="basic", exclude_input_prompt=True, exclude_output_prompt=True)
    return str(exporter.from_notebook_node(notebook)[0])


def exercises(text: str) -> Iterator[str]:
    """The cell of the exercises, as Markdown with ruled room below each."""
    before, *items = re.split(r"^(?=\d+\. )", text, flags=re.M)
    yield before
    for item in items:
        yield f'<div class="exercise">\n\n{item.strip()}\n\n<div class="room">{"<div></div>" * LINES}</div>\n\n</div>'


def still(output: Any, players: bool = False) -> None:
    """What was shown, without widgets, which need a kernel, and without `players` where there is a picture."""
    data = output.get("data", {})
    data.pop(WIDGET, None)
    if not players and "<iframe" in data.get("text/html", "") and "image/png" in data:
        del data["text/html"]
        told = re.sub(r"; save it.*|[<>]", "", data.get("text/plain", ""))
        output.setdefault("metadata", {})["image/png"] = {"alt": told}


def browser() -> str:
    """The path of a Chromium; an Alarm if there is none."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        raise Alarm(
            "a PDF needs Chromium or Chrome, and neither is on the PATH",
            hint="without --pdf an .html file is written, which every browser prints to a PDF",
        )
    return found


def print_pdf(printer: str, source: Path) -> Path:
    """A page printed to a PDF beside it."""
    out = source.with_suffix(".pdf")
    command = [printer, "--headless", "--disable-gpu", "--no-pdf-header-footer", f"--print-to-pdf={out}", source.as_uri()]
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        command.insert(1, "--no-sandbox")  # which Chromium refuses to have as root; the page has no scripts
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=LONGEST, check=False)
    if not out.is_file():
        raise Alarm(f"{printer} made no PDF of the pages", hint="without --pdf an .html file is written")
    return out


def _put(source: Path, out: Path) -> None:
    with replaced(out) as beside:
        shutil.copyfile(source, beside)
    print(out)
