"""What stands before a program runs: the machine with its verbs, its setup, what controls and cycles declare.

May import `text`, `geometry`, `path`, `workpiece` and `machining`; it knows no control by name. A new verb is a
method of `Machine`; a new way of running blocks (a jump, a call) goes to `running`.
"""
