"""What must stay while the house is rebuilt: recorded once, replayed after each step, and told where it differs.

A record keeps what it was asked, so a later tree answers the same questions, wherever its own samples have gone::

    python tests/unchanged.py record before.json.gz                 # in the tree as it was
    python tests/unchanged.py replay before.json.gz                 # in the tree as it is: one line a difference
    python tests/unchanged.py replay before.json.gz --only names pictures --shown 40

Chapters: `names` (signatures and docstrings behind the front door, its shelves and the classes that they lead to), `runs`
(card, alarms, path, values, times, cuts of samples, listings, manuals' examples and refused programs), `pictures` (lines,
patches and texts of 60 programs in 12 pictures), `parts` (volumes and differences), `lessons` (what their cells print).
Numbers are kept to 12 digits and compared at 1e-9, places in pictures at 1e-6.
"""

import argparse
import contextlib
import gzip
import hashlib
import inspect
import io
import json
import math
import os
import re
import sys
from pathlib import Path

os.environ.setdefault("MPLBACKEND", "agg")

import numpy as np
from tools import refusals

import mnclab

TESTS = Path(__file__).resolve().parent
ROOT = TESTS.parent
CONTROLS = ["mnc", "jnc-t01", "nc-31", "g43", "tnc-620"]
CONTROL_OF = {"jnc-t01": "jnc-t01", "nc-31": "nc-31", "turning": "jnc-t01", "tnc620": "tnc-620", "programs-tnc-620": "tnc-620"}
TOLERANCE = {"pictures": 1e-6}  # mm; 1e-9 elsewhere


# --- what is asked ----------------------------------------------------------------------------------------------------


def questions():
    """Programs by name: text, control, and the file of its setup, if any."""
    found = {}
    for control in CONTROLS:
        for file in sorted((ROOT / "data" / "programs" / control).iterdir()):
            setup = ROOT / "data" / "setups" / control / f"{file.stem}.toml"
            found[f"sample {control}/{file.name}"] = (mnclab.read(file, control).text, control, setup)
        for folder in ("programs", "recognition"):
            for file in sorted((TESTS / folder / control).glob("*")):
                if file.is_file() and file.suffix != ".expected":
                    found[f"{folder} {control}/{file.name}"] = (mnclab.read(file, control).text, control, None)
        for refusal in refusals.of(control):
            found[f"refused {control}/{refusal.file.stem} {refusal.name}"] = (refusal.text, control, None)
    for file in sorted((TESTS / "authorities" / "catalogue").glob("*.json")):
        control = next((name for start, name in CONTROL_OF.items() if file.name.startswith(start)), "mnc")
        for number, entry in enumerate(json.loads(file.read_text("utf-8"))):
            if isinstance(entry, dict) and entry.get("program"):
                found[f"manual {file.stem} {number}"] = (entry["program"], control, None)
    return {
        name: {"text": text, "control": control, "setup": setup.read_text("utf-8") if setup and setup.exists() else ""}
        for name, (text, control, setup) in found.items()
    }


def run_of(question):
    """The run of a question; its samples may call each other."""
    control = question["control"]
    setup = None
    if question["setup"]:
        setup = Path(os.environ.get("TMPDIR", "/tmp")) / f"mnclab-unchanged-{os.getpid()}.toml"
        setup.write_text(question["setup"], "utf-8")
    elif control == "nc-31":
        setup = mnclab.Setup(start=(30, 0, 2))
    return mnclab.run(mnclab.read(question["text"] + "\n", control), setup=setup)


# --- what is answered -------------------------------------------------------------------------------------------------


def told(value):
    """A number to 12 digits; a text as it is; an array as its digits."""
    if isinstance(value, np.ndarray):
        return [told(each) for each in value.tolist()]
    if isinstance(value, list | tuple):
        return [told(each) for each in value]
    if isinstance(value, dict):
        return {str(key): told(each) for key, each in value.items()}
    if isinstance(value, float):
        return float(f"{value:.12g}") if math.isfinite(value) else str(value)
    return value if isinstance(value, int | str | bool | type(None)) else str(value)


