"""Examples, codes, parameters and open readings of manuals, copied from a catalogue: writes the files of catalogue/.

    python3 tests/authorities/extract_checks.py FOLDER

FOLDER holds the catalogue, one YAML file for each part of the manual. The tests read only the JSON files made here.
"""

import json
import re
import sys
from pathlib import Path

import yaml

HERE = Path(__file__).parent / "catalogue"

#: Entries whose examples are copied, by file; behind a blank, what more the name of the copy says.
#: A function that is built gets its entry here.
EXAMPLES = {
    "mnc-language": [
        *("words", "modal groups", "block execution", "G17", "G18", "G19", "G90", "G91", "G92", "G53"),
        *("G54", "G55", "G56", "G57", "G58", "G59", "polar coordinates", "G16", "G15", "G10", "G11", "G12", "G13"),
        *("G37", "G36", "G51", "G50", "G39", "G38", "G147", "G0", "G1", "G2", "G3", "arc by radius", "arc by centre"),
        *("G61", "G64", "G9", "F", "G94", "G95", "G4", "T", "tool length compensation", "cutter radius compensation"),
        *("G41", "G42", "CRC entry (table 7.1)", "CRC travel (table 7.2)", "G40", "CRC exit (table 7.3)"),
        *("S", "G26", "G25", "M word", "M3", "M4", "M5", "M99"),
    ],
    "mnc-drilling": [
        *("drilling cycles G83-G85", "G80", "G98", "G99", "G83", "G84", "G85", "prepared cycles", "G300", "G301"),
        *("G302", "G303", "G304", "G305", "G306", "G307", "G309"),
    ],
    "mnc-milling": ["G320", "G321", "G343", "G344"],
    "nc-31": [
        *("frame", "discretes", "G70", "G71", "G77", "G78", "contour exercise", "G73", "G72", "G74", "G75"),
        *("G31", "G32", "G33", "G25", "fragment N90-N111"),
    ],
    "mnc-probing": [
        *("G400", "G404", "G408", "G409", "G410", "G411", "G412", "G413", "G414", "G415", "G417", "G419"),
        *("G420", "G421", "G422", "G423", "G424", "G425", "G426", "G490", "G499", "G491", "G492", "G460", "G461", "G462"),
    ],
    "jnc-t01": [
        *("program structure", "table 2 notes", "axes and dimensions", "spindle control", "feed programming"),
        *("linear moves", "arc moves", "G00", "G01", "G02", "G03", "G04", "G12", "G14", "G32", "G73", "G74", "G75"),
        *("G77", "G78", "G90", "G91", "G92", "G93", "G94", "G95", "G96", "G97", "T+L"),
    ],
    "tnc620-klartext": [
        *("BLK FORM", "TOOL CALL", "L", "C", "CT", "CP", "CALL LBL", "CYCL DEF (formats)", "FN", "FK"),
        *("contour formula", "CONTOUR DEF", "PLANE SPATIAL"),
    ],
    "tnc620-contour-formula": [
        *("complex contour formula", "SEL CONTOUR", "DECLARE CONTOUR", "QC contour formula"),
        *("overlapping contours with contour formula", "CONTOUR DEF"),
    ],
    "tnc620-special": [
        *(f"CYCL DEF {number}" for number in (9, 12, 13, 18, 32, 225, 232, 239)),
        *("engraving layout", "engraving characters", "engraving system variables"),
    ],
    "tnc620-transformations": [
        *("transformation chain", "CYCL DEF 7", "CYCL DEF 7 (datum table)", "datum table", "PGM COTRANS (section 11.10)"),
        *(f"CYCL DEF {number}" for number in (8, 10, 11, 19, 26, 247)),
    ],
    "tnc620-using-cycles": [
        *("fixed cycles", "CYCL DEF", "CYCL CALL PAT", "CYCL CALL POS", "M89", "PREDEF"),
        *(f"PATTERN DEF {form}" for form in ("POS", "ROW", "PAT", "FRAME", "CIRC", "PITCHCIRC")),
        *("point table", "SEL PATTERN"),
    ],
    "tnc620-probing-alignment": [
        *(f"TCH PROBE {number}" for number in (400, 401, 402, 403, 404, 405, 1410, 1411, 1420)),
        *("14xx semi-automatic mode", "14xx text parameters"),
    ],
    "tnc620-patterns": ["CYCL DEF 220", "CYCL DEF 221"],
    "tnc620-pockets": [
        *(f"CYCL DEF {number}" for number in (251, 252, 253, 254, 256, 257, 258, 233)),
        "PGM C210 (section 6.10)",
    ],
    "tnc620-probing-inspection": [
        *("measuring log", "result classification", "tool monitoring"),
        *(f"TCH PROBE {number}" for number in (0, 1, 420, 421, 422, 423, 424, 425, 426, 427, 430, 431)),
        *("program BEAMS", "program BSMEAS"),
    ],
    "tnc620-probing-presets": [*(f"TCH PROBE {number}" for number in range(408, 420)), "example 15.14", "example 15.15"],
    "tnc620-tool-measurement": [
        *("TT spindle speed and probing feed", "TT geometry", "TT wear and breakage status"),
        *(f"TCH PROBE {number}" for number in (30, 480, 484, 31, 481, 32, 482, 33, 483)),
    ],
    "mnc-probing tool-setting": ["G470", "G471", "G472", "G480", "G481", "G482"],
    "tnc620-threading": [
        *(f"CYCL DEF {number}" for number in (206, 207, 209, 262, 263, 264, 265, 267)),
        "PGM 1 (section 5.11)",
    ],
    "tnc620-kinematics": [
        *("CfgKinematicsOpt", "TCH PROBE 450", "DATA450.KD", "KinematicsOpt measuring positions", "KinematicsOpt Hirth axes"),
        *("KinematicsOpt backlash", "KinematicsOpt sphere measurement", "KinematicsOpt evaluation", "TCH PROBE 451"),
        *("TCH PROBE 452", "KinematicsOpt interchangeable heads", "KinematicsOpt drift compensation"),
    ],
    "tnc620-probing-special": [f"TCH PROBE {number}" for number in (460, 461, 462, 463, 441)],
    "turning-technology": [
        *("loop", "zigzag", "descent", "pick-up", "semi-finish pass", "equidistant", "contour scheme"),
        *("closed zone strokes", "groove pass count", "groove scheme 5", "one-sided flank infeed"),
        "alternate flank infeed",
    ],
    "tnc620-drilling": [
        *("Q379 positioning behavior", "CYCL DEF 240", "CYCL DEF 200", "CYCL DEF 201", "CYCL DEF 202", "CYCL DEF 203"),
        *("CYCL DEF 204", "CYCL DEF 205", "CYCL DEF 208", "CYCL DEF 241", "PGM C200", "PGM 1 (4.11)"),
    ],
}

