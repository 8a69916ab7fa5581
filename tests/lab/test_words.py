"""Completion and the meaning of words in a notebook: `|` is the cursor in a source that nobody has finished yet."""

import pytest

import mnclab
from mnclab.lab.cell import call_at, explanation, suggestions

RUN = mnclab.run("G0 X1\n", "mnc")
NAMES = {"mnc": mnclab, "run": mnclab.run, "r": RUN, "help": mnclab.help, "print": print, "tools": {1: mnclab.Tool(radius=3)},
         "mine": mnclab.Setup()}  # fmt: skip
MACHINES = {"fast-mill", "hobby-router", "old-lathe", "small-mill"}  # data/machines


def offered(source):
    """What is typed, and the words offered; None where mnclab has no say."""
    found = suggestions(source.replace("|", "", 1), source.index("|"), NAMES)
    return found and (found[0], {word for word, _ in found[1]})


def told(source):
    return explanation(source.replace("|", "", 1), source.index("|"), NAMES)


@pytest.mark.parametrize(
    ("source", "function", "position", "keyword", "typed"),
    [
        ('mnc.help("G8|', "mnc.help", 0, "", "G8"),
        ('mnc.help("G8|")', "mnc.help", 0, "", "G8"),
        ('f(1, [2, 3], "a, b", x="|', "f", 3, "x", ""),
        ('f(g(1, "("), |', "f", 1, "", None),
        ('f("""a\n"b" |""", 1)', "f", 0, "", 'a\n"b" '),
        ("f('it\\'s |')", "f", 0, "", "it\\'s "),
        ('f(  # no "text"\n  "|', "f", 0, "", ""),
        ('mnc.run("x\\n").profile("|', ".profile", 0, "", ""),
    ],
)
def test_the_call_around_a_cursor(source, function, position, keyword, typed):
    call = call_at(source.replace("|", ""), source.index("|"))
    text = None if call.text is None else call.text[: call.at]
    assert (call.function, call.position, call.keyword, text) == (function, position, keyword, typed)


def test_a_cursor_beyond_the_source_stands_at_its_end():
    assert call_at('f(1, [2], x', 99) == call_at('f(1, [2], x', 11)
    assert (call_at('f("ab', 99).text, call_at("", 5)) == ("ab", None)


@pytest.mark.parametrize("source", ['f("a")|', "x = (1 + |", 'x = "|', "|", 'f("a\n|'[:-1], '# f("|', "d[|", ")))|"])
def test_no_call(source):
    call = call_at(source.replace("|", ""), len(source) - 1)
    assert call is None or call.text is None or "\n" in source


@pytest.mark.parametrize(
    ("source", "typed", "among"),
    [
        ('mnc.help("G8|', "G8", {"G83", "G84"}),
        ('mnc.help("CYCL DEF 20|", "tnc-620")', "20", {"200", "201", "208"}),
        ('mnc.help("se|", "mnc")', "se", {"settings"}),
        ('help("mn|', "mn", {"mnc"}),
        ('mnc.form("G8|", "mnc")', "G8", {"G83", "G84", "G85"}),
        ('mnc.form("G83", "|")', "", set(mnclab.controls)),
        ('mnc.run("a.mnc", control="t|', "t", {"tnc-620"}),
        ('mnc.steps("G83", "mnc", K=5, R|', "R", {"R="}),
        ('r.profile("|', "", MACHINES),
        ('r.profile(limits="sm|")', "sm", {"small-mill"}),
        ('mnc.run("x\\n").profile("|', "", MACHINES),
        ('mnc.run("""\nN10 G83 X20 K|5\n""", control="mnc")', "K", set()),
        ('mnc.run("""\nN10 G83 X20 |\n""", control="mnc")', "", {"K", "R"}),
        ('mnc.run("""\nN10 G8|', "G8", {"G83"}),  # no control yet: the codes of all
        ("%%mnc --control mnc\nN10 G83 X20 |", "", {"K", "R"}),
        ("%%mnc\nBEGIN PGM A MM\nCYCL DEF 2|", "2", {"200"}),
        ("%%mnc --co|", "--co", {"--control", "--colour"}),
        ("%%mnc --control n|", "n", {"nc-31"}),
        ("%%mnc --tools |", "", {"tools"}),
        ("%%mnc --setup m|", "m", {"mine"}),
    ],
)
def test_what_is_offered(source, typed, among):
    found = offered(source)
    assert found[0] == typed and among <= found[1]


@pytest.mark.parametrize("source", ['print("G8|', 'open("|', 'r.plot(view="|', "mnc.|", "G8|", 'mnc.help(|', 'other.help("G8|'])
def test_what_is_left_to_others(source):
    assert offered(source) is None


def test_a_form_is_offered_cycles_alone():
    assert offered('mnc.form("|", "mnc")')[1] == set(mnclab.controls["mnc"].cycles)


def test_programs_and_folders_are_offered(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("part.mnc", "picture.png", "sub.h", ".hidden.mnc"):
        (tmp_path / name).write_text("")
    (tmp_path / "jobs").mkdir()
    (tmp_path / "jobs" / "a.g43").write_text("")
    assert offered('mnc.run("|') == ("", {"part.mnc", "sub.h", "jobs/"})
    assert offered('mnc.editor("pa|') == ("pa", {"part.mnc"})
    assert offered('mnc.read("jobs/|') == ("jobs/", {"jobs/a.g43"})
    assert offered('mnc.run("no/such/|')[1] == set()
    assert offered("%%mnc --control tnc-620\nCALL PGM s|") == ("s", {"sub.h"})


def test_a_word_is_explained_and_a_code_has_its_whole_table():
    found = told("%%mnc --control mnc\nN40 G83 |K5")
    assert found["text/plain"] == "K  depth of one peck, mm (G83 Deep-hole drilling)"
    assert "<code>K</code>" in found["text/html"]
    assert told("%%mnc --control mnc\nN40 G83| K5")["text/plain"] == str(mnclab.help("G83", "mnc"))
    assert told('mnc.run("""\nG83 X1 |K5\n""", control="mnc")') == told("%%mnc --control mnc\nG83 X1 |K5")


@pytest.mark.parametrize(
    "source", ["%%mnc --control |mnc\nG1", "x = |G83", "%%mnc --control no\nG8|3", "%%mnc\n|", 'print("G8|3")']
)
def test_what_is_explained_by_others(source):
    assert told(source) == {}


def test_no_source_is_a_fault():
    odd = ["%%mnc --control 'mnc\nG83 \"", 'mnc.run("""\n%%mnc ((', "mnc.steps('G83', 'no', K", "%%mnc --setup=\x00", 'f("\\']
    for source in odd:
        for at in range(len(source) + 1):
            suggestions(source, at, NAMES)
            explanation(source, at, NAMES)
