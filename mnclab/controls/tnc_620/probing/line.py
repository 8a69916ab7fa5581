"""The angle of a line through two places, cycles 1410 and 1411 (TNC 620, 14.4, 14.5): Q964, Q965, Q994, Q995."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.probing import aimed, taken_over
from mnclab.controls.tnc_620.probing.aimed import Floats, Found, Judged
from mnclab.controls.tnc_620.probing.cycle import needed, numbers
from mnclab.controls.tnc_620.state import active_preset
from mnclab.geometry import frames
from mnclab.machine.machine import Machine
from mnclab.machine.rotary import angles
from mnclab.machine.setup import Datum
from mnclab.machining.probing import fits
from mnclab.machining.steps import Measure, Step


def no_line(c: Any, m: Machine) -> Iterator[Fault]:
    """Two nominal places that coincide in the plane."""
    (x, y, _), (x_2, y_2, _) = (tuple(each.mean for each in axes) for axes in aimed.nominals(c, m))
    if None not in (x, y, x_2, y_2) and (x, y) == (x_2, y_2):
        yield "second_point_ref_axis", "and the minor axis give the first place again: two places make a line"


def line_results(
    c: Any, m: Machine, found: Sequence[Found], nominal: Floats, judged: Sequence[Judged], diameters: Mapping[int, float]
) -> Iterator[Step]:
    """Results, the status, and what they make of the preset; `diameters` are further results by number."""
    is_ = needed(taken_over.angle, *(one.point for one in found), m=m, code=c.code)
    by = fits.reduced(is_ - needed(taken_over.angle, *nominal, m=m, code=c.code), 360)
    table = is_ + m.tables.presets.get(active_preset(m), Datum()).rotation + angles(m)[2]
    yield Measure("rotation", by, 0.0, unit="deg", touches=numbers([each for one in found for each in one.contacts]))
    yield from aimed.report(c, m, found, nominal, judged, {964: is_, 965: table, 994: by, 995: by}, diameters)
    turned = frames.turn(math.radians(by))[:3, :3]
    yield from taken_over.take_over(c, m, found, nominal, turned, by)
