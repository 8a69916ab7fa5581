"""What LinuxCNC says to single blocks in situations: refusals, variables that it keeps, compensation; writes iso_blocks.json.

    python3 tests/authorities/generate_iso_blocks.py

A record has `error`, LinuxCNC's sentence, or where the program ends, mm. The value of a variable is where X goes last.
"""

from recording import ask, save

HEAD = "G21 G17 G90 G94 F100 S100 M3\nG0 X1 Y2 Z10\n"
ENTRY = "G0 X0 Y0\nG41.1 D4\nG1 X20 Y0\nG1 X40 Y0\n"
LEAVE = "G40\nG0 X60 Y60\n"
HOLE = "G81 X5 Z-1 R1\n"
BLOCKS = (
    *("H1", "G1 D1 X4", "G2", "G3 F50", "G4 X4", "G52", "G53", "G80 X4", "G28 G0 X3", "G0 X1 M0 M1", "M2 M30", "M48 M49"),
    *("M50 M51", "M3 M8 M48 M0 M62 P1", "M61", "M200", "M62", "M62 P1", "M64", "M66", "M66 P1", "M66 P0 E0", "M66 P0 L1 Q0"),
    *("M66 P0 L3 Q2", "M66 E0 L1 Q1", "M67", "M67 E0 Q2", "M67 E-1", "M68", "M62 L2", "M67 P1", "M48 P1", "M72"),
    *("G82 X4 Z-1 R5", "G86 X4 Z-1 R5", "G89 X4 Z-1 R5", "G82 X4 Z-1 R5 P1", "G81 R1", "G81 X5 Z-1 R1 L0", f"{HOLE}R2"),
    *(f"{HOLE}Z-3", f"{HOLE}X3 R2\nX4", f"{HOLE}G80 X6", f"{HOLE}L0 X6", f"G98 {HOLE}G20\nX1\nG21\nX4", f"{HOLE}X5 D1"),
    *("G99 G83 X5 Z-6 R1 Q3\nG20\nX1\nG21\nX4", "G91 G98 G81 X5 Z-1 R-1\nG20\nX1\nG21\nX4", f"G98 {HOLE}G10 L2 P1 Z3\nX6"),
    *("#<_x>=3", "#<_value>=2", "#<_a>=1", "#5400=3", "#5602=3", "#3000=1", "#5221=4\nG0 X7", "#5221=4\nG54\nG0 X7"),
    *("#5221=4\nG55\nG54 G0 X7", "#5161=3\nG28", "G83 X5 Z-6 R1 Q3 P1", "G73 X5 Z-6 R1 Q3 P1", "G84 X5 Z-6 R1 Q3"),
    *("G84 X5 Z-6 R1 J2", "G84 X5 Z-6 R1 P1", "G0 X[SQR[4]]", "G0 X[RND[2.4]]", "G0 X[BIN[3]]", "G0 X[BCD[3]]"),
    *("G0 X[POW[2,3]]", "G0 X[ATAN[1,2]]", "G0 X[ATAN[1]/[2]]", "G0 X[ATAN[1]]", "G2 X21 Y1.682 R10", "G2 X21 Y1.681 R10"),
    *("G0 X0 Y0\nG20 G2 X2 Y-.02 R1", "G0 X0 Y0\nG20 G2 X2 Y-.03 R1", "G18 G2 X21 Z10.319 R10", "G91 G3 X20 Y.318 R10"),
)  # fmt: skip
COMPENSATED = (
    *("G61", "G61.1", "G64 P.1", "G98", "G99", "G41", "G42", "G28.1", "G30.1", "M48", "M49", "M50", "M51", "M52 P1", "M53"),
    *("M62 P1", "M63 P1", "M64 P1", "M65 P1", "M66 P1", "M67 E0 Q1", "M68 E0 Q1", "#1=#5420", "#1=#5422", "G1 X[#5420+5]"),
    *("G40 G64", "G40 G54", "G40 G92 X0", "G40 G49", "G40 M48", "G40 G10 L2 P1 X1", "G17", "M19 R1", "G91", "G4 P1"),
)  # fmt: skip
BEGINNINGS = (
    *("G41.1 D4 G64", "G41.1 D4 G98", "G41.1 D4 G55", "G41.1 D4 G49", "G41.1 D4 G92 X0", "G41.1 D4 M48"),
    *("G19\nG42.1 D4\nG1 Y20", "G18\nG42.1 D4", "G41.1 D4\nG1 Z5", "G41.1 D4\nG0 Z5", "G41.1 D4\nG1 X2", "G41.1 D4\nG1 X2.1"),
)  # fmt: skip
STATES = (
    *("", "G91", "G93", "G95 F1", "G20", "G18", "G55", "G59.3", "G43.1 Z2", "G43.1 Z2\nG49", "G98", "G99", "G90.1", "M7\nM8"),
    *("M8\nM9", "M49", "M50 P0", "M51 P0", "M52 P1", "M53 P0", "G81 X3 Z-1 R1", "G1 X4", "G2 X4 Y4 R9", "G80", "M4", "M5"),
    *("G92 X3", "G92 X3\nG92.2", "G28.1", "G10 L2 P1 R5", "O1 sub\nO1 endsub [5]\nO1 call", "#1000=3", "#5399=2"),
)  # fmt: skip
NAMES = (
    *"a u motion_mode plane ccomp metric imperial absolute incremental inverse_time units_per_minute units_per_rev".split(),
    *"coord_system tool_offset retract_r_plane retract_old_z spindle_rpm_mode spindle_css_mode ijk_absolute_mode".split(),
    *"lathe_diameter_mode lathe_radius_mode spindle_on spindle_cw mist flood speed_override feed_override".split(),
    *"adaptive_feed feed_hold rpm value value_returned call_level remap_level vmajor vminor line x y z".split(),
)  # fmt: skip
NUMBERS = (1000, 4001, 5021, 5161, 5210, 5211, 5220, 5221, 5230, 5399, 5400, 5403, 5410, 5420, 5421, 5422)


def programs():
    for block in BLOCKS:
        yield block, f"{HEAD}{block}\nM2\n"
    for block in COMPENSATED:
        yield f"compensated: {block}", f"{HEAD}{ENTRY}{block}\n{LEAVE}M2\n"
    for block in BEGINNINGS:
        yield f"beginning: {block}", f"{HEAD}G0 X0 Y0\n{block}\nG1 X20\nX40\n{LEAVE}M2\n"
    for state in STATES:
        read = [f"#{100 + k}=#<_{name}>" for k, name in enumerate(NAMES)]
        read += [f"#{200 + k}=#{number}" for k, number in enumerate(NUMBERS)]
        shown = [f"G0 X#{100 + k}\nX-1" for k in range(len(NAMES))] + [f"X#{200 + k}\nX-1" for k in range(len(NUMBERS))]
        plain = "G40 G80 G21 G90 G94 G49 G54\nG92.1\nG10 L2 P1 R0\n"
        yield f"variables: {state}", "\n".join((f"{HEAD}{state}", *read, f"{plain}{shown[0]}", *shown[1:], "M2", ""))


def main():
    records = []
    for name, text in programs():
        answer = ask(text)
        said = {"ends": [row["to"] for row in answer["motion"]]} if answer["ok"] else {"error": answer["error"]}
        records.append({"name": name, "text": text} | said)
    save("iso_blocks.json", 0, records)


if __name__ == "__main__":
    main()
