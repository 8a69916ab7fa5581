"""The features of a turned part, by their names in files."""

from mnclab.design.model.turned_feature import TurnedFeature
from mnclab.design.model.turned_grooves import FaceGroove, RingGroove
from mnclab.design.model.turned_holes import CENTRES, Bore, CentreHole
from mnclab.design.model.turned_threads import Thread, Undercut

__all__ = [
    "CENTRES", "TURNED_FEATURES", "Bore", "CentreHole", "FaceGroove", "RingGroove", "Thread", "TurnedFeature", "Undercut",
]  # fmt: skip

TURNED_FEATURES: dict[str, type[TurnedFeature]] = {
    each.kind: each for each in (Bore, CentreHole, RingGroove, FaceGroove, Undercut, Thread)
}
