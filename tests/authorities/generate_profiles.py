"""Record in profile.json how long ruckig, toppra and a linear program take for the cases of profile_cases.py.

    python3 -m venv V && V/bin/pip install ruckig==0.19.4 toppra==0.6.10 scipy
    V/bin/python tests/authorities/generate_profiles.py        (a few minutes)

ruckig (Pantor GmbH, MIT): the duration of single moves under a jerk limit. toppra (H. Pham, MIT): the time-optimal run of
a contour under the axes' accelerations, its grid finer than a degree and refined at joints. Where the curvature jumps its
answer is sometimes a little *above* the optimum, and sometimes there is none (0 here); so the same problem is also given
to a linear program (scipy, HiGHS): over parts of at most half a degree, the sum of v² at their ends as large as the limits at
both ends of every part permit. Answers are float64, little endian, in base64.
"""

import base64
import json
import math
import sys
from array import array
from pathlib import Path

import numpy as np
import ruckig
import scipy
import scipy.sparse
import toppra
from profile_cases import CONTOURS, GROUPS, accelerations, contours, moves
from scipy.optimize import linprog
from toppra.algorithm import TOPPRA
from toppra.constraint import DiscretizationType, JointAccelerationConstraint

HERE = Path(__file__).resolve().parent


def packed(values):
    numbers = array("d", values)
    if sys.byteorder == "big":
        numbers.byteswap()
    return base64.b64encode(numbers.tobytes()).decode()


def ruckig_times():
    planner, found = ruckig.Ruckig(1), []
    for length, v0, v1, v, a, j in moves():
        case, run = ruckig.InputParameter(1), ruckig.Trajectory(1)
        case.current_position, case.target_position = [0.0], [length]
        case.current_velocity, case.target_velocity = [v0], [v1]
        case.max_velocity, case.max_acceleration, case.max_jerk = [v], [a], [j]
        planner.calculate(case, run)
        found.append(run.duration)
    return found


class Contour(toppra.interpolator.AbstractGeometricPath):
    """A contour for toppra: place, tangent and curvature vector at lengths."""

    dof = 2
    waypoints = None

    def __init__(self, rows):
        self.rows, start = [], (0.0, 0.0)
        for x, y, sweep, cx, cy in rows:
            spoke = (start[0] - cx, start[1] - cy)
            length = abs(sweep) * math.hypot(*spoke) if sweep else math.dist(start, (x, y))
            self.rows.append((np.array(start), np.array((x, y)), sweep, np.array((cx, cy)), length))
            start = (x, y)
        self.ends = np.append(0.0, np.cumsum([row[4] for row in self.rows]))

    @property
    def path_interval(self):
        return np.array([0.0, self.ends[-1]])

    def on_row(self, k, u):
        """Place, tangent and curvature u mm behind the start of a row."""
        start, end, sweep, centre, length = self.rows[k]
        if not sweep:
            tangent = (end - start) / length
            return start + u * tangent, tangent, 0 * tangent
        rate = sweep / length
        c, s = math.cos(rate * u), math.sin(rate * u)
        x, y = start - centre
        spoke = np.array((c * x - s * y, s * x + c * y))
        return centre + spoke, rate * np.array((-spoke[1], spoke[0])), -(rate**2) * spoke

    def __call__(self, places, order=0):
        where = np.clip(np.searchsorted(self.ends, places, "right") - 1, 0, len(self.rows) - 1)
        one = np.atleast_1d(where)
        return np.array(
            [self.on_row(k, s - self.ends[k])[order] for k, s in zip(one, np.atleast_1d(places), strict=True)]
        )

    def parts(self, degrees):
        return [max(60, math.ceil(abs(math.degrees(row[2])) / degrees)) for row in self.rows]


def toppra_time(contour, most):
    grid = [0.0]
    for k, count in enumerate(contour.parts(0.5)):
        length = contour.rows[k][4]
        grid += [contour.ends[k] + length * i / count for i in range(1, count)]
        grid += [contour.ends[k + 1] - 1e-5 * length, contour.ends[k + 1]]
    limit = JointAccelerationConstraint(np.stack([-most, most], 1), DiscretizationType.Interpolation)
    grid = np.array(grid)
    v = TOPPRA([limit], contour, gridpoints=grid, solver_wrapper="seidel").compute_parameterization(0, 0)[1]
    return 0.0 if v is None else float(np.sum(2 * np.diff(grid) / (v[1:] + v[:-1])))


def optimum(contour, most):
    table, steps = [], []
    for k, count in enumerate(contour.parts(0.5)):
        step = contour.rows[k][4] / count
        for i in range(count):
            for end in (0, 1):
                _, tangent, curve = contour.on_row(k, (i + end) * step)
                for axis in (0, 1):
                    one = [-tangent[axis] / (2 * step), tangent[axis] / (2 * step)]
                    one[end] += curve[axis]
                    table.append((len(steps), one[0] / most[axis], one[1] / most[axis]))
            steps.append(step)
    node, first, second = (np.array(column) for column in zip(*table, strict=True))
    row = np.arange(len(node))
    shape = (len(row), len(steps) + 1)
    matrix = scipy.sparse.csr_matrix((first, (row, node.astype(int))), shape)
    matrix += scipy.sparse.csr_matrix((second, (row, node.astype(int) + 1)), shape)
    bounds = [(0, 0), *[(0, None)] * (len(steps) - 1), (0, 0)]
    both = scipy.sparse.vstack([matrix, -matrix])
    w = linprog(-np.full(shape[1], 1e-3), A_ub=both, b_ub=np.ones(2 * shape[0]), bounds=bounds, method="highs").x
    v = np.sqrt(np.maximum(w, 0.0))
    return float(np.sum(2 * np.array(steps) / (v[1:] + v[:-1])))


def main():
    toppra.setup_logging("ERROR")
    limits, best, bound = accelerations(), [], []
    for k, rows in enumerate(contours()):
        contour, most = Contour(rows), np.array(limits[k * GROUPS // CONTOURS])
        bound.append(toppra_time(contour, most))
        best.append(optimum(contour, most))
    versions = f"ruckig {ruckig.__version__}, toppra 0.6.10, scipy {scipy.__version__}"
    data = {"authority": versions, "ruckig": packed(ruckig_times()), "toppra": packed(bound), "optimum": packed(best)}
    (HERE / "profile.json").write_text(json.dumps(data, indent=1) + "\n")


if __name__ == "__main__":
    main()
