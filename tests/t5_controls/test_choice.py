"""Which control a program is for: its name, the file's suffix, the text; and no guessing when two fit."""

import pytest

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
        with pytest.raises(Alarm, match="more than one control fits: name it"):
            mnclab.read(SQUARES["mnc"])
    finally:
        mnclab.controls.remove("twin")


def test_an_unknown_control_is_named_with_those_that_exist():
    with pytest.raises(Alarm) as found:
        mnclab.run("G0 X1\n", "tnc620")
    assert str(found.value) == (
        "alarm: there is no control 'tnc620' (known: mnc, tnc-620, nc-31, g43, jnc-t01; near: tnc-620)"
    )


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
