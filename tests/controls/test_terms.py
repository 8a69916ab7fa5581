"""What the manuals call their codes, and the glossary: help shows it, and finds by it.

`authorities/catalogue/terms.json` has control, code and term of every entry of the catalogue whose manual has a term for it
(`authorities/extract_terms.py` looks each up in the text of its manual). The words are those of the table of words of the house.
"""

import json
import re
from pathlib import Path

import pytest

import mnclab as mnc
from mnclab import Alarm
from mnclab.controls.glossary import Entry, glossary, named
from mnclab.machine.terms import folded, terms

EXPECTED = json.loads((Path(__file__).parents[1] / "authorities" / "catalogue" / "terms.json").read_text("utf-8"))
#: The words to be used, and those that lead to them.
WORDS = {
    "part program, block, word, address": "line, token, letter", "preparatory function, miscellaneous function": "G-code, M-code",
    "cycle, to define, to call": "canned cycle, macro", "datum, work offset": "zero, origin",
    "contour, equidistant, tool-centre path": "outline, offset curve",
    "compensation left, compensation right, approach, departure": "cutter comp, lead-in, lead-out",
    "set-up clearance, second set-up clearance": "safe height", "peck, infeed, stepover, allowance": "step, bite",
    "feed rate, rapid, dwell, spindle speed": "speed, pause, RPM", "retract plane, surface coordinate, depth": "R level",
    "probe, touch, measured": "test, hit", "alarm": "exception, error", "workpiece, blank, stock": "in-process model",
    "collision, gouge, rest material": "crash, overcut, leftover", "design, drawing, dimension": "target, blueprint",
    "profile": "speed plot, trajectory", "helix": "corkscrew",
    # of the tasks of the first weeks
    "modal, discrete, single block": "", "insert, nose radius, chuck, clamp": "jaws", "edge finder, gauge block": "",
    "climb milling, conventional milling, engagement": "down milling, up milling", "core hole, fit": "tap drill hole",
}  # fmt: skip
#: What the manuals call them.
MANUALS = (
    "управляющая программа; кадр; слово; адрес; подготовительная функция; вспомогательная функция; цикл; ciclu; definire; "
    "apelare; нулевая точка; origine; контур; эквидистанта; коррекция; выход на контур; сход; compensare de rază; безопасное "
    "расстояние; distanță de siguranță; глубина за проход; припуск; подача; ускоренное перемещение; выдержка; уровень возврата; "
    "координата поверхности; щуп; касание; palpator; ошибка; авария; alarmă; заготовка; деталь; semifabricat; piesă; "
    "столкновение; зарез; недорез; чертёж; размер; desen; cotă; профиль скорости"
)


def said(code, control):
    """What help says of a code, or why it is refused."""
    try:
        return str(mnc.help(code, control))
    except Alarm as alarm:
        assert code in mnc.controls[control].refused, alarm
        return alarm.message


@pytest.mark.parametrize("control", mnc.controls)
def test_help_shows_what_the_manual_calls_it(control):
    rows = [(code, term) for of, code, term in EXPECTED if of == control]
    assert len(rows) >= {"mnc": 130, "tnc-620": 330, "nc-31": 60, "jnc-t01": 55, "g43": 10}[control]
    shown = ((code, term, folded(" ".join(said(code, control).split()))) for code, term in rows)
    assert not [(code, term) for code, term, text in shown if folded(term) not in text]


def test_each_page_shows_it_in_grey():
    for code, control, term in (
        ("G83", "mnc", "Цикл глубокого сверления"), ("CYCL DEF 205", "tnc-620", "Ciocănire universală"),
        ("G1", "jnc-t01", "Линейная интерполяция"), ("semi-open zone", "nc-31", "Полуоткрытая зона"),
    ):
        assert term in mnc.help(code, control)._repr_html_()
    assert "color:#767676" in mnc.help("G83", "mnc")._repr_html_()
    assert "Цикл глубокого сверления" in mnc.help("mnc")._repr_html_()
    run = mnc.run("T1 S800 M3\nG0 X0 Y0 Z5\nG83 X9 Z-9 R2 K4 F120\n", "mnc")
    assert "cycle: Deep-hole drilling [Цикл глубокого сверления]" in str(run.explain(line=3))
    assert "[Цикл глубокого сверления]" in run.explain(line=3)._repr_html_()


def test_a_refused_code_is_refused_with_its_term():
    with pytest.raises(Alarm, match=re.escape("U (координата скоса по оси X)")):
        mnc.help("U", "jnc-t01")


def test_a_concept_says_what_it_is():
    title, kind = str(mnc.help("open zone")).splitlines()
    assert title == "open zone  Open zone · Открытая зона"
    assert kind == "turning technology in the manual of Elektronika NC-31 (lathe)"


def test_files_are_read_when_they_are_asked_for():
    every = [one.terms for one in mnc.controls.values()]
    assert all(file.is_file() for file in every) and sum(len(terms(file)) for file in every) >= 500
    assert terms(None) == {}


