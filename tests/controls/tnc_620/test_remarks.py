"""What is remarked and does not stop a program."""

from __future__ import annotations

import mnclab as mnc


def test_a_name_that_differs_and_blocks_after_the_end() -> None:
    run = mnc.run("0 BEGIN PGM A MM\n1 L X+5 F100\n2 END PGM B MM\n3 L X+9\n", "tnc-620")
    assert run.ok and [(a.span.line, a.message) for a in run.alarms] == [
        (3, "END PGM names B, BEGIN PGM A"), (4, "nothing after END PGM is obeyed"),
    ]  # fmt: skip


def test_a_blank_without_its_second_corner() -> None:
    run = mnc.run("2 BLK FORM 0.1 Z X+0 Y+0 Z-20\n3 L X+1 FMAX\n4 M30\n", "tnc-620")
    assert run.ok and [(a.span.line, a.message) for a in run.alarms] == [
        (3, "the blank has no greatest corner: BLK FORM 0.2 is missing")
    ]