def or_alarm(call):
    """What a call gives, or what its alarm says."""
    try:
        return call()
    except mnclab.Alarm as alarm:
        return f"alarm: {alarm}"


COLUMNS = ["kind", "start", "end", "centre", "sweep", "axis", "rotary", "feed", "spindle", "tool", "time", "step", "rule"]


def answer(question):
    """Everything a run says without a picture."""
    run = run_of(question)
    path = run.toolpath
    found = {
        "ok": run.ok,
        "card": str(run),
        "alarms": [str(alarm) for alarm in run.alarms],
        "places": [list(alarm.span) if alarm.span else None for alarm in run.alarms],
        "variables": told(dict(run.variables)),
        "labels": [path.labels[k] for k in path.label] if len(path) < 5000 else len(path),
    }
    if len(path) < 5000:
        found |= {f"path {name}": told(np.asarray(getattr(path, name))) for name in COLUMNS if hasattr(path, name)}
    found["page"] = run._repr_html_()
    found["blocks"] = [str(block) for block in run.program][:400]
    if run.ok:
        found["seconds"] = told(or_alarm(lambda: float(run.profile().time)))
        for name in ("holes", "collisions", "cutting_data", "removal"):
            found[name] = told(or_alarm(lambda name=name: str(getattr(run, name)())))
        lines = sorted({int(line) for line in run.lines()})[:40]
        found["explained"] = [or_alarm(lambda line=line: str(run.explain(line))) for line in lines]
    return found


def classes():
    """The classes of the front door and those that a run leads to."""
    shelves = [mnclab.part, mnclab.blank, mnclab.design, mnclab.area, mnclab.strategies, mnclab.schemes, mnclab.probing]
    for name in mnclab.__all__:
        yield name, getattr(mnclab, name)
    yield "help", mnclab.help
    for shelf in shelves:
        for name in shelf.__all__:
            yield f"{shelf.__name__}.{name}", getattr(shelf, name)
    for control in CONTROLS:
        yield f"controls[{control}]", type(mnclab.controls[control])
    run = mnclab.run("T1 S900 M3 F100\nG0 X10 Y10 Z2\nG1 Z-5\nG0 Z2\nX30\n", "mnc")
    for name, call in {
        "holes": run.holes, "collisions": run.collisions, "removal": run.removal, "cutting_data": run.cutting_data,
        "profile": run.profile, "workpiece": run.workpiece, "explain": lambda: run.explain(1), "at": lambda: run.at(1),
        "executions": lambda: run.executions(1), "when": lambda: run.when("z < 0"), "design": run.design,
    }.items():  # fmt: skip
        with contextlib.suppress(mnclab.Alarm):
            yield f"of run.{name}", type(call())


HOME = re.compile(r"\bmnclab(?:\.\w+)+\.(?=\w)")


def said(thing):
    """Signature and docstring, without the files where names live."""
    try:
        signature = HOME.sub("", str(inspect.signature(thing)))
    except (TypeError, ValueError):
        signature = ""
    return {"signature": re.sub(r" at 0x\w+", "", signature), "doc": inspect.getdoc(thing) or ""}


def names():
    """What Tab shows: each name with its signature and docstring, and the members of classes."""
    found = {}
    for name, thing in classes():
        if inspect.isclass(thing):
            found[name] = said(thing)
            for member in sorted(each for each in dir(thing) if not each.startswith("_") or each == "_repr_html_"):
                value = inspect.getattr_static(thing, member)
                value = value.fget if isinstance(value, property) else getattr(value, "__func__", value)
                found[f"{name}.{member}"] = said(value) if callable(value) else {"value": type(value).__name__}
        elif callable(thing):
            found[name] = said(thing)
        else:
            found[name] = {"kind": type(thing).__name__}
    for control in CONTROLS:
        for code in mnclab.controls[control].cycles:
            found[f"help {control} {code}"] = {"text": str(mnclab.help(code, control))}
        found[f"help {control}"] = {"text": or_alarm(lambda control=control: str(mnclab.help(control=control)))}
    return found


