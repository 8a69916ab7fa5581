"""Every notebook is a lesson: short cells, exercises at the end, no stored outputs; and it runs."""

import ast
import json
import os
import re
from pathlib import Path
from types import SimpleNamespace

import pytest

import mnclab

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
LONGEST_CELL = 8

each_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)


def cells_of(path):
    """The cells as they stand in the file, with the source of each in one piece."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    return [SimpleNamespace(**cell | {"source": "".join(cell["source"])}) for cell in cells]


@each_notebook
def test_notebook_is_a_lesson(path):
    cells = cells_of(path)
    for cell in cells:
        if cell.cell_type == "code":
            assert not cell.outputs, "outputs are stored: clear them before saving"
            assert len(cell.source.splitlines()) <= LONGEST_CELL, f"too long:\n{cell.source}"
            assert not re.search(r"^\s*(async )?def ", cell.source, re.M), f"a function:\n{cell.source}"
    prose = "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")
    headings = re.findall(r"^##? +(.+?) *$", prose, re.M)
    assert headings and headings[-1] == "Exercises", "the last section is headed Exercises"
    exercises = re.findall(r"^\d+\. ", prose.rpartition("## Exercises")[2], re.M)
    assert exercises == ["1. ", "2. ", "3. "], "three exercises"


@each_notebook
def test_a_lesson_begins_with_its_question_and_the_part_and_asks_for_no_python(path):
    """A question and a picture stand on the first screen; programs are typed in cells of blocks, and no cell loops."""
    cells = cells_of(path)
    question, picture, head = cells[:3]
    assert [cell.cell_type for cell in cells[:3]] == ["markdown", "code", "markdown"]
    assert "?" in question.source and len(question.source.split()) <= 80
    assert len(picture.source.splitlines()) <= 6 and "import mnclab as mnc" in picture.source and "plot" in picture.source
    size = re.search(r"size=\([\d.]+, ([\d.]+)\)|width=4", picture.source)  # a region 4 wide is 3.3 high
    high, rows = float(size[1] or 3.3), len(question.source.split("\n\n", 1)[1]) // 130 + 1
    above = 210 + 22 * rows + 18.4 * len(picture.source.splitlines())  # of JupyterLab in 1366 x 768, measured
    assert above + 100 * high <= 744, "the picture reaches below the first screen"
    parts = re.split(r"\*\*What you (?:will do|will learn|need)\.\*\*", head.source)
    assert len(parts) == 4 and 20 <= int(re.search(r"(\d+) minutes", parts[3])[1]) <= 45
    code = [cell.source for cell in cells if cell.cell_type == "code"]
    assert any(source.startswith("%%mnc") for source in code)
    plain = "\n".join(line for source in code if source[:2] != "%%" for line in source.splitlines() if line[:1] not in "%!")
    nodes = list(ast.walk(ast.parse(plain)))
    assert not [node for node in nodes if isinstance(node, ast.For | ast.While | ast.If | ast.With | ast.Lambda)]
    assert sum(isinstance(node, ast.ListComp | ast.DictComp | ast.SetComp | ast.GeneratorExp) for node in nodes) <= 2
    assert sum(isinstance(node, ast.Constant) and "\n" in str(node.value).strip() for node in nodes) <= 2


@each_notebook
def test_the_teacher_is_told_what_to_show(path):
    told = json.loads(path.read_text("utf-8"))["metadata"]["teacher"]
    assert 2 <= len(told) <= 4 and all(len(sentence.split()) > 3 for sentence in told)


SLIDES = {"slide", "subslide", "fragment", "-", "skip", "notes"}  # of JupyterLab, which `jupyter nbconvert --to slides` reads


@each_notebook
def test_a_heading_begins_a_slide_and_nothing_follows_the_exercises(path):
    cells = cells_of(path)
    kinds = [cell.metadata.get("slideshow", {}).get("slide_type") for cell in cells]
    assert set(kinds) <= SLIDES
    for cell, kind in zip(cells, kinds, strict=True):
        if cell.cell_type == "markdown":
            headed = re.match(r"##? ", cell.source) is not None
            assert (kind == "slide") is headed, cell.source[:60]
            assert not re.search(r"\n##? ", cell.source), f"a heading inside a cell:\n{cell.source}"
    last = next(k for k, cell in enumerate(cells) if cell.source.startswith("## Exercises"))
    assert set(kinds[last + 1 :]) == {"skip"}, "the empty cells for the reader's programs"
    assert all(cell.cell_type == "code" and cell.source.startswith("# your ") for cell in cells[last + 1 :])


@pytest.mark.deep
@each_notebook
def test_notebook_runs(path):
    """Its form is checked against the standard too; both packages take seconds to import."""
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    environment = dict(os.environ)
    environment.pop("MPLBACKEND", None)  # the kernel chooses its own, as it does for people
    place = {"metadata": {"path": path.parent}}
    NotebookClient(notebook, timeout=120, kernel_name="python3", resources=place).execute(env=environment)


@pytest.mark.parametrize("path", sorted((ROOT / "data" / "lessons").glob("*.[hm]*")), ids=lambda path: path.stem)
def test_a_program_that_a_lesson_shows_runs_and_collides_nowhere(path):
    setup = path.with_suffix(".toml")
    run = mnclab.run(path, setup=setup if setup.exists() else None)
    assert run.ok
    assert run.stock is None or len(run.collisions()) == 0


def test_the_map_of_the_course_has_every_lesson():
    text = (ROOT / "notebooks" / "README.md").read_text("utf-8")
    assert sorted(re.findall(r"\]\((\w+\.ipynb)\)", text)) == [path.name for path in NOTEBOOKS]


each_plan = pytest.mark.parametrize("path", sorted((ROOT / "notebooks" / "plans").glob("*_*.md")), ids=lambda path: path.stem)
FUNCTION = re.compile(r"\bG0*(\d+)|\b(FN ?\d+|LBL|REP|RND|CHF|CC|CR|CT|APPR \w+|DEP \w+|PATTERN DEF|GLOBAL DEF)")


def functions_in(text):
    return {code or word for code, word in FUNCTION.findall(text)}


@each_plan
def test_a_program_to_read_has_no_function_that_no_lesson_before_it_in_the_plan_names(path):
    known, said = {each.id: each for each in mnclab.exercises()}, set()
    for row in re.findall(r"(?m)^\| (?:\d+ )?\| .*", path.read_text("utf-8")):
        for lesson in re.findall(r"\]\(\.\./(\w+\.ipynb)\)", row):
            text = "\n".join(cell.source for cell in cells_of(ROOT / "notebooks" / lesson))
            programs = [ROOT / "notebooks" / name for name in re.findall(r'"(\.\./data/[\w/-]+\.(?:h|i|mnc|jnc|nc31))"', text)]
            said |= functions_in("\n".join([text, *(program.read_text("utf-8") for program in programs)]))
        for name in re.findall(r"`([\w-]+-\d\d)`", row):
            given = re.sub(r"//.*|;.*|'.*", "", known[name].template + "\n" + known[name].program)
            assert functions_in(given) <= said, (name, functions_in(given) - said)


@each_plan
def test_a_plan_gives_no_exercise_before_its_lesson_and_own_dimensions_where_there_are_some(path):
    rows = [line.split("|") for line in path.read_text("utf-8").splitlines() if re.match(r"\| (\d+ )?\| ", line)]
    assert len(rows) == 36 and [row[1].strip() for row in rows[::2]] == [str(week) for week in range(1, 19)]
    known = {each.id: each for each in mnclab.exercises()}
    taken = set()
    for _, _, lesson, what, given, *_ in rows:
        assert all((path.parent / link).is_file() for link in re.findall(r"\]\(([^)]+)\)", lesson))
        taken.update(re.findall(r"\[(\d\d)\]", lesson))
        named = re.findall(r"`([\w-]+-\d\d)`", given)
        early = [name for name in named if known[name].lesson not in taken]
        assert not early, (early, [known[name].lesson for name in early])
        own = re.findall(r"`([\w-]+-\d\d)`", what.partition("with the dimensions of each name")[0]) if "each name" in what else []
        assert all("[vary]" in known[name].file.read_text("utf-8") for name in own), own
