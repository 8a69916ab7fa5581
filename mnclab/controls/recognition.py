"""Which control a program is for: signs are weighed, and none is chosen where two weigh about the same."""

from __future__ import annotations

from pathlib import PurePath
from typing import NamedTuple

from mnclab.controls import Controls
from mnclab.machine.control import Control
from mnclab.text.alarm import Alarm
from mnclab.text.dialect import Finding, Sign, code_of, found, sign

# Signs of programs that none of the controls here reads, so that they are called by their names.

#: What a text looks like -> the signs of it; the name stands behind "this looks like".
FOREIGN: dict[str, tuple[Sign, ...]] = {
    "a SINUMERIK program": (
        sign(
            r"\b(?:CYCLE\d{2,4}|POCKET\d|HOLES\d|SLOT\d|LONGHOLE|WORKPIECE)[ \t]*\(",
            20, "a cycle with a list of values", 2,
        ),
        sign(r"\bMCALL\b", 20, "a modal call"),
        sign(r"^[ \t]*(?:N\d+ )?(?:DEF[ \t]+(?:REAL|INT|BOOL|CHAR|STRING|AXIS|FRAME)|PROC |EXTERN )", 20, "a declaration"),
        sign(r"%_N_\w+", 20, "the head of a file in transfer", whole=True),
        sign(r"^;\$PATH=", 20, "the path of a file in transfer", whole=True),
        sign(r"[A-Z]=[IAD](?:C|CP|CN)[ \t]*\(", 15, "a coordinate with its own dimensioning"),
        sign(r"\bMSG[ \t]*\([ \t]*\"", 15, "a message", whole=True),
        sign(r"\bT[ \t]*=[ \t]*\"", 15, "the name of a tool", whole=True),
        sign(r"\bCR[ \t]*=", 12, "the radius of an arc"),
        sign(r"\b(?:TRANS|ATRANS|ROT|AROT|MIRROR|AMIRROR|SCALE|ASCALE)[ \t]+[XYZ]", 12, "a frame", 2),
        sign(
            r"\b(?:STOPRE|SUPA|TRAORI|TRAFOOF|GOTO[FB]|SETMS|DIAM(?:ON|OF|90)|ORI(?:WKS|MKS)|COMP(?:CAD|CURV|OF)|FFW(?:ON|OF)"
            r"|EXTCALL|LIMS[ \t]*=|ENDFOR|CUT2D|CUT3D\w*|SOFT|BRISK|KONT|NORM)\b", 8, "a word of this control", 3,
        ),
        sign(r"^[ \t]*(?:N\d+[ \t]*)?R\d{1,3}[ \t]*=", 8, "a value for an R parameter", 2),
        sign(r"\bS\d[ \t]*=[ \t]*\d|\bM\d=\d", 6, "a spindle by its number"),
    ),
    "an OKUMA program": (
        sign(r"^\$[\w-]+(?:\.\w+)?%", 20, "the head of a file"),
        sign(r"\bCALL[ \t]+O[A-Z0-9]+", 15, "a call by name"),
        sign(r"\b(?:VC\d+|VZOF[XYZ]|VTOF\w*|VETF\w*)[ \t]*[=\[]", 15, "a variable by name", 2),
        sign(r"\b(?:NLAP|NOEX|NAT\d+)", 12, "a word of this control", 2),
        sign(r"(?<![A-Z])G15[ \t]+H\d", 8, "a work coordinate system"),
        sign(r"(?<![A-Z])G56[ \t]+H\d|(?<![A-Z])G116[ \t]+T", 8, "a tool by its number"),
        sign(r"\bGOTO[ \t]+N[A-Z]", 8, "a jump to a name"),
        sign(r"^[ \t]*N[A-Z]{2}\w*[ \t]", 6, "a name of a block"),
    ),
    "a FAGOR program": (
        sign(r"^%[^,\r\n]{1,40},[MX-]{2,3},", 20, "the head of a program"),
        sign(
            r"\((?:RPT|CALL|PCALL|MCALL|SUB|RET|GOTO|IF|TRACE|P\d+)[ \t]*[=N\d(P]",
            12, "a statement in brackets", 2, whole=True,
        ),
        sign(r"^#(?:CALL|PCALL|MCALL|TOOL|RPT|PATH|HSC|TCPC)\b", 15, "a statement"),
        sign(r"\bP\d+[ \t]*=[ \t]*P\d+[ \t]*F\d", 12, "an operation on parameters"),
    ),
    "a MAHO or Philips program": (
        sign(r"^%[PM]M\d*", 20, "the head of a memory"),
        sign(
            r"^[ \t]*(?:N\d+[ \t]+)?G9[89][ \t]+X\S+[ \t]+Y\S+[ \t]+Z\S+[ \t]+I\S+[ \t]+J",
            15, "a window or a blank for the graphics",
        ),
        sign(r"^[ \t]*(?:N\d+[ \t]+)?E\d+[ \t]*=", 8, "a value for an E parameter"),
        sign(r"(?<![A-Z])G18[ \t]+S\d+[ \t]+T\d+[ \t]+M6?6\b", 8, "plane, speed and tool in one block"),
    ),
    "a lathe program of the FANUC kind": (
        sign(r"(?<![A-Z])G50[ \t]*S\d", 6, "the greatest spindle speed"),
        sign(r"(?<![A-Z])G7[0-3][ \t]*P\d+[ \t]*Q\d", 8, "a cycle with the first and last block of a contour"),
        sign(r"(?<![A-Z])G7[1-3][ \t]*[UW][\d.]+[ \t]*R", 6, "depth of cut and retract"),
        sign(r"(?<![A-Z])G76[ \t]*P\d{6}", 8, "a thread cycle"),
        sign(r"(?<![A-Z])G28[ \t]*(?:G0?0[ \t]*)?[UW]", 6, "the reference point, by U and W"),
        sign(r"(?<![A-Z])G92[ \t]*X[^\n]*Z[^\n]*F", 3, "a thread cycle"),
        sign(r"(?<![A-Z])T\d{4}(?!\d)", 3, "tool and offset in four digits"),
        sign(r"(?<![A-Z])G96\b[^\n]*S", 2.5, "a constant cutting speed"),
        sign(r"^(?![^\n]*(?<![A-Z])G7)[^\n]*\b[UW]-?[\d.]", 2, "increments U, W"),
        sign(
            r"\A(?=[\s\S]*(?<![A-Z])G[ \t]*\d)(?=[\s\S]*X[ \t]*[-+.\d])(?=[\s\S]*Z[ \t]*[-+.\d])(?![\s\S]*Y[ \t]*[-+.\d#\[])",
            2.5, "positions of X and Z, and no Y",
        ),
        sign(r"^[ \t]*[O:]\d+|^%[ \t]*$", 0.8, "the head of a program"),
        sign(r"\(", 0.5, "comments in brackets"),
        sign(
            r"(?<![A-Z])G4[39][ \t]*H|(?<![A-Z])M0?6(?!\d)|(?<![A-Z])G17(?!\d)|(?<![A-Z])G8[1-36-9](?!\d)[^\n]*X",
            -5, "words of mills",
        ),
        sign(r"'", -6, "comments behind apostrophes"),
    ),
    "a program of a 3D printer": (
        sign(r"(?<![A-Z])M10[49][ \t]*S\d|(?<![A-Z])M1[49]0[ \t]*S\d", 12, "a temperature"),
        sign(r"(?<![A-Z])G[01]\b[^\n]*E-?[\d.]", 5, "a filament that moves", 3),
        sign(r"(?<![A-Z])G92[ \t]+E0", 4, "a filament that is set to zero"),
        sign(r"^;(?:LAYER|TYPE|FLAVOR|MESH)\b", 10, "a remark of a slicer", whole=True),
    ),
    "an HPGL drawing": (
        sign(r"\A\s*(?:\x1b[^\n]{0,40})?IN;", 15, "the beginning of a drawing", whole=True),
        sign(r"\bP[UD](?:-?\d+,-?\d+,?){0,99};", 8, "the pen up or down", 2, whole=True),
    ),
    "an APT source or CLDATA": (
        sign(r"^[ \t]*(?:GOTO|LOADTL|FEDRAT|SPINDL|PARTNO|CUTTER|MULTAX|GODLTA)[ \t]*/", 10, "a statement", 2),
    ),
    "a drawing or a model": (
        sign(r"\A\s*0\s+SECTION", 25, "the head of a DXF file", whole=True),
        sign(r"\AISO-10303-21", 25, "the head of a STEP file", whole=True),
        sign(r"\Asolid\b[^\n]*\n\s*facet", 25, "the head of an STL file", whole=True),
    ),
    "source code or a page": (
        sign(r"^[ \t]*#[ \t]*(?:include|define|ifn?def|pragma|endif)\b", 12, "an instruction to a compiler", 2, whole=True),
        sign(
            r"^(?-i:import|from|def|class|module|function|package|using|public)[ \t][^\n]*[({:;.\w]$",
            12, "a line of source code", 2, whole=True,
        ),
        sign(r"^[ \t]*(?-i:const|static|void|int|char|struct|let|var) [^\n]*[=;({\[]", 20, "a declaration", 2, whole=True),
        sign(r"^[^\n;(]*[{}][ \t;]*$", 4, "a brace", 3, whole=True),
        sign(r"\A\s*<[?!A-Z]", 25, "a tag", whole=True),
        sign(r"\A\s*[{\[]\s*[\"\[{]", 20, "JSON", whole=True),
    ),
}  # fmt: skip
#: Suffixes of files that say a little: what the text looks like then, and how much.
SUFFIXES = {
    ".mpf": ("a SINUMERIK program", 6), ".spf": ("a SINUMERIK program", 6), ".arc": ("a SINUMERIK program", 6),
    ".min": ("an OKUMA program", 4), ".pim": ("a FAGOR program", 4), ".plt": ("an HPGL drawing", 4),
    ".hpgl": ("an HPGL drawing", 6), ".gcode": ("a program of a 3D printer", 1), ".dxf": ("a drawing or a model", 6),
}  # fmt: skip


