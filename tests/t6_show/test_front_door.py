"""The front door takes what it is made for; anything else is a sentence that says what that is. What it opens is real."""

import ast
import inspect
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Alarm, Limits, Setup
from mnclab.machine.setup_file import load

pytest.importorskip("ipywidgets")
WRONG = [5, None, b"G0 X5\n", 1.5, [1], {}, ("mnc",), object(), True]

PROGRAM = "G0 X5\nG1 X9 F100\n"


@pytest.mark.parametrize("wrong", WRONG, ids=lambda value: type(value).__name__)
def test_a_wrong_type_is_an_alarm(run, wrong):
    doors = [
        lambda: mnclab.run(wrong, "mnc"),
        lambda: mnclab.run(run, "mnc"),
        lambda: mnclab.read(wrong, "mnc"),
        lambda: mnclab.modern(wrong),
        lambda: mnclab.help(wrong, "mnc"),
        lambda: mnclab.help("G83", wrong),
        lambda: mnclab.form(wrong, "mnc"),
        lambda: mnclab.form("G83", wrong),
        lambda: mnclab.panel(wrong, "mnc"),
        lambda: mnclab.editor(wrong),
        lambda: mnclab.diff(wrong, run),
        lambda: mnclab.diff(run, wrong),
        lambda: mnclab.compare(wrong, 4.0),
        lambda: mnclab.compare_turning(wrong, 30),
        lambda: run.when(wrong),
        lambda: run.again(wrong),
        lambda: run.plot(view=wrong),
        lambda: run.plot(colour=wrong),
        lambda: run.plot(frame=wrong),
        lambda: run.plot_compensation(view=wrong),
        lambda: mnclab.diff(run, run).plot(view=wrong),
        lambda: run.profile().plot(over=wrong),
        lambda: run.profile().time_by(wrong),
        lambda: run.player(theme=wrong),
        lambda: run.save(wrong),
        lambda: run.report(wrong),
    ]
    if wrong is not None:
        doors += [
            lambda: mnclab.run("G0 X5\n", wrong),
            lambda: mnclab.run("G0 X5\n", "mnc", wrong),
            lambda: run.profile(wrong),
            lambda: run.player(wrong),
        ]
    if not isinstance(wrong, int | float):
        doors += [
            lambda: mnclab.panel("G0 X{x}\n", "mnc", x=wrong),
            lambda: run.profile(override=wrong),
            lambda: run.player(speed=wrong),
            *([] if wrong is None else [lambda: run.player(height=wrong)]),  # None: as high as there is room
        ]
    for door in doors:
        with pytest.raises(Alarm) as caught:
            door()
        assert len(caught.value.message) < 300


LONG = "é" * 5000
DOORS = {
    "a text for a line": lambda run: run.at("5"),
    "nothing for a pass": lambda run: run.at(1, None),
    "a dict for a line": lambda run: run.at({}),
    "an array for a pass": lambda run: run.at(1, np.zeros(3)),
    "half a line": lambda run: run.at(1.5),
    "an endless step": lambda run: run.at(step=10**400),
    "a text for a program": lambda run: run.at(1, program="0"),
    "a text to explain": lambda run: run.explain("5"),
    "a long name for limits": lambda run: run.profile(LONG),
    "a long name for a player": lambda run: run.player(LONG),
    "a long name for an editor": lambda run: mnclab.editor(LONG),
    "a folder that is a file": lambda run: mnclab.editor(f"{__file__}/a.mnc"),
    "a long sum": lambda run: run.when("x+" * 20_000 + "x>1"),
    "a sum of some length": lambda run: run.when("x+" * 250 + "x>1"),
    "a long product": lambda run: run.when("x>" + "1*" * 20_000 + "1"),
    "a number for a title": lambda run: run.report("r.html", title=5),
    "an array for a corner": lambda run: Limits(corner_speed=np.array([1])),
    "a text for a corner of a part": lambda run: mnclab.part.box("a", (1, 1, 1)),
    "a ball without a radius": lambda run: mnclab.part.ball((0, 0, 0), None),
    "a text for a blank": lambda run: mnclab.blank.cylinder("a", 0, 1),
    "an endless blank": lambda run: mnclab.blank.cylinder(5, 0, float("inf")),
    "a blank about a text": lambda run: mnclab.blank.cylinder(5, 0, 1, at="x"),
    "an endless normal": lambda run: mnclab.part.plane((0, 0, 0), (0, 0, float("inf"))),
    "nothing for an area": lambda run: mnclab.area.area_of(None),
    "numbers for an area": lambda run: mnclab.area.area_of([1]),
    "a text for a tolerance": lambda run: mnclab.area.area_of([], "x"),
    "nothing for a drawing": lambda run: mnclab.area.svg(None),
    "a number for a drawing": lambda run: mnclab.area.svg(5),
    "a tolerance of nothing": lambda run: mnclab.area.svg("<svg/>", None),
    "a run for its path": lambda run: mnclab.area.outline(run),
    "nothing for a path": lambda run: mnclab.area.outlines(None),
    "a path and a text": lambda run: mnclab.area.outlines(run.toolpath, "x"),
    "nothing to clear": lambda run: mnclab.strategies.clear("rings", None, 4, 4),
    "an entry at a text": lambda run: mnclab.strategies.Entry("helix", "x"),
    "an array for rapids": lambda run: Limits(rapid_motion=np.array([1, 2])),
    "arrays of axes": lambda run: Setup(kinematics=np.array([1, 2])),
    "no kinematics": lambda run: Setup(kinematics=False),
    "an array of tools": lambda run: Setup(true_tools=np.array([1, 2])),
    "a number for a place": lambda run: Setup(start=np.array(5)),
    "nothing for a file": lambda run: load(None),
    "a name without a letter": lambda run: load(""),
}