@pytest.mark.parametrize(("words", "control", "code"), [
    ("глубокого сверления", "mnc", "G83"), ("ГЛУБОКОЕ СВЕРЛЕНИЕ", "jnc-t01", "G73"), ("ciocanire", None, "CYCL DEF 205"),
    ("filetare rigida", None, "CYCL DEF 207"), ("Ciocănire universală", "tnc-620", "CYCL DEF 205"),
    ("gun drilling", None, "G307"), ("rotatia de baza peste doua gauri", None, "TCH PROBE 401"),
])  # fmt: skip
def test_one_hit_is_shown(words, control, code):
    assert str(mnc.help(words, control)).startswith(f"{code}  ")


@pytest.mark.parametrize(("words", "control", "codes"), [
    ("drilling", None, {"G83", "CYCL DEF 200", "G73", "G81"}), ("foraj", None, {"CYCL DEF 200", "CYCL DEF 241"}),
    ("сверления", "mnc", {"G83", "G300", "G307"}), ("datum table", None, {"datum table"}), ("step", None, {"peck", "infeed"}),
])  # fmt: skip
def test_several_are_a_table(words, control, codes):
    found = mnc.help(words, control)
    assert codes <= {row[0] for row in found.entry} and "<table>" in found._repr_html_()
    assert str(found).startswith("code ")


def test_nothing_is_an_alarm_with_near_names():
    with pytest.raises(Alarm) as found:
        mnc.help("equidistent")
    assert "near: equidistant" in found.value.hint
    for words in ("hello", "xyzzy plugh", "G999", "no such zone"):
        with pytest.raises(Alarm):
            mnc.help(words)
        with pytest.raises(Alarm):
            mnc.help(words, "mnc")


def test_case_and_marks_of_letters_do_not_matter():
    assert folded("ȘTIFT Ţepi şi Ț, чертёж Й") == "stift tepi si t, чертеж и"
    assert str(mnc.help("ЭКВИДИСТАНТА")) == str(mnc.help("equidistant"))
    assert str(mnc.help("Alarma")) == str(mnc.help("alarm"))


def test_the_glossary_has_every_word_of_the_house():
    table = str(mnc.help("glossary"))
    for used, others in WORDS.items():
        here = [one for term in used.split(", ") for one in glossary() if one.term == term]
        assert [one.term for one in here] == used.split(", ")
        for word in filter(None, others.split(", ")):
            assert set(map(id, named(word))) & set(map(id, here)), word
            assert any(one.term in str(mnc.help(word)) for one in named(word)), word
    for one in glossary():
        assert one.means.endswith(".") and one.ru and one.ro and one.term.split()[0] in table
    assert "<table>" in mnc.help("glossary")._repr_html_()


def test_what_the_manuals_call_a_word_leads_to_it():
    for word in MANUALS.split("; "):
        assert any(one.term in str(mnc.help(word)) for one in named(word)), word
    for one in glossary():
        assert all(one in named(word) for word in one.words)


def test_a_word_of_a_file_stands_above_it():
    """The page of a design is still one that can be read back."""
    assert str(mnc.help("design")).startswith("# design  (ru чертёж; ro desen)\n# ")


def test_a_word_with_a_picture_shows_it():
    page = mnc.help("equidistant")
    assert "<img" in page._repr_html_() and page.plot(size=(4, 3)).get_figwidth() == 4
    assert "mnclab-dimension" in mnc.help("set-up clearance")._repr_html_()
    with pytest.raises(Alarm, match="no picture"):
        mnc.help("dwell").plot()
    with pytest.raises(Alarm, match="only a term"):
        mnc.help("G83", "mnc").plot()


SHAPES = {one.picture: one for one in reversed(glossary()) if one.picture}


@pytest.mark.parametrize("one", SHAPES.values(), ids=lambda one: one.term)
def test_every_picture_is_drawn_within_its_borders(one):
    figure = one.plot()
    figure.draw_without_rendering()
    edge = figure.bbox
    for ax in figure.axes:
        box = ax.get_window_extent()
        assert (box.min >= edge.min - 1).all() and (box.max <= edge.max + 1).all()
    for text in (text for text in figure.texts if text.get_text().strip()):
        box = text.get_window_extent()
        assert (box.min >= edge.min - 1).all() and (box.max <= edge.max + 1).all(), text.get_text()


@pytest.mark.parametrize("one", [one for one in glossary() if one.form], ids=lambda one: one.term)
def test_every_scheme_has_its_dimension_within_the_picture(one):
    wide, high = map(int, re.search(r'viewBox="0 0 (\d+) (\d+)"', one.drawn).groups())
    texts = re.findall(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*>(\S+) ', one.drawn)
    assert texts and all(0 < float(x) < wide and 0 < float(y) < high and name == one.form[2] for x, y, name in texts)


def test_a_page_to_print(tmp_path, monkeypatch):
    monkeypatch.setattr(Entry, "drawn", "")
    page = mnc.help("glossary").save(tmp_path / "glossary.html").read_text("utf-8")
    assert all(one.term in page for one in glossary()) and page.startswith("<!DOCTYPE html>")
    with pytest.raises(Alarm, match=r"help is saved as \.html"):
        mnc.help("glossary").save(tmp_path / "glossary.pdf")
