"""%%mnc in a real IPython: what is shown, what is bound, what is refused."""

import pytest

import mnclab

shells = pytest.importorskip("IPython.core.interactiveshell")
PROGRAM = "G90 G54 T1 S500 M3\nG0 X0 Y0 Z5\nG1 Z-2 F100\nX20\n"


@pytest.fixture
def shell():
    shell = shells.InteractiveShell.instance()  # what display() speaks to
    shell.run_line_magic("load_ext", "mnclab")
    yield shell
    shells.InteractiveShell.clear_instance()


def shown(shell, line, cell=PROGRAM):
    """What a cell shows, as MIME bundles; a fault is raised."""
    from IPython.utils.capture import capture_output

    with capture_output() as captured:
        result = shell.run_cell(f"%%mnc {line}\n{cell}")
    if result.error_in_exec:
        raise result.error_in_exec
    return [output.data for output in captured.outputs]


def test_a_cell_shows_card_and_picture_and_binds_the_run(shell):
    card, picture = shown(shell, "--control mnc")
    assert "no alarms" in card["text/html"] and "Mechatronics" in card["text/html"]
    assert 'alt="tool path: 3 moves' in picture["text/html"]
    assert isinstance(shell.user_ns["run"], mnclab.Run) and shell.user_ns["run"].ok


def test_alarms_stand_under_the_cell_with_their_caret(shell):
    (card,) = shown(shell, "--control mnc --name first", "G90\nG1 X4,5 F100\n")
    assert 'role="alert"' in card["text/html"] and "^" in card["text/html"]
    assert not shell.user_ns["first"].ok and "run" not in shell.user_ns


def test_a_program_that_moved_before_its_fault_has_a_picture(shell):
    _, picture = shown(shell, "--control mnc", "G90\nG0 X5\nG1 X4,5 F100\n")
    assert "stopped in line 3" in picture["text/html"]


def test_tools_and_setup_come_from_the_notebook(shell, tmp_path):
    shell.user_ns["t"] = {1: mnclab.Tool(radius=7)}
    shown(shell, "--control mnc --tools t")
    assert shell.user_ns["run"].toolpath.radius[-1] == 7
    shell.user_ns["s"] = mnclab.Setup(start=(0, 0, 99))
    shown(shell, "--control mnc --setup s --tools t --quiet")
    assert shell.user_ns["run"].toolpath.start[0, 2] == 99 and shell.user_ns["run"].toolpath.radius[-1] == 7
    (tmp_path / "m.toml").write_text("start = [0, 0, 77]\n")
    shown(shell, f"--control mnc --setup '{tmp_path / 'm.toml'}'")
    assert shell.user_ns["run"].toolpath.start[0, 2] == 77


def test_klartext_needs_no_name(shell):
    shown(shell, "", "BEGIN PGM A MM\nTOOL CALL 1 Z S100\nL X+5 R0 FMAX\nEND PGM A MM\n")
    assert shell.user_ns["run"].control.name == "tnc-620"


def test_quiet_shows_alarms_alone(shell):
    assert shown(shell, "--control mnc --quiet") == []
    (alarm,) = shown(shell, "--control mnc --quiet", "G1 X5\n")
    assert "no feed rate" in alarm["text/html"]


def test_the_card_alone_has_no_picture(shell):
    (card,) = shown(shell, "--control mnc --card")
    assert "blocks" in card["text/html"] and len(shown(shell, "--control mnc")) == 2


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("--controll mnc", "unrecognized arguments"),
        ("--control mnd", "there is no control 'mnd'"),
        ("--control mnc --tools nothing", "no dict of tools"),
        ("--control mnc --setup nothing", "neither a Setup"),
        ("--control mnc --name 1a", "name of Python"),
        ("--control 'mnc", "No closing quotation"),
    ],
)
def test_options_that_make_no_sense_are_alarms(shell, line, sentence):
    with pytest.raises(mnclab.Alarm, match=sentence):
        shown(shell, line)


def completed(shell, source):
    """What IPython offers at the end of a source: word -> what is said of it, and the range that is replaced."""
    from IPython.core.completer import provisionalcompleter

    with provisionalcompleter():
        found = list(shell.Completer.completions(source, len(source)))
    return {each.text: each.type for each in found}, {(each.start, each.end) for each in found}


def test_tab_offers_codes_of_a_control_and_nothing_else(shell):
    words, places = completed(shell, "%%mnc --control mnc\nN40 G8")
    assert words["G83"] == "◆ Deep-hole drilling" and {word[:2] for word in words} == {"G8"} and places == {(24, 26)}
    shell.user_ns["mnc"] = mnclab
    assert "G83" in completed(shell, 'mnc.help("G8')[0]
    words, places = completed(shell, 'mnc.help("CYCL DEF 20')
    assert "200" in words and places == {(19, 21)}
    assert "append" in completed(shell, "x = []\nx.app")[0]  # Python is as it was


def test_what_is_offered_has_a_sign_of_its_kind_that_is_no_address(shell):
    """A code, a word of a code with its meaning as the manual has it, a name; JupyterLab shows the first letter as an icon."""
    words, _ = completed(shell, "%%mnc --control mnc\nN40 G83 X20 ")
    assert words["R"] == "◇ level R, mm (G83)"
    words, _ = completed(shell, "%%mnc --control tnc-620\nCYCL DEF 200 DRILLING ~\n  Q2")
    assert words["Q200="].startswith("◇ set-up clearance")
    words, _ = completed(shell, "%%mnc --control tnc-620\nLBL 5\nCALL LBL ")
    assert words == {"5": "▤ label"}