@pytest.mark.parametrize("door", DOORS)
def test_what_a_door_is_not_made_for_is_an_alarm(run, door, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(Alarm) as caught:
        DOORS[door](run)
    assert len(caught.value.message) < 400 and not list(tmp_path.iterdir())


def test_whole_numbers_of_every_kind_name_a_line(run):
    assert run.at(2).line == run.at(np.int64(2)).line == run.at(2.0).line == run.at(step=np.uint8(1)).line == 2


def test_a_condition_may_have_some_operators(run):
    assert len(run.when("0*x+" * 99 + "x > 6")) == 1


def test_one_thing_is_one():
    run = mnclab.run("G0 X1\n", "mnc")
    assert ": 1 block, 1 move, " in repr(run) and "1 block, 0 alarms" in repr(run.program)
    assert "1 row, 1 move, " in repr(run.toolpath) and "1 move, " in repr(run.player())


@pytest.mark.parametrize("notebook", ["help", "settings", "control", "controls", "explain", "program"])
def test_words_of_a_table_stand_to_the_left(notebook):
    """Notebooks set every cell to the right that does not say otherwise."""
    run = mnclab.run("G90 G54\nG1 X1 F100\n", "mnc")
    shown = {
        "help": lambda: mnclab.help("G83", "mnc"),
        "settings": lambda: mnclab.help("settings", "mnc"),
        "control": lambda: mnclab.help("mnc"),
        "controls": lambda: mnclab.controls,
        "explain": lambda: run.explain(line=2),
        "program": lambda: run.program,
    }[notebook]()._repr_html_()
    cells = re.findall(r'<td style="text-align:(left|right)">(.*?)</td>', shown)
    assert len(cells) == shown.count("<td") > 4
    for side, text in cells:
        assert side == "left" or re.fullmatch(r"-?[0-9.]+", text), text


@pytest.mark.parametrize(
    "number", [(2, 1), (1, 5, 9), (5, 1, 2), (1, 2, 3, 4), float("nan"), (1, 0, float("inf")), "5", True, [1, 0, 2]]
)
def test_a_number_of_a_panel_has_a_value_and_limits(number):
    with pytest.raises(Alarm, match="x "):
        mnclab.panel("G0 X{x}\n", "mnc", x=number)


ANYTHING = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=9), st.binary(max_size=9),
                     st.lists(st.integers(), max_size=3), st.just(Path("no-such-file")), st.just(Setup()))  # fmt: skip


@given(source=ANYTHING, control=ANYTHING, setup=ANYTHING)
def test_run_and_help_of_anything_give_a_result_or_an_alarm(source, control, setup):
    for door in (lambda: mnclab.run(source, control, setup), lambda: mnclab.help(source, control)):
        try:
            assert str(door()) is not None
        except Alarm as alarm:
            assert alarm.message


HOME = Path(mnclab.__file__)
SHELVES = ["area", "blank", "part", "probing", "schemes", "strategies"]


