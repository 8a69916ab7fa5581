"""What pdoc documents: the names of the front door and of the shelves, and the classes that their calls give back.

A page is a module made for it, which has these names and no other; annotations are shown as one reads them, classes by the names
under which a user has them.
"""

from __future__ import annotations

import re
import sys
import warnings
from collections.abc import Iterator, Mapping
from inspect import Parameter, formatannotation, getdoc, isclass
from types import ModuleType
from typing import Any, get_args

from numpy.typing import ArrayLike

from mnclab.text.signatures import parts

HIDDEN = {"load_ipython_extension"}
NOT_SAID = re.compile(r"^(Alias for field number|Create new instance of).*")  # what Python says of a named tuple
RESULTS = "results"
WHAT_RESULTS = "What calls give back: classes that have no place on a shelf, as nobody makes one by hand."
UNPACKED = re.compile(r"\*?<class '([\w.]+)'>")
LIKE = formatannotation(ArrayLike)  # a union of what numpy makes an array of
LONG = 60  # letters of a default
OF_GETTERS = "Return a callable object that fetches"  # the text of Python's attrgetter
ARRAY = re.compile(r"(?:numpy|np)\.ndarray\[tuple\[(?:typing\.)?Any, \.\.\.\], numpy\.dtype\[(?:numpy\.)?(\w+)\]\]")
KNOWN = re.compile(r"\b(?:typing|collections\.abc|pathlib|concurrent\.futures\._base)\.(?=\w)")  # modules that need not be said


class Told:
    """An annotation as it is shown."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __repr__(self) -> str:
        return self.text


def public() -> dict[str, dict[str, Any]]:
    """The names of the front door and of each shelf, a shelf on a shelf too: name of the page -> name -> what it is."""
    door: Any = sys.modules["mnclab"]
    front = {name: getattr(door, name) for name in door.OPENED.__all__ if name not in HIDDEN}
    pages, left = {"mnclab": front | {"controls": door.controls}}, [vars(door).get(name) for name in door.__all__]
    while left:
        shelf = left.pop(0)
        if isinstance(shelf, ModuleType):
            names = {name: getattr(shelf, name) for name in shelf.__all__}
            left += names.values()
            pages[shelf.__name__] = {name: each for name, each in names.items() if not isinstance(each, ModuleType)}
    return pages


def documents() -> dict[str, Any]:
    """The pages by their names, as pdoc has them."""
    with warnings.catch_warnings():  # of an annotation that only type checkers can read: it is shown as it is written
        warnings.simplefilter("ignore", UserWarning)
        pages = public()
        documented = {name: _module(name, about(name), names) for name, names in pages.items()}
        given = {
            f"{each.__module__}.{each.__qualname__}": f"{page}.{name}" for page, names in reversed(pages.items())
            for name, each in names.items() if hasattr(each, "__qualname__")
        }  # fmt: skip
        back = {
            each.__qualname__: each for page in documented.values() for one in _all_of(page) for each in _classes(_answer(one))
            if each.__module__.startswith("mnclab.") and f"{each.__module__}.{each.__qualname__}" not in given
        }  # fmt: skip
        documented[RESULTS] = _module(RESULTS, WHAT_RESULTS, dict(sorted(back.items())))
        given |= {f"{each.__module__}.{name}": f"{RESULTS}.{name}" for name, each in back.items()}
        for page in documented.values():
            for one in _all_of(page):
                _write_plainly(one, given)
            for one in page.classes:  # what bases of the house have is shown already
                one.bases = [(*way, repr(_told(said, given))) for *way, said in one.bases if not way[0].startswith("mnclab.")]
    return dict(sorted(documented.items()))


def _write_plainly(one: Any, given: Mapping[str, str]) -> None:
    """Give a function or a value the annotations that are shown, and take from its docstring what only Python says."""
    if hasattr(one, "signature"):
        signature = one.signature
        takes = [
            each.replace(annotation=_told(each.annotation, given), default=_short(each.default))
            for each in signature.parameters.values()
        ]
        one.signature = signature.replace(parameters=takes, return_annotation=_told(signature.return_annotation, given))
    else:
        one.annotation = _told(one.annotation, given)
    own = getattr(one.obj, "__doc__", None) if one.name == "__init__" else one.docstring
    said = NOT_SAID.sub("", one.docstring if own else "").replace("::\n", ":\n")
    one.docstring = "" if OF_GETTERS in said else said


def _short(default: Any) -> Any:
    """A default as it is shown: an ellipsis where that is long, or nothing that could be typed."""
    if default is Parameter.empty or (len(said := repr(default)) <= LONG and "<" not in said):
        return default
    return Told("…")


def about(name: str) -> str:
    """What a page says of itself: of the front door the beginning, without the map of the house."""
    said = (getdoc(sys.modules[name]) or "").replace(" ::", "").replace("::", ":") if name != RESULTS else WHAT_RESULTS
    return "\n\n".join(said.split("\n\n")[:2])


def _module(modulename: str, says: str, names: Mapping[str, Any]) -> Any:
    """A page of pdoc; its classes show what they have of any class of the house."""
    import pdoc.doc

    made: Any = ModuleType(modulename, says)
    made.__all__ = list(names)
    vars(made).update(names)
    page = pdoc.doc.Module(made)
    for name, each in names.items():
        if isclass(each):  # also one that has another name here than where it is made
            page.members[name] = pdoc.doc.Class(modulename, name, each, (each.__module__, each.__qualname__))
        elif type(each).__module__.startswith("mnclab."):
            page.members[name].docstring = getdoc(type(each)) or ""
    for one in page.classes:
        one.own_members = [each for each in one.members.values() if f"{each.taken_from[0]}.".startswith("mnclab.")]
    page.docstring = says  # not that of the stub, which pdoc has found by itself
    return page


def _all_of(page: Any) -> Iterator[Any]:
    """All functions and values of a page, those of its classes too."""
    for one in page.members.values():
        yield from getattr(one, "own_members", (one,))


def _answer(one: Any) -> Any:
    """What a function gives back, or what a property is."""
    return one.signature.return_annotation if hasattr(one, "signature") else getattr(one, "annotation", None)


def _classes(annotation: Any) -> Iterator[type]:
    """The classes in an annotation."""
    if isclass(annotation) and not get_args(annotation):
        yield annotation
    for part in get_args(annotation):
        yield from _classes(part)


def _told(annotation: Any, given: Mapping[str, str]) -> Any:
    """An annotation with the public names of classes, or their last names; without modules that everyone knows."""
    if annotation is Parameter.empty:
        return annotation
    text = annotation if isinstance(annotation, str) else formatannotation(annotation)
    text = UNPACKED.sub(lambda found: found[1].rpartition(".")[2], text)
    text = text.replace(LIKE, "ArrayLike")
    if "_array_like." in text:  # in one union with what stands beside it
        kinds = parts(text.replace(LIKE.partition("[")[2][:-1], "ArrayLike").partition("[")[2].removesuffix("]"), ",")
        text = " | ".join(each.replace("NoneType", "None") for each in kinds)
    text = re.sub(r"ForwardRef\('([^']+)'[^()]*\)", r"\1", ARRAY.sub(r"NDArray[\1]", text))
    text = re.sub(r"\bmnclab(?:\.\w+)+", lambda found: given.get(found[0], found[0].rpartition(".")[2]), text)
    return Told(KNOWN.sub("", text))
