"""Exercises: a task and a drawing, the learner's program run, its part measured, and the next smaller step as a hint.

A learner: `mnclab.exercise("mnc-07").editor()`, or a cell `%%mnc --exercise mnc-07`; `mnclab.progress()` is the map.
A teacher: `mnclab exercise give 05 -o DIR` for the pupils, `mnclab grade DIR --html class.html` for what comes back. In nbgrader
an answer is a cell that sets a text, and the cell of tests that follows gives part of the marks by its last line:

    grade = mnclab.exercise("mnc-07").check(answer)
    print(grade)
    round(10 * grade.score)
"""
