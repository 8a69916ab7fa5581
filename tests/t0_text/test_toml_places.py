"""Where a file of a user says a thing: under its keys, and under its number in a list."""

import pytest

from mnclab.text.alarm import Alarm
from mnclab.text.file import File, table_of

TEXT = """\
title = "a"
profile = [
    { z = 0, r = 12, chamfer = 1.5 },   # front
    [-30, 12],
    { z = -50, r = 20 },
]
[blank]
radius = 5
[[features]]
kind = "bore"
depth = 4
[[features]]
kind = "groove"
place = { z = 1, r = 2 }
[features.tolerances]
depth = 0.1
"""


@pytest.mark.parametrize(
    ("keys", "line", "word"),
    [
        ("title", 1, "title"),
        ("profile", 2, "profile"),
        ("profile 0 r", 3, "r"),
        ("profile 1", 4, "["),
        ("profile 2 z", 5, "z"),
        ("blank radius", 8, "radius"),
        ("features", 9, "features"),
        ("features 0 depth", 11, "depth"),
        ("features depth", 11, "depth"),
        ("features 1", 12, "features"),
        ("features 1 depth", 12, "features"),
        ("features 1 place r", 14, "r"),
        ("features 1 tolerances depth", 16, "depth"),
    ],
)
def test_places(keys, line, word):
    file = File("design.toml", TEXT)
    place = file.place_of(*keys.split())
    assert place.line == line
    assert file.line_text(line)[place.column - 1 :][: place.length] == word


def test_a_table_that_only_its_parts_name():
    place = File("design.toml", "a = 1\n[limits.rapid]\nx = 2\n").place_of("limits")
    assert (place.line, place.column) == (2, 9)


def test_what_is_not_there():
    assert File("design.toml", TEXT).place_of("nothing") is None


@pytest.mark.parametrize(
    ("text", "line", "column", "says"),
    [
        ('name = "a"\nstepover = 1,5\nfeed = 800\n', 2, 12, "write 1.5"),
        ("a = -0,25 # mm\r\nb = 1\r\n", 1, 5, "write -0.25"),
        ("[t]\n1 = [10, 20, 0\n2 = [1, 2, 3]\n", 2, 5, "the bracket is not closed"),
        ("[t]\n1 = [10, 20, 0,\n\n[u]\nb = 1\n", 2, 5, "the bracket is not closed"),
        ("a = [[1, 2],\n     [3, 4]\n# ] \nb = ']'\n", 1, 5, "the bracket is not closed"),
        ('a = """\n[ {\n"""\nb = [1,\nc = 3\n', 4, 5, "the bracket is not closed"),
        ("a = [\n 1,\n 2\n", 1, 5, "the bracket is not closed"),
        ("a = [\n [1, 2],\n x\n]\n", 3, 2, "Invalid value"),
        ("a = 1\nb = \n", 2, 5, "Invalid value"),
    ],
)
def test_a_slip_is_shown_where_it_was_made(text, line, column, says):
    """Not where a reader of TOML can go no further."""
    with pytest.raises(Alarm, match=says) as found:
        table_of(text)
    assert (found.value.span.line, found.value.span.column) == (line, column)
