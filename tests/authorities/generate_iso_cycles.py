"""Situations of fixed cycles, offsets, turned systems and reference points, with LinuxCNC's motion: iso_cycles.json.

    python3 tests/authorities/generate_iso_cycles.py

They are those of which its documentation speaks (chapters canned cycles, coordinate systems, G28, G30, G53), each a program
of our own; what is said of a situation is its name. Rows of no length are left out.
"""

from generate_iso_offsets import rows
from recording import ask, save

HEAD = "G21 G17 G90 G94 G40 G49 G54 G98\nF200 S900 M3\n"
TURN = "G10 L2 P1 X10 Y-5 R30\n"
PROGRAMS = {
    "g81 absolute, back to the initial level": "G0 X1 Y2 Z3\nG98 G81 X4 Y5 Z1.5 R2.8\nG80\n",
    "g81 in increments, three times, R above the start": "G0 X1 Y2 Z3\nG91 G98 G81 X4 Y5 Z-.6 R1.8 L3\nG80\n",
    "g81 in increments, four times at level R": "G0 X0 Y0 Z10\nG91 G99 G81 X7 Y-2 Z-6 R-8 L4\nG80\n",
    "g81 absolute, twice at one place": "G0 X0 Y0 Z10\nG99 G81 X7 Y3 Z-6 R2 L2\nG80\n",
    "a row of holes and another beside it": "G0 X0 Y0 Z4\nG91 G81 X9 Y0 Z-5 R-2 L4\nG90 G0 X0 Y9\nZ4\n"
    "G91 G81 X9 Y0 Z-3 R-2 L4\nG80\n",
    "twelve holes as a frame": "G0 X0 Y0 Z9\nG91 G99 G81 X10 Z-9 R-7 L4\nX0 Y10 L3\nX-10 Y0 L3\nX0 Y-10 L2\nG80\n",
    "g98 and g99 in turn": "G0 X0 Y0 Z15\nG99 G81 X10 Z-4 R3\nX20\nG98 X30\nG99 X40\nX50\nG98 Y8\nG80\n",
    "from below level R": "G0 X2 Y3 Z-1\nG99 G81 X12 Y8 Z-7 R2\nX14\nG80\n",
    "from below level R, back to the initial level": "G0 X2 Y3 Z-1\nG98 G81 X12 Y8 Z-7 R2\nX14\nG80\n",
    "from level R itself": "G0 X2 Y3 Z2\nG98 G81 X12 Y8 Z-7 R2\nG99 X14\nG80\n",
    "another R in a later block": "G0 X0 Y0 Z20\nG99 G81 X5 Z-4 R2\nX10 R6 Z-8\nX15 R1\nG80\n",
    "another Z in a later block": "G0 X0 Y0 Z20\nG98 G82 X5 Z-4 R2 P.25\nX10 Z-6\nX15 P.5\nG80\n",
    "g83 to level R between pecks": "G0 X0 Y0 Z8\nG99 G83 X5 Y6 Z-10 R1 Q3\nX9\nG80\n",
    "g83 whose last peck is small": "G0 X0 Y0 Z8\nG98 G83 X5 Z-10 R1 Q3.6\nG80\n",
    "g83 with one peck": "G0 X0 Y0 Z8\nG98 G83 X5 Z-2 R1 Q20\nG80\n",
    "g73 lifts a little": "G0 X0 Y0 Z8\nG99 G73 X5 Y6 Z-10 R1 Q3\nX9\nG80\n",
    "g73 in increments": "G0 X0 Y0 Z8\nG91 G98 G73 X5 Y6 Z-7.5 R-6 Q2 L3\nG80\n",
    "g85 out at feed": "G0 X0 Y0 Z8\nG99 G85 X5 Y6 Z-7 R1\nY12\nG98 Y18\nG80\n",
    "g86 stops the spindle": "G0 X0 Y0 Z8\nG98 G86 X5 Y6 Z-7 R1 P.5\nY12\nG80\n",
    "g89 out at feed to the initial level": "G0 X0 Y0 Z8\nG98 G89 X5 Y6 Z-7 R1 P.5\nY12\nG80\n",
    "g89 out at feed to level R": "G0 X0 Y0 Z8\nG99 G89 X5 Y6 Z-7 R1 P.5\nY12\nG80\n",
    "one cycle after another": "G0 X0 Y0 Z8\nG99 G81 X5 Y6 Z-3 R1\nX10\nG82 X15 Z-3 R1 P.5\nG83 X20 Z-9 R1 Q4\nG80\n",
    "inches": "G20\nF8\nG0 X0 Y0 Z.5\nG99 G81 X1 Y.5 Z-.25 R.1\nX2\nG91 X.5 Y.5 L2\nG90 G80\n",
    "inches and pecks": "G20\nF8\nG0 X0 Y0 Z.5\nG98 G83 X1 Y.5 Z-.75 R.1 Q.3\nG73 X2 Z-.75 R.1 Q.3\nG80\n",
    "feed changed between holes": "G0 X0 Y0 Z8\nG99 G81 X5 Z-3 R1 F150\nX10 F90\nX15\nG80\nG1 X20\n",
    "g91 and g90 within a cycle": "G0 X0 Y0 Z8\nG99 G81 X5 Y5 Z-3 R1\nG91 X10\nX10 Y2\nG90 X0\nG80\n",
    "cycle ended by g1": "G0 X0 Y0 Z8\nG99 G81 X5 Z-3 R1\nG1 X20 Z4\nX30\n",
    "cycle ended by g0": "G0 X0 Y0 Z8\nG99 G81 X5 Z-3 R1\nG0 Z20\nX30\n",
    "z alone drills here": "G0 X0 Y0 Z8\nG99 G81 X5 Z-3 R1\nZ-5\nG80\n",
    "cycle in a turned system": f"{TURN}G0 X0 Y0 Z8\nG99 G81 X20 Y0 Z-3 R1\nX30 Y10\nG91 X5 L3\nG90 G80\n",
    "pecks in a turned system": f"{TURN}G0 X0 Y0 Z8\nG98 G83 X20 Y-6 Z-6 R1 Q2.5\nX30\nG80\n",
    "lines in a turned system": f"{TURN}G0 X0 Y0 Z8\nG1 X20 Y0\nY20\nG91 X-20\nY-20\n",
    "arcs in a turned system": f"{TURN}G0 X10 Y0 Z8\nG3 X0 Y10 I-10 J0\nG2 X10 Y20 R10\n",
    "the angle written anew": f"{TURN}G0 X20 Y0 Z8\nG10 L2 P1 R-45\nG1 X20 Y0\nY10\nG10 L2 P1 R0\nX5 Y5\n",
    "cycle in a local system": "G52 X10 Y20 Z-2\nG0 X0 Y0 Z8\nG99 G81 X5 Z-3 R1\nX10\nG80\nG52 X0 Y0 Z0\nG0 X0\n",
    "cycle after g92": "G0 X10 Y10 Z8\nG92 X0 Y0 Z5\nG99 G81 X5 Y5 Z-3 R1\nX10\nG80\nG92.1\nG0 X0 Y0\n",
    "g92 put aside and back": "G0 X10 Y10 Z8\nG92 X0 Y0 Z0\nG0 X5\nG92.2\nG0 X5\nG92.3\nG0 X7 Y7\nG92.1\nG0 X7\n",
    "six systems": "G10 L2 P2 X100\nG10 L2 P3 Y100\nG10 L2 P4 X-50 Z3\nG0 X1 Y1 Z8\nG55 G0 X1\nG56 X1 Y1\nG57 X1 Z8\n"
    "G58 X2\nG59 X3\n",
    "three more systems": "G10 L2 P7 X10 Y20\nG10 L2 P8 X30\nG10 L2 P9 Z-6\nG59.1 G0 X1 Y1 Z8\nG59.2 X1\nG59.3 Z8\n",
    "cycle goes over to another system": "G10 L2 P2 X100 Y-20\nG0 X0 Y0 Z8\nG99 G81 X5 Z-3 R1\nG55 X5 Y0\nX9\nG54 X9\nG80\n",
    "g28 over a place": "G0 X10 Y20 Z5\nG28 Z30\nG0 X5 Y5 Z5\nG91 G28 X0 Y0\nG90 G28 X1 Y1 Z9\n",
    "g28.1 and g30.1": "G0 X10 Y20 Z5\nG28.1\nG0 X40 Y-10 Z25\nG30.1\nG0 X0 Y0 Z0\nG28\nG0 Z40\nG30 Z50\nG91 G28 Z0\n",
    "g53 in a shifted and turned system": f"{TURN}G0 X5 Y5 Z8\nG53 G0 X0 Y0\nG0 X5 Y5\nG53 G1 Z30\nG1 X0 Y0\n",
    "g10 l20": "G0 X10 Y20 Z5\nG10 L20 P1 X0 Y0 Z0\nG0 X5 Y5\nG10 L20 P2 X1 Y1\nG55 X0 Y0\n",
    "helix and whole circles": "G0 X10 Y0 Z8\nG2 X10 Y0 Z2 I-10 P3\nG3 I-5 F80\nG18 G2 X10 Z2 I-4 K3\nG17\n",
    "length of a tool": "G0 X0 Y0 Z50\nG43.1 Z30\nG0 X0 Y0 Z8\nG99 G81 X5 Z-3 R1\nX10\nG80\nG49\nG0 Z50\n",
}


def main():
    records = []
    for name, text in PROGRAMS.items():
        answer = ask(f"{HEAD}{text}M2\n")
        if not answer["ok"]:
            raise SystemExit(f"{name}: {answer['error']} in line {answer['line']}")
        found = rows(answer, len(f"{HEAD}{text}".splitlines()))
        records.append({"name": name, "text": f"{HEAD}{text}", "motion": found})
    save("iso_cycles.json", 0, records)


if __name__ == "__main__":
    main()