#: Controls all of whose example programs are copied, for tests of their readers, and how their files begin.
PROGRAMS = {"tnc-620": "tnc620-"}

#: Files whose G and M codes are listed.
CODES = ["mnc-language", "mnc-drilling", "mnc-milling", "mnc-probing"]
#: Files of the TNC 620 whose entries are listed, whatever their kind.
CHAPTERS = ["klartext", "using-cycles", "patterns", "drilling", "threading", "pockets", "transformations", "special",
            "probing-inspection"]
#: Files whose ambiguities are listed: what the manual leaves open, and the reading to adopt.
AMBIGUITIES = ["mnc-language"]
KEYS = (
    *("address", "name", "unit", "type", "range", "alternatives", "choices", "default", "required", "modal"),
    "incremental",
)


def entries(folder, name):
    """The entries of one file of the catalogue by their codes."""
    loaded = yaml.safe_load((folder / f"{name}.yaml").read_text(encoding="utf-8"))
    return {entry["code"]: entry for entry in loaded["entries"]}


def examples(folder, name, codes):
    """The examples of the named entries, with the numbers that they must give."""
    found = entries(folder, name)
    for code in codes:
        for example in found[code].get("examples") or []:
            check = example.get("check", example.get("checks"))
            kept = {key: example[key] for key in ("title", "origin", "program", "expected") if key in example}
            kept["title"] = re.sub(r" \(seed lines? [^)]*\)|, seed lines? [\d, -]+", "", kept["title"])
            if "program_adopted" in example:  # printed with a misprint
                kept |= {"printed": example["program"], "program": example["program_adopted"]}
            yield {"code": code, **kept, "check": check}


