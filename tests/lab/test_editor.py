"""The editor: text, alarms and picture follow each other; a file is saved as it was found."""

import json
import re
from html import unescape

import pytest

import mnclab

pytest.importorskip("ipywidgets")


@pytest.fixture(autouse=True)
def patience(monkeypatch):
    """These look at the picture at once, however busy the computer is."""
    for name in ("PATIENCE", "FIRST"):
        monkeypatch.setattr(f"mnclab.lab.editor.{name}", 60.0)


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "part.mnc"
    path.write_bytes(b"G90 G54\r\nG1 X20 F100\r\n")
    return path


def test_typing_draws_and_checks(file):
    box = mnclab.editor(str(file))
    assert "X 0 to 20" in box.picture.value and "saved" in box.status.value
    box.text.value = box.text.value.replace("X20", "X33")
    assert "X 0 to 33" in box.picture.value and "changed" in box.status.value
    box.text.value = "G90\nG1 X5\n"
    assert 'role="alert"' in box.alarms.value and "no feed rate" in box.alarms.value and "^^" in box.alarms.value
    box.text.value = "G90 S500 M3\nG1 X5 F100\n"
    assert "no alarms" in box.alarms.value


def test_alarms_carry_the_name_of_the_file(file):
    box = mnclab.editor(str(file))
    box.text.value = "G90\nG1 X5\n"
    assert "part.mnc:2:" in box.alarms.value and "program:" not in box.alarms.value


def test_programs_beside_the_file_are_called(tmp_path):
    (tmp_path / "SUB.H").write_text("BEGIN PGM SUB MM\nL X+9 FMAX\nEND PGM SUB MM\n")
    (tmp_path / "a.h").write_text("BEGIN PGM A MM\nTOOL CALL 1 Z S100\nCALL PGM SUB\nEND PGM A MM\n")
    assert mnclab.editor(tmp_path / "a.h").run.toolpath.end[-1, 0] == 9


def test_saving_keeps_line_ends(file):
    box = mnclab.editor(str(file))
    box.text.value += "Y5\n"
    box.button.click()
    assert file.read_bytes() == b"G90 G54\r\nG1 X20 F100\r\nY5\r\n"
    assert "saved" in box.status.value and list(file.parent.iterdir()) == [file]


def test_saving_keeps_the_byte_order_mark(tmp_path):
    path = tmp_path / "a.mnc"
    path.write_bytes(b"\xef\xbb\xbfG0 X5\n")
    box = mnclab.editor(str(path))
    box.text.value += "Y5\n"
    box.button.click()
    assert path.read_bytes() == b"\xef\xbb\xbfG0 X5\nY5\n"


def test_saving_keeps_the_code_page(tmp_path):
    path = tmp_path / "a.mnc"
    path.write_bytes("G90 // чистовой проход\nG0 X5\n".encode("cp1251"))
    box = mnclab.editor(str(path))
    box.text.value = box.text.value.replace("X5", "X6")
    box.button.click()
    assert path.read_bytes() == "G90 // чистовой проход\nG0 X6\n".encode("cp1251")
    box.text.value += "// \N{SNOWMAN}\n"
    box.button.click()
    assert "cannot be written in" in box.status.value and path.read_bytes().endswith(b"X6\n")


def test_a_change_elsewhere_is_written_over_only_when_saved_once_more(file):
    box = mnclab.editor(str(file))
    file.write_text("G0 X1\n")
    box.text.value = "G0 Y5\n"
    box.button.click()
    assert "changed elsewhere" in box.status.value and file.read_text() == "G0 X1\n"
    file.write_text("G0 X2\n")  # and again: what is written over is what was told of
    box.button.click()
    assert "changed elsewhere" in box.status.value and file.read_text() == "G0 X2\n"
    box.button.click()
    assert "saved" in box.status.value and file.read_bytes() == b"G0 Y5\r\n"


def test_what_was_typed_and_not_saved_is_there_when_the_cell_is_run_again(file):
    box = mnclab.editor(str(file))
    box.text.value += "Y5\n"
    again = mnclab.editor(str(file))
    assert again.text.value == box.text.value and "changed" in again.status.value
    file.write_text("G0 X1\n")  # the file is newer
    assert mnclab.editor(str(file)).text.value == "G0 X1\n"


