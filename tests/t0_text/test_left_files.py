"""What a save that was killed left beside its file is taken away by a later one; a save under way is left alone."""

import os
import time

import pytest

from mnclab.text import file


def test_what_a_killed_save_left_goes_with_the_next_one(tmp_path):
    target = tmp_path / "moves.csv"
    with pytest.raises(KeyboardInterrupt), file.replaced(target) as beside:
        killed, fresh = (beside.with_name(beside.name.replace(beside.name[10:26], digit * 16)) for digit in "ab")
        raise KeyboardInterrupt
    for left in (killed, fresh, tmp_path / ".0123.csv"):
        left.write_text("half of it")
    long_ago = time.time() - 2 * file.OLD
    os.utime(killed, (long_ago, long_ago))
    with file.replaced(target) as beside:
        beside.write_text("whole")
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([fresh.name, ".0123.csv", "moves.csv"])
    assert target.read_text() == "whole"
