"""What tests of the two tiers share: a program through both, their comparison, and how much went one by one."""

import numpy as np
import pytest

import mnclab
from mnclab import Setup
from mnclab.path.toolpath import COLUMNS
from mnclab.running.interpreter import Interpreter


@pytest.fixture(scope="session")
def both():
    def run_both(text, control="mnc", **settings):
        """The same program through both tiers."""
        datums = {1: (10.5, -20.25, 3)}
        return [
            mnclab.run(text, control, Setup(datums=datums, settings={**settings, "bulk": bulk}))
            for bulk in (True, False)
        ]

    return run_both


@pytest.fixture(scope="session")
def assert_equal():
    def compare(bulk, single):
        assert [str(a) for a in bulk.alarms] == [str(a) for a in single.alarms]
        assert len(bulk.toolpath) == len(single.toolpath)
        for name in COLUMNS:
            left, right = getattr(bulk.toolpath, name), getattr(single.toolpath, name)
            assert np.allclose(left, right, rtol=0, atol=1e-12, equal_nan=True), name
        assert np.array_equal(bulk.steps.block, single.steps.block)
        assert set(bulk.history) == set(single.history)
        for name in single.history:
            for step in range(len(single.steps.block)):
                left, right = bulk.history.value(name, step), single.history.value(name, step)
                assert left == right or np.allclose(left, right, rtol=0, atol=1e-12), (name, step)
                assert (name in bulk.history.changes(step)) == (name in single.history.changes(step)), (name, step)

    return compare


@pytest.fixture(scope="session")
def executed():
    def count(text):
        """How many blocks went one by one."""
        interpreter = Interpreter(mnclab.controls["mnc"], Setup(), mnclab.read(text, "mnc"))
        interpreter.run()
        return len(interpreter.flow.steps().block) - interpreter.flow.in_bulk

    return count