PICTURES = {
    "path": lambda run: run.plot(),
    "toolpath": lambda run: run.toolpath.plot(),
    "from the front": lambda run: run.plot(view="XZ"),
    "compensation": lambda run: run.plot_compensation(),
    "depth": lambda run: run.plot_depth(),
    "face": lambda run: run.plot_face(),
    "lengths": lambda run: run.plot_lengths(next(int(line) for line in run.lines())),
    "datums": lambda run: run.plot_datums(),
    "measured": lambda run: run.plot_measured(),
    "speed": lambda run: run.plot_speed(),
    "profile": lambda run: run.profile().plot(),
    "part": lambda run: run.workpiece().plot(),
    "removal": lambda run: run.removal().plot(),
}


def drawn(figure):
    """Lines, patches, collections and texts of a figure, in the order in which they are drawn."""
    figure.canvas.draw()
    found = []
    for axes in figure.axes:
        marks = []
        for line in axes.lines:
            marks.append(["line", told(np.asarray(line.get_xydata(), float)), str(line.get_color()), line.get_linestyle()])
        for patch in axes.patches:
            ways = patch.get_path()
            marks.append(["patch", type(patch).__name__, told(np.asarray(ways.vertices, float)), told(patch.get_facecolor())])
        for many in axes.collections:
            ways = [told(np.asarray(way.vertices, float)) for way in many.get_paths()]
            marks.append(["collection", type(many).__name__, ways, told(np.asarray(many.get_offsets(), float))])
        for text in axes.texts:
            marks.append(["text", text.get_text(), told(np.asarray(text.get_position(), float).tolist())])
        for image in axes.images:
            marks.append(["image", hashlib.sha1(np.ascontiguousarray(image.get_array()).tobytes()).hexdigest()])
        titles = [axes.get_title(), axes.get_xlabel(), axes.get_ylabel(), told(axes.get_xlim()), told(axes.get_ylim())]
        found.append({"titles": titles, "marks": marks, "legend": legend(axes)})
    found.append([[text.get_text(), told(list(text.get_position()))] for text in figure.texts])
    return found


def legend(axes):
    shown = axes.get_legend()
    return [text.get_text() for text in shown.get_texts()] if shown else []


def pictures(question):
    """What each picture of a run draws, or its alarm."""
    import matplotlib.pyplot as plt

    run, found = run_of(question), {}
    for name, draw in PICTURES.items():
        try:
            figure = draw(run)
            figure = getattr(figure, "figure", figure)
            data = drawn(figure)
            text = json.dumps(data)
            found[name] = data if len(text) < 30_000 else coarse(data)
        except (mnclab.Alarm, TypeError) as error:
            found[name] = f"{type(error).__name__}: {HOME.sub('', str(error))}"
        plt.close("all")
    return found


def coarse(value):
    """Long lists of numbers as their count, sum and sum of squares with places: they move when any of them moves."""
    if isinstance(value, list):
        flat = np.array(list(numbers_of(value)))
        if len(flat) > 24 and not any(isinstance(each, str | dict) for each in flat_items(value)):
            weights = 1 + np.arange(len(flat)) % 97
            return ["so many", len(flat), told(float(flat.sum())), told(float((flat * weights).sum() / len(flat)))]
        return [coarse(each) for each in value]
    return {key: coarse(each) for key, each in value.items()} if isinstance(value, dict) else value


def flat_items(value):
    for each in value:
        if isinstance(each, list):
            yield from flat_items(each)
        else:
            yield each


def numbers_of(value):
    return (float(each) for each in flat_items(value) if isinstance(each, int | float))


def parts(question):
    """Volumes of the part and of each tool, and what a design of the run differs by."""
    run = run_of(question)
    part = or_alarm(run.workpiece)
    if isinstance(part, str):
        return {"part": part}
    found = {"volume": told(float(part.volume))}
    for by in ("tool", "line"):
        found[f"removed by {by}"] = told(or_alarm(lambda by=by: dict(part.removed_by(by))))
    made = or_alarm(run.design)
    if not isinstance(made, str):
        found["design"] = str(made)
        found["difference"] = or_alarm(lambda: str(part.compare(made)))
    return {key: told(value) for key, value in found.items()}


