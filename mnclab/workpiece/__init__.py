"""What the tool meets, and what is left: the blank, the milled and the turned part, removal, collisions, what a probe touches.

May import `text`, `geometry` and `path`; knows neither strategies nor machines. Of a run it knows a `Cutting`: rows, their
tools, the blank, what holds it. `milling` and `turning` make a `Workpiece` each, with the same face. A new way to describe
material is a new file here.
"""
