"""Runs and paths side by side: how far one is from the other, and where.

May import ``path``, ``workpiece`` and ``machining``; knows no machine and no control.
"""
