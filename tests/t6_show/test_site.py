"""The pages of `mnclab site`: every name and every code has its place, every link leads somewhere, nothing comes from a network.

Expected are the stubs and the declarations; what a page refers to is read from the page by the parser of Python.
"""

import re
import sys
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from unittest.mock import Mock
from urllib.parse import unquote

import pytest

pytest.importorskip("pdoc")

import mnclab
from mnclab import Alarm
from mnclab import __main__ as shell
from mnclab.controls.glossary import Entry
from mnclab.shell import site as command
from mnclab.shell.handout import lessons
from mnclab.shell.reference import documents

HOUSE = Path(mnclab.__file__).parent
LOADS = {"src", "poster", "data", "srcset"}  # attributes that fetch what they name; href does where the tag is a link
FETCHED = re.compile(r"(?:url\(|@import)\s*[\"']?(https?:|//)")


class Page(HTMLParser):
    """What a page fetches, where it leads to, and the places on it; a page in a frame of it counts as part of it."""

    def __init__(self, text):
        super().__init__()
        self.fetches, self.ways, self.places, self._in = [], [], set(), ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self._in = tag
        given = {name: value or "" for name, value in attrs}
        if "id" in given:
            self.places.add(given["id"])
        self.fetches += [given[name] for name in LOADS & set(given)] + [given.get("href", "")] * (tag == "link")
        self.fetches += FETCHED.findall(given.get("style", ""))
        if tag == "a" and "href" in given:
            self.ways.append(given["href"])
        if "srcdoc" in given:
            self.fetches += Page(given["srcdoc"]).fetches

    def handle_data(self, data):
        if self._in == "style":
            self.fetches += FETCHED.findall(data)


