"""The curves of a profile: what lasts no time is not drawn as an acceleration."""

import numpy as np

import mnclab
from mnclab.show.plot.profile import curve


def test_a_constant_cutting_speed_has_no_slab_of_accelerations():
    """Facing at a constant surface speed: the feed grows smoothly, and no point between its ends jumps to the limit."""
    text = "M3\nT1\nG96 S150 F0.2\nG00 X60 Z3\nG01 Z0\nG01 X5\nG00 Z3\n"
    run = mnclab.run(text, "jnc-t01", mnclab.Setup(start=(80, 0, 20), stock=mnclab.cylinder(radius=60, low=-40, high=1)))
    profile = run.profile()
    drawn, lasts = curve(profile, "time"), np.diff(profile.pieces.t)
    brief = lasts[drawn.piece] <= 1e-4
    assert (np.diff(drawn.t) >= 0).all() and np.isfinite(drawn.a).all()
    assert not (brief & (np.abs(drawn.a) > np.abs(profile.pieces.a[lasts > 1e-4]).max() + 1e-9)).any()
    jumps = np.count_nonzero(np.diff(np.sign(drawn.a[~brief])))
    assert np.count_nonzero(np.diff(np.sign(drawn.a))) <= jumps + 2
