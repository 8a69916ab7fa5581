"""What a part has that its drawing has not: taper, bow, roughness, a burr.

A ball finds an error as large as it is at its centre. Errors are given in the axes in which the part stands when they are
given, and go with it where it is placed, turned and shifted afterwards.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from mnclab.geometry.regions import less
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, choice, whole
from mnclab.workpiece.part.part import Distance, Floats, Part
from mnclab.workpiece.part.prisms import Joint, Prism, Prisms

WAVES = 8  # that make up a rough surface
STEEPEST = 0.5  # of the errors of a part: mm for each mm along it
BOWED = {a + b: ("xyz".index(a), "xyz".index(b)) for a in "xyz" for b in "xyz" if a != b}


def with_errors(
    part: Part, *, taper: float = 0.0, bow: float = 0.0, bowed: str = "xy", roughness: float = 0.0, grain: float = 5.0,
    seed: int = 0, burr: tuple[float, float] | None = None,
) -> Part:  # fmt: skip
    """The same part as it came out.

    `taper`: degrees by which upright walls lean, true at the top and material standing out below; less than 0 the other way.
    `bow`: mm by which the part is bent in the middle of its length: "xy" along X, the middle towards +Y.
    `roughness`: mm by which the surface stands out or lies deep at most, in waves `grain` mm long, others for each `seed`.
    `burr`: height and width, mm, of the ridge along all edges of the top, those of holes too.
    """
    check_number(taper, "the taper of a part (degrees)", at_least=-45, at_most=45)
    check_number(bow, "the bow of a part (mm)")
    check_number(roughness, "the roughness of a part (mm)", at_least=0)
    check_number(grain, "the length of the waves of a rough part (mm)", above=0)
    if whole(seed, "the seed of a rough part") < 0:
        raise Alarm(f"the seed of a rough part must be at least 0, got {seed}")
    if burr is not None:
        part = _burred(part, burr)
    if taper:
        body = _prisms(part, "a taper")
        wide = abs(np.tan(np.radians(taper))) * (part.bounds[1, 2] - part.bounds[0, 2]) * np.array([1.0, 1.0, 0.0])
        bounds = part.bounds + np.array([-wide, wide])
        part = replace(part, distance=replace(body, taper=float(np.tan(np.radians(taper)))), bounds=bounds, bound=None)
    if bow:
        along, out = BOWED[choice(bowed, "how a part is bowed", BOWED)]
        low, high = part.bounds[:, along].tolist()
        if not np.isfinite(high - low):
            raise Alarm("a part without ends cannot be bowed")
        way = bow * np.eye(3)[out]
        distance: Distance = partial(_bowed, part.distance, along, (low + high) / 2, (high - low) / 2, way)
        part = _steeper(part, distance, abs(bow), 4 * abs(bow) / (high - low))
    if roughness:
        rng = np.random.default_rng(int(seed))
        waves = rng.normal(size=(WAVES, 3))
        waves *= 2 * np.pi / grain / np.linalg.norm(waves, axis=1)[:, None]
        rough = partial(_rough, part.distance, waves, rng.uniform(0, 2 * np.pi, WAVES), roughness)
        part = _steeper(part, rough, roughness, 2 * np.pi * roughness / grain)
    return part


def _steeper(part: Part, distance: Distance, by: float, more: float) -> Part:
    """A part with an error of at most `by` mm, which changes by `more` mm for each mm."""
    if more > STEEPEST:
        raise Alarm(f"an error of {by:g} mm is too steep for this part", hint="make it smaller, or longer")
    return replace(part, distance=distance, bounds=part.bounds + np.array([[-by], [by]]), steep=part.steep + more, bound=None)


def _prisms(part: Part, what: str) -> Prisms:
    body = part.distance
    if not isinstance(body, Prisms) or body.taper or not np.isfinite(body.top):
        raise Alarm(f"{what} is for parts of upright prisms with a top, before other errors, got {part.name}")
    return body


def _burred(part: Part, burr: tuple[float, float]) -> Part:
    check_point(burr, "a burr, its height and width (mm)", flat=True)
    height, width = burr
    check_number(height, "the height of a burr", above=0)
    check_number(width, "the width of a burr", above=0)
    body = _prisms(part, "a burr")
    face = body.solid[-1].region
    ridge = Prism(less(face, [face.inset(float(width))]), body.top, body.top + float(height))
    own = replace(body, body=Joint("|", (body.body, ridge)))
    bounds = part.bounds + np.array([[-1.0], [1.0]]) * height * np.abs(body.placing[:3, 2])
    return replace(part, distance=own, bound=None, bounds=bounds)


# Distances of points p (n, 3).


def _bowed(distance: Distance, along: int, middle: float, half: float, way: Floats, p: Floats) -> Floats:
    share = np.clip((p[:, along, None] - middle) / half, -1.0, 1.0)
    return distance(p - way * (1 - share**2))


def _rough(distance: Distance, waves: Floats, phases: Floats, height: float, p: Floats) -> Floats:
    return np.asarray(distance(p) - height * np.sin(p @ waves.T + phases).mean(axis=1))
