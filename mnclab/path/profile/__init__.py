"""Feed-rate profiles: from a path and the limits of a machine to time, speed and acceleration."""

from mnclab.path.profile.profile import CAUSES, Instant, Profile
from mnclab.path.profile.timing import PlannedRows, plan

__all__ = ["CAUSES", "Instant", "PlannedRows", "Profile", "plan"]
