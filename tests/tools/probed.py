"""What tests of probing cycles share: whether the positioning of a run went through the part."""

import numpy as np

from mnclab import Kind


def gaps(run, part, ball, samples=60):
    """The smallest signed distance of the ball's surface from the part along each row that positions, mm.

    `part` is in machine coordinates, the ball stands above the tip; touches are left out.
    """
    path = run.toolpath.motion
    found = []
    for row in path:
        if row.kind == Kind.PROBE:
            continue
        if row.kind == Kind.ARC:
            along = np.array([path_point(row, share) for share in np.linspace(0, 1, samples)])
        else:
            along = row.start + (row.end - row.start) * np.linspace(0, 1, samples)[:, None]
        centres = along + np.array(path.origin) + (0, 0, ball)
        found.append(float(part(centres).min()) - ball)
    return np.array(found)


def path_point(row, share):
    """A place on an arc of the plane XY."""
    spoke = row.start - row.centre
    turn = row.sweep * share
    cos, sin = np.cos(turn), np.sin(turn)
    x, y, z = spoke
    return row.centre + (x * cos - y * sin, x * sin + y * cos, z + (row.end[2] - row.start[2]) * share)
