"""The options of a picture are written out for Tab and for type checkers: those that what draws takes, no more, no fewer."""

import inspect
import typing

import pytest
from tools.odd_arguments import RUN

import mnclab as mnc
from mnclab.comparison.diff import Deviation, HolesCompared
from mnclab.comparison.strategies import Comparison, Trial
from mnclab.comparison.tool_sets import ToolSets
from mnclab.comparison.turning_schemes import TurningComparison, TurningTrial
from mnclab.design.difference.difference import Difference
from mnclab.design.difference.plot import plot_difference
from mnclab.design.drawing import plot as plot_drawing
from mnclab.design.drawing import save as save_drawing
from mnclab.learning.exercise import Exercise
from mnclab.show.player.page import Player
from mnclab.show.plot.compensation import compensation
from mnclab.show.plot.face import plot_face
from mnclab.show.plot.holes import plot_holes
from mnclab.show.plot.lathe import plot_speed_of
from mnclab.show.plot.measured import plot_measured
from mnclab.show.plot.over_time import plot_depth, plot_removal
from mnclab.show.plot.part import plot_part
from mnclab.show.plot.path import plot_path, plot_run
from mnclab.show.plot.pocketing import plot_strategies, plot_tool_sets
from mnclab.show.plot.profile import plot_lost, plot_profile, plot_reached
from mnclab.show.plot.set_up import plot_datums, plot_lengths
from mnclab.show.plot.side_by_side import plot_deviation
from mnclab.show.plot.turning_schemes import plot_schemes
from mnclab.show.scene import part_body, scene
from mnclab.text import given
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.removal import Removal
from mnclab.workpiece.workpiece import Workpiece

#: A door, what draws, and the options that the door gives itself.
DOORS = [
    (mnc.Run.plot, plot_run, set()), (mnc.Run.plot_depth, plot_depth, set()),
    (mnc.Run.plot_datums, plot_datums, set()), (mnc.Run.plot_face, plot_face, set()),
    (mnc.Run.plot_lengths, plot_lengths, set()), (mnc.Run.plot_measured, plot_measured, set()),
    (mnc.Run.plot_speed, plot_speed_of, set()), (mnc.Run.plot_compensation, compensation, set()),
    (mnc.Run.scene, scene, set()), (mnc.Run.player, Player, {"profile", "cutting", "collisions"}),
    (mnc.Toolpath.plot, plot_path, set()), (mnc.Profile.plot, plot_profile, set()),
    (mnc.Profile.plot_reached, plot_reached, set()), (mnc.Profile.plot_lost, plot_lost, set()),
    (Workpiece.plot, plot_part, set()), (Workpiece.save, plot_part, set()), (Workpiece.scene, part_body, set()),
    (Removal.plot, plot_removal, set()), (Collisions.plot, plot_part, {"collisions"}),
    (Difference.plot, plot_difference, set()), (Difference.save, plot_difference, set()),
    (Deviation.plot, plot_deviation, set()), (HolesCompared.plot, plot_holes, set()),
    (Comparison.plot, plot_strategies, set()), (Trial.plot, plot_strategies, set()),
    (ToolSets.plot, plot_tool_sets, set()), (TurningComparison.plot, plot_schemes, set()),
    (TurningTrial.plot, plot_schemes, set()), (mnc.Design.plot, plot_drawing, set()),
    (Exercise.drawing, plot_drawing, set()), (mnc.Run.save, plot_run, set()), (mnc.Design.save, save_drawing, set()),
]  # fmt: skip
OWN = {"path", "limits_", "machine", "of", "true_size", "step"}  # of a door alone: the file, the machine of a player, of a body


def names(door):
    takes = [*inspect.signature(door).parameters.values()][1:]
    return {each.name for each in takes if each.kind not in (each.VAR_KEYWORD, each.VAR_POSITIONAL)}


@pytest.mark.parametrize(("door", "draws", "filled"), DOORS, ids=lambda each: getattr(each, "__qualname__", ""))
def test_a_door_has_the_options_of_what_draws(door, draws, filled):
    takes = (names(draws) | set(getattr(draws, "options", {}))) - {"run", "self"} - filled
    own = OWN | ({"limits"} if draws is Player else set())
    assert names(door) - own == takes - own
    assert not any(each.kind == each.VAR_KEYWORD for each in inspect.signature(door).parameters.values())


def test_the_kinds_that_are_written_are_those_of_what_draws():
    """Options of plain kinds: what a type checker reads is what is refused when it is another."""
    plain = {"bool", "int", "float", "str", "int | None", "float | None", "bool | None", "bool | int", "str | None"}
    for door, draws, _ in DOORS:
        said = {name: str(each.annotation) for name, each in inspect.signature(door).parameters.items()}
        for name, each in getattr(draws, "options", {}).items():
            if name in said and str(each.annotation) in plain:
                assert said[name] == str(each.annotation), (door.__qualname__, name)


def test_every_kind_of_options_is_used():
    kinds = [name for name, each in vars(given).items() if typing.is_typeddict(each)]
    assert len(kinds) == 21 and all(name.endswith("Options") for name in kinds)


@pytest.mark.parametrize("refused", [
    lambda: RUN.plot(colr="feed"), lambda: RUN.save("a.png", colr="feed"), lambda: RUN.workpiece(step=1.0).save("a.png", colr=1),
    lambda: RUN.plot_compensation(colr=1), lambda: mnc.plot_runs(RUN, colr="feed"), lambda: RUN.save("a.csv", colr=1),
    lambda: RUN.plot(title=5), lambda: RUN.profile().plot(colr=1), lambda: RUN.report("a.html", colr=1),
])  # fmt: skip
def test_what_is_no_option_is_refused_by_its_name(refused, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(mnc.Alarm, match="colr|title must be a text"):
        refused()
    assert not [*tmp_path.iterdir()]
