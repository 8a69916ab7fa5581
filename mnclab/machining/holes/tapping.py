"""Tapping as steps at a hole: spindle and feed locked, or a floating holder; a reversal at each end of the thread.

`sense` is +1 where the spindle cuts clockwise (M3, a right-hand thread), -1 counter-clockwise.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mnclab.machining.steps import Go, Orient, Spin, Step, Thread, Wait


def tap(
    levels: Sequence[float], *, above: float, sense: int, end: int, pitch: float = 0.0, feed: float | None = None,
    speed: float | None = None, out_speed: float | None = None, dwell: float = 0.0, dwell_first: bool = True,
    stand: float = 0.0, back: float = 0.0, angle: float | None = None,
) -> Iterator[Step]:  # fmt: skip
    """Cut to each of the `levels` and back: between two by `back` mm, or with 0 out of the hole to `above`.

    Without a `pitch` the holder floats and the axis runs at `feed`. `end` is what the spindle does afterwards:
    `sense` again, or 0. At the last level the spindle stands still for `stand` seconds, and `dwell` acts before the
    reversal or after it. `out_speed` is the spindle speed on the way out, `angle` where it is oriented before.
    """

    def travel(label: str, level: float) -> Step:
        return Thread(label, level, pitch) if pitch else Go(label, level, feed)

    if angle is not None:
        yield Orient(f"orient the spindle to {angle:g} degrees", angle)
    up = 1.0 if above > levels[-1] else -1.0
    for number, level in enumerate(levels, 1):
        last = number == len(levels)
        cut = "cut the thread" if len(levels) == 1 else f"cut the thread {number} of {len(levels)}"
        yield Spin("spindle on", sense, speed)
        yield travel(cut, level)
        if last and dwell_first:
            yield Wait("dwell at the bottom", dwell)
        if last and stand:
            yield Spin("stop the spindle", 0)
            yield Wait("wait for the spindle", stand)
        yield Spin("reverse the spindle", -sense, speed if out_speed is None else out_speed)
        if last and not dwell_first:
            yield Wait("dwell at the bottom", dwell)
        out = last or not back or back >= abs(above - level)
        yield travel("retract" if out else "break the chip", above if out else level + up * back)
    yield Spin("reverse the spindle" if end else "stop the spindle", end, speed)