# Each control declares its signs, and `foreign` those of programs that no control here reads. A suffix that only one control
# uses decides by itself; those that many makers share say little.

LOOKED_AT = 20_000  # characters of a program that tell its control
LEAST = 2.0  # what the signs of a control must weigh
AHEAD, SHARE = 1.0, 0.2  # by how much more than those of the next: so much, and so much of the whole
CLEARLY = 5.0  # more than the control that was named, which has signs too, before another is thought of
TOLD = 3  # findings that an alarm tells of each
#: Suffixes of a control that others use too, and what they weigh.
SHARED = {".h": 4.0, ".i": 4.0, ".iso": 4.0}
BINARY = 0.02  # share of characters that no text has


class Candidate(NamedTuple):
    """A control, or what else a text looks like, and what speaks for and against it."""

    name: str
    findings: list[Finding]
    foreign: bool = False

    @property
    def weight(self) -> float:
        return sum(finding.weight for finding in self.findings)

    @property
    def described(self) -> str:
        return self.name if self.foreign else f"a program of {self.name}"

    def reasons(self) -> str:
        """The weightiest findings that speak for it."""
        best = sorted((one for one in self.findings if one.weight > 0), key=lambda one: -one.weight)
        return ", ".join(map(str, best[:TOLD]))


def is_binary(text: str) -> bool:
    """Whether a text has characters that no text has: NUL, or many control characters and replaced bytes."""
    head = text[:LOOKED_AT]
    strange = sum(head.count(c) for c in map(chr, (*range(1, 9), *range(14, 27), 28, 29, 30, 31, 0xFFFD)))
    return "\0" in head.rstrip("\0") or strange > max(2.0, BINARY * len(head))


