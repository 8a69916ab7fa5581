"""Plane and space geometry on numpy arrays: frames, arcs, contours, areas.

Imports numpy alone (`regions` also shapely, inside functions) and nothing of mnclab outside this folder;
it knows neither tools nor programs. A new kind of curve or a new operation on shapes is a new file here.
"""
