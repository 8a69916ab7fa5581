"""Tables of texts, as HTML and as text."""

from mnclab.text.tables import Rounded, html_table, text_table


def plain(table: str) -> str:
    return table.replace(' style="text-align:left"', "").replace("; white-space:normal", "")


def test_cells_are_escaped_and_a_line_end_begins_a_line():
    table = html_table(("a", "b"), [("1 < 2", "x\ny")], code=(1,))
    assert plain(table).endswith("<tr><td>1 &lt; 2</td><td><code>x<br>y</code></td></tr></table>")
    assert text_table(("a", "b"), [("1 < 2", "x\ny"), ("3", "")]) == "a      b\n-----  -\n1 < 2  x\n       y\n3"


def test_numbers_stand_to_the_right():
    assert html_table((), [("a", "1")], numbers=(1,)).count("text-align:right") == 1


def test_a_cell_spans_those_below_it_and_those_after_it():
    table = html_table(("a", "b", "c"), [("1", "two", "x"), ("2", None, "y"), ("… 3 rows …",)])
    assert table.count("<td") == 6 and 'rowspan="2">two<' in table and 'colspan="3">… 3 rows …<' in table


def test_numbers_stand_under_each_other_by_their_points():
    """12 has no decimals where 3.125 has a point and three of them: 3 digits and half of one are kept free behind it."""
    table = html_table((), [("3.125",), ("12",), ("-0.5",), ("1:20",), ("5 mm",)], numbers=(0,))
    assert ">3.125<" in table and 'padding-right:3.5ch">12<' in table and 'padding-right:2ch">-0.5<' in table
    assert table.count("padding-right") == 2  # a time and a size with its unit are no plain numbers
    rows = text_table(("n",), [("3.125",), ("12",), ("-0.5",), ("word",)], numbers=(0,)).split("\n")
    assert rows == ["     n", "------", " 3.125", "12", "-0.5", "  word"]


def test_numbers_by_name_print_with_three_decimals_and_keep_their_digits():
    found = Rounded(cutting=2.911161243192578, rapid=1.0)
    assert repr(found) == "{'cutting': 2.911, 'rapid': 1.0}" and found["cutting"] == 2.911161243192578
