"""What LinuxCNC takes beside M19: writes iso_words.json.

    python3 tests/authorities/generate_iso_words.py

R is the angle, P the direction, Q the time to wait. Positions are mm.
"""

from generate_iso_macros import motion
from recording import ask, save

WORDS = (
    *("", "R0", "R90", "R359.5", "R360", "R360.5", "R-1", "R90 P0", "R90 P1", "R90 P2", "R90 P3", "R90 P-1", "R90 P0.5"),
    *("P1", "R90 Q2", "R90 Q0", "R90 Q-1", "R90 P1 Q.5"),
)


def main():
    records = []
    for words in WORDS:
        text = f"G21 G90 F100\nG0 X1\nM19 {words}\nG1 X2 Y1\nM2\n"
        answer = ask(text)
        said = {} if answer["ok"] else {"error": answer["error"]}
        records.append({"name": f"M19 {words}".strip(), "text": text, "motion": motion(answer)} | said)
    save("iso_words.json", 0, records)


if __name__ == "__main__":
    main()
