"""The player's data says what a fresh run says: its columns are unpacked here as the page unpacks them."""

import base64
import dataclasses
import hashlib
import random
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools.pages import hidden_scripts, unpack
from tools.together import deep_but_one_in

import mnclab
from mnclab import Alarm, Limits, Setup, Tool
from mnclab.running.interpreter import Interpreter, Stop
from mnclab.runs.run import run_program
from mnclab.show.player.part import Packer, plain
from mnclab.show.player.payload import payload
from mnclab.workpiece.blank import cylinder

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = sorted(
    path
    for pattern in ("data/programs/*/*", "tests/programs/*/*", "tests/controls/nc_31/examples/*")
    for path in ROOT.glob(pattern)
    if path.is_file() and path.suffix != ".expected"
)
EVERY = [*PROGRAMS, None]
FREE = ("FL", "FLT", "FC", "FCT")
INDICES = 500  # steps looked at, over all programs


class Data:
    """What the page can know of a run."""

    def __init__(self, text):
        self.header, columns = unpack(text)
        self.columns = [np.array(column, dtype=np.float64) for column in columns]
        self.row_step = self.columns[self.header["row"]["step"]]
        self.scale = self.header["scale"]
        self.tell()
        self.vertices = np.stack([self.columns[k] for k in self.header["path"]["vertex"]], axis=1)
        if self.header["profile"].get("guessed"):
            self.retime(self.header["profile"])

    def tell(self):
        """Ends that the blocks say, as `Recorded.tell` of data.js has them."""
        header, columns = self.header, self.columns
        texts = [re.sub("\r\n?", "\n", program["text"]).split("\n") for program in header["programs"]]
        blocks, programs = columns[header["steps"]["block"]].astype(int), columns[header["steps"]["program"]].astype(int)
        for axis, k in enumerate(header["path"]["vertex"]):
            for row, step in enumerate(self.row_step.astype(int), 1) if header["path"]["told"][axis] else ():
                which = programs[step]
                line = texts[which][int(columns[header["lines"][which]][blocks[step]]) - 1]
                said = re.search("XYZ"[axis] + "([-+]?[0-9]*[.]?[0-9]+)", line)
                value = float(said[1]) * header["unit"]["length"] * self.scale + 0.5 if said else np.inf
                columns[k][row] += np.floor(value) if abs(value) < 2**49 else columns[k][row - 1]

    def retime(self, packed):
        """Times that lengths and speeds let guess, as `Course.timed` of data.js has them."""
        rows, sent, v = self.columns[packed["row"]], self.columns[packed["t"]], self.columns[packed["v"]] / packed["speeds"]
        arcs, before, apart, mean = self.columns[self.header["path"]["kind"]] == 2, 0.0, np.diff(sent), (v[1:] + v[:-1]) / 2
        lengths = np.linalg.norm(np.diff(self.vertices / self.scale, axis=0), axis=1)
        for row in np.unique(rows).astype(int):
            own = np.flatnonzero(rows == row)
            if len(own) == 3 and not arcs[row]:
                i, j, k = own
                before = apart[i] = apart[i] + before
                steps = abs(v[k + 1] - v[k]), abs(v[i + 1] - v[i])
                apart[k] += np.floor(apart[i] * steps[0] / steps[1] + 0.5) if steps[1] else 0
                left = lengths[row] - (mean[i] * apart[i] + mean[k] * apart[k]) / packed["seconds"]
                apart[j] += np.floor(left / mean[j] * packed["seconds"] + 0.5) if mean[j] else 0
        self.columns[packed["t"]] = np.append(sent[:1], sent[0] + np.cumsum(apart))

    def tip(self, step):
        return self.vertices[np.searchsorted(self.row_step, step, "right")] / self.scale

    def log(self, log, index):
        k = np.searchsorted(self.columns[log["at"]], index, "right") - 1
        return None if k < 0 else log["values"][int(self.columns[log["of"]][k])]

    def state(self, step):
        found = {
            name: value for name, log in self.header["history"].items() if (value := self.log(log, step)) is not None
        }
        at = self.columns[self.header["position"]["at"]]
        k = np.searchsorted(at, step, "right") - 1
        away = np.array([self.columns[each][k] for each in self.header["position"]["from"]])
        vertex = self.vertices[np.searchsorted(self.row_step, at[k], "right")] if len(self.row_step) else 0.0
        return found | {"position": ((vertex + away) / self.scale).tolist()}


