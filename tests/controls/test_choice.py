"""Which control a program is for: its name, the file's suffix, the text; and no guessing when two fit."""

import re
from itertools import product

import pytest
from tools.together import together

import mnclab
from mnclab import Alarm

SQUARES = {
    "mnc": "N10 G90 G54\nG1 X40 F100 // a comment\n",
    "tnc-620": "0 BEGIN PGM A MM\n1 L X+40 R0 FMAX\n2 END PGM A MM\n",
    "nc-31": "N1 F20\nN2 X4000 ~ *\nN3 Z200 ~\n",
    "jnc-t01": "G90 F100 ' a comment\nG01 X40.\n",
}
SUFFIX = {"mnc": ".mnc", "tnc-620": ".h", "nc-31": ".nc31", "jnc-t01": ".jnc"}


@pytest.mark.parametrize("name", SQUARES)
def test_the_text_says_it(name):
    assert mnclab.read(SQUARES[name]).control == name


@pytest.mark.parametrize("name", SQUARES)
def test_the_suffix_says_it_before_the_text(name, tmp_path):
    file = tmp_path / f"A{SUFFIX[name].upper()}"
    file.write_text("X10\n", encoding="utf-8")
    assert mnclab.read(file).control == name and mnclab.read(str(file)).control == name


@pytest.mark.parametrize("text", ["", "\n", "X10\n", "hello\n"])
def test_no_guessing(text):
    with pytest.raises(Alarm, match="nothing in the text or the file's name says"):
        mnclab.read(text)


def test_two_that_fit_are_not_chosen_from(monkeypatch):
    from dataclasses import replace

    twin = replace(mnclab.controls["mnc"], name="twin", suffixes=())
    mnclab.controls.add(twin)
    try:
        with pytest.raises(Alarm, match="may be a program of mnc or a program of twin: name the control"):
            mnclab.read(SQUARES["mnc"])
    finally:
        mnclab.controls.remove("twin")


def test_an_unknown_control_is_named_with_those_that_exist():
    with pytest.raises(Alarm) as found:
        mnclab.run("G0 X1\n", "tnc620")
    known = ", ".join(mnclab.controls)
    assert str(found.value) == f"alarm: there is no control 'tnc620' (known: {known}; near: tnc-620)"


def test_a_path_that_does_not_exist_is_an_alarm(tmp_path):
    with pytest.raises(Alarm, match="cannot be read"):
        mnclab.run(tmp_path / "nothing.mnc")


