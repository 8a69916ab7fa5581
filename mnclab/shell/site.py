"""The command `site`: a folder of pages that need neither a network nor a kernel: the reference, the tables of every control,
the glossary, and the lessons with what their cells showed.

The reference is made by pdoc of what stands at the front door and on the shelves, and of nothing else: a page a shelf, and one
of what calls give back. The tables are made of the declarations of the controls.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from html import escape, unescape
from pathlib import Path
from typing import Any, NamedTuple

from mnclab.controls import CONTROLS
from mnclab.controls.choice import Help
from mnclab.controls.glossary import glossary
from mnclab.machine.control import Control, settings_html
from mnclab.machine.terms import terms
from mnclab.shell.handout import PACKAGES, as_html, lessons, ran
from mnclab.shell.reference import about, documents
from mnclab.shell.saying import ALARMS, CLEAN, refuse, say, sensible
from mnclab.text.alarm import Alarm
from mnclab.text.file import reason, replaced
from mnclab.text.given import shown
from mnclab.text.opening import require
from mnclab.text.tables import html_table

MARK = '<meta name="generator" content="mnclab site">'  # of the first page, by which a site of ours is known
NO_LESSONS = "They were left out; <code>mnclab site</code> without <code>--no-lessons</code> runs them."
FUNCTION = ("code", "title", "what it does", "group", "at power-on", "source", "in the manual")


class Place(NamedTuple):
    """Something that can be looked for: its name, what it is, and where it stands, from the folder of the site."""

    name: str
    what: str
    href: str


def site(chosen: argparse.Namespace) -> int:
    """Write the pages into a folder: an empty one, or that of a site."""
    out = Path(chosen.output)
    if out.exists() and (not out.is_dir() or any(out.iterdir())) and MARK not in _text(out / "index.html"):
        refuse(f"{out} is there already, and something other than a site is in it", "name another folder")
    if chosen.jobs < 1:
        refuse(f"-j must be at least 1, got {shown(chosen.jobs)}")
    sensible(require, "pdoc", "pages of the reference", "site")
    found = {} if chosen.no_lessons else sensible(lessons)
    for package in PACKAGES if found else ():
        sensible(require, package, "lessons")
    return CLEAN if sensible(Site(out).build, found, chosen.jobs) else ALARMS


def _text(file: Path) -> str:
    return file.read_text("utf-8", "replace") if file.is_file() else ""


class Site:
    """The pages that are written to a folder, and what can be found on them."""

    def __init__(self, out: Path) -> None:
        import pdoc.render

        self.out, self.places = out, list[Place]()
        pdoc.render.configure(docformat="markdown", show_source=False, template_directory=Path(__file__).with_name("pages"))
        self.environment = pdoc.render.env
        controls = [(name, f"controls/{name}.html") for name in CONTROLS]
        self.environment.globals["ways"] = [
            ("mnclab", "index.html"), ("reference", "reference/mnclab.html"), *controls, ("glossary", "glossary.html"),
            ("lessons", "index.html#lessons"),
        ]  # fmt: skip

    def build(self, found: Mapping[str, Path], jobs: int) -> bool:
        """Write all pages; whether every lesson ran to its end. An Alarm where a page cannot be written."""
        self.reference()
        for name, control in CONTROLS.items():
            self.control(name, control)
        self.glossary()
        ran_all = self.lessons(found, jobs)
        self.index()
        return ran_all

    def write(self, name: str, text: str) -> None:
        """A page, by its name from the folder of the site."""
        path = self.out / name
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise Alarm(f"{path.parent} cannot be made: {reason(error)}") from None
        with replaced(path) as beside:
            beside.write_text(text, "utf-8", newline="\n")
        print(path, flush=True)

    def page(
        self, name: str, title: str, body: str, entries: Iterable[tuple[str, str]] = (), find: str = "", head: str = ""
    ) -> None:
        """A page in the frame of the reference; what it says of mnclab leads there, `entries` are its table of contents."""
        root = "../" * name.count("/")
        made = self.environment.get_template("page.html.jinja2").render(
            title=title, body=self.linked(body, root), entries=entries, find=find, root=root
        )
        self.write(name, made.replace("<head>", f"<head>{head}", 1))

    def linked(self, body: str, root: str) -> str:
        """Names such as `mnc.part.box(…)` with the way to the reference."""
        known = {place.name: place.href for place in self.places if place.what == "reference"}

        def way(found: re.Match[str]) -> str:
            parts = found[1].split(".")
            names = (".".join(["mnclab", *parts[:k]]) for k in range(len(parts), 0, -1))
            href = next((known[name] for name in names if name in known), None)
            return f'<a href="{root}{href}">{found[0]}</a>' if href else found[0]

        return re.sub(r"<code>(?:mnclab|mnc)\.(\w++(?:\.\w++)*+)[^<]*+</code>(?!</a>)", way, body)

    # The reference.

    def reference(self) -> None:
        """A page a shelf, one of what calls give back, and what pdoc needs to search them."""
        import pdoc.render

        documented = documents()
        self.write("reference/search.js", pdoc.render.search_index(documented))
        for name, page in documented.items():
            href = f"reference/{name.replace('.', '/')}.html"
            self.write(href, pdoc.render.html_module(page, documented))
            self.places.append(Place(name, "reference", href))
            for each in page.flattened_own_members:
                self.places.append(Place(f"{name}.{each.qualname}", "reference", f"{href}#{each.qualname}"))
                inner = getattr(each, "own_members", ())
                self.places += [
                    Place(f"{name}.{one.qualname}", "reference", f"{href}#{one.qualname}")
                    for one in inner if not one.name.startswith("_")
                ]  # fmt: skip

    # The controls.

    def control(self, name: str, control: Control) -> None:
        """Functions, cycles with their parameters, words, settings, what is refused, and the terms of the manual."""
        href = f"controls/{name}.html"
        cycles = {code: each for code, each in control.cycles.items() if code == each.code}
        others = {code: each.code for code, each in control.cycles.items() if code != each.code}
        listed = control.listed
        functions = [
            (one.code, one.title, _sentence(one.doc, one.takes), one.group or "", "●" if one.power_on else "", one.source,
             control.term(one.code)) for one in listed.values()
        ]  # fmt: skip
        of_cycles = [
            f'<section class="find" id="{anchor(code)}">{Help(each, control)._repr_html_()}</section>'
            for code, each in cycles.items()
        ]
        parts = {
            "Functions": _anchored(html_table(FUNCTION, functions, code=(0,))),
            "Cycles": "".join(of_cycles) + (html_table(("code", "is"), others.items(), code=(0, 1)) if others else ""),
            "Words of functions": html_table(("word", "meaning"), control.meanings.items(), code=(0,)),
            "Settings": settings_html(control.settings),
            "What is refused by name": _anchored(html_table(("code", "why"), control.refused.items(), code=(0,))),
            "Terms of the manual": html_table(("code", "title", "kind", "in the manual"), [
                (one.code, one.title, one.kind, "; ".join(one.said)) for one in terms(control.terms).values()], code=(0,)),
        }  # fmt: skip
        parts = {title: text for title, text in parts.items() if "<td" in text}
        body = "".join(
            f'<h2 id="{anchor(title)}">{title}</h2><div class="{"" if title in ("Cycles", "Settings") else "find"}">{text}</div>'
            for title, text in parts.items()
        )
        suffixes = f"Programs end in {', '.join(control.suffixes)}. " if control.suffixes else ""
        called = f'{suffixes}In Python it is <code>control="{escape(name)}"</code>.'
        entries = [*((title, f"#{anchor(title)}") for title in parts), *((code, f"#{anchor(code)}") for code in cycles)]
        body = re.sub(r"`([^`<>]+)`", r"<code>\1</code>", f"<h1>{escape(control.title)}</h1><p>{called}</p>{body}")
        self.page(href, control.title, body, entries, "Filter the tables")
        for code, title in [*((one.code, one.title) for one in listed.values()), *((c, one.title) for c, one in cycles.items())]:
            self.places.append(Place(code, f"{name}: {title}", f"{href}#{anchor(code)}"))
        for setting in control.settings:
            self.places.append(Place(setting.name, f"{name}: setting, {setting.meaning}", f"{href}#Settings"))

    def glossary(self) -> None:
        """All terms with their pictures."""
        sections = re.split(r"(?=<section )", glossary().entries)[1:]
        body = "".join(
            section.replace("<section ", f'<section class="find" id="{anchor(entry.term)}" ', 1)
            for entry, section in zip(glossary(), sections, strict=True)
        )
        entries = [(entry.term, f"#{anchor(entry.term)}") for entry in glossary()]
        self.page("glossary.html", "Glossary", f"<h1>Glossary</h1>{body}", entries, "Filter the terms")
        self.places += [
            Place(entry.term, f"term {entry.manuals}", f"glossary.html#{anchor(entry.term)}") for entry in glossary()
        ]

    # The lessons.

    def lessons(self, found: Mapping[str, Path], jobs: int) -> bool:
        """Run lessons, `jobs` at a time, and write them; whether each ran to its end. One that did not is said."""
        ran_all = True
        pool = ThreadPoolExecutor(jobs)
        try:
            running = {path: pool.submit(ran, path) for path in found.values()}
            for path, waiting in running.items():
                try:
                    self.lesson(path, waiting.result())
                except Alarm as alarm:
                    say(alarm, str(path))
                    ran_all = False
        finally:
            pool.shutdown(cancel_futures=True)
        return ran_all

    def lesson(self, path: Path, notebook: Any) -> None:
        """A lesson that ran: players stay players, of a form the text or the picture is left."""
        text = re.sub(r'<a href="(?!https?:|#)([^"]*)">((?:[^<]|<(?!a |/a>))*+)</a>', _way, as_html(notebook, players=True))
        text = text.replace('class="highlight', 'class="pdoc-code highlight')  # in the colours of the reference
        heads = re.findall(r'<h2 id="([^"]+)"', text)
        title = notebook.cells[0].source.splitlines()[0].lstrip("# ")
        self.page(f"lessons/{path.stem}.html", title, text, [(head.replace("-", " "), f"#{head}") for head in heads])

    # The first page.

    def index(self) -> None:
        """What it is, and the way to everything; the lessons are those that are in the folder, of this time or an earlier one."""
        says = "".join(f"<p>{escape(each)}</p>" for each in about("mnclab").split("\n\n"))
        reference = [place for place in self.places if place.what == "reference" and "#" not in place.href]
        controls = [(name, f"controls/{name}.html", one.title) for name, one in CONTROLS.items()]
        pages = sorted((self.out / "lessons").glob("[0-9][0-9]_*.html"))
        heads = {page: re.search("<title>([^<]*)</title>", _text(page)) for page in pages}
        titles = {page: unescape(head[1]).removesuffix(" · mnclab") for page, head in heads.items() if head}
        self.places += [Place(title, "lesson", f"lessons/{page.name}") for page, title in titles.items()]
        found = "".join(f'<a href="{escape(p.href)}">{escape(p.name)} <small>{escape(p.what)}</small></a>' for p in self.places)
        parts = {
            "Reference": [(place.name, place.href, _first(about(place.name))) for place in reference],
            "Controls": controls,
            "Words": [("glossary", "glossary.html", "the words of the trade, and what the manuals call them")],
            "Lessons": [(page.stem[:2], f"lessons/{page.name}", title) for page, title in titles.items()],
        }
        body = ""
        for title, rows in parts.items():
            cells = (f'<td><a href="{to}">{escape(name)}</a></td><td>{escape(does)}</td>' for name, to, does in rows)
            table = f"<table>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>" if rows else f"<p>{NO_LESSONS}</p>"
            body += f'<h2 id="{title.lower()}">{title}</h2>{table}'
        head = f'<h1>mnclab {sys.modules["mnclab"].__version__}</h1>{says}<div class="found" hidden>{found}</div>'
        self.page("index.html", "mnclab", head + body, (), "Find a code, a name, a term", MARK)


def anchor(name: str) -> str:
    """A code, a term or a heading as a place on a page."""
    return escape(name.replace(" ", "-"))


def _anchored(table: str) -> str:
    """A table whose rows can be led to by their first cells."""
    row = re.compile(r"<tr>(?=<td[^>]*><code>([^<]+)</code>)")
    return row.sub(lambda found: f'<tr id="{anchor(unescape(found[1]))}">', table)


def _sentence(doc: str, takes: Iterable[str]) -> str:
    """What a function does and takes, without line ends."""
    return " ".join([*doc.split(), *(["takes", *takes] if takes else [])])


def _way(found: re.Match[str]) -> str:
    """A link of a lesson: to another lesson, to the first page, or none where the pages do not have it."""
    if found[1] == "README.md":
        return f'<a href="../index.html">{found[2]}</a>'
    return f'<a href="{found[1].removesuffix("ipynb")}html">{found[2]}</a>' if found[1].endswith(".ipynb") else found[2]


def _first(text: str) -> str:
    return text.partition("\n")[0].removesuffix(" ::")
