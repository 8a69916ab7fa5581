"""Settling: the passes run on the rows that a machine has made, so that the true place of the tool is known.

Settled once at the end of a run, and before anything that observes the tool: a departure, a touch, an actual position.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mnclab.machine.in_mm import in_mm
from mnclab.path import compensation, corners, feed_rules, leads, rapids
from mnclab.path.fault import PathFault
from mnclab.path.recorder import join
from mnclab.path.toolpath import Toolpath, concatenate
from mnclab.path.travel import first_beyond, stopped_at
from mnclab.text.alarm import WARNING, Alarm

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


def settle(m: Machine, unfinished: bool = False) -> None:
    """Corners, compensation, leads; `unfinished` says that an alarm broke the program off.

    A fault is an Alarm at the block of its row, and the machine notes the step from which nothing counts.
    """
    piece = m.recorder.take()
    if not len(piece):
        return
    m.programmed_pieces.append(piece)
    recorder = m.recorder
    for label in (*(joint.label for joint in recorder.joints), *([compensation.CORNER] if piece.side.any() else ())):
        recorder.label(label)
    piece = piece.annotated(labels=tuple(recorder.labels), joints=tuple(recorder.joints))
    start = end_of_settled(m)
    if start is not None and start != tuple(piece.start[0].tolist()):
        piece = piece.replace(start=np.concatenate([[start], piece.start[1:]]))
    report = compensation.Report()
    try:
        passed = _passes(m, piece, unfinished, report)
    except PathFault as fault:
        m.cut = fault.step
        m.settled.append(_before(m, piece[piece.step < fault.step]))
        for gouge in report.gouges:  # that the control does not see
            if gouge.step < fault.step:
                message = in_mm(gouge.message, m.variable_unit)
                m.alarms.append(Alarm(message, m.flow.span_of_step(gouge.step), WARNING, gouge.hint))
        raise Alarm(in_mm(fault.message, m.variable_unit), m.flow.span_of_step(fault.step), hint=fault.hint) from None
    finally:
        m.gouges += report.gouges
    for message, step, hint in report.remarks():
        m.alarms.append(Alarm(in_mm(message, m.variable_unit), m.flow.span_of_step(step), WARNING, hint))
    m.altered |= passed is not piece
    m.settled.append(passed)


def stop_at_travel(m: Machine) -> None:
    """Cut the run at the first block that leads out of the travel of the machine, as its limit switch would: an Alarm."""
    if m.setup.limits.travel is None or not m.settled:
        return
    path, travel = concatenate(m.settled), np.array(m.setup.limits.travel, dtype=np.float64)
    found = first_beyond(path, np.array(m.setup.start), travel)
    if found is None:
        return
    m.cut = int(path.step[found.row])
    m.settled = [path[path.step < m.cut]]
    axis, (low, high) = "XYZ"[found.axis], travel[found.axis].tolist()
    mm = " mm" if m.variable_unit != 1 else ""
    place = f"{axis}{found.position:.3f} in machine coordinates, and goes from {low:g} to {high:g}{mm}"
    hint = "Limits(travel=…) says how far the axes go, and counts the spindle reference, not the tip of the tool"
    message = f"{axis} leaves the travel of the machine: the spindle would be at {place}"
    alarm = Alarm(message, m.flow.span_of_step(m.cut), hint=hint)
    m.stopped = stopped_at(path, found, travel, alarm)
    raise alarm


def _passes(m: Machine, piece: Toolpath, unfinished: bool, report: compensation.Report | None = None) -> Toolpath:
    turned, gouge = corners.apply(piece, unfinished), str(m.settings.get("gouge", "refuse"))
    rules = m.control.compensation
    if rules is not None:
        rules = replace(rules.chosen(m.settings), look_ahead=rules.look_ahead or m.look_ahead)
    path = compensation.apply(turned, rules, unfinished, gouge, report)
    path = leads.apply(path, turned, unfinished)
    path = feed_rules.apply(path, m.feed_rules)
    return rapids.broken(path, m.setup.limits.rapid) if m.settings.get("rapid_path") == "broken" else path


def _before(m: Machine, piece: Toolpath) -> Toolpath:
    """The tool-centre path up to a fault; its last element ends nobody knows where and is left out."""
    try:
        return _passes(m, piece, True)
    except PathFault:
        return piece[:0]


def end_of_settled(m: Machine) -> tuple[float, float, float] | None:
    """Where the tool-centre path ends so far, machine coordinates; None before its first row."""
    for path in reversed(m.settled):
        if len(path):
            x, y, z = path.end[-1].tolist()
            return x, y, z
    return None


def paths(m: Machine) -> tuple[Toolpath, Toolpath]:
    """The programmed contour and the tool-centre path of a whole run, relative to the origin; one path if no pass acted."""
    programmed = join(m.programmed_pieces, m.recorder)
    if m.cut is not None:
        programmed = programmed[programmed.step < m.cut]
    if m.cut is None and not m.altered:
        return (_shown(m, programmed),) * 2
    return _shown(m, programmed), _shown(m, concatenate(m.settled))


def _shown(m: Machine, path: Toolpath) -> Toolpath:
    """A path relative to the origin, with the labels and joints known at the end."""
    origin = np.array(m.origin or (0.0, 0.0, 0.0))
    if origin.any() and len(path):
        vertices = np.concatenate([path.start[:1], path.end]) - origin
        centre = path.centre if path.centre.strides[0] == 0 else path.centre - origin
        path = path.replace(start=vertices[:-1], end=vertices[1:], centre=centre)
        if not np.isnan(path.surface).all():
            path = path.replace(spindle_x=path.spindle_x - origin[0])
    notes = {"labels": tuple(m.recorder.labels), "joints": tuple(m.recorder.joints), "origin": tuple(origin)}
    notes["cylinders"] = tuple(one.moved(-origin) for one in m.recorder.cylinders)
    unit = {"inches": m.variable_unit != 1, "tenths": m.feed_unit != m.variable_unit}
    return path.annotated(**notes, **unit, lathe=m.control.lathe)


def shifted(m: Machine) -> Iterator[compensation.Gouge]:
    """The places where the tool did not fit, relative to the origin of the paths."""
    for gouge in m.gouges:
        yield gouge._replace(place=tuple(np.subtract(gouge.place, m.origin or (0.0, 0.0, 0.0)).tolist()))