def imports_for_types():
    """What the stub of the front door imports from the rooms: name here -> module and name there."""
    lines = (node for node in ast.parse(HOME.with_suffix(".pyi").read_text("utf-8")).body if isinstance(node, ast.ImportFrom))
    return {line.names[0].asname: (line.module, line.names[0].name) for line in lines if line.level == 0}


def test_what_is_opened_later_is_the_real_thing():
    told = imports_for_types()
    assert set(told) == set(mnclab.OPENED.__all__)
    for name, (module, there) in told.items():
        real = getattr(__import__(module, fromlist=[there]), there)
        assert getattr(mnclab, name) is real and (name in dir(mnclab) or name == "load_ipython_extension")
        assert inspect.getdoc(real)


@pytest.mark.parametrize("name", sorted({*mnclab.__all__, *mnclab.OPENED.__all__}))
def test_every_function_of_the_door_has_parameters_with_names(name):
    found = getattr(mnclab, name)
    if inspect.isfunction(found):
        given = inspect.signature(found).parameters
        assert (given or name == "machines") and "object" not in str(inspect.signature(found))
        assert not given or next(iter(given.values())).kind is not inspect.Parameter.VAR_POSITIONAL


def test_a_name_that_is_not_there_has_a_near_one():
    with pytest.raises(AttributeError, match="mnclab has no 'comparee' \\(near: compare\\)"):
        getattr(mnclab, "comparee")  # noqa: B009
    with pytest.raises(AttributeError, match="mnclab has no 'Boxx' .*near: .*\\bbox"):
        getattr(mnclab, "Boxx")  # noqa: B009
    with pytest.raises(AttributeError, match="mnclab has no 'Setupp' \\(near: Setup\\)"):
        getattr(mnclab, "Setupp")  # noqa: B009
    with pytest.raises(AttributeError, match="mnclab.part has no 'boxx' \\(near: box\\)"):
        getattr(mnclab.part, "boxx")  # noqa: B009


def test_everything_may_be_imported_and_help_stays_that_of_python():
    names = {}
    exec("from mnclab import *", names)
    assert set(mnclab.__all__) <= set(names) and "help" not in names
    assert mnclab.help("G83", "mnc").entry.code == "G83"


@pytest.mark.parametrize("name", SHELVES)
def test_a_shelf_says_what_is_on_it(name):
    shelf = getattr(mnclab, name)
    head, *lines = repr(shelf).splitlines()
    assert head.startswith(f"mnclab.{name}: ") and [line.split()[0] for line in lines] == shelf.__all__
    assert all(len(line.split()) > 2 for line in lines), "a name without a word about it"
    assert set(shelf.__all__) <= set(dir(shelf))
    exec(f"from mnclab.{name} import *; import mnclab.{name}", {})


SETUPS = ["tools", "datums", "presets", "correctors", "limits", "stock", "part", "probe", "start", "files", "settings",
          "variables", "kinematics", "true_tools"]  # fmt: skip


@pytest.mark.parametrize("name", SETUPS)
def test_a_setup_says_what_each_part_of_it_is(name):
    rows = name in ("tools", "datums", "presets", "correctors", "files", "variables")
    for wrong in (5, "5", [None], *([{1: 5}, {"A": [1]}] if rows else [])):
        if (name, wrong) == ("part", "cut"):
            continue
        with pytest.raises(Alarm) as caught:
            Setup(**{name: wrong})
        assert name in caught.value.message and caught.value.hint
        example = re.search(r"Setup\((\w+)=.*\)$", caught.value.hint)
        assert example is None or example[1] == name
        if example:  # and what it shows is true
            eval(example[0], {"Setup": Setup, "mnclab": mnclab, "pathlib": __import__("pathlib")})


INSIDES = re.compile(r"array\(|\bat 0x|\d{12}|mappingproxy|object at|dtype=|<function|functools|<lambda>|nan\b")
TURNED = {
    "profile": [(0, 20), (-40, 20), (-50, 30)],
    "tool": {"kind": "turning", "main_angle": 95, "auxiliary_angle": 30},
}


