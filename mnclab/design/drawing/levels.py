"""The level sections of a part that its views ask for, each worked out once."""

from __future__ import annotations

from dataclasses import dataclass, field

from mnclab.design.model.slabs import Slab, Stack
from mnclab.geometry.regions import Region


@dataclass(frozen=True, eq=False)
class Levels:
    """A stack of slabs; `nested` where no section has material above that a lower one lacks."""

    stack: Stack
    nested: bool = False
    known: dict[tuple[int, float], Region] = field(default_factory=dict)

    @property
    def slabs(self) -> tuple[Slab, ...]:
        return self.stack.slabs

    def section(self, slab: Slab, z: float) -> Region:
        if not slab.slants:
            return slab.region
        key = id(slab), z
        if key not in self.known:
            self.known[key] = slab.section(z)
        return self.known[key]
