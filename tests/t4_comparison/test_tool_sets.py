"""Sets of tools: the quickest of all sets tried one by one; times add up; every set reaches what the smallest tool reaches."""

from itertools import combinations

import numpy as np
import pytest

import mnclab
from mnclab import Alarm, area, compare, tool_sets
from mnclab.strategies import rest

BOX = area.Region.of(area.rectangle(60, 40, 2.0))  # corners of a radius of 2
TOOLS = [mnclab.Tool(diameter=d, teeth=3) for d in (4, 8, 12)]
SIMPLE = {"strategies": ["rings", "zigzag"], "overlap": 0.4}


@pytest.fixture(scope="module")
def found():
    return tool_sets(BOX, TOOLS, change=10.0, **SIMPLE)


def test_all_sets_stand_in_the_table(found):
    names = {"⌀" + ", ⌀".join(f"{d:g}" for d in (*larger, 4)) for n in (0, 1, 2) for larger in combinations((12, 8), n)}
    assert {each.name for each in found.trials} == names and len(found) == 4
    assert [each.time for each in found.trials] == sorted(each.time for each in found.trials)
    assert found.best("time") is found.trials[0] and found.best().tools[-1] is TOOLS[0]


def test_a_set_is_its_tools_one_after_the_other(found):
    """As `compare` says of each tool on what the one before it has left, by the quickest strategy, and the changes."""
    for each in found.trials:
        stock, total = None, 10.0 * (len(each.tools) - 1)
        for tool, trial in zip(each.tools, each.trials, strict=True):
            alone = compare(BOX, tool, SIMPLE["strategies"], overlap=0.4, stock=stock)
            total += min(one.time for one in alone.trials)
            assert trial.name == alone.best("time").name
            stock = rest(BOX, tool, stock)
        assert each.time == pytest.approx(total, rel=1e-9)
        assert stock.area == pytest.approx(0, abs=1e-6)
        ways = each.path.length - sum(trial.path.length for trial in each.trials)  # rapid, from the end of one to the next
        assert 0 <= ways < 80 * (len(each.tools) - 1) + 1e-9
        assert each.length(rapid=False) == pytest.approx(sum(trial.length(rapid=False) for trial in each.trials))


def test_the_path_of_a_set_has_the_names_and_numbers_of_its_tools(found):
    each = next(one for one in found.trials if len(one.tools) == 2)
    labels = [each.path.labels[k] for k in each.path.label]
    own = [[trial.path.labels[k] for k in trial.path.label] for trial in each.trials]
    assert labels == [*own[0], "to the entry", *own[1]]
    assert each.path.tool.tolist() == [1] * len(own[0]) + [2] * (1 + len(own[1]))
    assert np.abs(each.path.end[:-1] - each.path.start[1:]).max() < 1e-12


def test_a_change_that_takes_long_makes_one_tool_the_best():
    assert len(tool_sets(BOX, TOOLS, change=1e4, **SIMPLE).best("time").tools) == 1
    assert len(tool_sets(BOX, TOOLS, change=0, most=1, **SIMPLE)) == 1
    large = area.Region.of(area.rectangle(120, 80, 2.0))
    assert len(tool_sets(large, TOOLS, change=0, **SIMPLE).best("time").tools) > 1


def test_a_tool_that_does_not_fit_is_in_no_set():
    assert {each.name for each in tool_sets(BOX, [2.0, 30.0], **SIMPLE).trials} == {"⌀4"}


def test_tools_that_leave_nothing_need_none_after_them():
    round_ = area.Region.of(area.Contour.circle((0, 0), 20))
    assert {each.name for each in tool_sets(round_, [2.0, 5.0], **SIMPLE).trials} == {"⌀4", "⌀10"}


def test_table_and_picture(found, tmp_path):
    assert found.save(tmp_path / "t.csv").read_text("utf-8").count("\n") == 5
    assert found.save(tmp_path / "t.svg").stat().st_size > 1000
    picture = found.plot()
    texts = {text.get_text() for text in picture.axes[0].texts}
    assert found.best().name in texts


@pytest.mark.parametrize(
    "given, said",
    [
        ((3, [2.0]), "Region"), ((BOX, 3), "list"), ((BOX, []), "tools"), ((BOX, [2.0, 2.0]), "two of the tools"),
        ((BOX, [50.0]), "fits"), ((BOX, ["x"]), "tool"), ((BOX, [2.0], "swirl"), "strategy"), ((BOX, [2.0], []), "strategy"),
        ((BOX, [-2.0]), "tool"), ((BOX, list(range(1, 20))), "12"),
    ],
)  # fmt: skip
def test_faults(given, said):
    with pytest.raises(Alarm, match=said):
        tool_sets(*given)


@pytest.mark.parametrize("options", [{"change": -1}, {"most": 0}, {"most": 1.5}, {"overlap": 1.0}, {"depth": 0}, {"chip": 0.05}])
def test_faults_of_options(options):
    with pytest.raises(Alarm):
        tool_sets(BOX, [2.0], **options)