def candidates(name: str, text: str, controls: Controls) -> list[Candidate]:
    """Whatever has signs in a text or the suffix of its file, the weightiest first."""
    head = text[:LOOKED_AT].replace("\r\n", "\n").replace("\r", "\n").removeprefix("\ufeff")
    if len(text) > LOOKED_AT:  # whole lines
        head = head[: head.rfind("\n") + 1] or head
    code, suffix = code_of(head), PurePath(name).suffix.lower()
    known = list(controls.signed())
    of_suffix = {one.name: SHARED[suffix] for one in known if suffix in one.suffixes and suffix in SHARED}
    of_suffix |= dict([SUFFIXES[suffix]]) if suffix in SUFFIXES else {}
    listed = [(one.name, one.signs, False) for one in known]
    listed += [(name, signs, True) for name, signs in FOREIGN.items()]
    made = []
    for name, signs, foreign in listed:
        findings = found(signs, head, code)
        if name in of_suffix:
            findings.append(Finding(of_suffix[name], f"the suffix {suffix}", 0, ""))
        made.append(Candidate(name, findings, foreign))
    return sorted((one for one in made if one.weight > 0), key=lambda one: -one.weight)


def leading(ranked: list[Candidate]) -> list[Candidate]:
    """Those between which nobody can decide: one where it is clear, none where nothing says enough."""
    if not ranked or ranked[0].weight < LEAST:
        return []
    best = ranked[0].weight
    return [one for one in ranked if one.weight > best - max(AHEAD, SHARE * best) or one is ranked[0]]


