"""Programs of all controls, spoilt at random, and cycles with absurd values: nothing but alarms comes of them.

A small share of what `tests/fuzz.py` runs by hand.
"""

import random

import fuzz
import pytest

pytestmark = pytest.mark.deep


@pytest.mark.parametrize("hundred", range(2))
@pytest.mark.parametrize("control", fuzz.CONTROLS)
def test_spoilt_programs_raise_nothing_but_alarms(control, hundred):
    for seed in range(100 * hundred, 100 * hundred + 60):
        run = fuzz.survives(control, seed)
        if seed % 20 == 0 and len(run.toolpath) < 2000:
            for show in fuzz.SHOWN:
                fuzz.shown(run, show)


@pytest.mark.parametrize("control", fuzz.CONTROLS)
def test_absurd_values_of_cycles_raise_nothing_but_alarms(control):
    for case in random.Random(31).sample(list(fuzz.cases(control)), 150):
        fuzz.steps_survive(control, *case)
        fuzz.program_survives(control, *case)
