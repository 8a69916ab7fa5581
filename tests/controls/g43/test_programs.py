"""Programs of the ISO mill that call others: O numbers, M98 and M99, G65 and G66, other files."""

from functools import partial

from tools import running

import mnclab
from mnclab import Setup

run = partial(running.run, control="g43")


def xs(text, **settings):
    return run(text, **settings).toolpath.end[:, 0].tolist()


def test_calls_in_a_file():
    """The second call is made from a subprogram, the third three times, in both spellings."""
    text = "O1 (MAIN)\nM98 P2\nG0 X1\n{0}\nM30\nO2\nM98 P3\nG0 X2\nM99\n:3\nG91 G0 X3\nG90\nM99\n"
    assert xs(text.format("M98 P3 L3")) == [3, 2, 1, 4, 7, 10]
    assert xs(text.format("M98 P30003")) == [3, 2, 1, 4, 7, 10]
    assert xs(text.format("M98 P0030003")) == [3, 2, 1, 4, 7, 10]
    assert xs(text.format("M98 P3 L0")) == [3, 2, 1]
    assert xs("M98 P31000\nM30\nO31000\nG0 X5\nM99\nO1000\nG0 X6\nM99\n") == [5]


def test_subprograms_share_the_variables_of_their_caller():
    """As LinuxCNC does it: 5, and 7 after the call."""
    assert xs("#1=5\nM98 P2\nG0 X#1\nM2\nO2\nG0 X#1\n#1=7\nM99\n") == [5, 7]


def test_named_variables_belong_to_one_program():
    """As LinuxCNC does it, but for those that begin with an underscore."""
    assert xs("#<a>=1\nM98 P2\nG0 X#<a>\nM2\nO2\n#<a>=5\nG0 X#<a>\nM99\n") == [5, 1]
    assert xs("#<_most>=1\nM98 P2\nG0 X#<_most>\nM2\nO2\n#<_most>=#<_most>+4\nM99\n") == [5]


def test_the_return_to_a_block():
    assert xs("O1\nM98 P2 L5\nG0 X1\nN50 G0 X5\nM30\nO2\nG0 X2\nM99 P50\nN50 G0 X9\n") == [2, 5]
    assert xs("G0 X1\nM99 P20\nG0 X2\nN20 G0 X3\n") == [1, 3]


def test_the_end_of_the_main_program():
    ends = run("G0 X1\nM99\nG0 X2\n")
    assert ends.toolpath.end[:, 0].tolist() == [1] and "M99 in the main program" in ends.alarms[0].message
    assert xs("#1=#1+1\nIF [#1 GT 3] GOTO 9\nG0 X#1\nM99\nN9 M30\n", main_m99="repeat") == [1, 2, 3]
    forever = mnclab.run("G0 X1\nM99\n", "g43", Setup(settings={"main_m99": "repeat"}))
    assert "never gets out" in forever.alarms[0].message


def test_a_program_ends_where_the_next_one_begins():
    found = run("O1\nM98 P2\nG0 X1\nO2\nG0 X2\nO3\nG0 X3\n")
    assert found.toolpath.end[:, 0].tolist() == [2, 1]
    assert [alarm.message for alarm in found.alarms] == ["O1 ends where O2 begins", "O2 ends where O3 begins"]


def test_blocks_belong_to_their_program():
    """N10 stands in both."""
    first = "O1\nN10 #1=#1+1\nG0 X#1\nM98 P2\nIF [#1 LT 2] GOTO 10\nM30\n"
    assert xs(f"{first}O2\nGOTO 10\nG0 X9\nN10 G0 X-#1\nM99\n") == [1, -1, 2, -2]


def test_arguments_of_a_macro():
    """Fanuc's table: A 1, B 2, C 3, I 4, J 5, K 6, D 7, … X 24; of the second I on #7, and the last of two counts."""
    names = dict(zip("ABCIJKDEFHMQRSTUVWXYZ", (*range(1, 10), 11, 13, *range(17, 27))))
    call = "G65 P9000 " + " ".join(f"{letter}{number}.5" for letter, number in names.items())
    body = "\n".join(f"#{500 + number}=#{number}" for number in range(1, 34))
    found = run(f"{call}\nM30\nO9000\n{body}\nM99\n").variables
    assert found == {f"#{500 + number}": number + 0.5 for number in names.values()}
    found = run(f"G65 P9000 A1 B2 I-3 I4 D5\nM30\nO9000\n{body}\nM99\n").variables
    assert found == {"#501": 1, "#502": 2, "#504": -3, "#507": 5}
    found = run(f"#9=2\nG65P9000I1J2K3I4J5K[#9*3]K7\nM30\nO9000\n{body}\nM99\n").variables
    assert found == {"#9": 2, "#504": 1, "#505": 2, "#506": 3, "#507": 4, "#508": 5, "#509": 6, "#512": 7}


