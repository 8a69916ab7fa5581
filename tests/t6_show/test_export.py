"""Files that other programs can read, and that say the same as the run."""

import csv
import json
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import mnclab
from mnclab import Alarm

PROGRAM = "G90 G54 T1 S1000 M3\nG0 X0.1 Y0 Z5\nG1 Z-2 F100\nG2 X30 Y0.3 R20\nG4 P1.5\nG83 X3 Y4 Z-9 R2 K5\nG80\n"


def test_csv_reads_back_with_every_digit(run, tmp_path):
    table = np.genfromtxt(run.save(tmp_path / "a.csv"), delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert len(table) == len(run.toolpath)
    for k, axis in enumerate("xyz"):
        assert np.array_equal(table[f"end_{axis}"], run.toolpath.end[:, k])
        assert np.array_equal(table[f"centre_{axis}"], run.toolpath.centre[:, k], equal_nan=True)
    assert np.array_equal(table["feed"], run.toolpath.feed, equal_nan=True)  # inf for rapids, nan for events
    assert table["kind"][:4].tolist() == ["TOOL", "SPINDLE", "RAPID", "LINE"]
    assert "G83 peck 1 of 3" in table["label"].tolist()


def test_csv_has_plain_line_ends_and_the_names_of_columns(run, tmp_path):
    data = run.save(tmp_path / "a.csv").read_bytes()
    assert b"\r" not in data and data.count(b"\n") == len(run.toolpath) + 1
    assert next(csv.reader(data.decode().splitlines())) == list(run.toolpath.columns())


def test_json_is_strict_and_complete(run, tmp_path):
    def refuse(constant):
        raise AssertionError(f"{constant} is not JSON")

    found = json.loads(run.save(tmp_path / "a.json").read_text("utf-8"), parse_constant=refuse)
    assert found["ok"] is True and found["summary"]["moves"] == run.summary()["moves"]
    assert found["columns"]["end_z"] == run.toolpath.end[:, 2].tolist()
    assert found["columns"]["centre_x"][0] is None and found["columns"]["feed"][2] is None
    assert found["columns"]["kind"].count("DWELL") == 1


def test_json_tells_the_alarms(tmp_path):
    run = mnclab.run("G0 X1\nG1 X4,5 F100\n", "mnc")
    (alarm,) = json.loads(run.save(tmp_path / "a.json").read_text("utf-8"))["alarms"]
    assert (alarm["line"], alarm["column"], alarm["severity"]) == (2, 6, "alarm")


@pytest.mark.parametrize(("suffix", "begin"), [("svg", b"<?xml"), ("pdf", b"%PDF"), ("PNG", b"\x89PNG")])
def test_pictures_are_the_same_every_time(run, tmp_path, suffix, begin):
    one, other = (run.save(tmp_path / f"{name}.{suffix}").read_bytes() for name in "ab")
    assert one == other and one.startswith(begin)


def test_text_in_an_svg_stays_text(run, tmp_path):
    tree = ElementTree.parse(run.save(str(tmp_path / "a.svg")))
    texts = {"".join(node.itertext()).strip() for node in tree.iter("{http://www.w3.org/2000/svg}text")}
    assert {"X, mm", "Y, mm", "Z, mm", "rapid", "feed"} <= texts


def test_exactly_one_file_is_written(run, tmp_path):
    for suffix in ("svg", "csv", "json"):
        run.save(tmp_path / f"a.{suffix}")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.csv", "a.json", "a.svg"]


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("a.xyz", "cannot write .xyz"),
        ("a", "no suffix"),
        ("none/a.csv", "cannot be written"),
    ],
)
def test_what_cannot_be_written_is_an_alarm(run, tmp_path, name, sentence):
    with pytest.raises(Alarm, match=sentence) as caught:
        run.save(tmp_path / name)
    assert ".csv" in caught.value.headline
    assert list(tmp_path.iterdir()) == []


def test_an_empty_run_can_be_saved(tmp_path):
    run = mnclab.run("G90\n", "mnc")
    for suffix in ("svg", "pdf", "png", "csv", "json"):
        assert run.save(tmp_path / f"a.{suffix}").stat().st_size > 0
