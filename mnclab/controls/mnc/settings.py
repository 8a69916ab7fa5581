"""The settings of the MNC: where its manual leaves two readings open, the one that a machine may need.

The default is the reading that is adopted; its name (MNC-…) stands in the column of sources. `peck_clearance` belongs
to the cycles, `block_skip` is a switch of the operator's panel, `bulk` is about speed alone.
"""

from __future__ import annotations

from mnclab.controls.mnc.probing import tool_setting
from mnclab.machine.control import Setting, one_of
from mnclab.path.limits import RAPIDS

REMARKS = {"warn": "allowed, with a warning", "accept": "allowed, without a word", "refuse": "an alarm"}
M_CODES = "M0 M1 M2 M6 M7 M8 M9 M30, which the manual does not list"


def _power_on(name: str, meaning: str, **choices: str) -> Setting:
    """The function of a group that is active at power-on: by default the first."""
    return one_of(f"power_on_{name}", f"{meaning} at power-on", "MNC-POWERON", **choices)


PROGRAM = (
    Setting("block_skip", False, "operator mode: blocks with / are passed over", "1.5"),
    _power_on("motion", "motion function", G0="rapid", G1="line; it needs a feed"),
    _power_on("plane", "plane", G17="XY", G18="ZX", G19="YZ"),
    _power_on("dimension", "dimensions", G90="absolute", G91="incremental"),
    _power_on("blending", "block transitions", G64="blended", G61="exact stop"),
    _power_on("feed", "meaning of F", G94="mm/min", G95="mm/rev"),
    _power_on("return", "return of G83 to G85", G98="to the initial level", G99="to level R"),
    one_of("unlisted_m", M_CODES, "MNC-PROG-END", **REMARKS),
)

MOTION = (
    Setting("arc_tolerance", 0.01, "difference of the radii at start and end of an arc", "MNC-ARC-TOL", {}, "mm", 0),
    one_of("arc_by_both", "R and I J K in one block", "MNC-ARC-RIJK",
           radius="R counts, with a warning", centre="I J K count, with a warning", refuse="an alarm"),
    one_of("helix", "a word of the third axis in an arc block", "MNC-HELIX, MNC-POLAR-THIRD", **REMARKS),
    one_of("rapid_path", "the path of a rapid along several axes", "MNC-G0-PATH",
           straight="a straight line", broken="each axis at its own rapid speed until it arrives"),
    Setting("rapid_motion", "axes", "how a rapid goes, for profiles and times", "3.1", RAPIDS),
    one_of("g18_axes", "order of the axes of G18: arcs, polar angles, rotation and sides turn over", "MNC-G18-ORDER",
           ZX="G3 turns from +Z to +X", XZ="G3 turns from +X to +Z"),
)  # fmt: skip

COORDINATES = (
    Setting("datum_rows", 6, "rows of the datum table that exist, as zeros, without being listed", "MNC-DATUM-ROWS", at_least=6),
    one_of("transformation_order", "order of scaling, mirror image and rotation", "MNC-XFORM-ORDER",
           fixed="a point is scaled, mirrored, turned, whatever the order of programming",
           nested="each counts in the system that is active when it is programmed"),
    one_of("switch_keeps", "what G36 to G39, G50 and G51 leave as it was", "MNC-XFORM-SWITCH, MNC-G39-START",
           programmed="the programmed coordinates: an axis that is not written may move with the next motion",
           tip="the place of the tool: its coordinates are read anew, as after a work offset"),
    one_of("g37_omitted", "factor of an axis that a G37 does not name", "MNC-G37-OMIT",
           one="1", kept="what an earlier G37 gave it"),
    Setting("g53_transformed", True, "scaling, mirror image and rotation act in a block with G53", "MNC-G53-KEEP"),
    Setting("g53_tool_length", True, "the tool length acts in a block with G53: Z is the tip", "MNC-G53-KEEP"),
    one_of("g92_increment", "U V W of G92", "MNC-G92-U",
           subtract="new coordinate = old - U: the origin moves by +U", add="new coordinate = old + U"),
    one_of("g16_pole", "the pole of G16 under G91", "MNC-G16-ABS",
           absolute="from the origin, as under G90", incremental="from the last programmed point"),
    one_of("polar_arc", "which of the two arcs of G12, G13 K is meant", "MNC-G12-K",
           pole="the one about the pole if it fits; else as by sign",
           sign="K > 0 below 180 degrees, K < 0 above, as R of G2 and G3"),
    one_of("polar_arc_without_k", "G12, G13 without K", "MNC-G12-NOK",
           line="a straight line, as G2 and G3 without a centre", pole="an arc about the pole"),
)  # fmt: skip

TECHNOLOGY = (
    one_of("gouge", "what happens where a compensated tool does not fit", "MNC-CRC-GOUGE",
           refuse="an alarm, before the tool goes there", mark="it cuts anyway: marked rows and warnings"),
    one_of("outside_corners", "how outside corners are joined, to compare", "6.4",
           programmed="as the program says",
           G160="arc, whatever the program says",
           G161="straight, whatever the program says",
           G162="arc at acute corners only, whatever the program says"),
    one_of("feed_mode_switch", "the feed when G94 and G95 change", "MNC-G95-SWITCH",
           kept="the number of F stays and is read anew",
           converted="the speed stays while the spindle turns; else as cleared",
           cleared="F must be written again"),
    one_of("tool_change", "what puts a tool into the spindle", "MNC-T-CHANGE",
           T="T itself; M6 does nothing", M6="M6, the one that T selected"),
    Setting("corrector_length", False, "D takes the length of its row too, not the corrections and radius alone", "MNC-D"),
    Setting("spindle_run_up", 0.0, "wait for the spindle at a new speed under G26", "MNC-G26-TIME", {}, "s", 0),
    one_of("spindle_stop", "when M5 acts", "MNC-M-ORDER, MNC-BLOCK-ORDER",
           after="after the motion of its block", before="before it"),
    Setting("peck_clearance", 1.0, "above the last depth to which G83 returns at rapid", "MNC-G83-CLEARANCE", {}, "mm", 0),
    Setting("bulk", True, "obey long runs of plain blocks at once"),
)  # fmt: skip

PROBING = (
    one_of("corner_spacing", "where points 2 and 4 of G414 lie", "MNC-G414-SPACING",
           positive="towards positive coordinates", away="away from the corner"),
    Setting("measurements_per_point", 1, "how often G499 touches; it takes the mean", "12.21", at_least=1, at_most=1000),
    one_of("g491_l2_plane", "plane of the angle of G491 L2", "MNC-G491-PLANE",
           YZ="from +Y towards +Z", XY="from +Y counter-clockwise in XY"),
    one_of("raw_z", "Z of G491 and G492", "MNC-G492-RAW",
           tip="of the south pole by the length of the table, without its correction", reference="of the spindle reference"),
)  # fmt: skip

SETTINGS = PROGRAM + MOTION + COORDINATES + TECHNOLOGY + PROBING + tool_setting.SETTINGS
