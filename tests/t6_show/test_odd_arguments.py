"""Odd arguments of all that the front door offers: an Alarm or an answer, and nothing else, comes out of every call."""

import random
import warnings

import pytest
from tools import odd_arguments

from mnclab import Alarm

CALLS = {name: (door, values) for name, door, values in odd_arguments.calls()}


@pytest.mark.deep
@pytest.mark.parametrize("which", range(4))
def test_nothing_but_an_alarm_comes_out_of_an_odd_call(which):
    """One odd value beside otherwise right ones, in each position; a wrong number of values is not tried."""
    found = []
    for name in sorted(CALLS)[which::4]:
        door, values = CALLS[name]
        for parameter in odd_arguments.parameters(door):
            for odd in odd_arguments.ODD:
                found += fault(name, door, values | {parameter: odd}, f"{parameter}={odd!r:.20}")
    assert not found, "\n".join(found)


@pytest.mark.deep
def test_nothing_but_an_alarm_comes_out_of_several_odd_values():
    """The same with two or more odd values at once, a thousand calls by a seed."""
    dice, found = random.Random(20), []
    for _ in range(1000):
        name = dice.choice(sorted(CALLS))
        door, values = CALLS[name]
        names = odd_arguments.parameters(door)
        odd = {each: dice.choice(odd_arguments.ODD) for each in dice.sample(names, min(len(names), dice.randint(2, 3)))}
        found += fault(name, door, values | odd, str(odd)[:80])
    assert not found, "\n".join(found)


def test_the_right_calls_are_right():
    """Else an alarm of an odd call would say nothing; here of what is made without drawing."""
    refused = []
    for name, (door, values) in CALLS.items():
        if "plot" not in name and not name.startswith("compare"):
            refused += [f"{name}: {alarm}" for alarm in alarms(door, values)]
    assert not refused, "\n".join(refused)


def alarms(door, values):
    try:
        odd_arguments.called(door, values)
    except Alarm as alarm:
        yield alarm.message


def fault(name, door, values, what):
    """What is no Alarm, in a line."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            odd_arguments.called(door, values)
        except Alarm:
            pass
        except Exception as error:
            yield f"{name}({what}): {type(error).__name__}: {error!s:.80}"
