"""Many small checks in one test case: all of them are made, and every one that fails is told, by its name."""

import functools
import inspect
import traceback
from collections.abc import Callable, Iterable
from typing import Any

import pytest

FAILED = (Exception, pytest.fail.Exception)


def deep_but_one_in(n: int, cases: Iterable[Any]) -> list[Any]:
    """Cases for `parametrize`: the first of every n stays in the fast part, the others are deep."""
    values = [case if isinstance(case, tuple) else (case,) for case in cases]
    return [pytest.param(*each, marks=pytest.mark.deep if k % n else ()) for k, each in enumerate(values)]


def together(
    names: str, cases: Iterable[Any], group: Callable[..., str], name: Callable[..., str] | None = None,
    deep_but_one_in: int = 1,
) -> Any:  # fmt: skip
    """Like `parametrize(names, cases)`, but all cases of a group are one test case.

    `group` and `name` say of the values of a case to which group it belongs and what it is called; without `name` it is
    called by its values. Of n = `deep_but_one_in` cases of a group one is in the fast part, in each group another one of them;
    the others are a test case of their own, which is deep. What else the test takes are fixtures, shared by a group.
    """
    keys = names.split()
    groups: dict[str, list[tuple[Any, ...]]] = {}
    for case in cases:
        values = tuple(case) if len(keys) > 1 else (case,)
        groups.setdefault(group(*values), []).append(values)
    assert groups, "no cases"
    chosen, n = [], deep_but_one_in
    for k, (called, each) in enumerate(list(groups.items())):
        first = k % min(n, len(each))
        groups[called] = each[first::n]
        chosen.append(called)
        if rest := [case for i, case in enumerate(each) if i % n != first]:
            groups[f"rest of {called}"] = rest
            chosen.append(pytest.param(f"rest of {called}", marks=pytest.mark.deep))

    def decorate(test: Callable[..., None]) -> Any:
        @functools.wraps(test)
        def all_of(group: str, **fixtures: Any) -> None:
            wrong = []
            for values in groups[group]:
                try:
                    test(**dict(zip(keys, values, strict=True)), **fixtures)
                except FAILED as error:
                    called = name(*values) if name else " ".join(map(str, values))
                    wrong.append(f"{called}: {_said(error, test)}")
            if wrong:
                pytest.fail(f"{len(wrong)} of {len(groups[group])} in {group}:\n" + "\n".join(wrong), pytrace=False)

        takes = [one for one in inspect.signature(test).parameters if one not in keys]
        shown = [inspect.Parameter(one, inspect.Parameter.POSITIONAL_OR_KEYWORD) for one in ("group", *takes)]
        all_of.__signature__ = inspect.Signature(shown)  # what pytest looks fixtures up by
        return pytest.mark.parametrize("group", chosen)(all_of)

    return decorate


def _said(error: BaseException, test: Callable[..., None]) -> str:
    """What an error says, and the last line of the test's own file on its way."""
    file = inspect.getsourcefile(inspect.unwrap(test))
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == file]
    kind = "" if isinstance(error, AssertionError | pytest.fail.Exception) else f"{type(error).__name__}: "
    return f"line {lines[-1] if lines else '?'}: {kind}{error}".replace("\n", "\n    ")