def typed(*arguments):
    """The exit status of a command line."""
    try:
        return shell.main(["site", *arguments])
    except SystemExit as end:
        return end.code


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The folder of a site without lessons and without the pictures of the glossary, which take half the time."""
    out = tmp_path_factory.mktemp("site")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Entry, "drawn", "")
        assert typed("-o", str(out), "--no-lessons") == 0
    return out


def pages_of(out):
    return {path: Page(path.read_text("utf-8")) for path in out.rglob("*.html")}


def faults(out):
    """What is fetched from elsewhere, and ways that lead nowhere."""
    pages = pages_of(out)
    for path, page in pages.items():
        yield from (f"{path.name} fetches {each[:80]}" for each in page.fetches if re.match(r"(https?:)?//", each))
        for way in page.ways:
            if way.startswith(("http://", "https://")):
                continue
            name, _, place = way.partition("#")
            there = (path.parent / unquote(name)).resolve() if name else path
            if there not in pages or (place and unquote(place) not in pages[there].places):
                yield f"{path.name} leads to {way}"


def test_nothing_is_fetched_from_elsewhere_and_every_way_leads_somewhere(built):
    assert list(faults(built)) == []


def stubbed(stub):
    """The names of a stub, as editors read them."""
    return re.findall(r"^from mnclab\.\S+ import \w+ as (\w+)$", stub.read_text("utf-8"), re.M)


def test_every_public_name_stands_in_the_reference(built):
    stubs = {f"mnclab/{stub.stem}": stub for stub in HOUSE.glob("[a-z]*.pyi")} | {"mnclab/design": HOUSE / "design/__init__.pyi"}
    stubs["mnclab"] = HOUSE / "__init__.pyi"
    assert len(stubs) == 8
    for name, stub in stubs.items():
        places = Page((built / "reference" / f"{name}.html").read_text("utf-8")).places
        lost = {each for each in stubbed(stub) if each not in places} - {"load_ipython_extension"}
        lost -= {each for each in lost if (built / "reference" / name / f"{each}.html").is_file()}  # a shelf on a shelf
        assert not lost, name


def test_no_private_module_is_named_in_the_reference(built):
    """But for what a docstring says: annotations have the names that a user has."""
    for path in (built / "reference").rglob("*.html"):
        heads = re.findall(r'<div class="attr (?:class|function)">(.*?)</div>', path.read_text("utf-8"), re.S)
        assert len(heads) > 10
        text = re.sub("<[^>]+>", "", " ".join(heads))
        assert not re.findall(r"mnclab\.(?!(?:area|blank|design|part|probing|schemes|strategies)\.)[a-z]\w*\.\w+", text)
        assert "mnclab.design.model" not in text


def test_what_calls_give_back_is_described():
    documented = documents()
    shown = {each.obj for page in documented.values() for each in page.classes}
    for result in (mnclab.Run.explain, mnclab.Run.holes, mnclab.Run.largest_radius, mnclab.Workpiece.compare):
        name = result.__annotations__["return"].strip('"')
        assert name.split(".")[-1] in {each.__name__ for each in shown}, name
    assert "plot" in {each.name for each in documented["mnclab"].get("Run").own_members}  # of a base class


@pytest.mark.parametrize("name", list(mnclab.controls))
def test_every_code_stands_in_the_tables_of_its_control(built, name):
    control = mnclab.controls[name]
    text = (built / "controls" / f"{name}.html").read_text("utf-8")
    page = Page(text)
    codes = [*control.listed, *(code for code, each in control.cycles.items() if code == each.code), *control.refused]
    assert not [code for code in codes if code.replace(" ", "-") not in page.places]
    cells = {unescape(re.sub("<[^>]+>", "", cell)) for cell in re.findall(r"<td[^>]*>(.*?)</td>", text, re.S)}
    assert not [code for code, each in control.cycles.items() if code != each.code and code not in cells]
    for code, cycle in control.cycles.items():
        section = text.partition(f'id="{cycle.code.replace(" ", "-")}"')[2].partition("</section>")[0]
        told = {unescape(each) for each in re.findall(r"<code>([^<]*)</code>", section)}
        assert not [each.address for each in cycle.parameters() if each.address not in told], code
    assert not [each.name for each in control.settings if each.name not in cells]
    assert not [each for each in control.meanings if each not in cells]


def test_the_first_page_finds_codes_terms_and_names(built):
    page = (built / "index.html").read_text("utf-8")
    for href in ("controls/jnc-t01.html#G73", "controls/mnc.html#G83", "glossary.html#equidistant",
                 "reference/mnclab.html#Run.explain", "reference/mnclab/part.html#box"):  # fmt: skip
        assert f'href="{href}"' in page, href


def test_only_an_empty_folder_or_that_of_a_site_is_taken(built, tmp_path, capsys, monkeypatch):
    (tmp_path / "thesis.txt").write_text("mine")
    assert typed("-o", str(tmp_path), "--no-lessons") == 2
    assert "something other than a site is in it" in capsys.readouterr().err and len(list(tmp_path.iterdir())) == 1
    file = tmp_path / "thesis.txt"
    assert typed("-o", str(file), "--no-lessons") == 2 and file.read_text() == "mine"
    assert typed("-o", str(file / "site"), "--no-lessons") == 2
    assert "cannot be made" in capsys.readouterr().err
    made = Mock()
    made.return_value.build.return_value = True
    monkeypatch.setattr(command, "Site", made)
    for out in (built, tmp_path / "new"):
        assert typed("-o", str(out), "--no-lessons") == 0
    assert made.call_count == 2


def test_without_pdoc_the_extra_is_named(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "pdoc", None)
    assert typed("-o", str(tmp_path / "site")) == 2 and not (tmp_path / "site").exists()
    said = capsys.readouterr().err
    assert "need pdoc" in said and 'pip install "mnclab[site]" brings it' in said


def test_jobs_are_one_at_least(tmp_path, capsys):
    assert typed("-o", str(tmp_path), "-j", "0") == 2 and "-j must be at least 1" in capsys.readouterr().err


@pytest.mark.deep
def test_a_lesson_that_does_not_run_is_said_and_the_others_are_written(tmp_path, capsys, monkeypatch):
    """Its status is that of an alarm."""
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("nbconvert")

    def ran(path):
        if path.stem.startswith("01"):
            raise Alarm("lesson 01_blocks_and_words does not run to its end: NameError")
        prose = "# Arcs\n\n[map](README.md), [08](08_x.ipynb), [plan](plans/marks.md), `mnc.run(…)`"
        return nbformat.v4.new_notebook(cells=[nbformat.v4.new_markdown_cell(prose), nbformat.v4.new_code_cell("mnc.run()")])

    monkeypatch.setattr(command, "ran", ran)
    made = command.Site(tmp_path)
    made.places.append(command.Place("mnclab.run", "reference", "reference/mnclab.html#run"))
    assert not made.lessons(lessons(["1", "3"]), 2)
    assert "01_blocks_and_words does not run to its end" in capsys.readouterr().err
    (page,) = tmp_path.glob("lessons/*.html")
    text = page.read_text("utf-8")
    assert page.name == "03_arcs.html" and "<title>Arcs · mnclab</title>" in text
    ways = Page(text).ways
    assert {"../index.html", "08_x.html", "../reference/mnclab.html#run"} <= set(ways) and "plans/marks.md" not in ways


@pytest.mark.deep
def test_lessons_stand_beside_it(built, monkeypatch):
    """Two of them: that all run is said by the tests of the lessons."""
    two = lessons(["00", "10"])
    monkeypatch.setattr(command, "lessons", lambda: two)
    monkeypatch.setattr(Entry, "drawn", "")
    assert typed("-o", str(built), "-j", "2") == 0
    assert list(faults(built)) == []
    text = (built / "lessons/10_player_and_stepping.html").read_text("utf-8")
    assert 'class="mnclab-player"' in text and "require" not in text.partition("srcdoc")[0]
    assert 'href="lessons/10_player_and_stepping.html"' in (built / "index.html").read_text("utf-8")
