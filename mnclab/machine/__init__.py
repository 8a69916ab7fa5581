"""Who obeys: the machine with its verbs, and the interpreter that hands it the words of a program.

May import `text`, `geometry`, `path`, `workpiece` and `machining`; it knows no control by name. A new verb is a
method of `Machine`; a new way of running blocks (a jump, a call) goes to `calls`.
"""