def lesson(file):
    """What the cells of a lesson print and show as text; pictures as their size only."""
    import nbformat
    from nbclient import NotebookClient

    book = nbformat.read(file, as_version=4)
    NotebookClient(book, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(file.parent)}}).execute()
    found = []
    for cell in book.cells:
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            text = output.get("text") or data.get("text/plain", "")
            found.append(re.sub(r"0x\w+|[0-9a-f]{32}", "…", text))
    return found


# --- record and replay ------------------------------------------------------------------------------------------------


def spread(found, many):
    """So many names, spread evenly."""
    keys = sorted(found)
    return keys if len(keys) <= many else [keys[k * len(keys) // many] for k in range(many)]


def chapters(asked):
    """Each chapter: its entries and what answers one."""
    shown = [name for name in asked if name.startswith(("sample", "programs"))]
    by_control = {c: {n: asked[n] for n in shown if asked[n]["control"] == c} for c in CONTROLS}
    sixty = [name for c in CONTROLS for name in spread(by_control[c], 12)]
    samples = [name for name in asked if name.startswith("sample")]
    lessons = [file.name for file in sorted((ROOT / "notebooks").glob("*.ipynb"))]
    return {
        "names": (["all"], lambda name: names()),
        "runs": (list(asked), lambda name: answer(asked[name])),
        "pictures": (sixty, lambda name: pictures(asked[name])),
        "parts": (samples, lambda name: parts(asked[name])),
        "lessons": (lessons, lambda name: lesson(ROOT / "notebooks" / name)),
    }


def safely(call, name):
    """An answer; an error that is no alarm is an answer, too."""
    try:
        return call(name)
    except Exception as error:  # what a replay must tell
        return f"{type(error).__name__}: {error}"


def differences(old, new, near, where=""):
    """Places where two answers differ, each with both."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key in [*old, *(key for key in new if key not in old)]:
            if key not in old or key not in new:
                yield f"{where}/{key}", old.get(key, "(nothing)"), new.get(key, "(nothing)")
            else:
                yield from differences(old[key], new[key], near, f"{where}/{key}")
    elif isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        for k, (a, b) in enumerate(zip(old, new, strict=True)):
            yield from differences(a, b, near, f"{where}[{k}]")
    elif isinstance(old, float | int) and isinstance(new, float | int) and not isinstance(old, bool):
        if abs(old - new) > near * max(1.0, abs(old) if near < 1e-8 else 1.0):
            yield where, old, new
    elif old != new:
        yield where, old, new


def by_hand():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("what", choices=["record", "replay"])
    options.add_argument("file", type=Path)
    options.add_argument("--only", nargs="*", default=[], help="some of the chapters")
    options.add_argument("--match", default="", help="entries whose names contain this")
    options.add_argument("--shown", type=int, default=20, help="differences told a chapter")
    given = options.parse_args()
    record = {} if given.what == "record" else json.loads(gzip.decompress(given.file.read_bytes()))
    asked = record.get("asked") or questions()
    answers = record.get("answers", {})
    bad = 0
    for chapter, (entries, call) in chapters(asked).items():
        if given.only and chapter not in given.only:
            continue
        found = {}
        for name in entries:
            if given.match in name:
                with contextlib.redirect_stdout(io.StringIO()):
                    found[name] = json.loads(json.dumps(safely(call, name)))
        if given.what == "record":
            answers[chapter] = found
            print(f"{chapter}: {len(found)} recorded", flush=True)
            continue
        before = {name: each for name, each in answers[chapter].items() if given.match in name}
        told_so_far = list(differences(before, found, TOLERANCE.get(chapter, 1e-9)))
        bad += len(told_so_far)
        print(f"{chapter}: {len(found)} replayed, {len(told_so_far)} differences", flush=True)
        for where, old, new in told_so_far[: given.shown]:
            print(f"  {where}\n    was {str(old)[:300]}\n    is  {str(new)[:300]}")
    if given.what == "record":
        given.file.write_bytes(gzip.compress(json.dumps({"asked": asked, "answers": answers}).encode(), 6))
        print(f"{given.file}: {given.file.stat().st_size / 1e6:.1f} MB")
    sys.exit(bad > 0)


if __name__ == "__main__":
    by_hand()
