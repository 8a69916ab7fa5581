"""Contours from parts of a program and the cycles that machine them (TNC 620, chapters 8 to 10).

`labels` and `data` are the definitions 14 and 20; `area` and `line` read what a contour describes; the others are the cycles.
"""
