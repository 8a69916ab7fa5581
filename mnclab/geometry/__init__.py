"""Plane and space geometry on numpy arrays: frames, arcs, contours, areas.

Imports numpy alone (and shapely when areas are first asked for) and of mnclab nothing but `text`;
it knows neither tools nor programs. A new kind of curve or a new operation on shapes is a new file here.
"""
