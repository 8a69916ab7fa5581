"""Long paths are written by columns: the files are those that one row after the other makes."""

import csv
import io
import json
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab
from mnclab import Kind, Toolpath
from mnclab.path.toolpath import COLUMNS, MOTION_KINDS
from mnclab.show.export_gcode import lines
from mnclab.show.player.payload import _said
from mnclab.show.plot.profile import COLUMNS as WIDE
from mnclab.show.plot.profile import THINNED, curve, drawn_pieces
from mnclab.text import columns as text_columns

LABELS = ("", "G83 peck 1 of 3", 'a, "b"', "100 % (é)", "two\nlines")
NUMBERS = st.one_of(st.sampled_from([0.0, -0.0, 1.0, -2.5, 0.1, 1e-9, 123456.789012345, 1 / 3]), st.floats(-1e6, 1e6))
STRAIGHT = (Kind.RAPID, Kind.LINE, Kind.PROBE)


@st.composite
def tables(draw, kinds=tuple(Kind), most=12):
    """Paths with rows of some kinds whose columns are anything."""
    n = draw(st.integers(0, most))

    def column(values):
        return draw(st.one_of(st.lists(values, min_size=n, max_size=n), values.map(lambda value: [value] * n)))

    ends = np.array(column(st.tuples(NUMBERS, NUMBERS, NUMBERS)), dtype=float).reshape(n, 3)
    some = st.one_of(NUMBERS, st.sampled_from([np.nan, np.inf]))
    columns = {
        "kind": np.array(column(st.sampled_from(kinds)), dtype=np.uint8),
        "line": np.array(column(st.integers(1, 3)), dtype=np.int32),
        "label": np.array(column(st.integers(0, len(LABELS) - 1)), dtype=np.int32),
        "feed": np.array(column(some), dtype=float),
        "time": np.array(column(some), dtype=float),
        "spindle": np.array(column(st.sampled_from([0.0, 800.0, -1200.5])), dtype=float),
        "tool": np.array(column(st.integers(0, 2)), dtype=np.int32),
        "exact": np.array(column(st.booleans()), dtype=bool),
        "synchronous": np.array(column(st.booleans()), dtype=bool),
        "sweep": np.array(column(st.floats(-7, 7)), dtype=float),
        "centre": ends + np.array(column(st.tuples(*[st.floats(-9, 9)] * 3)), dtype=float).reshape(n, 3),
    }
    if draw(st.booleans()):
        columns["gouge"] = COLUMNS["gouge"].of(n, True)
    return Toolpath.chain(np.vstack([np.zeros(3), ends]), columns, labels=LABELS)


def a_run(path):
    """A run that has this path, on a machine whose rapids go straight."""
    found = mnclab.run("G90\n", "mnc", mnclab.Setup(limits=mnclab.Limits(rapid_motion="line")))
    found.toolpath = path
    return found