def control_of(path):
    return next(part.replace("_", "-") for part in reversed(path.parts) if part.replace("_", "-") in mnclab.controls)


class Until(Interpreter):
    """Obeys blocks one by one, and only the first `steps` of them."""

    steps = obeyed = 0

    def obey(self, index):
        if self.obeyed == self.steps:
            raise Stop
        self.obeyed += 1
        super().obey(index)


def fresh(run, step, monkeypatch):
    """A fresh run of the same text that ends behind a step, wherever in a loop or a called program that is."""
    monkeypatch.setattr(Until, "steps", step + 1)
    monkeypatch.setattr("mnclab.runs.run.Interpreter", Until)
    slow = dataclasses.replace(run.control, bulk=None)
    found = run_program(run.program, slow, run.setup)
    assert len(found.steps.block) == step + 1
    return found


#: A program that calls another one from within a repeat, with parameters, a cycle and rotary axes.
MAIN = """0 BEGIN PGM MAIN MM
1 BLK FORM 0.1 Z X-50 Y-50 Z-20
2 BLK FORM 0.2 X+50 Y+50 Z+0
3 TOOL CALL 2 Z S3000 F500
4 L Z+50 R0 FMAX M3
5 Q1 = 10
6 Q5 = Q1 * 2 + SIN 30
7 L X+Q1 Y+0 A+15 B-30 C+45 FMAX
8 LBL 1
9 L IY+5 F AUTO
10 CALL PGM DRILL.H
11 CALL LBL 1 REP2
12 L X+0 C+90
13 L Z+50 FMAX M30
14 END PGM MAIN MM
"""
DRILL = """0 BEGIN PGM DRILL MM
1 CYCL DEF 200 DRILLING Q200=+2 Q201=-15 Q206=+150 Q202=+5 Q210=+0 Q203=+0 Q204=+50 Q211=+0 Q395=+0
2 CYCL CALL
3 Q1 = Q1 + 1
4 L X+Q1 FMAX M99
5 END PGM DRILL MM
"""


def run_of(path):
    """A run of a program of the list; None stands for the program that calls another."""
    if path is None:
        return mnclab.run(MAIN, "tnc-620", Setup(files={"DRILL.H": DRILL}))
    return mnclab.run(path, control_of(path))


