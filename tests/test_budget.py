"""How much code a room may hold: lines that bear a token of code, without docstrings, comments and blanks.

`python3 tests/test_budget.py` prints the table: code lines, share of imports, files, median of lines a file. A budget is
raised only in a commit that says why, and lowered when a room has become smaller.
"""

import ast
import io
import statistics
import tokenize
from pathlib import Path

HOUSE = Path(__file__).resolve().parent.parent / "mnclab"
SILENT = {
    tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENCODING, tokenize.ENDMARKER,
}  # fmt: skip
SLACK = 40  # code lines: a mend must not wait for a budget

#: Room -> code lines.
BUDGETS = {
    "front door": 376, "comparison": 2546, "controls": 1193, "controls/g43": 3744, "controls/jnc_t01": 509,
    "controls/mnc": 2301, "controls/nc_31": 879, "controls/tnc_620": 15273, "controls/word_address": 579,
    "design": 9926, "geometry": 2841, "lab": 2089, "learning": 1800, "machine": 3321, "machining": 5162,
    "path": 4534, "running": 1969, "runs": 2745, "shell": 983, "show": 8956, "text": 2294, "workpiece": 6505,
}  # fmt: skip
FILES = 510


def code_lines(text):
    """The numbers of lines that bear code, and how many of them are imports."""
    tree = ast.parse(text)
    lines = {
        row
        for token in tokenize.generate_tokens(io.StringIO(text).readline)
        if token.type not in SILENT
        for row in range(token.start[0], token.end[0] + 1)
    }
    imports = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            imports |= set(range(node.lineno, node.end_lineno + 1))
        body = getattr(node, "body", None)
        if isinstance(body, list) and body and isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant):
            if isinstance(body[0].value.value, str):
                lines -= set(range(body[0].lineno, body[0].end_lineno + 1))
    return lines, len(lines & imports)


def room_of(file):
    """The folder below mnclab; a control is a room of its own."""
    folders = file.relative_to(HOUSE).parts[:-1]
    if not folders:
        return "front door"
    return "/".join(folders[:2]) if folders[0] == "controls" and len(folders) > 1 else folders[0]


def rooms():
    """Room -> (code lines, imports among them, lines of each file)."""
    found = {}
    for file in sorted(HOUSE.rglob("*.py")):
        text = file.read_text("utf-8")
        lines, imports = code_lines(text)
        code, so_far, files = found.get(room_of(file), (0, 0, []))
        found[room_of(file)] = code + len(lines), so_far + imports, [*files, text.count("\n")]
    return found


def test_every_room_keeps_its_budget():
    found = rooms()
    assert set(found) == set(BUDGETS)
    over = {room: code - BUDGETS[room] for room, (code, _, _) in found.items() if code > BUDGETS[room] + SLACK}
    assert not over, "lines of code beyond the budget of a room: take as many away, or raise it in a commit that says why"
    assert sum(len(files) for _, _, files in found.values()) <= FILES


def test_code_is_counted_without_what_is_said_about_it():
    text = (
        '"""What."""\n\nimport os  # why\n\n\ndef f(x):\n    """Say.\n\n    More.\n    """\n'
        "    # so\n    return (\n        x\n    )\n"
    )
    lines, imports = code_lines(text)
    assert sorted(lines) == [3, 6, 12, 13, 14] and imports == 1


if __name__ == "__main__":
    table, every = rooms(), []
    print(f"{'room':22}{'code':>8}{'budget':>8}{'imports':>9}{'files':>7}{'median':>8}{'longest':>9}")
    for room, (code, imports, files) in table.items():
        every += files
        share = f"{100 * imports / code:.1f} %"
        median = statistics.median(files)
        print(f"{room:22}{code:8}{BUDGETS.get(room, 0):8}{share:>9}{len(files):7}{median:8.0f}{max(files):9}")
    code, imports = (sum(row[k] for row in table.values()) for k in (0, 1))
    print(f"{'all':22}{code:8}{sum(BUDGETS.values()):8}{f'{100 * imports / code:.1f} %':>9}{len(every):7}"
          f"{statistics.median(every):8.0f}{max(every):9}")  # fmt: skip
