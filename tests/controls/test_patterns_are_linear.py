"""No regular expression goes back over a long line again and again.

All of them are collected: those that modules keep, and those that are written where they are used. Each is tried, in the
ways in which it is used, on long lines of its characters, one after another and in pairs. A line of 8,000 characters takes
well below a millisecond then, and 80 milliseconds or more where a pattern returns to its beginning at every character.
"""

import ast
import importlib
import pkgutil
import re
import re._parser as parser
import time
from functools import cache
from itertools import product
from pathlib import Path

import pytest

import mnclab

LONG = 8000
PARTS = 16  # of the patterns, a test each
MOST = 0.02  # s of processor, the least of three
SOURCE = Path(mnclab.__file__).parent
SEEKS = ("search", "finditer", "findall", "sub", "subn", "split")
#: Patterns that are put together where they are used, as a use makes them, and how they are used.
PUT_TOGETHER = {
    "din_statements.py": (r"(?<![\w.])CP(?![A-Za-z_.])", "search"),
    "labels.py": (r"GT(?![A-Z])", "match"),
    "formulas.py": (r"[ \t]*LEN(?![A-Z])", "match"),
    "feature_file.py": (r"\bdepth", "search"),
    "programs.py": (r"O?0*1000(\.\w{1,8})?", "fullmatch"),
    "neighbours.py": (r"(?<![\w.])17(?!\.?\w)", "search"),
    "reader.py": (r"/[ \t]?/|;", "search"),
    "program.py": (r"/[ \t]?/", "search"),
    "vocabulary.py": (r";|\(|\*[ \t]*-", "search"),
    "completion.py": (r";|\(|\*[ \t]*-", "search"),
    "fields.py": (r"\b251 Q215\b", "search"),
    "fields.py: groups": (r"position|corner|\bangle\b(?! reference)", "search"),
    "fields.py: words": (r"Q215(?![A-Za-z])", "match"),
    "kinds.py": (r"straight side|\bangle\b|^measuring( in three dimensions)?$", "search"),
    "__init__.py": (r"(pocket|stud) (length|width)", "fullmatch"),
    "causes.py": (r"(?<![A-Z])X\s*[-+=.\d]", "search"),
    "terms.py": (r"\bpocket", "search"),
    "asked.py": (r"(?<![A-Z_])CYCL\s+DEF\s*0*200(?![0-9.])", "search"),
    "file.py": (r"""(?:^|[\s.{,])(["']?start["']?)\s*=""", "search"),
}


def kept():
    """Patterns that modules keep, also in tables, and their names."""
    found = {}

    def collect(value, name, depth=0):
        if isinstance(value, re.Pattern):
            found.setdefault((value.pattern, value.flags), set()).add(name)
        elif isinstance(value, dict | list | tuple | set | frozenset) and depth < 4:
            for item in value.values() if isinstance(value, dict) else value:
                collect(item, name, depth + 1)

    for module in pkgutil.walk_packages([str(SOURCE)], "mnclab."):
        if "__main__" not in module.name and not module.name.startswith("mnclab.lab.labextension"):
            try:
                names = vars(importlib.import_module(module.name)).items()
            except ImportError:  # needs an extra
                continue
            for name, value in names:
                if not name.startswith("__"):
                    collect(value, name)
    return found