def test_loading_twice_offers_once(shell):
    from mnclab.lab.magic import load_ipython_extension

    before = len(shell.Completer.custom_matchers)
    load_ipython_extension(shell)
    assert len(shell.Completer.custom_matchers) == before


def test_importing_mnclab_is_enough(monkeypatch):
    """In a running IPython; each import of its own takes a process of its own."""
    import subprocess
    import sys

    script = (
        "from IPython.core.interactiveshell import InteractiveShell as S; s = S.instance(); import sys, mnclab as mnc;"
        "s.user_ns['mnc'] = mnc; heavy = {'matplotlib', 'ipywidgets', 'pyvista', 'shapely'} & {*sys.modules};"
        "print(heavy or 'light', 'mnc' in s.magics_manager.magics['cell'], len(s.Completer.custom_matchers))"
    )
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert result.stdout.split() == ["light", "True", "1"], result.stderr


def test_a_picture_is_drawn_once_where_ipython_draws_figures_too(shell, monkeypatch):
    from IPython.core.pylabtools import select_figure_formats
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    select_figure_formats(shell, {"png"})  # what importing pyplot does in a notebook
    monkeypatch.setattr(shell.display_formatter, "active_types", shell.display_formatter.format_types)
    drawn, draw = [], FigureCanvasAgg.print_figure
    monkeypatch.setattr(FigureCanvasAgg, "print_figure", lambda *given, **more: drawn.append(draw(*given, **more)))
    data, _ = shell.display_formatter.format(mnclab.run(PROGRAM, "mnc").plot())
    assert len(drawn) == 1 and data["image/png"] in data["text/html"]


def test_the_kernel_is_asked_for_words_of_programs_and_answers_all_others_as_before(shell):
    from mnclab.lab.magic import explain_words

    class Kernel:
        def do_inspect(self, code, cursor_pos, detail_level=0, omit_sections=()):
            return {"found": False}

    kernel = Kernel()
    explain_words(kernel, shell)
    explain_words(kernel, shell)
    cell = "%%mnc --control mnc\nN40 G83 K5"
    found = kernel.do_inspect(cell, cell.index("K5"), detail_level=0)
    assert found["found"] and "depth of one peck" in found["data"]["text/plain"]
    assert kernel.do_inspect("len", 2, 0) == {"found": False}


def test_a_cell_is_graded_as_the_answer_to_an_exercise_and_kept(shell, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    model = mnclab.exercise("mnc-07").solution()
    (bundle,) = shown(shell, "--exercise mnc-07", model.replace("Z-5", "Z-4", 1))
    assert "not yet" in bundle["text/html"] and "line 3: pocket: its depth is not as drawn" in bundle["text/plain"]
    assert not shell.user_ns["grade"].passed and shell.user_ns["run"].ok
    shown(shell, "--exercise mnc-07 --name mine", model)
    assert shell.user_ns["grade"].passed and shell.user_ns["mine"].ok
    assert mnclab.progress().done["mnc-07"] == {"score": 1.0, "passed": True, "tries": 2, "faults": {"pocket depth": 1}}
    with pytest.raises(mnclab.Alarm, match="there is no exercise 'mnc-77'"):
        shown(shell, "--exercise mnc-77", model)


def test_the_editor_of_an_exercise_begins_as_its_template_and_grades(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    exercise = mnclab.exercise("mnc-02")  # to mend
    live = exercise.editor(tmp_path)
    assert live.text.value == exercise.template != "" and live.sheets.titles == ("task", "drawing", "path")
    assert "new" in live.status.value  # nobody changed it yet
    live.check.click()
    assert live.grade is not None and not live.grade.passed and "not yet" in live.told.value
    assert "not yet" not in live.part.value and "saved" in live.status.value
    live.text.value = exercise.solution()
    assert "mnclab-old" in live.told._dom_classes
    live.check.click()
    assert "mnclab-old" not in live.told._dom_classes
    assert live.grade.passed and live.sheets.titles[live.sheets.selected_index] == "part" and "<img" in live.part.value
    assert (tmp_path / "mnc-02.mnc").read_text() == exercise.solution()


def test_a_grade_does_not_write_over_what_was_changed_elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    one, two = (mnclab.exercise("mnc-02").editor(tmp_path) for _ in range(2))
    one.check.click()
    two.text.value += "M5\n"
    for _ in range(2):
        two.check.click()
        assert "not saved" in two.status.value and two.grade is not None
    assert (tmp_path / "mnc-02.mnc").read_text() == one.text.value
    two.button.click()
    assert (tmp_path / "mnc-02.mnc").read_text() == two.text.value


def test_an_answer_that_is_no_program_is_not_read_as_one(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    predicted = mnclab.exercise("nc-31-01").editor(tmp_path)
    assert predicted.text.value.startswith("1 =\n2 =\n") and predicted.sheets.titles == ("task",)
    predicted.check.click()
    still = predicted.still()["text/html"]
    assert "which control" not in still and "part program" not in still and not predicted.alarms.value
    assert ".mnclab-still { display: none; }" in predicted.children[-1].value  # the widget hides its still picture


@pytest.mark.parametrize("name", ["jnc-t01-08", "nc-31-07"])
def test_a_program_to_make_quicker_is_there_from_the_beginning(tmp_path, name):
    exercise = mnclab.exercise(name)
    assert exercise.editor(tmp_path).text.value == exercise.program
