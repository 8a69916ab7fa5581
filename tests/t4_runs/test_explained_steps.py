"""A block that calls a cycle, explained: its steps by name, the moves of one in one line, folded in a notebook."""

import mnclab

HOLE = "T2 S900 M3\nG0 X0 Y0 Z25\nG99 G83 X10 Y10 Z-18 R2 K6 F120\n"


def test_every_step_of_a_cycle_has_its_name():
    """From R2 to Z-18 in pecks of 6: 6, 6, 6 and 2."""
    told = mnclab.run(HOLE, "mnc").explain(3)
    named = [move for move in told.moves if "peck" in move]
    assert [move.partition("  ; ")[2] for move in named] == [f"G83 peck {k} of 4" for k in (1, 2, 3, 4)]
    assert named[0].startswith("line X10 Y10 Z-4 F120")
    assert "<details>" in told._repr_html_() and "moves of the cycle</summary>" in told._repr_html_()


def test_moves_of_one_step_stand_in_one_line():
    run = mnclab.run("T1 S3000 M3\nG0 X0 Y0 Z20\nG343 M1 A80 B50 R6 Z0 H-3 P3 Q2 U0 K1 J1 F600 V150\n", "mnc")
    told, rows = run.explain(3), run.toolpath[run.at(line=3).rows]
    names = [rows.labels[k] for k in rows.label]
    steps = 1 + sum(a != b for a, b in zip(names, names[1:]))
    assert len(told.moves) == min(steps, 12) and any(" moves, the last " in move for move in told.moves)


def test_a_block_without_a_cycle_is_not_folded():
    told = mnclab.run(HOLE, "mnc").explain(2)
    assert told.moves == ("rapid X0 Y0 Z25",) and "<details>" not in told._repr_html_()
