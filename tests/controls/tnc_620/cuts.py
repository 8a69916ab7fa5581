"""The rows of one cycle in lengths of the program, whatever frame the program works in: depths, and ways as straight pieces."""

import numpy as np

from mnclab import Kind


class Cuts:
    """The rows of a cycle in lengths of the program: depths below the surface, ways in the plane."""

    def __init__(self, job, path, code, tool=None):
        at = np.array([label.startswith(f"CYCL DEF {code}") for label in path.labels])
        some = at[path.label] & path.is_motion & ((path.tool == tool) if tool else True)
        self.rows, self.job, scale = path[some], job, job.frame.scale
        self.names = np.array([path.labels[k] for k in self.rows.label])
        self.start, self.end = (job.frame.in_program(each[:, :2]) for each in (self.rows.start, self.rows.end))
        self.top, self.bottom = (-each[:, 2] / scale for each in (self.rows.start, self.rows.end))
        self.rapid = self.rows.kind == Kind.RAPID
        self.flat = ~self.rapid & (abs(self.top - self.bottom) < 1e-9)

    @property
    def depths(self):
        return np.unique(np.round(self.bottom[self.flat & (self.bottom > -1)], 7))

    def at(self, depth):
        return self.flat & (abs(self.bottom - depth) < 1e-6)

    def pieces(self, some, hair):
        """The ways of some rows as straight pieces `(k, 2, 2)`, and the row of each."""
        rows, scale = self.rows[some], self.job.frame.scale
        radius = np.hypot(*(rows.start - rows.centre)[:, :2].T)
        arc = (rows.sweep != 0) & (rows.kind == Kind.ARC)
        with np.errstate(invalid="ignore"):
            most = 2 * np.arccos(np.clip(1 - hair * scale / radius, 0.5, 1))
            count = np.where(arc, np.ceil(abs(rows.sweep) / most), 1).astype(int)
        row = np.repeat(np.arange(len(count)), count)
        share = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
        share = np.stack([share, share + 1], axis=1) / count[row][:, None]
        turned = (rows.sweep * np.where(arc, rows.axis[:, 2], 0))[row][:, None] * share
        arm = (rows.start - np.where(arc[:, None], rows.centre, 0))[row, :2] @ [1, 1j]
        round_ = np.where(arc[:, None], rows.centre, 0)[row, :2] @ [1, 1j]
        places = round_[:, None] + arm[:, None] * np.exp(1j * turned)
        a, b = (each[row, :2] @ [1, 1j] for each in (rows.start, rows.end))
        places = np.where(arc[row][:, None], places, np.stack([a, b], axis=1))
        found = self.job.frame.in_program(np.stack([places.real, places.imag], axis=2))
        real = np.hypot(*(found[:, 1] - found[:, 0]).T) > 0
        return found[real], np.flatnonzero(some)[row[real]]