@pytest.fixture(scope="module")
def public():
    """One of every kind of object that a person may come to print."""
    text = "G17 G90 G54 T2\nG0 X0 Y0 Z5 S1200 M3\nG83 X20 Y10 Z-30 R2 K5 F120\nG80\nG41 G1 X30 Y0\nX50\nG40 X0\n"
    setup = Setup(datums={1: (1, 2, 3)}, stock=((0, 0, -20), (60, 40, 0)), part=mnclab.part.box((0, 0, 0), (1, 2, 3)))
    run = mnclab.run(text, "mnc", setup)
    tnc = mnclab.run("BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nQ1 = 5\nL X+Q1 R0 FMAX M3\nEND PGM A MM\n", "tnc-620")
    square = mnclab.area.Region.of(mnclab.area.rectangle(60, 40, 5))
    compared = mnclab.compare(square, 4.0, ["rings"])
    profile = mnclab.area.Contour(TURNED["profile"], closed=False)
    turned = mnclab.compare_turning(profile, 30, mnclab.Tool(**TURNED["tool"]), ["loop"])
    planned = run.profile()
    bodies = mnclab.part.ball((0, 0, 0), 3) | mnclab.part.box((0, 0, 0), (1, 1, 1)) - mnclab.part.plane(
        (0, 0, 0), (0, 0, 1)
    )
    found = {
        **{f"{name} of a run": value for name, value in vars(run).items() if not name.startswith("_")},
        **{f"{name} of Klartext": value for name, value in vars(tnc).items() if not name.startswith("_")},
        "run": run, "moment": run.at(line=3), "moment within": run.when("z < -5")[0], "moments": run.when("z < -5"),
        "block": run.program[2], "words": run.program[2].words, "words of Klartext": tnc.program[2].words,
        "explanation": run.explain(3), "profile": planned, "instant": planned.at(0.3), "instants": planned.at([0.1, 0.3]),
        "pieces": planned.pieces, "plan": planned.plan, "rows": planned.plan.rows, "moves": list(run.toolpath),
        "deviation": mnclab.diff(run, tnc), "traces": mnclab.diff(run, tnc).one, "player": run.player(),
        "help": mnclab.help("G83", "mnc"), "a function": mnclab.help("G1", "mnc"), "settings": mnclab.help("settings", "mnc"),
        "control": mnclab.controls["mnc"], "functions": mnclab.controls["tnc-620"].functions,
        "cycles": mnclab.controls["tnc-620"].cycles,
        "controls": mnclab.controls,
        "parameters": mnclab.controls["mnc"].cycles["G83"].parameters(), "setting": mnclab.controls["mnc"].settings,
        "tool": mnclab.Tool(radius=5), "datum": mnclab.Datum(1), "probe": mnclab.Probe(), "limits": Limits(),
        "default setup": Setup(), "bodies": bodies, "blank": mnclab.blank.cylinder(25, -60, 2), "stock": run.stock,
        "box": mnclab.blank.Box((0, 0, 0), (1, 1, 1)), "region": square, "contour": profile, "compared": compared,
        "trial": compared[0], "clearing": compared[0].clearing, "piece": compared[0].clearing.pieces[0],
        "engagement": compared[0].engagement, "turned": turned, "turning trial": turned[0], "turning plan": turned[0].plan,
        "strokes": turned[0].plan.strokes[:3], "entry": mnclab.strategies.Entry("helix", 3), "alarm": Alarm("no feed"),
        "zone": mnclab.schemes.zones(profile, 30), "groove": mnclab.schemes.Groove(right=0, width=10, bottom=25, rim=30),
        "picture": run.plot(), "notation": mnclab.modern("N1\nZ1\n", "nc-31"), "kind": mnclab.Kind.ARC,
    }  # fmt: skip
    return found


def test_nothing_prints_its_insides(public):
    each = [(name, one) for name, found in public.items() for one in (found if type(found) in (tuple, list) else [found])]
    for name, value in each:
        for shown in (repr(value), str(value)):
            assert not INSIDES.search(shown), f"{name}: {shown[:400]}"
            assert max(len(line) for line in shown.splitlines() or [""]) < 2000, f"{name}: {shown[:400]}"
            assert all(line.count("=") <= 12 for line in shown.split("),")), f"{name} is a dump: {shown[:400]}"


def test_a_moment_is_a_page(public):
    head, *lines = str(public["moment"]).splitlines()
    assert head == "line 3: G83 X20 Y10 Z-30 R2 K5 F120"
    assert lines[0].split() == ["programmed", "point", "X20", "Y10", "Z5"]
    assert any(line.startswith("  changed") and "feed 120" in line for line in lines) and max(map(len, lines)) <= 100
    assert "<code>G83" in public["moment"]._repr_html_() and "drill 8" in public["moment"]._repr_html_()
    assert "% of row" in str(public["moment within"])