def recognise(name: str, text: str, controls: Controls) -> Control:
    """The control that a program is for; an Alarm says what else it looks like, or between which it cannot be decided."""
    suffix = PurePath(name).suffix.lower()
    by_suffix = [one.name for one in controls.signed() if suffix and suffix in one.suffixes and suffix not in SHARED]
    if len(by_suffix) == 1:
        return controls[by_suffix[0]]
    choose = f"control= one of {', '.join(controls)}"
    if is_binary(text):
        hint = f"Mazatrol and other programs of menus are no text; {choose} reads it all the same"
        raise Alarm("this is a binary file, and no part program in letters and numbers", hint=hint)
    fitting = leading(candidates(name, text, controls))
    if not fitting:
        hint = choose if text.strip() else f"the text is empty; {choose}"
        raise Alarm("nothing in the text or the file's name says which control it is for: name it", hint=hint)
    if all(one.foreign for one in fitting):
        kinds = " or ".join(one.name for one in fitting)
        why = "; ".join(one.reasons() for one in fitting)
        hint = f"{why}; {choose} reads it all the same"
        raise Alarm(f"this looks like {kinds}, which is none of mnclab's controls", hint=hint)
    if len(fitting) > 1:
        why = "; ".join(f"{one.name}: {one.reasons()}" for one in fitting)
        first = next(one.name for one in fitting if not one.foreign)
        said = " or ".join(one.described for one in fitting)
        raise Alarm(f"this may be {said}: name the control", hint=f'{why}; control="{first}" chooses')
    return controls[fitting[0].name]


def looks_like(text: str, controls: Controls, read_as: str = "") -> str:
    """What a text plainly looks like, in words: "a program of mnc", "a SINUMERIK program"; empty where that is not plain, or
    where it has signs of the control that it was `read_as` too: two ISO mills share most words, and a slip is a slip."""
    ranked = candidates("", text, controls)
    fitting = leading(ranked)
    own = max((one.weight for one in ranked if one.name == read_as), default=-CLEARLY)
    return fitting[0].described if len(fitting) == 1 and fitting[0].weight - own > CLEARLY else ""
