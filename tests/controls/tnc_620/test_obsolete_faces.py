"""Cycles 230 and 231 against numbers worked out from the manuals of earlier controls (TNC 426/430, 8.8; iTNC 530)."""

from __future__ import annotations

import numpy as np
import pytest

import mnclab as mnc
from mnclab import Kind, Setup, Tool

FACE = {
    "Q225": 10, "Q226": 12, "Q227": 2.5, "Q218": 150, "Q219": 75, "Q240": 10, "Q206": 150, "Q207": 500, "Q209": 200, "Q200": 2,
}  # fmt: skip
RULED = {
    "Q225": 0, "Q226": 5, "Q227": -2, "Q228": 100, "Q229": 15, "Q230": 5, "Q231": 95, "Q232": 125, "Q233": 25, "Q234": 15,
    "Q235": 125, "Q236": 25, "Q240": 40, "Q207": 500,
}  # fmt: skip
R = 6


def cut(number: int, **changed: float | str) -> mnc.Run:
    multipass = changed.pop("multipass", "within")
    values = (FACE if number == 230 else RULED) | changed
    lines = "".join(f"{address}={value}\n" for address, value in values.items())
    text = f"TOOL CALL 1 Z S1000\nL X+0 Y+0 Z+90 R0 FMAX M3\nCYCL DEF {number} X\n{lines}CYCL CALL\n"
    return mnc.run(text, "tnc-620", Setup(tools={1: Tool(radius=R)}, settings={"multipass": multipass}))


def test_multipass_milling_in_its_example(rows) -> None:
    """By R to the left and upward of the corner: X4 Y18; to and fro between X4 and X166; the last line R inside Y87, on Y81."""
    path = rows(cut(230))
    assert path.end[:3].tolist() == [[4, 18, 90], [4, 18, 4.5], [4, 18, 2.5]]
    assert path.kind[:3].tolist() == [Kind.RAPID, Kind.RAPID, Kind.LINE] and path.feed[2] == 150
    lines = path[[" line " in path.labels[k] for k in path.label]]
    assert lines.end[:, 0].tolist() == [166, 4] * 5 and (lines.feed == 500).all()
    assert lines.end[:, 1] == pytest.approx(18 + 7 * np.arange(10)) and (lines.end[:, 2] == 2.5).all()
    across = path[["link" in path.labels[k] for k in path.label]]
    assert len(across) == 9 and (across.feed == 200).all()
    assert path.end[-1].tolist() == [4, 81, 4.5] and path.kind[-1] == Kind.RAPID


def test_its_lines_over_the_whole_width(rows) -> None:
    """The other reading: 75 / 10 from line to line."""
    path = rows(cut(230, multipass="width"))
    assert np.unique(path.end[2:, 1]) == pytest.approx(18 + 7.5 * np.arange(10))


def test_one_cut_is_one_line(rows) -> None:
    assert np.unique(rows(cut(230, Q240=1, Q219=5)).end[:, 1]).tolist() == [18]


def test_what_it_leaves_is_said() -> None:
    """63 in four steps are 15.75, the tool is 12 wide; 21 in three, as wide as 12, leave nothing."""
    sentence = "CYCL DEF 230 Q240=5 leaves strips between the lines, which are 15.75 mm apart"
    assert [a.message for a in cut(230, Q240=5).alarms] == [sentence] and not cut(230, Q240=7).alarms


def test_the_ruled_surface_in_its_example(rows) -> None:
    """40 lines: the k-th from P1 + k/39 (P4 - P1) to P2 + k/39 (P3 - P2); the first one at half the feed."""
    path = rows(cut(231))
    lines = path[[path.labels[k].endswith(" of 40") for k in path.label]]
    share = np.arange(40)[:, None] / 39
    assert lines.start == pytest.approx(np.array([0, 5, -2]) + share * np.array([15, 120, 27]))
    assert lines.end == pytest.approx(np.array([100, 15, 5]) + share * np.array([-5, 110, 20]))
    assert lines.feed.tolist() == [250] + [500] * 39
    assert path.end[0].tolist() == [0, 5, -2] and path.kind[0] == Kind.LINE and path.feed[0] == 250
    assert path.end[-1] == pytest.approx([95, 125, 25 + 2 * R])


def test_the_way_back_of_the_ruled_surface(rows) -> None:
    """Up by the tool diameter and back over the line at rapid, down to where it began, and on to the next one."""
    path = rows(cut(231, Q240=2))
    assert path.end[2:6].tolist() == [[100, 15, 17], [0, 5, 10], [0, 5, -2], [15, 125, 25]]
    assert path.kind[2:6].tolist() == [Kind.RAPID] * 2 + [Kind.LINE] * 2