@pytest.fixture(scope="module", autouse=True)
def _some_rows_at_a_time():
    """Parts of three rows, so that what is kept from one to the next is needed."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(text_columns, "ROWS", 3)
        yield


def saved(path, folder, suffix):
    return a_run(path).save(folder / f"a.{suffix}").read_bytes().decode()


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("exports")


def named(path):
    """The columns with kinds and labels by their names."""
    found = {name: column.tolist() for name, column in path.columns().items()}
    return found | {"kind": [Kind(kind).name for kind in path.kind], "label": [path.labels[k] for k in path.label]}


@given(path=tables())
def test_a_table_is_that_of_the_module_csv(path, folder):
    found = named(path)
    rows = zip(*([int(value) if isinstance(value, bool) else value for value in column] for column in found.values()))
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows([found, *rows])
    assert saved(path, folder, "csv") == out.getvalue()


@given(path=tables())
def test_json_is_that_of_the_module_json(path, folder):
    def known(value):
        return None if isinstance(value, float) and not np.isfinite(value) else value

    text = saved(path, folder, "json")
    whole = json.loads(text)
    assert list(whole)[-1] == "columns"
    whole["columns"] = {name: [known(value) for value in column] for name, column in named(path).items()}
    assert json.dumps(whole, allow_nan=False) + "\n" == text


@given(path=tables((*STRAIGHT, Kind.DWELL, Kind.STOP)))
def test_a_drawing_has_a_line_for_each_straight_move(path, folder):
    text = saved(path, folder, "dxf")
    expected = ""
    for row in path.motion:
        ends = (*row.start, *row.end)
        codes = (10, 20, 30, 11, 21, 31)
        layer = "RAPID" if row.kind == Kind.RAPID else "PROBING" if row.kind == Kind.PROBE else "FEED"
        expected += f"  0\nLINE\n  8\n{layer}\n" + "".join(f"{c:3d}\n{float(v) + 0.0!r}\n" for c, v in zip(codes, ends))
    assert text.split("ENTITIES\n")[1] == f"{expected}  0\nENDSEC\n  0\nEOF\n"


@settings(max_examples=20)
@given(path=tables())
def test_files_do_not_depend_on_how_many_rows_are_written_at_a_time(path, folder):
    for suffix in ("csv", "json", "ngc", "dxf", "svg"):
        options = {"true_size": True} if suffix == "svg" else {}
        texts = set()
        for rows in (1, 3, 1000):
            with pytest.MonkeyPatch.context() as patched:
                patched.setattr(text_columns, "ROWS", rows)
                texts.add(a_run(path).save(folder / f"b.{suffix}", **options).read_bytes())
        assert len(texts) == 1, suffix


@given(path=tables((*STRAIGHT, Kind.DWELL, Kind.TOOL, Kind.SPINDLE, Kind.STOP)))
def test_plain_blocks_say_every_straight_move(path, folder):
    """Read as a control reads them, words staying until they change: the ends, the codes and the feeds of the moves."""
    path = path.replace(synchronous=np.zeros(len(path), dtype=bool), kind=path.kind)
    said, at, code, feed = [], dict.fromkeys("XYZ", "0"), "", ""
    for block in lines(a_run(path))[3:-2]:
        words = re.findall(r"([A-Z])(-?[0-9.]+)", re.sub(r"\(.*?\)", "", block))
        codes = [f"G{value}" for letter, value in words if letter == "G" and value in ("0", "1")]
        code = codes[0] if codes else code
        moves = {letter: value for letter, value in words if letter in "XYZ"}
        feed = next((value for letter, value in words if letter == "F"), feed)
        at |= moves
        if moves:
            said.append((code, *at.values(), feed if code == "G1" else ""))
    wanted, now, feed, first, jumped = [], [0.0] * 3, "", True, True
    for row in path:
        if row.kind == Kind.TOOL:
            jumped = True
        if row.kind not in MOTION_KINDS:
            continue
        if first and row.kind != Kind.RAPID:
            wanted.append(("G0", *map(rounded, row.start), ""))
            now, jumped = [rounded(value) for value in row.start], False
        first = False
        end = [rounded(value) for value in row.end]
        if end != now or jumped:
            if row.kind != Kind.RAPID and np.isfinite(row.feed):
                still = row.kind == Kind.LINE and (row.start == row.end).all()  # a move of rotary axes alone counts degrees
                feed = rounded(np.degrees(row.feed) if still else row.feed, 4)
            wanted.append(("G0" if row.kind == Kind.RAPID else "G1", *end, "" if row.kind == Kind.RAPID else feed))
            now, jumped = end, False
    assert said == wanted


def rounded(value, decimals=6):
    """A number as the file has it: without trailing zeros, an exponent or a negative zero."""
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def raster(n):
    """A path over a wavy surface, whose profile has more pieces than a picture shows."""
    rng = np.random.default_rng(3)
    points = np.cumsum(rng.normal(0, 0.4, (n + 1, 3)), axis=0)
    columns = {"kind": np.where(np.arange(n) % 97, Kind.LINE, Kind.RAPID).astype(np.uint8), "feed": np.full(n, 3000.0)}
    return Toolpath.chain(points, columns)


WORDS = "X Y Z x 1 - + .5 2.25 0.1234567891 G1 ( ) X1.5 Y-2 Z+.5 ; é A=".split()
LINES = st.lists(st.lists(st.sampled_from([*WORDS, " ", "\t"]), max_size=8).map("".join), min_size=1, max_size=6)


@given(lines=LINES, end=st.sampled_from(["\n", "\r\n", "\r"]))
def test_the_page_finds_the_numbers_of_a_line_as_its_script_does(lines, end):
    """`data.js` looks for them by one expression in each line."""
    wanted = [[re.search(f"{axis}([-+]?[0-9]*[.]?[0-9]+)", line) for axis in "XYZ"] for line in lines]
    numbers = [[float(found[1]) if found else np.nan for found in line] for line in wanted]
    assert np.array_equal(_said(end.join(lines), np.arange(len(lines))), numbers, equal_nan=True)


def test_a_selection_keeps_constant_columns_constant():
    path = mnclab.run("G90\nG1 X1 F100\nY2\nM5\n", "mnc").toolpath
    for some in (path[[0, -1]], path[path.kind == Kind.LINE], path[np.array([1, 0])]):
        assert some.axis.strides[0] == 0 and some.axis.shape == (2, 3)
    assert path[[0, -1]].line.tolist() == [path.line[0], path.line[-1]]
    with pytest.raises(IndexError):
        path[[len(path)]]


@pytest.mark.parametrize("over", ["time", "path"])
def test_each_column_of_a_thinned_profile_has_its_least_and_its_greatest(over):
    profile = mnclab.Profile(raster(8_000), mnclab.Limits(jerk=2e4))
    some, p = drawn_pieces(profile, over, axes=True), profile.pieces
    assert len(some) < len(p.row)
    x = p.t if over == "time" else p.s
    column = np.searchsorted(np.linspace(x[0], x[-1], WIDE, endpoint=False), x[:-1], "right")
    all_of_them, kept = curve(profile, over), curve(profile, over, some)
    for name in ("v", "a", "j"):
        for least in (np.fmin, np.fmax):
            found = []
            for drawn in (all_of_them, kept):
                values = np.full(WIDE + 1, np.nan)
                least.at(values, column[drawn.piece], getattr(drawn, name))
                found.append(values)
            assert np.allclose(*found, rtol=1e-12, atol=0, equal_nan=True)
    assert (kept.t[0], kept.t[-1]) == (all_of_them.t[0], all_of_them.t[-1])


def test_a_thinned_picture_says_so():
    long, short = (mnclab.Profile(raster(n), mnclab.Limits(jerk=2e4)) for n in (8_000, 300))
    assert isinstance(drawn_pieces(short, "time"), slice)
    for profile, said in ((long, True), (short, False)):
        figure = profile.plot()
        names = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
        assert (THINNED in names) is said
        small = [text.get_text() for legend in profile.plot(size=(3, 3)).legends for text in legend.get_texts()]
        assert (THINNED in small) is said  # whatever else has no room
        ax = figure.add_subplot()
        profile.plot(ax=ax)
        assert (THINNED in [text.get_text() for text in ax.texts]) is said