@pytest.fixture(scope="module")
def chosen():
    """Which steps of which programs are looked at."""
    dice = random.Random(20)
    return {path: [dice.random() for _ in range(-(-INDICES // len(EVERY)))] for path in EVERY}


@pytest.mark.parametrize("looks", [slice(2), pytest.param(slice(2, None), marks=pytest.mark.deep)], ids=["few", "others"])
@pytest.mark.parametrize("path", deep_but_one_in(3, EVERY), ids=lambda path: "/".join(path.parts[-2:]) if path else "called")
def test_state_at_any_step_is_that_of_a_fresh_run(path, looks, chosen, monkeypatch):
    run = run_of(path)
    steps = len(run.steps.block)
    data = Data(payload(run, run.profile()))
    for share in chosen[path][looks]:
        step = int(share * steps)
        other = fresh(run, step, monkeypatch)
        expected = {name: plain(value) for name, value in other.at(step=step).state.items()}
        found = data.state(step)
        here = [run.at(step=k).block.keyword for k in range(max(step - 1, 0), step + 1)]
        free = here[-1] in FREE or (here[-1] in ("RND", "CHF") and here[0] in FREE)  # known when the contour is solved
        here, there = found.pop("position"), expected.pop("position")
        if run.toolpath.cylinders:  # what turns is logged at the call of the cycle, whose contour is read in the steps after it
            found.pop("rotary", None), expected.pop("rotary", None)
            free = True
        assert free or np.allclose(here, there, rtol=0, atol=5.1e-7)
        assert found == expected
        if len(other.toolpath) and not free and run.toolpath is run.programmed:  # else the contour would end in the air
            same = other.toolpath.origin - run.toolpath.origin  # an origin that a later block selects
            assert np.allclose(data.tip(step), other.toolpath.end[-1] + same, rtol=0, atol=5.1e-7)


def test_there_are_many_programs_of_all_controls():
    assert len(EVERY) >= 50 and {control_of(path) for path in PROGRAMS} == set(mnclab.controls)
    assert len(run_of(None).programs) == 2


PLATE = ROOT / "data/programs/mnc/first_path.mnc"


def test_arcs_stay_arcs_and_times_are_those_of_the_profile():
    run = mnclab.run(PLATE)
    profile = run.profile()
    data = Data(payload(run, profile))
    arc, packed = run.toolpath.kind == mnclab.Kind.ARC, data.header["path"]
    assert arc.sum() == 6  # four of the contour, two about its outside corners
    assert np.allclose(
        data.columns[packed["sweep"]] / data.header["angles"], run.toolpath.sweep[arc], rtol=0, atol=1e-9
    )
    centre = np.stack([data.columns[k] for k in packed["centre"]], axis=1) / data.scale
    assert np.allclose(centre, run.toolpath.centre[arc], rtol=0, atol=5.1e-7)
    t = data.columns[data.header["profile"]["t"]] / 1e6
    assert np.allclose(t, profile.t, rtol=0, atol=5.1e-7)
    assert np.allclose(data.columns[data.header["profile"]["v"]] / 1e3, profile.v, rtol=0, atol=5.1e-4)


@pytest.mark.parametrize("limits", [Limits(), Limits(jerk=5000)])
def test_between_nodes_the_way_is_the_cubic_of_both_speeds(limits):
    run = mnclab.run(PLATE)
    profile = run.profile(limits)
    data = Data(payload(run, profile))
    packed = data.header["profile"]
    t, v = data.columns[packed["t"]] / 1e6, data.columns[packed["v"]] / 1e3
    dt = np.diff(t)
    way = np.diff(data.columns[packed["s"]]) / data.scale if "s" in packed else (v[:-1] + v[1:]) / 2 * dt
    s = np.append(0.0, np.cumsum(way))
    for share in (0.25, 0.5, 0.9):  # Hermite's cubic, written out
        u, w = share, 1 - share
        found = s[:-1] + u * w * w * dt * v[:-1] + u * u * (3 - 2 * u) * way - u * u * w * dt * v[1:]
        there = profile.at(profile.t[:-1] + share * np.diff(profile.t)).s
        assert np.abs(found - there).max() < 2e-3


def test_a_rapid_that_leaves_its_line_is_sent_as_it_goes():
    run = mnclab.run("G90 G54\nG0 X100 Y20 Z5\nG1 X0 F500\n", "mnc", Setup(limits=Limits(rapid=6000, acceleration=500)))
    profile = run.profile()
    data = Data(payload(run, profile))
    loose = data.header["profile"]["loose"]
    pieces = data.columns[loose["piece"]].astype(int)
    assert len(pieces) > 1 and set(profile.move[pieces]) == {int(np.flatnonzero(run.toolpath.kind == 0)[0])}
    for name, node in (("p0", pieces), ("p1", pieces + 1)):
        place = np.stack([data.columns[k] for k in loose[name]], axis=1) / data.scale
        assert np.allclose(place, profile.at(profile.t[node]).position, rtol=0, atol=1e-3)
    # at 500 mm/s² both axes reach 100 mm/s in 0.2 s and 10 mm; Y brakes at once, so at 0.4 s it is at 20 and X at 30
    row = profile.at(0.4).position
    assert row == pytest.approx([30, 20, 5])
    nearest = np.abs(profile.t[pieces + 1] - 0.4).argmin()
    place = [data.columns[k][nearest] / data.scale for k in loose["p1"]]
    assert place == pytest.approx([30, 20, 5], abs=1e-3)


@given(st.lists(st.lists(st.integers(-(2**50), 2**50), max_size=40), max_size=5))
@settings(max_examples=60, deadline=None)
def test_columns_read_back(columns):
    pack = Packer()
    assert [pack.add(column) for column in columns] == list(range(len(columns)))
    header, found = unpack(pack.text({"title": "Ø"}))
    assert found == columns and header["title"] == "Ø"


def test_fifty_thousand_moves_stay_below_two_and_a_half_megabytes():
    k = np.arange(50_000)
    x, y = np.cos(k / 40) * (80 + k / 5000), np.sin(k / 40) * 60
    lines = [f"N{i + 2} G1 X{a:.3f} Y{b:.3f} Z{c:.3f}" for i, a, b, c in zip(k, x, y, -k / 10_000)]
    run = mnclab.run("N1 G90 G54 T1 S3000 M3 F1500\n" + "\n".join(lines) + "\n", "mnc")
    assert len(run.toolpath.motion) == 50_000
    assert len(run.player().page.encode()) < 2_500_000


def test_the_page_is_one_file_that_asks_for_nothing(tmp_path):
    run = mnclab.run(PLATE)
    saved = run.save(tmp_path / "part.html").read_text("utf-8")
    assert saved == run.player().page
    assert not re.search(r"""(?:src|href)\s*=\s*["'](?!data:)|\bimport\s*\(|@import|fetch\(|https?://|url\(""", saved)
    shown = run.player(height=500, theme="dark")._repr_html_()
    assert 'title="player of first_path.mnc"' in shown and 'sandbox="allow-scripts"' in shown and "500px" in shown


def test_a_text_cannot_break_out_of_the_page():
    text = "G0 X1 // </script><script>alert(1)</script> @data@\n"
    page = mnclab.run(text, "mnc").player().page
    assert "alert(1)" not in page and page.count("<script") == 3


def test_a_run_without_moves_and_one_with_an_alarm_have_pages():
    assert "<canvas" in mnclab.run("// nothing\n", "mnc").player().page
    run = mnclab.run("G0 X1\nG1 X4,5 F100\n", "mnc")
    (alarm,) = Data(payload(run, run.profile())).header["alarms"]
    assert (alarm["line"], alarm["severity"]) == (2, "alarm")


HELICES = "G17 G90 G54 T4 F200 S800 M3\nG3 Z-1 I10\nG3 Z-2 I10\n"  # one warning, at two places


@pytest.mark.parametrize(
    ("text", "more"),
    [
        ("X,1\n" * 1500, "1499 more alarms"),
        ("X,1\n" * 2, "1 more alarm"),
        (HELICES, "1 more warning"),
        (HELICES + "X,1\n", "2 warnings"),
        ("X,1\n", ""),
        ("G0 X1\n", ""),
    ],
)
def test_what_the_page_has_no_room_for_is_counted_by_its_kind(text, more):
    run = mnclab.run(text, "mnc")
    assert Data(payload(run, run.profile())).header["more"] == more


def test_an_alarm_that_is_told_once_has_all_its_places():
    run = mnclab.run(HELICES, "mnc")
    (alarm,) = Data(payload(run, run.profile())).header["alarms"]
    assert alarm["places"] == [[0, 2], [0, 3]]


@pytest.mark.parametrize("wrong", [{"theme": "pink"}, {"speed": 0}, {"speed": float("nan")}])
def test_options_are_checked(wrong):
    with pytest.raises(Alarm, match=next(iter(wrong))):
        mnclab.run("G0 X1\n", "mnc").player(**wrong)


def test_a_page_that_cannot_be_written_is_an_alarm(tmp_path):
    with pytest.raises(Alarm, match="cannot be written"):
        mnclab.run("G0 X1\n", "mnc").save(tmp_path / "no" / "part.html")


@pytest.mark.parametrize(
    ("program", "start", "seconds"),
    [
        ("G0 X1\nG1 X900000001 F0.0000001\n", 0.0, 9e8 * 60e7),
        ("G0 X1\nG1 X5 F0.000000000000000002\n", 0.0, 4 * 30e18),  # 4 mm at 2e-18 mm/min
        ("G0 X1\nG1 X5 F1\n", 9e8, None),
    ],
    ids=["time", "feed", "way"],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_what_is_too_large_for_the_page_is_sent_coarser(program, start, seconds):
    """Of 2^53 whole numbers all are exact in a browser; the parts of a unit grow until the largest one fits."""
    run = mnclab.run(program, "mnc", Setup(start=(start, 0, 0)))
    profile = run.profile()
    data = Data(payload(run, profile))
    packed = data.header["profile"]
    assert all(np.abs(column).max(initial=0) < 2**53 for column in data.columns)
    for name, parts, values in (("t", "seconds", profile.t), ("v", "speeds", profile.v)):
        found, step = data.columns[packed[name]] / packed[parts], 1 / packed[parts]
        assert np.allclose(found[np.isfinite(values)], values[np.isfinite(values)], rtol=1e-9, atol=step)
    vertices = np.concatenate([run.toolpath.start[:1], run.toolpath.end])
    assert np.allclose(data.vertices / data.scale, vertices, rtol=1e-9, atol=1 / data.scale)
    assert seconds is None or profile.time == pytest.approx(seconds, rel=1e-6)


def test_numbers_that_no_browser_holds_are_refused():
    for wrong in ([2**62], [-(2**63)], [0, -(2**63)], [2**51 + 1]):
        with pytest.raises(ValueError, match="too large"):
            Packer().add(np.array(wrong, dtype=np.int64))


def policy_of(page):
    """What the page allows by name, and the digests of its scripts and styles."""
    (content,) = re.findall(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', page)
    allowed = {name: rest for name, _, rest in (each.strip().partition(" ") for each in content.split(";"))}

    def digests(kind):
        texts = [text.encode() for text in re.findall(f"<{kind}>(.*?)</{kind}>", page, re.S)]
        if kind == "script":  # the first one unpacks the others
            texts += hidden_scripts(page)
        return ["'sha256-" + base64.b64encode(hashlib.sha256(text).digest()).decode() + "'" for text in texts]

    return allowed, digests("script"), digests("style")


def test_a_page_lets_its_own_script_run_and_asks_for_nothing():
    allowed, scripts, styles = policy_of(mnclab.run("G0 X1\nG1 X5 F100\n", "mnc").player().page)
    assert allowed["default-src"] == "'none'" and allowed["base-uri"] == allowed["form-action"] == "'none'"
    assert len(scripts) == 2 and allowed["script-src"].split() == scripts
    assert [allowed["style-src"]] == styles and allowed["img-src"] == "data:"


def test_a_report_runs_nothing_and_asks_for_nothing(tmp_path):
    page = mnclab.run("G0 X1\nG1 X5 K3\n", "mnc").report(tmp_path / "a.html").read_text("utf-8")
    allowed, scripts, _ = policy_of(page)
    assert allowed["default-src"] == "'none'" and "script-src" not in allowed and scripts == []
    assert page.index("Content-Security-Policy") < page.index("<style>")


def test_the_name_of_a_program_is_no_place_of_the_page(tmp_path):
    path = tmp_path / "@data@ @script@.mnc"
    path.write_text("G0 X1\n")
    run = mnclab.run(path)
    page = run.player().page
    assert page.count("<title>@data@ @script@.mnc on") == 1 and policy_of(page)[1] == policy_of(page)[0]["script-src"].split()
    data = Data(payload(run, run.profile()))
    assert data.header["title"] == "@data@ @script@.mnc" == data.header["programs"][0]["name"]


def test_half_a_letter_does_not_stop_the_page():
    run = mnclab.run("G0 X1 // \ud800\nG1 X5 K\udfff\n", "mnc")
    object.__setattr__(run.program, "name", "\udc80.mnc")
    page = run.player()._repr_html_().encode("utf-8").decode()
    assert "?.mnc" in page and Data(payload(run, run.profile())).header["programs"][0]["text"].startswith(
        "G0 X1 // ?\n"
    )


@pytest.mark.deep
@pytest.mark.parametrize("control", ["mnc", "jnc-t01"])
def test_with_a_part_twenty_thousand_moves_stay_below_two_megabytes(control):
    k = np.arange(20_000)
    if control == "mnc":
        name, *columns = "XYZ", np.cos(k / 40) * 45, np.sin(k / 40) * 40, -k / 4000
        head, stock = "N1 G90 G54 T1 S3000 M3 F1500", ((-50, -50, -20), (50, 50, 0))
    else:
        name, *columns = "XZ", 30 - k / 1000 + np.sin(k / 9) / 5, -np.abs(k % 400 - 200) / 4
        head, stock = "M3 T1 S800 G97 G94 F200", cylinder(31, -90, 1)
    lines = ["G1 " + " ".join(f"{axis}{v:.3f}" for axis, v in zip(name, row)) for row in zip(*columns)]
    run = mnclab.run(head + "\n" + "\n".join(lines) + "\n", control, Setup(stock=stock))
    assert run.ok and len(run.toolpath.motion) >= 19_000
    player = run.player()
    assert player.cutting is not None and len(player.page.encode()) < 2_000_000


@pytest.mark.parametrize(
    ("control", "stock", "cut"),
    [
        ("mnc", ((0, 0, -20), (60, 40, 0)), "part"),
        ("mnc", cylinder(20, 0, 60, "X"), "part"),
        ("jnc-t01", cylinder(30, -60, 1), "section"),
        ("jnc-t01", cylinder(30, -60, 1, at=(2, 0, 0)), "section"),
        ("jnc-t01", cylinder(30, -60, 1, "X"), None),
        ("mnc", None, None),
    ],
)
def test_a_page_has_the_part_where_there_is_a_blank(control, stock, cut):
    run = mnclab.run("T1 S800 M3\nG0 X10 Z5\nG1 Z-5 F100\nX20\n", control, Setup(stock=stock))
    player = run.player()
    header = Data(payload(run, player.profile, player.cutting, player.collisions)).header
    assert [name for name in ("part", "section") if header[name]] == ([cut] if cut else [])


def test_a_mill_shows_what_holds_the_blank():
    """A box has twelve edges; in the frame of the path, whose origin is the datum."""
    setup = Setup(stock=((0, 0, -20), (60, 40, 0)), fixtures=(((-10, 0, -20), (0, 40, -5)),), datums={1: (100, 0, 0)})
    run = mnclab.run("T1 S800 M3\nG0 X10 Y10 Z5\nG1 Z-5 F100\n", "mnc", setup)
    player = run.player()
    lines = Data(payload(run, player.profile, player.cutting, player.collisions)).header["fixtures"]
    corners = np.array(lines).reshape(-1, 3)
    assert len(lines) == 12
    assert corners.max(axis=0) - corners.min(axis=0) == pytest.approx([10, 40, 15])
    assert corners.min(axis=0) == pytest.approx(np.array([-10, 0, -20]) - run.toolpath.origin)


def test_collisions_are_said_with_their_rows():
    run = mnclab.run("T1 S800 M3\nG0 X10 Y10 Z5\nG0 Z-5\nG0 Z5\n", "mnc", Setup(stock=((0, 0, -20), (60, 40, 0))))
    player = run.player()
    (told,) = Data(payload(run, player.profile, player.cutting, player.collisions)).header["collisions"]
    assert (told["kind"], told["line"], told["program"]) == ("rapid", 3, 0)
    assert run.toolpath.line[told["row"]] == 3


def test_a_piece_that_is_parted_off_goes_with_the_row_that_frees_it():
    text = "M3\nT3\nS800 G97 G94 F60\nG00 X35 Z-30\nG01 X-0.5\nG00 X40\nM5\n"
    run = mnclab.run(text, "jnc-t01", Setup(stock=cylinder(30, -60, 0), start=(60, 0, 50)))
    header, columns = unpack(payload(run, run.profile(), run.workpiece().cutting))
    section = header["section"]
    rows, count = columns[section["rows"]], columns[section["count"]]
    (which,) = section["fallen"]
    assert [run.toolpath.line[row] for row in rows[: which + 2]] == [5] * (which + 1) + [6]  # the last of its row
    z, r = (np.array(columns[k])[sum(count[:which]) : sum(count[: which + 1])] / section["parts"] for k in section["corners"])
    assert (z.min(), z.max(), r.min(), r.max()) == (-27, 0, 0, 30)
    (chuck,) = section["chuck"]
    assert max(place for place, _ in chuck) == -60  # a chuck that nobody gave stands behind the bar


def test_a_page_of_many_moves_without_any_order_is_small():
    """20,000 moves of three coordinates with three decimals: what a school can send by mail, 500 kB."""
    rng = random.Random(2)
    places = ((rng.uniform(0, 90), rng.uniform(0, 45), rng.uniform(-3, 0)) for _ in range(20_000))
    text = "F800\n" + "".join(f"G1 X{x:.3f} Y{y:.3f} Z{z:.3f}\n" for x, y, z in places)
    setup = Setup(tools={1: Tool(radius=4)}, stock=((0, 0, -20), (90, 45, 0)))
    assert len(mnclab.run("T1 S3000 M3\n" + text, "mnc", setup).player().page.encode()) < 500_000
