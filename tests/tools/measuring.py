"""Processor time of works that are done in turn."""

import resource
import time
from statistics import median

ROUNDS = 5


def used():
    """Processor seconds of this process and its children."""
    both = resource.getrusage(resource.RUSAGE_SELF), resource.getrusage(resource.RUSAGE_CHILDREN)
    return sum(part.ru_utime + part.ru_stime for part in both)


def seconds(work):
    """Processor and wall seconds of a work, and its result."""
    before, clock = used(), time.perf_counter()
    result = work()
    return used() - before, time.perf_counter() - clock, result


def in_turn(*works, rounds=ROUNDS):
    """The median processor seconds of some works, done in turn; the first round warms up."""
    times = [[seconds(work)[0] for work in works] for _ in range(rounds + 1)][1:]
    return [median(column) for column in zip(*times, strict=True)]
