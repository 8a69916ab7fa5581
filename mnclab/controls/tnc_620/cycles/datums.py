"""Datums: cycle 7 with values or with a row of a datum table, cycle 247 with a row of the preset table (11.2 to 11.4)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from mnclab.controls.tnc_620.cycles import chain
from mnclab.controls.tnc_620.cycles.addresses import coordinate, count
from mnclab.controls.tnc_620.tables.datum_tables import row_of
from mnclab.geometry import frames
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.machining.steps import Step, Write
from mnclab.text.program import Word

CYCLES = CycleTable()
AXES = "xyzabc"


linear = partial(coordinate, default=None, default_means="as it is")
rotary = partial(linear, unit="deg")


@CYCLES("CYCL DEF 7", "Datum shift", runs="definition", source="11.2")
class DatumShift(Cycle):
    """Moves the datum; IX counts from the shift that was valid before, an axis that is not named keeps its shift.

    `#5` takes the shift from a row of the active datum table; an empty field there leaves its axis as it is.
    """

    x: float | None = linear("X", "datum shift along X")
    y: float | None = linear("Y", "datum shift along Y")
    z: float | None = linear("Z", "datum shift along Z")
    a: float | None = rotary("A", "datum shift of A")
    b: float | None = rotary("B", "datum shift of B")
    c: float | None = rotary("C", "datum shift of C")
    datum_number: float | None = count(
        "#", "row of the datum table", at_most=9999, default=None, default_means="the shift is written"
    )

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        for name, before in zip(AXES, (*chain.shift_of(m), *chain.rotary(m)[0]), strict=True):
            if name in given and given[name].incremental:
                values[name] += before
        return values

    @property
    def written(self) -> dict[str, float]:
        """The axes that are named, with their values."""
        return {axis: value for axis in AXES if (value := getattr(self, axis)) is not None}

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        if not self.written and self.datum_number is None:
            yield "", "needs an axis, for example CYCL DEF 7.1 X+60"
        if self.written and self.datum_number is not None:
            yield "datum_number", "and shifts of axes cannot stand in one definition"
        elif self.datum_number is not None:
            try:
                row_of(m, int(self.datum_number))
            except LookupError as error:
                yield "datum_number", str(error.args[0])

    def moves(self, m: Machine) -> Iterator[Step]:
        new = self.written if self.datum_number is None else row_of(m, int(self.datum_number))
        x, y, z = (new.get(axis, before) for axis, before in zip("xyz", chain.shift_of(m), strict=True))
        turned = tuple(new.get(axis, before) for axis, before in zip("abc", chain.rotary(m)[0], strict=True))
        yield Write("memory", turned, "rotary_shift")
        yield from chain.define(m, chain.SHIFT, frames.shift(x, y, z) if (x, y, z) != (0, 0, 0) else None)


@CYCLES("CYCL DEF 247", "Presetting", runs="definition", source="11.4")
class Presetting(Cycle):
    """Makes a row of the preset table the datum of the program; cycles 7, 8, 10, 11 and 26 are over, a tilt stays."""

    preset_number: float = count("Q339", "number of the preset", at_most=65535, note="0: the one set by hand", example=0)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        row = int(self.preset_number)
        if row and row not in m.tables.presets:
            known = ", ".join(map(str, sorted(m.tables.presets))) or "none but 0"
            yield "preset_number", f"names row {row}, which the preset table does not have (rows: {known})"
        preset = m.tables.presets.get(row, Datum())
        if any((preset.a, preset.b, preset.c, preset.rotation)):
            yield "preset_number", f"names row {row}, which carries a rotation: that is not built yet"

    def moves(self, m: Machine) -> Iterator[Step]:
        row = int(self.preset_number)
        yield from chain.reset(m)
        yield Write("memory", row, "preset")
        yield Write("datum", m.tables.presets.get(row, Datum()), "preset")
