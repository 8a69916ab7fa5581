"""Doors of a run to pictures of one idea each; they hold no logic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mnclab.text.calls import fitting_class

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@fitting_class
class Pictures:
    """What a run shows beside its path."""

    def plot_depth(self, **options: Any) -> Figure:
        """Z over time: pecks, dwells and retractions of a hole, by `line`; see `mnclab.show.plot.over_time`."""
        from mnclab.show.plot.over_time import plot_depth

        return plot_depth(self, **options)

    def plot_datums(self, **options: Any) -> Figure:
        """Machine zero and the zero points of the program as vectors from it; see `mnclab.show.plot.set_up`."""
        from mnclab.show.plot.set_up import plot_datums

        return plot_datums(self, **options)

    def plot_face(self, **options: Any) -> Figure:
        """The spirals that a lathe cuts in a face, seen from the tailstock; see `mnclab.show.plot.face`."""
        from mnclab.show.plot.face import plot_face

        return plot_face(self, **options)

    def plot_lengths(self, line: int, **options: Any) -> Figure:
        """Spindle nose, tool and tip with their heights after a line: a wrong length offset is seen; see
        `mnclab.show.plot.lengths`."""
        from mnclab.show.plot.lengths import plot_lengths

        return plot_lengths(self, line, **options)