def written():
    """Calls of functions of re with a pattern: function, pattern or None where it is put together, file."""
    for file in sorted(SOURCE.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.args:
                of, way, first = node.func.value, node.func.attr, node.args[0]
                if isinstance(of, ast.Name) and of.id == "re" and way not in ("escape", "compile"):
                    yield way, first.value if isinstance(first, ast.Constant) else None, file.name


def methods():
    """By which methods each name of a pattern is used."""
    found = {}
    for file in sorted(SOURCE.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.Attribute) and node.attr in (*SEEKS, "fullmatch"):
                name = node.value.id if isinstance(node.value, ast.Name) else getattr(node.value, "attr", "")
                found.setdefault(name, set()).add(node.attr)
    return found


def uses():
    """Every pattern with its ways of use: match, fullmatch, search."""
    ways, found = methods(), {}
    for (pattern, flags), names in kept().items():
        used = set().union(*(ways.get(name, set()) for name in names))
        found[pattern, flags] = {"match", *(used & {"fullmatch"}), *("search" for way in used if way in SEEKS)}
    for way, pattern, _ in written():
        if pattern is not None:
            found.setdefault((pattern, 0), set()).add("search" if way in SEEKS else way)
    for pattern, way in PUT_TOGETHER.values():
        found.setdefault((pattern, re.IGNORECASE), set()).add(way)
    return found


def characters(items, single, classes):
    """The characters of a pattern: all of them, and those that stand for a class or are repeated."""
    for operation, value in items:
        name = str(operation)
        if name in ("LITERAL", "NOT_LITERAL"):
            (single if name == "LITERAL" else classes).add(chr(value) if name == "LITERAL" else "\x01")
        elif name == "ANY":
            classes.add("\x01")
        elif name == "IN":
            members = set()
            for kind, member in value:
                if str(kind) == "LITERAL":
                    members.add(chr(member))
                elif str(kind) == "RANGE":
                    members.add(chr(member[0]))
                elif str(kind) == "CATEGORY":
                    members.add({"DIGIT": "7", "SPACE": " ", "WORD": "w"}.get(str(member).rpartition("_")[2], "\x01"))
                else:
                    members.add("\x01")
            single |= members
            classes |= set(sorted(members)[:3])
        elif name == "SUBPATTERN":
            characters(value[-1], single, classes)
        elif name == "BRANCH":
            for branch in value[1]:
                characters(branch, single, classes)
        elif "REPEAT" in name:
            inner = set()
            characters(value[2], single, inner)
            classes |= inner
            if len(value[2]) == 1 and str(value[2][0][0]) == "LITERAL":
                classes.add(chr(value[2][0][1]))
        elif name in ("ASSERT", "ASSERT_NOT"):
            characters(value[1], single, classes)


def lines(pattern, flags):
    """Long lines of the characters of a pattern."""
    single, classes = set(), set()
    characters(parser.parse(pattern, flags & ~re.UNICODE if flags & re.ASCII else flags), single, classes)
    single |= {" ", "7"}
    words = sorted({found.rstrip("|") for found in re.findall(r"[A-Z]{2,}", pattern)})[:3]
    for begin in ["", *sorted(single)[:12], *words]:
        for c in sorted(classes | {" ", "7"}):
            yield begin + c * LONG + "\x02"
    for a, b in product(sorted(classes | {" ", "7"}), sorted(single)):
        yield (a + b) * (LONG // 2) + "\x02"
        yield a * (LONG // 2) + b * (LONG // 2) + "\x02"
    for word in words:
        yield (word + " ") * (LONG // 4) + "\x02"


def seconds(use, line):
    """Processor time, the least of three where the first is long."""
    found = []
    while len(found) < 3 and (not found or min(found) > MOST):
        begin = time.thread_time()
        use(line)
        found.append(time.thread_time() - begin)
    return min(found)


def seek(pattern):
    """Every place where a pattern is found."""

    def use(line):
        for _ in pattern.finditer(line):
            continue

    return use


@cache
def all_uses():
    return sorted(uses().items())


@pytest.mark.deep
@pytest.mark.parametrize("part", range(PARTS))
def test_a_pattern_takes_time_in_proportion_to_its_line(part):
    slow = []
    for written, ways in all_uses()[part::PARTS]:
        pattern = re.compile(*written)
        for way in ways:
            use = seek(pattern) if way == "search" else getattr(pattern, way)
            found = [line for line in lines(*written) if seconds(use, line) >= MOST]
            slow += [f"{way} of {written[0]} on {line[:5]!r} … {line[-5:]!r}" for line in found]
    assert slow == []


def test_every_pattern_that_is_put_together_is_tried():
    assert {file for _, pattern, file in written() if pattern is None} <= set(PUT_TOGETHER)
    assert len(all_uses()) > 90


@pytest.mark.parametrize("control", ["mnc", "jnc-t01", "nc-31", "g43", "tnc-620"])
@pytest.mark.parametrize("begin", ["", "L", "X1 ", "Q1 = ", "CYCL DEF 200 A", "N10 G1 X", "; ", "BEGIN PGM "])
def test_a_long_line_is_read_in_proportion_to_its_length(control, begin):
    for c in " \t7.-+/~;:Q(A'\"*@%N\x01":
        for pair in (c, c + " ", c + "7", " " + c):
            clock = time.thread_time()
            mnclab.read(begin + pair * (4000 // len(pair)) + "\n", control)
            assert time.thread_time() - clock < 2, f"{begin}{pair * 3}…"  # some milliseconds; 2,000 blanks took 11 s