def test_a_macro_has_variables_of_its_own():
    """Those of the caller come back, whatever it wrote; each of three calls begins anew."""
    text = "#1=100\n#3=1\nG65 P9 L3 A5\nG0 X#1 Y#2\nM30\nO9\nG0 X#1 Y#3\n#1=#1+1\n#2=8\n#101=#101+#1\nM99\n"
    found = run(text)
    assert found.toolpath.end[:, :2].tolist() == [[5, 0], [100, 0]]
    assert found.variables == {"#1": 100, "#3": 1, "#101": 18}
    assert xs("G65 P9 A3\nM30\nO9\nIF [#1 EQ #0] GOTO 5\nG0 X#1\n#1=#1-1\nIF [#1 EQ 0] GOTO 5\nG65 P9 A#1\nN5 M99\n") == [3, 2, 1]


def test_a_macro_after_every_motion():
    """Not in the block of G66, nor after one without a way, nor inside the macro, nor after G67."""
    text = "G66 P9 A2\nG0 X10\nM8\nG4 X1\nG0 Y5\nG67\nG0 X30\nM30\nO9\nG91 G0 Z#1\nG90\nM99\n"
    assert run(text).toolpath.motion.end.tolist() == [[10, 0, 0], [10, 0, 2], [10, 5, 2], [10, 5, 4], [30, 5, 4]]


def test_long_runs_of_plain_blocks_call_the_macro_too():
    text = "G66 P9\n" + "".join(f"G0 X{k}\n" for k in range(1, 101)) + "G67\nM30\nO9\n#100=#100+1\nM99\n"
    assert run(text).variables == {"#100": 100}


def test_programs_in_other_files(tmp_path):
    """With an O number or without, whatever the ending; one that is there already is not read again."""
    main = "M98 P1000\nG0 X1\nM98 P20 L2\nG65 P300 A7\nM30\n"
    texts = {"O1000.nc": "%\nO1000\nG0 X5\nM98 P20\nM99\n%\n", "0020": "G91 G0 X1\nG90\nM99\n", "o0300.tap": "G0 X#1\nM99\n"}
    found = mnclab.run(main, "g43", Setup(files=texts))
    assert found.ok and found.toolpath.end[:, 0].tolist() == [5, 6, 1, 2, 3, 7]
    for name, text in {"main.g43": main, **texts}.items():
        (tmp_path / name).write_text(text)
    again = mnclab.run(tmp_path / "main.g43")
    assert again.ok and again.toolpath.end.tolist() == found.toolpath.end.tolist()
    assert len(again.programs) == 4


def test_another_file_names_the_block_to_come_back_to():
    """N30 of the main program, in which nothing else goes to a block."""
    for begin in ("M98 P5", "G65 P5 A1"):
        found = mnclab.run(f"{begin}\nG0 X9\nN30 G0 X8\nM30\n", "g43", Setup(files={"O5.nc": "O5\nG0 X1\nM99 P30\n"}))
        assert found.ok and found.toolpath.end[:, 0].tolist() == [1, 8]


def test_a_copy_beside_a_program_is_not_taken_for_it(tmp_path):
    """Of O2.bak, O2.nc and O0002.txt the one counts that ends as the running file does; without one it is an alarm."""
    for name, x in {"O2.bak": 1, "O2.nc": 2, "O0002.txt": 3}.items():
        (tmp_path / name).write_text(f"O2\nG0 X{x}\nM99\n")
    for name, end in {"main.nc": 2, "main.TXT": 3}.items():
        (tmp_path / name).write_text("M98 P2\nM30\n")
        assert mnclab.run(tmp_path / name, "g43").toolpath.end[:, 0].tolist() == [end]
    (tmp_path / "main.tap").write_text("M98 P2\nM30\n")
    (alarm,) = mnclab.run(tmp_path / "main.tap", "g43").alarms
    assert alarm.span[:2] == (1, 5) and alarm.message == "M98 P2: 3 files are O2: O0002.txt, O2.bak, O2.nc"


def test_a_file_with_another_number_inside_is_named():
    found = mnclab.run("M98 P5\nM30\n", "g43", Setup(files={"O5.nc": "O7\nG0 X1\nM99\n"}))
    assert found.ok and found.toolpath.end[:, 0].tolist() == [1]
    assert [a.message for a in found.alarms] == ["M98 P5: the file O5.nc holds O7, and no O5: it runs from its beginning"]


def test_an_alarm_in_another_file_has_its_place_there():
    found = mnclab.run("M98 P5\n", "g43", Setup(files={"O5.nc": "O5\nG0 X[1/#1]\nM99\n"}))
    (alarm,) = found.alarms
    assert alarm.span[:2] == (2, 7) and alarm.span.program == 1
