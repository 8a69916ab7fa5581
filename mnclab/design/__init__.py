"""A part as drawn: designs, drawings, differences, and the design that is recognised in a part.

A wing: it imports the rooms of the core, which open it by name through doors only.
"""
