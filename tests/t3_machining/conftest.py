"""What the tests of strategies at a hole share: the points that a list of steps visits."""

import math

import pytest

from mnclab.machining.steps import Go, Thread, Turn


@pytest.fixture(scope="session")
def trace():
    """Each step with the point (x, y, z) where it ends, from the axis at a level; turns by plain trigonometry."""

    def follow(steps, z=0.0):
        x = y = 0.0
        found = []
        for step in steps:
            if isinstance(step, Go):
                x, y = (x if step.x is None else step.x), (y if step.y is None else step.y)
            if isinstance(step, Turn):
                radius, at = (
                    math.hypot(x - step.centre[0], y - step.centre[1]),
                    math.atan2(y - step.centre[1], x - step.centre[0]),
                )
                x = step.centre[0] + radius * math.cos(at + step.angle)
                y = step.centre[1] + radius * math.sin(at + step.angle)
            if isinstance(step, Go | Thread | Turn) and step.z is not None:
                z = step.z
            found.append((step, (x, y, z)))
        return found

    return follow