def test_a_text_without_a_line_end_is_a_program_unless_such_a_file_exists(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert mnclab.run("G0 X1", "mnc").toolpath.end[-1, 0] == 1
    (tmp_path / "G0 X1").write_text("G0 X2\n")
    assert mnclab.run("G0 X1", "mnc").toolpath.end[-1, 0] == 2


def test_strict_raises_the_first_alarm():
    with pytest.raises(Alarm, match="no feed rate"):
        mnclab.run("G1 X5\n", "mnc", strict=True)
    assert mnclab.run("G0 X5\n", "mnc", strict=True).ok


@pytest.mark.parametrize("name", SQUARES)
def test_every_code_of_a_control_has_help(name):
    control = mnclab.controls[name]
    for code in (*control.functions, *control.cycles):
        meant = control.functions[code].code if code in control.functions else control.cycles[code].code
        assert meant in str(mnclab.help(code, name))
        assert mnclab.help(code, name)._repr_html_()
    assert control.title in control._repr_html_() and name in mnclab.controls._repr_html_()


def test_every_parameter_is_declared_in_full():
    """A meaning and a unit for each, a source for each cycle, and defaults that pass their own limits."""
    for name in SQUARES:
        for code, cycle in mnclab.controls[name].cycles.items():
            assert cycle.source and cycle.__doc__, code
            for parameter in cycle.parameters():
                assert parameter.meaning and parameter.unit, (code, parameter.address)
                if isinstance(parameter.default, int | float) and abs(parameter.default) < 1e12:
                    assert not parameter.refuses(parameter.default), (code, parameter.address)


NAMES = [
    "nofile.mnc", "part.H", "jobs/part", "jobs\\part.nc31", "/home/me/part", "my part.jnc", "./a b/my part.g43", "x5.g43",
    "C:\\jobs\\x.h", "TNC:\\A\\B.H",
]  # fmt: skip


@together(
    "door name control", product([mnclab.run, mnclab.read], NAMES, [None, *mnclab.controls]),
    lambda door, name, control: f"{door.__name__} {control}", lambda door, name, control: name,
)  # fmt: skip
def test_the_name_of_a_missing_file_is_not_obeyed(tmp_path, monkeypatch, door, name, control):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(Alarm, match=r"cannot be read: there is no such file \(.*a program ends") as found:
        door(name, control)
    assert found.value.message.startswith(name.replace("./", ""))


PROGRAMS = [
    ("mnc", "G0 X10/2"), ("mnc", "X10/2"), ("mnc", "/N10G0X5"), ("mnc", "/N10 G0 X5"), ("mnc", "G0X10//at/last"),
    ("mnc", "G0 X5 // see jobs/a.mnc"), ("mnc", "// a/b"), ("tnc-620", "Q1=3/4"), ("tnc-620", "Q1 = 3/4"),
    ("tnc-620", "FN 4: Q4 = +Q2 DIV +Q1"), ("tnc-620", "/ 5 L X+1 FMAX"), ("tnc-620", "/5 L X+1 FMAX ; in/out"),
    ("tnc-620", "CALL PGM part.h"), ("tnc-620", "7 CALL PGM TNC:\\A\\B.H"), ("tnc-620", "; part.h"), ("g43", "G0 X1 ; a/b"),
    ("jnc-t01", "G0 X1 ' drawing 12/3.jnc"), ("nc-31", "N1 X100~ ; in/out"), ("mnc", "hello"), ("mnc", "X1.5"),
]  # fmt: skip


@pytest.mark.parametrize(("control", "line"), PROGRAMS)
def test_a_line_with_a_slash_or_a_name_in_it_is_a_program(control, line):
    assert mnclab.read(line, control).text == line and mnclab.run(line, control).program.name == "program"


def test_a_missing_file_is_told_with_the_nearest_names(tmp_path):
    for name in ("bracket.h", "bracelet.h", "plate.h"):
        (tmp_path / name).write_text("1 L X+1 FMAX\n")
    for source in (tmp_path / "braket.h", str(tmp_path / "braket.h")):
        with pytest.raises(Alarm) as found:
            mnclab.run(source)
        assert found.value.hint.startswith("near: bracket.h") and "plate" not in found.value.hint
    with pytest.raises(Alarm, match="there is no folder"):
        mnclab.run(str(tmp_path / "jobs" / "braket.h"))
    with pytest.raises(Alarm):
        mnclab.read(tmp_path / "a\0b")


OTHERS = {
    "mnc": "N10 G90 G54\nN20 G1 X40 Y2 F100 // a cut\n",
    "tnc-620": "0 BEGIN PGM A MM\n1 L X+40 R0 FMAX\n2 END PGM A MM\n",
    "nc-31": "N1 F20\nN2 X4000 ~ *\nN3 Z200 ~\n",
    "jnc-t01": "G90 F100 ' a comment\nG01 X40. T01\n",
    "g43": "G0 X1 ; above\nG43 Z10 H1\n",
}


@pytest.mark.parametrize("control", OTHERS)
@pytest.mark.parametrize("other", OTHERS)
def test_faults_in_a_program_of_another_control_say_so_once(control, other):
    run = mnclab.run(OTHERS[other] * 30, control)
    said = [alarm for alarm in run.alarms if "this looks like" in alarm.hint]
    assert len(said) == (other != control)
    assert all(f"looks like a program of {other}" in alarm.hint for alarm in said)


@pytest.mark.parametrize(("name", "foreign"), [("jnc-t01", ("N", "%", "M2", "M30")), ("g43", ("G66 again",))])
def test_what_is_no_function_of_a_control_by_itself_is_not_listed(name, foreign):
    """JNC-T01, tables 1 and 3: neither N nor % nor M02 nor M30 is a word of it. A macro call is G66 alone."""
    told = str(mnclab.help(name)), mnclab.controls[name]._repr_html_()
    for code in foreign:
        assert code in mnclab.controls[name].functions
        assert not re.search(rf"^{code}  ", told[0], re.M) and f"<code>{code}</code>" not in told[1]
    assert re.search(r"^G1 +", told[0], re.M) and "<code>G1</code>" in told[1]


def test_a_code_and_a_setting_of_one_name_are_told_apart_as_they_are_written():
    assert str(mnclab.help("G61", "g43")).startswith("G61  ")
    assert "end of every motion" in str(mnclab.help("g61", "g43"))
    assert "\ndiameter " in str(mnclab.help("Diameter", "jnc-t01"))  # no code is named so


def test_help_without_a_control():
    for name, control in mnclab.controls.items():
        table = mnclab.help(name)
        assert all(code in str(table) for code in (*control.listed, *control.cycles))
        assert str(mnclab.help(name, name)) == str(mnclab.help(control)) == str(table) and "<table>" in table._repr_html_()
        assert str(table).endswith(f'help("settings", "{name}")')
    with pytest.raises(Alarm, match="every control has its own settings: name it") as found:
        mnclab.help("settings")
    assert found.value.hint.startswith('help("settings", "mnc")')
    assert "Drilling" in str(mnclab.help("CYCL DEF 200"))  # only one control has it
    for code, said in (("G1", "a code of mnc, g43, jnc-t01"), ("zzz", "no code of any control"), ("", "needs a code")):
        with pytest.raises(Alarm, match=said) as found:
            mnclab.help(code)
        assert f'help("{code if code == "G1" else "G83"}", "mnc")' in found.value.hint


RUN = mnclab.run("G0 X1\n", "mnc")


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        (lambda: mnclab.run(5), TypeError), (lambda: mnclab.run(b"G0 X1"), TypeError), (lambda: mnclab.run(None), TypeError),
        (lambda: mnclab.run("G0 X1\n", 5), TypeError), (lambda: mnclab.run("G0 X1\n", "mnc", {}), TypeError),
        (lambda: mnclab.read([]), TypeError), (lambda: mnclab.modern(5), TypeError),
        (lambda: mnclab.modern("no.nc31"), Alarm), (lambda: mnclab.help(83, "mnc"), TypeError),
        (lambda: mnclab.help("G83", 5), TypeError), (lambda: mnclab.help("G83", "mmc"), Alarm),
        (lambda: mnclab.diff("a.mnc", RUN), TypeError), (lambda: mnclab.diff(RUN, 5), TypeError),
        (lambda: mnclab.compare(5, 5), TypeError), (lambda: mnclab.compare_turning(5, 5), TypeError),
        (lambda: mnclab.editor(5), TypeError), (lambda: mnclab.form("G999", "mnc"), Alarm),
        (lambda: RUN.at(), TypeError), (lambda: RUN.at(99), Alarm), (lambda: RUN.at(step=99), Alarm),
        (lambda: RUN.explain(99), Alarm), (lambda: RUN.when(5), TypeError), (lambda: RUN.profile(5), TypeError),
        (lambda: RUN.profile("zz"), Alarm), (lambda: RUN.again({}), TypeError), (lambda: RUN.save("x.zzz"), Alarm),
    ],
)  # fmt: skip
def test_a_wrong_use_is_an_alarm_or_says_which_type_is_meant(call, kind):
    with pytest.raises((kind, Alarm), match="[a-z]+ [a-z]+") as found:
        call()
    assert "object has no attribute" not in str(found.value)