def test_a_new_file_is_made_when_it_is_saved(tmp_path):
    path = tmp_path / "new.mnc"
    box = mnclab.editor(str(path))
    assert "new" in box.status.value and not path.exists()
    box.text.value = "G0 X1\n"
    box.button.click()
    assert path.read_text() == "G0 X1\n"


def test_a_control_that_does_not_exist_is_an_alarm(file):
    with pytest.raises(mnclab.Alarm, match="there is no control"):
        mnclab.editor(str(file), "mnd")


def test_a_long_run_does_not_stop_the_typing(tmp_path, monkeypatch):
    """The last good picture stays while the work goes on elsewhere; a text typed over in the meantime is never run."""
    import threading
    import time

    from mnclab.lab import editor as module

    live = module.editor(tmp_path / "a.mnc", "mnc")
    live.text.value = "G54\nG0 X1\n"
    picture, go_on, ran = live.children[0].children[1], threading.Event(), []
    good, run_text = picture.value, module.run_text

    def slow(source, *rest):
        ran.append(source.text)
        assert go_on.wait(20)
        return run_text(source, *rest)

    monkeypatch.setattr(module, "run_text", slow)
    monkeypatch.setattr(module, "PATIENCE", 0.2)
    begin = time.monotonic()
    for number in (2, 3, 4):
        live.text.value = f"G54\nG0 X{number}\nG0 Y{number}\n"
    assert time.monotonic() - begin < 5  # and not 20
    assert picture.value == good and "at work" in live.status.value
    assert "mnclab-past" in live.alarms._dom_classes  # dimmed: they are those of the text before
    go_on.set()
    module.DRAWING.submit(int).result(20)
    assert [source.split()[2] for source in ran] == ["X2", "X4"]
    assert "mnclab-past" not in live.alarms._dom_classes
    assert picture.value != good and live.run.toolpath.end[-1].tolist()[:2] == [4, 4]


def test_faults_come_with_their_places(file):
    box = mnclab.editor(str(file))
    box.text.value = "G90 G54\nG1 X4,5 F100\n"
    (fault,) = json.loads(unescape(re.search(r'data-faults="([^"]*)"', box.alarms.value)[1]))
    assert (fault["line"], fault["column"], fault["severity"]) == (2, "G1 X4,".index(",") + 1, "alarm")
    assert 'data-control="mnc"' in box.alarms.value
    box.text.value = "G90 G54 S500 M3\nG1 X4 F100\n"
    assert 'data-faults="[]"' in box.alarms.value


def test_a_text_that_moves_nothing_leaves_the_last_picture_dimmed(file):
    box = mnclab.editor(str(file))
    good = box.picture.value
    box.text.value = "G90\nG1 X\n"
    assert box.picture.value == good and "mnclab-past" in box.picture._dom_classes
    box.text.value = "G90\nG0 X7\n"
    assert "X 0 to 7" in box.picture.value and "mnclab-past" not in box.picture._dom_classes


def test_half_a_program_is_never_a_fault_of_python(file):
    """Typed key by key, as far as any key goes; every text has its picture or its alarm."""
    box = mnclab.editor(str(file))
    for text in ("G83 X1 Z-3 R2 K", "BEGIN PGM A", "(", "%", "G2 X1 R", "N", "L X+Q"):
        box.text.value = text
        assert box.run is not None and "data-faults" in box.alarms.value or 'role="alert"' in box.alarms.value


def test_what_an_editor_keeps_is_saved_whatever_the_box_holds(file):
    box = mnclab.editor(str(file))
    (kept,) = (each for each in box.children[0].children[0].children[1].children if "mnclab-kept" in each._dom_classes)
    kept.value = "=G0 X1\n"
    assert file.read_bytes() == b"G0 X1\r\n" and kept.value == ""
    kept.value = "="
    assert file.read_bytes() == b""


def test_the_box_has_a_name_that_is_heard_and_not_seen(file):
    box = mnclab.editor(str(file))
    assert box.text.description == "part program" and "clip-path" in box.children[-1].value