def programs(folder, prefix):
    """Every example program, as printed or as it is to be read."""
    for file in sorted(folder.glob(f"{prefix}*.yaml")):
        for entry in yaml.safe_load(file.read_text(encoding="utf-8"))["entries"]:
            for example in entry.get("examples") or []:
                text = example.get("program_adopted", example.get("program_english", example["program"]))
                if text:
                    yield {"code": str(entry["code"]), "program": text}


def parameters(folder):
    """Parameters of every cycle by control, with the codes that mean the same."""
    controls = {}
    for file in sorted(folder.glob("*.yaml")):
        loaded = yaml.safe_load(file.read_text(encoding="utf-8"))
        for entry in loaded.get("entries") or []:
            declared = entry.get("kind") == "cycle" or str(entry["code"]).startswith("GLOBAL DEF ")
            if declared and entry.get("parameters"):
                rows = [{key: row[key] for key in KEYS if row.get(key) is not None} for row in entry["parameters"]]
                record = {"code": str(entry["code"]), "aliases": entry.get("aliases") or [], "parameters": rows}
                controls.setdefault(loaded["control"], []).append(record)
    return controls


def listed(folder, names):
    """Every G and M code of the manual."""
    for name in names:
        for code, entry in entries(folder, name).items():
            if entry["kind"] in ("function", "cycle"):
                kept = {key: entry.get(key) for key in ("kind", "title", "group", "modal", "power_on", "aliases")}
                yield {"code": code, **kept}


def chapters(folder, names):
    """Every entry of some files: its kind, whether it stays and holds at the start, and which examples have a check."""
    for name in names:
        for code, entry in entries(folder, f"tnc620-{name}").items():
            kept = {key: entry[key] for key in ("kind", "modal", "power_on") if entry.get(key) is not None}
            checked = [example for example in entry.get("examples") or [] if "check" in example or "checks" in example]
            yield {"file": name, "code": code, **kept, "checked": len(checked)}


def ambiguities(folder, names):
    """What the manual leaves open (`text`) and how it is read (`read`), by the names that code and tests cite."""
    for name in names:
        for code, entry in entries(folder, name).items():
            for sentence in entry.get("ambiguities") or ():
                found = re.fullmatch(r"\[(MNC-[A-Z0-9a-z-]+)\] TEXT: (.*) READ: (.*) WHY: .*", sentence, re.DOTALL)
                yield {"id": found[1], "code": code, "text": found[2], "read": found[3]}


def iso_names(folder):
    """The DIN/ISO names in the headings of the cycles."""
    for code, entry in entries(folder, "tnc620-index").items():
        if "iso" in entry:
            yield {"code": code, "iso": re.findall(r"G\d+", entry["iso"] or "")}


def save(name, records):
    """One record a line and one parameter a line, so that changes can be read."""
    lines = []
    for record in records:
        rows = record.pop("parameters", None)
        text = json.dumps(record, ensure_ascii=False)
        if rows is not None:
            inner = ",\n  ".join(json.dumps(row, ensure_ascii=False) for row in rows)
            text = f'{text[:-1]}, "parameters": [\n  {inner}\n]}}'
        lines.append(text)
    (HERE / f"{name}.json").write_text("[\n" + ",\n".join(lines) + "\n]\n", encoding="utf-8")
    print(f"{name}: {len(lines)}")


def main(folder):
    for name, codes in EXAMPLES.items():
        save(name.replace(" ", "-"), examples(folder, name.partition(" ")[0], codes))
    for control, prefix in PROGRAMS.items():
        save(f"programs-{control}", programs(folder, prefix))
    for control, records in parameters(folder).items():
        save(f"parameters-{control}", records)
    save("codes", listed(folder, CODES))
    save("codes-tnc-620", chapters(folder, CHAPTERS))
    save("iso-names-tnc-620", iso_names(folder))
    save("ambiguities", ambiguities(folder, AMBIGUITIES))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
