"""Feed-rate profiles: from a path and the limits of a machine to time, speed and acceleration."""

from mnclab.path.profile.look_ahead import Plan, plan
from mnclab.path.profile.profile import CAUSES, Instant, Profile

__all__ = ["CAUSES", "Instant", "Plan", "Profile", "plan"]
